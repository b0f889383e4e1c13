"""When each row of a table was: moments, seconds since something, or one row after the other."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, tzinfo

import numpy as np

from backend.core.channels import Values
from backend.formats.cells import iso_moment, number, unix_seconds
from backend.formats.columns import LATEST_S
from backend.formats.fit_numbers import EPOCH_S
from backend.formats.tables.layouts import Layout, since_column, time_column

# Numbers that can only be Unix time, in seconds and in milliseconds.
UNIX_S, UNIX_MS = (EPOCH_S, LATEST_S), (EPOCH_S * 1000, LATEST_S * 1000)
# A date and a time in the name of a file, as loggers call theirs.
NAME_MOMENT = re.compile(
    r"(20\d\d)[-_.]?(\d\d)[-_.]?(\d\d)[T _.-]*(\d\d)[-_.:h]?(\d\d)[-_.:m]?(\d\d)"
)
CLOCK = re.compile(r"(\d{1,3}):(\d\d)(?::(\d\d(?:[.,]\d+)?))?")
DAY_S = 86_400.0
# Where the file has no date, times begin here: before any clock of a bike was set.
NOWHEN_S = EPOCH_S + 1.0
FILE_NAME, NO_DATE = "file_name", "none"


@dataclass(frozen=True)
class Times:
    """Unix time of every row (n,), NaN where it cannot be read.

    naive: some have no zone, so that one must be said. start_of: what the date was taken from where
    the rows have none: `file_name` or `none`.
    """

    time_s: Values
    naive: bool = False
    start_of: str | None = None


def times_of(
    layout: Layout, body: Sequence[Sequence[str]], name: str, zone: tzinfo | None
) -> Times:
    """Times of the rows, as far as the table tells them. name: of the file."""
    at = time_column(layout.names)
    since = since_column(layout.names)
    if at is not None and words_are_moments(body, at):
        cells = [row[at] if at < len(row) else "" for row in body]
        return exact(moments(layout.names[at], cells, zone), since, body)
    if since is None and at is not None and unit_less_clock(body, at):
        since = (at, 0.0)
    seconds = row_seconds(layout, body, since)
    return started(seconds, layout.start, name, zone)


def words_are_moments(body: Sequence[Sequence[str]], at: int) -> bool:
    """Whether a column has dates, or numbers that are Unix time."""
    for row in body[:50]:
        cell = row[at].strip() if at < len(row) else ""
        if not cell:
            continue
        value = number(cell)
        if value == value:
            return any(low <= value <= high for low, high in (UNIX_S, UNIX_MS))
        return iso_moment(cell) is not None or not CLOCK.fullmatch(cell)
    return True


def unit_less_clock(body: Sequence[Sequence[str]], at: int) -> bool:
    """Whether a column has times of day or of a stopwatch: `0:01:30`."""
    return any(CLOCK.fullmatch(row[at].strip()) for row in body[:50] if at < len(row))


def moments(name: str, cells: Sequence[str], zone: tzinfo | None) -> Times:
    """Dates with their zone, and such without in `zone`."""
    is_utc = "utc" in name.lower()
    naive = False
    seconds = np.full(len(cells), np.nan)
    for row, cell in enumerate(cells):
        value = number(cell)
        if value == value:
            seconds[row] = value / 1000.0 if value >= UNIX_MS[0] else value
            continue
        moment = iso_moment(cell)
        if moment is not None and moment.tzinfo is None:
            naive |= not is_utc
            moment = moment.replace(tzinfo=UTC if is_utc or zone is None else zone)
        seconds[row] = unix_seconds(moment)
    return Times(seconds, naive)


def exact(times: Times, since: tuple[int, float] | None, body: Sequence[Sequence[str]]) -> Times:
    """Times to the microsecond where the table also counts seconds from its first row."""
    if since is None:
        return times
    place, scale = since
    seconds = column(body, place) * scale
    valid = np.flatnonzero(np.isfinite(seconds) & np.isfinite(times.time_s))
    if not len(valid):
        return times
    first = int(valid[0])
    return Times(seconds + (times.time_s[first] - seconds[first]), times.naive)


def row_seconds(
    layout: Layout, body: Sequence[Sequence[str]], since: tuple[int, float] | None
) -> Values:
    """Seconds since the table's beginning, NaN where a row tells none."""
    if since is None:
        spacing = layout.row_s if layout.rows_are_time else None
        return np.arange(len(body), dtype=np.float64) * (spacing if spacing else np.nan)
    place, scale = since
    cells = [row[place].strip() if place < len(row) else "" for row in body]
    seconds: Values = (
        np.array([clock_seconds(cell) for cell in cells])
        if scale == 0.0
        else np.array([number(cell.replace(",", ".")) for cell in cells]) * scale
    )
    # Over midnight a count of the day begins anew.
    steps = np.diff(seconds, prepend=seconds[:1])
    seconds = seconds + DAY_S * np.cumsum(np.nan_to_num(steps) < -DAY_S / 2)
    pauses = [place for place, name in enumerate(layout.names) if name.lower() == layout.pause]
    if layout.pause and pauses:
        stood = np.nan_to_num(column(body, pauses[0]))
        seconds = seconds + np.concatenate(([0.0], np.cumsum(stood)[:-1]))[: len(seconds)]
    return seconds


def clock_seconds(cell: str) -> float:
    """`1:02:03` or `2:03` -> seconds, NaN for what is neither."""
    match = CLOCK.fullmatch(cell)
    if match is None:
        return float("nan")
    first, second, third = match.groups()
    if third is None:
        return 60.0 * int(first) + int(second)
    return 3600.0 * int(first) + 60.0 * int(second) + float(third.replace(",", "."))


def started(seconds: Values, text: str, name: str, zone: tzinfo | None) -> Times:
    """Seconds since the beginning as Unix time: by the file's start, else its name, else none.

    A count of the day, in a file whose name has the date, is of that day.
    """
    moment, of = iso_moment(text), None
    if moment is None:
        moment, of = moment_of_name(name), FILE_NAME
    if moment is None:
        first = seconds[np.isfinite(seconds)]
        shift = float(first[0]) if len(first) else 0.0
        return Times(seconds - shift + NOWHEN_S, start_of=NO_DATE)
    naive = moment.tzinfo is None
    aware = moment.replace(tzinfo=zone or UTC) if naive else moment
    valid = seconds[np.isfinite(seconds)]
    begin = float(valid[0]) if len(valid) else 0.0
    return Times(seconds - begin + unix_seconds(aware), naive, of)


def moment_of_name(name: str) -> datetime | None:
    """The date and time in a file's name, None for none."""
    match = NAME_MOMENT.search(name)
    if match is None:
        return None
    try:
        return datetime(*map(int, match.groups()))  # type: ignore[arg-type]
    except ValueError:
        return None


def column(body: Sequence[Sequence[str]], place: int) -> Values:
    """The numbers of a column (n,), NaN for what is none."""
    return np.array([number(row[place].replace(",", ".")) if place < len(row) else np.nan
                     for row in body], np.float64)  # fmt: skip
