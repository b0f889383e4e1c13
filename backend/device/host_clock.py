"""Whether the host's clock was set while Spindle runs.

A machine without a battery for its clock starts in the past and gets the time once it has a
network, maybe in the middle of a ride. Unix time then moves against the time since the machine was
switched on, which nobody can set; that alone tells a clock that was set from rows that came late,
from a unit whose time is granted, and from one that runs faster than the world.
"""

from __future__ import annotations

import time

# Counts sleep, as Unix time does: a laptop that slept was not told another time. Linux keeps one
# that counts it and one that does not; the monotonic clocks of macOS and Windows do.
_STEADY = getattr(time, "CLOCK_BOOTTIME", getattr(time, "CLOCK_MONOTONIC", None))


def wall_offset_us() -> int:
    """Unix time minus the time since the host was switched on, in microseconds."""
    steady_ns = time.monotonic_ns() if _STEADY is None else time.clock_gettime_ns(_STEADY)
    return (time.time_ns() - steady_ns) // 1000
