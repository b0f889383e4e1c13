"""What happened on a ride: faults that came and went, modes the rider chose, settings that were
changed, moments somebody marked, the clock of who recorded it set.

Faults and modes are read from the ride's own rows, so that a ride shows them whichever way it came;
a unit's log also tells what began and ended between two rows. Settings are in no row: the unit
tells their change. Nor is the clock: who recorded the ride tells that.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal

import numpy as np

from backend.core.channels import ChannelSpec, Counts
from backend.core.described import described

EventKind = Literal["fault_set", "fault_cleared", "assist_mode", "settings", "mark", "clock_set"]
FAULT_SET: Final = "fault_set"
FAULT_CLEARED: Final = "fault_cleared"
ASSIST_MODE: Final = "assist_mode"
MARK: Final = "mark"
SETTINGS: Final = "settings"
CLOCK_SET: Final = "clock_set"
NOT_IN_ROWS = (MARK, SETTINGS, CLOCK_SET)
KINDS = frozenset({FAULT_SET, FAULT_CLEARED, ASSIST_MODE, *NOT_IN_ROWS})
# A loose plug makes thousands; they are in the rows all the same.
EVENTS_MAX = 200

# Each channel of faults with the bit that its bit 0 is. A ride of an older unit has only the first.
FAULTS_CHANNELS = {"fault_flags": 0, "fault_flags_high": 16}
MODE_CHANNEL = "assist_mode"


@described
class RideEvent:
    """A fault that came or went (value: bits of `fault_flags`), the mode chosen (its slot),
    settings that came into force (CRC-32 of the configuration), a moment that somebody marked (its
    number), or the host's clock set in mid-ride (by how many milliseconds, negative for back; the
    ride is dated by the clock as it was set)."""

    t_s: float
    kind: EventKind
    """The first `assist_mode` is the mode the ride began in."""
    value: int


def events_of_rows(
    channel: ChannelSpec, counts: Counts, times_us: np.ndarray[tuple[int], np.dtype[np.int64]]
) -> list[RideEvent]:
    """Changes in a channel of faults or the mode's, counts (n,); none for any other."""
    if channel.name != MODE_CHANNEL and channel.name not in FAULTS_CHANNELS:
        return []
    rows_with_values = np.flatnonzero(counts != channel.missing)
    values = np.rint(channel.to_values(counts[rows_with_values])).astype(np.int64)
    changed = np.flatnonzero(np.diff(values)) + 1
    events: list[RideEvent] = []
    if len(values):
        events += _between(channel.name, times_us[rows_with_values[0]], None, int(values[0]))
    for index in changed[:EVENTS_MAX]:
        before, after = int(values[index - 1]), int(values[index])
        events += _between(channel.name, times_us[rows_with_values[index]], before, after)
    return events[:EVENTS_MAX]


def merged(
    rows: Sequence[RideEvent], reported: Sequence[RideEvent], same_s: float
) -> list[RideEvent]:
    """What the rows show and what was reported besides, in order of time.

    same_s: so far apart they are one and the same. What is in no row is only told: of that none
    is left out, however many there are of the rest.
    """
    from_rows = _one_a_moment(rows)
    extra = [
        event
        for event in reported
        if event.kind not in NOT_IN_ROWS
        and not any(
            event.kind == other.kind
            and abs(event.t_s - other.t_s) <= same_s
            and _covers(other, event)
            for other in from_rows
        )
    ]
    shown = sorted([*from_rows, *extra], key=_time)[:EVENTS_MAX]
    marks = [event for event in reported if event.kind in (MARK, CLOCK_SET)]
    return sorted([*shown, *marks, *settings_changes(reported)], key=_time)


def settings_changes(events: Sequence[RideEvent], crc32: int | None = None) -> list[RideEvent]:
    """The events at which the settings became others, in order of time.

    crc32: of the configuration before the first of them, None where it is unknown.
    """
    changes: list[RideEvent] = []
    for event in sorted((event for event in events if event.kind == SETTINGS), key=_time):
        if event.value != crc32:
            changes.append(event)
        crc32 = event.value
    return changes


def _time(event: RideEvent) -> float:
    return event.t_s


def _one_a_moment(events: Sequence[RideEvent]) -> list[RideEvent]:
    """Faults that both channels show in the same row are one event."""
    together: dict[tuple[float, EventKind], RideEvent] = {}
    modes = []
    for event in events:
        if event.kind == ASSIST_MODE:
            modes.append(event)
            continue
        key = (event.t_s, event.kind)
        before = together.get(key)
        bits = event.value | (before.value if before else 0)
        together[key] = RideEvent(event.t_s, event.kind, bits)
    return [*together.values(), *modes]


def _between(name: str, time_us: int, before: int | None, after: int) -> list[RideEvent]:
    t_s = float(time_us) / 1e6
    if name == MODE_CHANNEL:
        return [RideEvent(t_s, ASSIST_MODE, after)]
    was, lowest = before or 0, FAULTS_CHANNELS[name]
    pairs: tuple[tuple[EventKind, int], ...] = (
        (FAULT_SET, (after & ~was) << lowest),
        (FAULT_CLEARED, (was & ~after) << lowest),
    )
    return [RideEvent(t_s, kind, bits) for kind, bits in pairs if bits]


def _covers(from_rows: RideEvent, reported: RideEvent) -> bool:
    if reported.kind == ASSIST_MODE:
        return from_rows.value == reported.value
    return from_rows.value & reported.value == reported.value
