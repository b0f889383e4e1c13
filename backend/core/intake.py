"""What became of every row and field of a file: kept, or listed here with the reason."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from backend.core.described import described

# Why a row is not in the ride.
NO_TIME = "no_time"
CLOCK_NOT_SET = "clock_not_set"
CLOCK_JUMPED = "clock_jumped"
NO_VALUE = "no_value"


@described
class Intake:
    """What became of every row and field of the file: kept, or counted here with the reason.

    rows_read = rows_kept + rows_joined + the sum of rows_dropped.
    """

    rows_read: int = 0
    rows_kept: int = 0
    rows_joined: int = 0
    """Of one time, each with a part of the values."""
    rows_spread: int = 0
    """Of one time with values of their own; they stand evenly within it."""
    rows_moved: int = 0
    """How often the clock went back."""
    rows_dropped: Mapping[str, int] = field(default_factory=dict)
    """By reason: no_time, clock_not_set, clock_jumped, no_value."""
    values_dropped: Mapping[str, int] = field(default_factory=dict)
    """By channel: what no bike can do, single samples far from both neighbours, positions that
    nobody could have reached."""
    restarts: Mapping[str, int] = field(default_factory=dict)
    """By channel, or `time`: how often a count began anew; it goes on where it was."""
    turned: tuple[str, ...] = ()
    """Channels whose sign was turned: a controller mounted the other way round."""
    fields_unread: Mapping[str, int] = field(default_factory=dict)
    """By name, in how many rows: text, bytes and lists of numbers."""
    taken_as: Mapping[str, str] = field(default_factory=dict)
    """What the file does not say, and what it was taken as: `time_zone`, `rows_per_second`,
    `date_order`, a column's unit, its channel or `left out`. `start`: where its date is from.
    `clock`: the zone that its two clocks, one of UTC, are apart."""
