"""Moments: microseconds since 1970 UTC inside, ISO 8601 outside; and when a clock counts as set."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def utc(time_us: int) -> datetime:
    """Microseconds since 1970 UTC -> moment. Raises OverflowError past the year 9999."""
    return EPOCH + timedelta(microseconds=time_us)


def utc_or_none(time_us: int | None) -> datetime | None:
    """As `utc`; of nothing, nothing."""
    return None if time_us is None else utc(time_us)


def microseconds(moment: datetime | None) -> int | None:
    """A time as microseconds since 1970; without a zone it is taken as UTC."""
    if moment is None:
        return None
    aware = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    return int(aware.timestamp() * 1e6)


# Whoever keeps the time by a network stays within a second, by hand within this; a date that is
# wrong by less misleads nobody.
CLOCK_SET_US = 60_000_000


def set_by_us(before_us: int, now_us: int) -> int:
    """By how much a clock was set between two of its differences to one that nobody sets, in
    microseconds; 0 where it was not."""
    by_us = now_us - before_us
    return by_us if abs(by_us) > CLOCK_SET_US else 0
