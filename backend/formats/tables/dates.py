"""Dates and times of day as people and their programs write them.

ISO 8601; day, month and year in numbers with points, slashes or dashes, month names of English and
its neighbours, clocks of 12 and 24 hours; days since 1899-12-30, as spreadsheets count; Unix time
in seconds to nanoseconds. Whether 03/04 is in March or April a column shows by a day above 12, by
the date in the file's name, or by its points (no country puts a month first there); else it is
asked. Not dateutil: it decides that cell by cell, and takes `12` for a date.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta, timezone
from typing import Literal

import numpy as np

from backend.core.channels import Values
from backend.formats.cells import iso_moment
from backend.formats.columns import LATEST_S
from backend.formats.fit_numbers import EPOCH_S

DateOrder = Literal["day_first", "month_first"]
# Digits of Unix time: unit -> seconds.
UNIX_UNITS = (1.0, 1e-3, 1e-6, 1e-9)
# 1990 to 2099 in days of a spreadsheet.
SERIAL_DAYS = (32_874.0, 73_050.0)
SERIAL_EPOCH = datetime(1899, 12, 30)
LONGEST_CELL = 60

MONTHS = {
    name: number
    for number, names in enumerate(
        (
            "jan january januar janvier enero gennaio januari",
            "feb february februar februari févr fév février febrero febbraio",
            "mar march mär märz mrz mars marzo maart mrt",
            "apr april avr avril abril aprile",
            "may mai mayo maggio mei",
            "jun june juni juin junio giugno",
            "jul july juli juil juillet julio luglio",
            "aug august août agosto augustus",
            "sep sept september septembre septiembre settembre",
            "oct october okt oktober octobre octubre ottobre",
            "nov november novembre noviembre",
            "dec december dez dezember déc décembre diciembre dicembre",
        ),
        1,
    )
    for name in names.split()
}
CLOCK = r"(\d{1,2})[:.h](\d\d)(?:[:.m](\d\d)(?:[.,:](\d{1,9}))?)?s?\s*(?:([ap])\.?\s?m\.?)?"
ZONE = r"\s*(z|utc|gmt|[+-]\d\d:?\d\d)?"
AFTER_DATE = r"(?:(?:\s*,\s*|\s+(?:at\s+|um\s+|-\s+)?|T)" + CLOCK + ZONE + r")?"
NUMERIC = re.compile(r"(\d{1,4})([./-])(\d{1,2})\2(\d{1,4})" + AFTER_DATE, re.IGNORECASE)
DAY_MONTH = re.compile(
    r"(?:[^\W\d]+\.?,?\s+)?(\d{1,2})\.?[\s-]+(?:de\s+)?([^\W\d]+)\.?,?[\s-]+(?:del?\s+)?(\d{2,4})"
    + AFTER_DATE,
    re.IGNORECASE,
)
MONTH_DAY = re.compile(
    r"(?:[^\W\d]+\.?,?\s+)?([^\W\d]+)\.?\s+(\d{1,2}),?\s+(?:" + CLOCK + ZONE + r"\s+)?(\d{4})"
    + AFTER_DATE,
    re.IGNORECASE,
)  # fmt: skip
TIME_OF_DAY = re.compile(CLOCK + ZONE, re.IGNORECASE)


@dataclass(frozen=True)
class Written:
    """A date whose order of day and month may be open: a numeric one of two small numbers."""

    first: int
    second: int
    year: int
    clock: timedelta
    zone: timezone | None
    with_points: bool


@dataclass(frozen=True)
class Dates:
    """moments: of every cell, without a zone where it names none, None where it cannot be read.

    order_open: the column does not show whether the day or the month comes first.
    """

    moments: list[datetime | None]
    order_open: bool = False


def dates_of(
    cells: Sequence[str], order: DateOrder | None = None, known_day: date | None = None
) -> Dates:
    """The moments of a column. order: as its owner stated it. known_day: that the ride is of."""
    read = [moment_or_written(cell) for cell in cells]
    open_ones = [one for one in read if isinstance(one, Written)]
    if not open_ones:
        return Dates([one if isinstance(one, datetime) else None for one in read])
    shown = shown_order(open_ones, known_day)
    order = shown or order
    moments = [in_order(one, order or "day_first") if isinstance(one, Written) else one
               for one in read]  # fmt: skip
    return Dates(moments, shown is None and is_open(open_ones))


def moment_or_written(cell: str) -> datetime | Written | None:
    """One cell; None for what is no date."""
    text = cell.strip()
    if not text or len(text) > LONGEST_CELL:
        return None
    moment = iso_moment(text)
    if moment is not None:
        return moment
    if match := NUMERIC.fullmatch(text):
        first, mark, second, third = match.group(1, 2, 3, 4)
        clock, zone = clock_of(match.groups()[4:10])
        if clock is None:
            return None
        if len(first) == 4:
            return moment_at(int(first), int(second), int(third), clock, zone)
        if len(third) not in (2, 4) or len(first) > 2:
            return None
        year = int(third) if len(third) == 4 else 2000 + int(third)
        return Written(int(first), int(second), year, clock, zone, mark == ".")
    return with_month_name(text)


def with_month_name(text: str) -> datetime | None:
    """`5 Sep 2025 17:12:01`, `Sep 5, 2025 5:12 PM`, `Fri Sep 5 17:12:01 2025`; None for others."""
    if match := DAY_MONTH.fullmatch(text):
        day, name, year, *rest = match.groups()
        clock, zone = clock_of(rest)
    elif match := MONTH_DAY.fullmatch(text):
        name, day, *rest = match.groups()
        year = rest[6]
        clock, zone = clock_of(rest[:6] if rest[0] is not None else rest[7:])
    else:
        return None
    month = MONTHS.get(name.lower())
    if month is None or clock is None:
        return None
    full_year = int(year) if len(year) == 4 else 2000 + int(year)
    return moment_at(full_year, month, int(day), clock, zone)


def clock_of(groups: Sequence[str | None]) -> tuple[timedelta | None, timezone | None]:
    """The time of day of a match; midnight where it has none, None where it cannot be one."""
    hour, minute, second, fraction, half, zone = groups
    if hour is None:
        return timedelta(0), None
    hours = int(hour)
    if half is not None:
        if not 1 <= hours <= 12:
            return None, None
        hours = hours % 12 + (12 if half.lower() == "p" else 0)
    if hours > 24 or int(minute or 0) > 59 or int(second or 0) > 60:
        return None, None
    microseconds = round(float(f"0.{fraction}") * 1e6) if fraction else 0
    clock = timedelta(
        hours=hours, minutes=int(minute or 0), seconds=int(second or 0), microseconds=microseconds
    )
    return clock, zone_of_text(zone)


def zone_of_text(text: str | None) -> timezone | None:
    """`Z`, `UTC`, `+02:00` -> the zone; None where none is named."""
    if not text:
        return None
    if text[0] not in "+-":
        return UTC
    sign = -1 if text[0] == "-" else 1
    return timezone(sign * timedelta(hours=int(text[1:3]), minutes=int(text[-2:])))


def moment_at(
    year: int, month: int, day: int, clock: timedelta, zone: timezone | None
) -> datetime | None:
    """A moment; None for a day that no calendar has."""
    try:
        return datetime(year, month, day, tzinfo=zone) + clock
    except (ValueError, OverflowError):
        return None


def in_order(written: Written, order: DateOrder) -> datetime | None:
    """A numeric date read in an order."""
    day, month = written.first, written.second
    if order == "month_first":
        day, month = month, day
    return moment_at(written.year, month, day, written.clock, written.zone)


def shown_order(dates: Sequence[Written], known_day: date | None) -> DateOrder | None:
    """The order that a column shows of itself; None for none."""
    if any(one.first > 12 or one.with_points for one in dates):
        return "day_first"
    if any(one.second > 12 for one in dates):
        return "month_first"
    if known_day is not None:
        for one in dates:
            if one.year == known_day.year and one.first != one.second:
                if (one.first, one.second) == (known_day.day, known_day.month):
                    return "day_first"
                if (one.first, one.second) == (known_day.month, known_day.day):
                    return "month_first"
    return None


def is_open(dates: Iterable[Written]) -> bool:
    """Whether the order makes a difference."""
    return any(one.first != one.second for one in dates)


def time_of_day(cell: str) -> timedelta | None:
    """`17:12:01`, `5:12 PM` -> since midnight; None for what is no time of day."""
    match = TIME_OF_DAY.fullmatch(cell.strip())
    return clock_of(match.groups())[0] if match else None


def unix_numbers(numbers: Values) -> Values:
    """Numbers (n,) that are Unix time of any unit, as seconds; NaN for the others."""
    seconds: Values = np.full(len(numbers), np.nan)
    for unit in UNIX_UNITS:
        scaled = numbers * unit
        fits = np.isnan(seconds) & (scaled >= EPOCH_S) & (scaled <= LATEST_S)
        seconds[fits] = scaled[fits]
    return seconds


def serial_moments(numbers: Values) -> list[datetime | None] | None:
    """Numbers (n,) that count days since 1899-12-30; None where they are something else."""
    finite = numbers[np.isfinite(numbers)]
    if not len(finite) or not ((finite >= SERIAL_DAYS[0]) & (finite <= SERIAL_DAYS[1])).all():
        return None
    # A cell has so few digits that a millisecond is the best of it.
    return [
        SERIAL_EPOCH + timedelta(milliseconds=round(days * 86_400_000)) if days == days else None
        for days in numbers.tolist()
    ]
