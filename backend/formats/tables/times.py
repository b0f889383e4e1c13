"""When each row of a table was: moments, a day and a clock, seconds since something, or one row
after the other."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, timedelta, tzinfo
from itertools import islice

import numpy as np

from backend.core.channels import Values
from backend.formats.cells import number
from backend.formats.fit_numbers import EPOCH_S
from backend.formats.local_times import times_in_zone
from backend.formats.tables.dates import (
    DateOrder,
    Dates,
    dates_of,
    moment_or_written,
    serial_moments,
    time_of_day,
    unix_numbers,
)
from backend.formats.tables.layouts import Layout, since_columns, time_columns

# A date in the name of a file, as loggers call theirs, and mostly a time behind it.
NAME_DATE = re.compile(
    r"(?<!\d)(20\d\d)[-_.]?([01]\d)[-_.]?([0-3]\d)"
    r"(?:[T _.-]*(\d\d)[-_.:h]?(\d\d)[-_.:m]?(\d\d)(?!\d)|(?!\d))"
)
STOPWATCH = re.compile(r"(\d{1,3}):(\d\d)(?::(\d\d(?:[.,]\d+)?))?")
DAY_S = 86_400.0
NOON = timedelta(hours=12)
# Where the file has no date, times begin here: before any clock of a bike was set.
NOWHEN_S = EPOCH_S + 1.0
FILE_NAME, FILE_NAME_DAY, NO_DATE = "file_name", "file_name_day", "none"
ROWS_LOOKED_AT = 50
PREAMBLE_CELLS_MAX = 200


@dataclass(frozen=True)
class TimeColumns:
    """Which columns tell the time, by what stands in them.

    moment: date and time of day. day, clock: one without the other. since: seconds of a column
    that counts from something, as (place, seconds of its unit), 0 for a stopwatch like `0:01:30`.
    """

    moment: int | None = None
    day: int | None = None
    clock: int | None = None
    since: tuple[int, float] | None = None

    @property
    def places(self) -> set[int]:
        """All of them."""
        since = None if self.since is None else self.since[0]
        return {place for place in (self.moment, self.day, self.clock, since) if place is not None}


@dataclass(frozen=True)
class Times:
    """Unix time of every row (n,), NaN where it cannot be read.

    naive: some have no zone, so that one must be stated. order_open: whether day or month comes
    first must be. start_of: what the date was taken from where the rows have none: `file_name`,
    `file_name_day` (its time of day is unknown) or `none`. restarts: how often a count began anew.
    """

    time_s: Values
    naive: bool = False
    order_open: bool = False
    start_of: str | None = None
    restarts: int = 0


def columns_of_time(layout: Layout, body: Sequence[Sequence[str]]) -> TimeColumns:
    """The columns of a table that tell the time."""
    kinds = {place: kind_of(sample(body, place)) for place in time_columns(layout.names)}

    def first(kind: str) -> int | None:
        return next((place for place, one in kinds.items() if one == kind), None)

    moment, day, clock = first("moment"), first("day"), first("clock")
    since = next(
        ((place, scale) for place, scale in since_columns(layout.names)
         if kinds.get(place, "number") == "number"),
        None,
    )  # fmt: skip
    if moment is not None:
        return TimeColumns(moment=moment, since=since)
    if day is not None and clock is not None:
        return TimeColumns(day=day, clock=clock, since=since)
    if since is None and clock is not None:
        return TimeColumns(since=(clock, 0.0))
    return TimeColumns(day=day, since=since)


def sample(body: Sequence[Sequence[str]], place: int) -> list[str]:
    """The first cells of a column that hold something."""
    cells = (row[place].strip() for row in body if place < len(row))
    return list(islice((cell for cell in cells if cell), ROWS_LOOKED_AT))


def kind_of(cells: Sequence[str]) -> str | None:
    """What a column of times holds: `moment`, `day`, `clock` or `number`; None for nothing.

    One damaged cell does not decide: it is what most cells are.
    """
    kinds = [kind_of_cell(cell) for cell in cells]
    if not kinds:
        return None
    kind = max(dict.fromkeys(kinds), key=kinds.count)
    # A ride that begins at midnight has one cell that could be a day.
    return "moment" if kind == "day" and "moment" in kinds else kind


def kind_of_cell(cell: str) -> str | None:
    """As of `kind_of`, of one cell."""
    value = decimal(cell)
    if value == value:
        numbers = np.array([value])
        if np.isfinite(unix_numbers(numbers))[0]:
            return "moment"
        if serial_moments(numbers) is None:
            return "number"
        return "day" if value.is_integer() else "moment"
    read = moment_or_written(cell)
    if read is None:
        return "clock" if time_of_day(cell) is not None or STOPWATCH.fullmatch(cell) else None
    at = timedelta(hours=read.hour, minutes=read.minute, seconds=read.second) if isinstance(
        read, datetime
    ) else read.clock  # fmt: skip
    return "moment" if at or ":" in cell else "day"


def times_of(
    layout: Layout,
    body: Sequence[Sequence[str]],
    columns: TimeColumns,
    name: str,
    zone: tzinfo | None,
    order: DateOrder | None = None,
) -> Times:
    """Times of the rows, as far as the table tells them. name: of the file."""
    named = date_of_name(name)
    known_day = named[0].date() if named else None
    if columns.moment is not None:
        is_utc = "utc" in layout.names[columns.moment].lower()
        times = moments(texts(body, columns.moment), None if is_utc else zone, order, known_day)
        times = replace(times, naive=times.naive and not is_utc)
        return exact(times, columns.since, body)
    if columns.day is not None and columns.clock is not None:
        joined = joined_cells(texts(body, columns.day), texts(body, columns.clock))
        return exact(moments(joined, zone, order, known_day), columns.since, body)
    seconds, restarts = row_seconds(layout, body, columns.since)
    start = layout.start or start_of_rows(body, columns.day)
    return replace(started(seconds, start, named, zone, order), restarts=restarts)


def texts(body: Sequence[Sequence[str]], place: int) -> list[str]:
    """The cells of a column."""
    return [row[place].strip() if place < len(row) else "" for row in body]


def joined_cells(days: Sequence[str], clocks: Sequence[str]) -> list[str]:
    """Days and times of day as one cell each; nothing where either is missing."""
    return [
        f"{day} {clock}" if day and clock else "" for day, clock in zip(days, clocks, strict=True)
    ]


def moments(
    cells: Sequence[str], zone: tzinfo | None, order: DateOrder | None, known_day: date | None
) -> Times:
    """Dates with their zone, and such without in `zone`, None for UTC."""
    numbers = np.array([decimal(cell) for cell in cells], np.float64)
    unix_s = unix_numbers(numbers)
    if serial := serial_moments(numbers):
        dates = Dates(serial)
    else:
        is_read = np.isfinite(unix_s)
        words = ["" if done else cell for done, cell in zip(is_read, cells, strict=True)]
        dates = dates_of(words, order, known_day)
    seconds = np.where(np.isnan(unix_s), times_in_zone(dates.moments, zone), unix_s)
    naive = any(moment is not None and moment.tzinfo is None for moment in dates.moments)
    return Times(seconds, naive, dates.order_open)


def exact(times: Times, since: tuple[int, float] | None, body: Sequence[Sequence[str]]) -> Times:
    """Times to the microsecond where the table also counts seconds from its first row.

    Where that count begins anew the moments are right and the count is not.
    """
    if since is None or since[1] == 0.0:
        return times
    place, scale = since
    seconds = column(body, place) * scale
    valid = np.flatnonzero(np.isfinite(seconds) & np.isfinite(times.time_s))
    if not len(valid) or (np.diff(seconds[valid]) < 0).any():
        return times
    first = int(valid[0])
    return replace(times, time_s=seconds + (times.time_s[first] - seconds[first]))


def row_seconds(
    layout: Layout, body: Sequence[Sequence[str]], since: tuple[int, float] | None
) -> tuple[Values, int]:
    """Seconds since the table's beginning, NaN where a row tells none; how often they began anew.

    Behind such a beginning rows follow those before: how long the logger was off nobody knows.
    """
    if since is None:
        spacing = layout.row_s if layout.rows_are_time else None
        rows: Values = np.arange(len(body), dtype=np.float64)
        return rows * (spacing if spacing else np.nan), 0
    place, scale = since
    seconds: Values = (
        np.array([clock_seconds(cell) for cell in texts(body, place)])
        if scale == 0.0
        else column(body, place) * scale
    )
    # Over midnight a count of the day begins anew.
    steps = np.diff(seconds, prepend=seconds[:1])
    seconds = seconds + DAY_S * np.cumsum(np.nan_to_num(steps) < -DAY_S / 2)
    seconds, restarts = continued(seconds)
    pauses = [place for place, name in enumerate(layout.names) if name.lower() == layout.pause]
    if layout.pause and pauses:
        stood = np.nan_to_num(column(body, pauses[0]))
        seconds = seconds + np.concatenate(([0.0], np.cumsum(stood)[:-1]))[: len(seconds)]
    return seconds, restarts


def continued(seconds: Values) -> tuple[Values, int]:
    """A count that began anew, going on one usual step behind where it was; how often it did.

    It began anew where it fell by more than half: a row out of order falls by a step or two.
    """
    valid = np.flatnonzero(np.isfinite(seconds))
    steps = np.diff(seconds[valid])
    usual_s = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    behind = seconds[valid][1:]
    anew = (steps < -10.0 * usual_s) & (behind <= seconds[valid][:-1] / 2)
    if not anew.any():
        return seconds, 0
    moved = np.concatenate(([0.0], np.cumsum(np.where(anew, usual_s - steps, 0.0))))
    result = seconds.copy()
    result[valid] += moved
    return result, int(anew.sum())


def clock_seconds(cell: str) -> float:
    """`1:02:03` or `2:03` -> seconds, NaN for what is neither."""
    match = STOPWATCH.fullmatch(cell)
    if match is None:
        of_day = time_of_day(cell)
        return float("nan") if of_day is None else of_day.total_seconds()
    first, second, third = match.groups()
    if third is None:
        return 60.0 * int(first) + int(second)
    return 3600.0 * int(first) + 60.0 * int(second) + float(third.replace(",", "."))


def start_of_rows(body: Sequence[Sequence[str]], day: int | None) -> str:
    """The first date of a column of dates, "" for none."""
    return next(iter(sample(body, day)), "") if day is not None else ""


def started(
    seconds: Values,
    text: str,
    named: tuple[datetime, str] | None,
    zone: tzinfo | None,
    order: DateOrder | None,
) -> Times:
    """Seconds since the beginning as Unix time: by the file's start, else its name, else none.

    A count of the day, in a file whose name has the date, is of that day.
    """
    dates = dates_of([text], order, named[0].date() if named else None)
    moment, of = dates.moments[0], None
    if moment is None and named is not None:
        moment, of = named
    valid = seconds[np.isfinite(seconds)]
    begin = float(valid[0]) if len(valid) else 0.0
    if moment is None:
        return Times(seconds - begin + NOWHEN_S, start_of=NO_DATE)
    (start_s,) = times_in_zone([moment], zone)
    return Times(seconds - begin + start_s, moment.tzinfo is None, dates.order_open, of)


def date_of_name(name: str) -> tuple[datetime, str] | None:
    """The moment in a file's name and how it is known; noon where it has a date alone."""
    match = NAME_DATE.search(name)
    if match is None:
        return None
    year, month, day, *clock = match.groups()
    try:
        at = datetime(int(year), int(month), int(day))
        if clock[0] is None:
            return at + NOON, FILE_NAME_DAY
        return at.replace(hour=int(clock[0]), minute=int(clock[1]), second=int(clock[2])), FILE_NAME
    except ValueError:
        return None


def start_in_preamble(rows: Sequence[Sequence[str]]) -> str:
    """A date and time, or a date beside a time, in the rows above a table's header; "" for none."""
    cells = [cell.strip() for row in rows for cell in row][:PREAMBLE_CELLS_MAX]
    found = {kind: next((c for c in cells if c and not plain(c) and kind_of_cell(c) == kind), "")
             for kind in ("moment", "day", "clock")}  # fmt: skip
    if found["moment"]:
        return found["moment"]
    return f"{found['day']} {found['clock']}".strip() if found["day"] else ""


def plain(cell: str) -> bool:
    """Whether a cell is a number: in a preamble that is no date."""
    return number(cell) == number(cell)


def column(body: Sequence[Sequence[str]], place: int) -> Values:
    """The numbers of a column (n,), NaN for what is none."""
    return np.array([decimal(cell) for cell in texts(body, place)], np.float64)


def decimal(cell: str) -> float:
    """A number with a point or a comma; NaN for what is none."""
    return number(cell.replace(",", "."))
