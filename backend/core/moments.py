"""Moments: microseconds since 1970 UTC inside, ISO 8601 outside."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def utc(time_us: int) -> datetime:
    """Microseconds since 1970 UTC -> moment. Raises OverflowError past the year 9999."""
    return EPOCH + timedelta(microseconds=time_us)


def utc_or_none(time_us: int | None) -> datetime | None:
    """As `utc`; of nothing, nothing."""
    return None if time_us is None else utc(time_us)
