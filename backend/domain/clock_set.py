"""When a clock counts as set, rather than kept."""

from __future__ import annotations

# Whoever keeps the time by a network stays within a second, by hand within this; a date that is
# wrong by less misleads nobody.
CLOCK_SET_US = 60_000_000


def set_by_us(before_us: int, now_us: int) -> int:
    """By how much a clock was set between two of its differences to one that nobody sets, in
    microseconds; 0 where it was not."""
    by_us = now_us - before_us
    return by_us if abs(by_us) > CLOCK_SET_US else 0
