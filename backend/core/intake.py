"""What became of every row and field of a file: kept, or listed here with the reason."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

# Why a row is not in the ride.
NO_TIME = "no_time"
CLOCK_NOT_SET = "clock_not_set"
CLOCK_JUMPED = "clock_jumped"
NO_VALUE = "no_value"


@dataclass(frozen=True)
class Intake:
    """Counts of one ride of a file: rows_read = rows_kept + rows_joined + all that was dropped.

    rows_joined: of one time, each with a part of the values. rows_spread: of one time with values
    of their own, which stand evenly within it. rows_moved: how often the clock went back, and
    rows were put in order. rows_dropped: by reason. values_dropped: by channel,
    what no bike can do. fields_unread: by name, in how many rows: text, bytes and lists of numbers.
    taken_as: what the file does not say, and was taken as: `time_zone`, `rows_per_second`, a
    column's unit, as `start` where the date is from: `file_name`, or `none`, and as `clock` the
    zone that its two clocks, one of UTC, are apart.
    """

    rows_read: int = 0
    rows_kept: int = 0
    rows_joined: int = 0
    rows_spread: int = 0
    rows_moved: int = 0
    rows_dropped: Mapping[str, int] = field(default_factory=dict)
    values_dropped: Mapping[str, int] = field(default_factory=dict)
    fields_unread: Mapping[str, int] = field(default_factory=dict)
    taken_as: Mapping[str, str] = field(default_factory=dict)
