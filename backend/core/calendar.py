"""Time zones of the IANA database; weeks and months from midnight to midnight of one."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta
from zoneinfo import ZoneInfo

from backend.errors import FieldError, InvalidRequest

PERIODS = 12
MONDAY = 1
SECOND_US = 1_000_000


@dataclass(frozen=True, slots=True)
class Period:
    """From the local midnight of its first day to that of the next one's, in Unix microseconds."""

    first_day: date
    from_us: int
    to_us: int


def require_zone(name: str) -> ZoneInfo:
    """A time zone of the IANA database. Raises InvalidRequest for a name that is none."""
    zone = zone_of(name)
    if zone is None:
        message = f"zone is {name!r}: a name of the IANA database is needed, as Europe/Dublin."
        error = FieldError("zone", "unknown_zone", message)
        raise InvalidRequest(message, code="unknown_zone", fields=[error])
    return zone


def last_weeks(now_us: int, zone: ZoneInfo, week_begins: int = MONDAY) -> tuple[Period, ...]:
    """The PERIODS weeks up to this one, the oldest first; week_begins: 1 Monday to 7 Sunday."""
    today = local_day(now_us, zone)
    begun = today - timedelta(days=(today.isoweekday() - week_begins) % 7)
    firsts = [begun + timedelta(weeks=n) for n in range(1 - PERIODS, 2)]
    return between(firsts, zone)


def last_months(now_us: int, zone: ZoneInfo) -> tuple[Period, ...]:
    """The PERIODS months up to this one, the oldest first."""
    today = local_day(now_us, zone)
    count = today.year * 12 + today.month - 1
    firsts = [date(n // 12, n % 12 + 1, 1) for n in range(count - PERIODS + 1, count + 2)]
    return between(firsts, zone)


def local_day(now_us: int, zone: ZoneInfo) -> date:
    """The day a moment is on."""
    return datetime.fromtimestamp(now_us / SECOND_US, zone).date()


def between(firsts: list[date], zone: ZoneInfo) -> tuple[Period, ...]:
    """Periods that each end where the next begins."""
    starts = [midnight_us(day, zone) for day in firsts]
    return tuple(Period(day, starts[i], starts[i + 1]) for i, day in enumerate(firsts[:-1]))


def midnight_us(day: date, zone: ZoneInfo) -> int:
    """The moment a day begins."""
    local = datetime(day.year, day.month, day.day, tzinfo=zone)
    return int(local.astimezone(UTC).timestamp()) * SECOND_US


def zone_of(name: str) -> ZoneInfo | None:
    """A time zone by its name, None when there is none of that name."""
    try:
        return ZoneInfo(name)
    except (KeyError, ValueError, OSError):
        return None
