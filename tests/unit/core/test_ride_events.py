"""Goal: what happened on a ride is told once, at its time, whichever way the ride came.

Rows are written here; bits are those of the registry's fault_flags.
"""

from __future__ import annotations

import numpy as np

from backend.core.channels import ChannelSpec
from backend.core.ride_events import RideEvent, events_of_rows, merged

FAULTS = ChannelSpec("fault_flags", "", 1.0)
FAULTS_HIGH = ChannelSpec("fault_flags_high", "", 1.0)
MODE = ChannelSpec("assist_mode", "", 1.0)
PERIOD_US = 100_000


def found(channel: ChannelSpec, *values: int | None) -> list[tuple[float, str, int]]:
    counts = np.array([channel.missing if v is None else v for v in values], np.int16)
    times_us = np.arange(len(values), dtype=np.int64) * PERIOD_US
    return [(e.t_s, e.kind, e.value) for e in events_of_rows(channel, counts, times_us)]


def test_a_fault_is_told_when_it_comes_and_when_it_goes() -> None:
    assert found(FAULTS, 0, 0, 4, 6, 6, 2, 0) == [
        (0.2, "fault_set", 4),
        (0.3, "fault_set", 2),
        (0.5, "fault_cleared", 4),
        (0.6, "fault_cleared", 2),
    ]


def test_one_fault_that_takes_the_place_of_another_is_two_events() -> None:
    assert found(FAULTS, 1, 2) == [
        (0.0, "fault_set", 1),
        (0.1, "fault_set", 2),
        (0.1, "fault_cleared", 1),
    ]


def test_faults_of_both_channels_in_one_row_are_one_event() -> None:
    counts, high = np.array([0, 2, 0], np.int16), np.array([0, 1, 1], np.int16)
    times_us = np.arange(3, dtype=np.int64) * PERIOD_US
    rows = [*events_of_rows(FAULTS, counts, times_us), *events_of_rows(FAULTS_HIGH, high, times_us)]

    together = merged(rows, [RideEvent(0.1, "fault_set", 0x10002)], 0.2)

    assert [(e.t_s, e.kind, e.value) for e in together] == [
        (0.1, "fault_set", 0x10002),
        (0.2, "fault_cleared", 2),
    ]


def test_the_mode_a_ride_began_in_is_told_and_then_every_other() -> None:
    assert found(MODE, 2, 2, 3, 3, 2) == [
        (0.0, "assist_mode", 2),
        (0.2, "assist_mode", 3),
        (0.4, "assist_mode", 2),
    ]


def test_a_gap_is_no_change() -> None:
    assert found(FAULTS, 4, None, None, 4, 0) == [(0.0, "fault_set", 4), (0.4, "fault_cleared", 4)]
    assert found(MODE, None, None) == []


def test_channels_of_numbers_have_no_events() -> None:
    assert found(ChannelSpec("speed_kmh", "km/h", 0.01), 1, 2, 3) == []


def test_what_a_log_tells_of_a_change_that_the_rows_show_is_the_same_change() -> None:
    seen = [RideEvent(1.0, "fault_set", 6), RideEvent(2.0, "assist_mode", 3)]
    told = [
        RideEvent(0.91, "fault_set", 2),
        RideEvent(1.95, "assist_mode", 3),
        RideEvent(1.95, "assist_mode", 4),
        RideEvent(1.5, "fault_set", 2),
        RideEvent(0.95, "fault_cleared", 2),
    ]

    together = merged(seen, told, 0.2)

    assert [(event.t_s, event.kind, event.value) for event in together] == [
        (0.95, "fault_cleared", 2),
        (1.0, "fault_set", 6),
        (1.5, "fault_set", 2),
        (1.95, "assist_mode", 4),
        (2.0, "assist_mode", 3),
    ]
