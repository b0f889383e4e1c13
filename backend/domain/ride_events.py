"""What happened on a ride: faults that came and went, modes the rider chose.

They are read from the ride's own rows, so that a ride shows them whichever way it came; a unit's
log also tells what began and ended between two rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.domain.channels import ChannelSpec, Counts

FAULT_SET = "fault_set"
FAULT_CLEARED = "fault_cleared"
ASSIST_MODE = "assist_mode"
# A loose plug makes thousands; they are in the rows all the same.
EVENTS_MAX = 200

FAULTS_CHANNEL = "fault_flags"
MODE_CHANNEL = "assist_mode"


@dataclass(frozen=True, slots=True)
class RideEvent:
    """Something that happened, t_s seconds after the ride's start.

    kind: `fault_set` or `fault_cleared` with the faults' bits as value, `assist_mode` with the
    slot of the rider's switch; the first of these is the mode the ride began in.
    """

    t_s: float
    kind: str
    value: int


def events_of_rows(
    channel: ChannelSpec, counts: Counts, times_us: np.ndarray[tuple[int], np.dtype[np.int64]]
) -> list[RideEvent]:
    """Changes in the faults' or the mode's channel, counts (n,); none for any other."""
    if channel.name not in (FAULTS_CHANNEL, MODE_CHANNEL):
        return []
    there = np.flatnonzero(counts != channel.missing)
    values = np.rint(channel.to_values(counts[there])).astype(np.int64)
    changed = np.flatnonzero(np.diff(values)) + 1
    found: list[RideEvent] = []
    if len(values):
        found += _between(channel.name, times_us[there[0]], None, int(values[0]))
    for index in changed[:EVENTS_MAX]:
        before, after = int(values[index - 1]), int(values[index])
        found += _between(channel.name, times_us[there[index]], before, after)
    return found[:EVENTS_MAX]


def merged(seen: Sequence[RideEvent], told: Sequence[RideEvent], same_s: float) -> list[RideEvent]:
    """What the rows show and what was told besides, in order of time.

    same_s: so far apart they are one and the same.
    """
    extra = [
        event
        for event in told
        if not any(
            event.kind == other.kind
            and abs(event.t_s - other.t_s) <= same_s
            and _covers(other, event)
            for other in seen
        )
    ]
    return sorted([*seen, *extra], key=lambda event: event.t_s)[:EVENTS_MAX]


def _between(name: str, time_us: int, before: int | None, after: int) -> list[RideEvent]:
    t_s = float(time_us) / 1e6
    if name == MODE_CHANNEL:
        return [RideEvent(t_s, ASSIST_MODE, after)]
    was = before or 0
    pairs = ((FAULT_SET, after & ~was), (FAULT_CLEARED, was & ~after))
    return [RideEvent(t_s, kind, bits) for kind, bits in pairs if bits]


def _covers(seen: RideEvent, told: RideEvent) -> bool:
    if told.kind == ASSIST_MODE:
        return seen.value == told.value
    return seen.value & told.value == told.value
