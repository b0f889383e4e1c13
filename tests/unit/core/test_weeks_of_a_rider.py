"""Goal: weeks and months are the rider's own, from midnight to midnight, whatever clocks do.

Method: known changes of the IANA database; lengths of periods count hours that clocks skip.
"""

from __future__ import annotations

import zoneinfo
from datetime import UTC, date, datetime, timedelta
from itertools import pairwise
from zoneinfo import ZoneInfo

import pytest

from backend.core.calendar import last_months, last_weeks, midnight_us, require_zone
from backend.errors import InvalidRequest

HOUR_US = 3_600_000_000
DUBLIN = ZoneInfo("Europe/Dublin")


def us(text: str) -> int:
    return int(datetime.fromisoformat(text).timestamp()) * 1_000_000


def test_a_week_begins_at_local_midnight_of_monday() -> None:
    weeks = last_weeks(us("2026-07-15T12:00:00+00:00"), DUBLIN)

    assert len(weeks) == 12
    assert weeks[-1].first_day == date(2026, 7, 13)
    # Irish summer time is an hour ahead.
    assert weeks[-1].from_us == us("2026-07-12T23:00:00+00:00")
    assert all(a.to_us == b.from_us for a, b in pairwise(weeks))


def test_sunday_late_in_new_york_is_still_the_old_week() -> None:
    late = us("2026-07-13T02:00:00+00:00")

    assert last_weeks(late, ZoneInfo("America/New_York"))[-1].first_day == date(2026, 7, 6)
    assert last_weeks(late, ZoneInfo("UTC"))[-1].first_day == date(2026, 7, 13)


def test_weeks_may_begin_on_sunday() -> None:
    weeks = last_weeks(us("2026-07-15T12:00:00+00:00"), DUBLIN, week_begins=7)

    assert weeks[-1].first_day == date(2026, 7, 12)


def test_weeks_of_a_change_of_clocks_are_an_hour_longer_or_shorter() -> None:
    spring = last_weeks(us("2026-04-05T12:00:00+00:00"), DUBLIN)
    autumn = last_weeks(us("2026-10-30T12:00:00+00:00"), DUBLIN)

    hours = {w.first_day: (w.to_us - w.from_us) // HOUR_US for w in (*spring, *autumn)}
    assert hours[date(2026, 3, 23)] == 167
    assert hours[date(2026, 10, 19)] == 169
    assert hours[date(2026, 3, 30)] == 168


def test_a_midnight_that_is_leapt_over_is_the_leap() -> None:
    # Clocks of Beirut went from 0:00 to 1:00 on 2022-03-27, which was 22:00 UTC the day before.
    leap = midnight_us(date(2022, 3, 27), ZoneInfo("Asia/Beirut"))

    assert datetime.fromtimestamp(leap / 1e6, UTC).isoformat() == "2022-03-26T22:00:00+00:00"


def test_twelve_months_reach_over_new_year() -> None:
    months = last_months(us("2026-02-10T12:00:00+00:00"), DUBLIN)

    assert [m.first_day for m in months][:2] == [date(2025, 3, 1), date(2025, 4, 1)]
    assert months[-1].first_day == date(2026, 2, 1)
    assert months[-1].to_us == us("2026-03-01T00:00:00+00:00")


@pytest.mark.parametrize("name", ["", "Moon/Crater", "../etc/passwd", "/etc/passwd", "a" * 300])
def test_no_other_name_is_a_zone(name: str) -> None:
    with pytest.raises(InvalidRequest, match="IANA"):
        require_zone(name)


def test_time_zones_come_with_spindle_where_the_system_has_none(
    request: pytest.FixtureRequest,
) -> None:
    """As on Windows, and in images without a time zone database."""
    request.addfinalizer(zoneinfo.reset_tzpath)
    zoneinfo.reset_tzpath(to=())
    zoneinfo.ZoneInfo.clear_cache()

    assert require_zone("Asia/Kolkata").utcoffset(datetime(2026, 1, 1)) == timedelta(hours=5.5)
