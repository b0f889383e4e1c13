"""Goal: whichever way a table or a track writes its times, they are the moments it means.

Method: small tables and tracks written here, each with the same ride; the right moments are those
that Python's own zone database gives for the wall clock.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from zoneinfo import ZoneInfo

import numpy as np
import pytest

from backend.formats.formats import read_file
from backend.formats.outcome import ImportedRide
from backend.formats.questions import TableAnswer

MADRID = ZoneInfo("Europe/Madrid")
BEGAN = datetime(2025, 7, 4, 18, 5, 9, tzinfo=MADRID)
ROWS = 40


def table(header: str, row: str, *, start: datetime = BEGAN, rows: int = ROWS) -> bytes:
    """A ride with a row a second. row: a pattern of strftime, `{n}` the row's number."""
    lines = [header]
    for n in range(rows):
        wall = start + timedelta(seconds=n)
        lines.append(wall.strftime(row.replace("{n}", str(n))))
    return "\n".join(lines).encode()


def ride_of(data: bytes, name: str = "ride.csv", **says: object) -> ImportedRide:
    answer = TableAnswer(**{"time_zone": "Europe/Madrid", **says})  # type: ignore[arg-type]
    outcome = read_file(name, data, answer)
    assert outcome.state == "complete", outcome
    (ride,) = outcome.rides
    return ride


def began(ride: ImportedRide) -> datetime:
    return datetime.fromtimestamp(ride.started_us / 1e6, UTC)


@pytest.mark.parametrize(
    "row",
    [
        "%Y-%m-%d %H:%M:%S",
        "%d.%m.%Y %H:%M:%S",
        '"%d.%m.%y, %H:%M:%S"',
        '"4. Juli 2025, %H:%M:%S"',
        '"4 de julio de 2025 %H:%M:%S"',
        "4 juil. 2025 %H:%M:%S",
        "04-Jul-2025 %H:%M:%S",
        "Jul 4 2025 06:%M:%S PM",
        '"Jul 4, 2025, 6:%M:%S p.m."',
        "Fri Jul 04 %H:%M:%S 2025",
        "%Y/%m/%d %H:%M:%S",
        "%Y%m%dT%H%M%S",
    ],
)
def test_a_date_in_words_or_numbers_is_that_date(row: str) -> None:
    ride = ride_of(table("time,speed (km/h)", row + ",{n}"))

    assert began(ride) == BEGAN.astimezone(UTC)
    assert len(ride.rows.times_us) == ROWS


@pytest.mark.parametrize("digits", [0, 3, 6, 9])
def test_unix_time_is_read_whatever_its_unit(digits: int) -> None:
    unix = [int(BEGAN.timestamp() + n) * 10**digits for n in range(ROWS)]
    data = "time,speed (km/h)\n" + "\n".join(f"{at},{n}" for n, at in enumerate(unix))

    assert began(ride_of(data.encode())) == BEGAN.astimezone(UTC)


def test_a_spreadsheet_counts_days_since_1899() -> None:
    """45842 is 2025-07-04 (Microsoft: serial number 1 is 1900-01-01, with a 29 February 1900)."""
    day = 45842 + (18 * 3600 + 5 * 60 + 9) / 86400
    data = "Zeit;Geschwindigkeit (km/h)\n" + "\n".join(
        f"{day + n / 86400:.8f};{n}".replace(".", ",") for n in range(ROWS)
    )

    assert abs(began(ride_of(data.encode())) - BEGAN.astimezone(UTC)) < timedelta(milliseconds=10)


def test_the_date_may_stand_in_a_column_of_its_own_in_the_preamble_or_in_the_name() -> None:
    own = table("date,time,speed (km/h)", "%d/%m/%Y,%H:%M:%S,{n}", start=BEGAN.replace(day=14))
    preamble = b"Start;2025-07-04 18:05:09\n" + table("seconds;speed (km/h)", "{n};{n}")
    name = table("seconds,speed (km/h)", "{n},{n}")

    assert began(ride_of(own)) == BEGAN.replace(day=14).astimezone(UTC)
    assert began(ride_of(preamble)) == BEGAN.astimezone(UTC)
    assert began(ride_of(name, "log_2025-07-04_18-05-09.csv")) == BEGAN.astimezone(UTC)


def test_three_four_is_asked_and_a_thirteenth_answers_for_all() -> None:
    april = datetime(2025, 4, 3, 10, 0, tzinfo=MADRID)
    doubtful = table("time,speed (km/h)", "%d/%m/%Y %H:%M:%S,{n}", start=april)
    asked = read_file("ride.csv", doubtful, TableAnswer("Europe/Madrid"))

    assert asked.code == "needs_mapping"
    assert asked.question is not None
    assert asked.question.date_order
    assert began(ride_of(doubtful, date_order="day_first")) == april.astimezone(UTC)
    march = april.replace(month=3, day=4)
    assert began(ride_of(doubtful, date_order="month_first")) == march.astimezone(UTC)
    late = april.replace(day=13)
    shown = table("time,speed (km/h)", "%d/%m/%Y %H:%M:%S,{n}", start=late)
    assert began(ride_of(shown)) == late.astimezone(UTC)
    named = ride_of(doubtful, "2025-04-03.csv")
    assert began(named) == april.astimezone(UTC)


# Where clocks go back: an hour in Berlin, half an hour on Lord Howe Island.
BACK = {
    "Europe/Berlin": datetime(2025, 10, 26, 2, 50),
    "Australia/Lord_Howe": datetime(2025, 4, 6, 1, 40),
}


@pytest.mark.parametrize("zone", BACK)
def test_the_hour_that_comes_twice_is_ridden_twice(zone: str) -> None:
    """Two hours from ten or twenty minutes before the clocks go back, a row every ten seconds."""
    first = BACK[zone].replace(tzinfo=ZoneInfo(zone), fold=0)
    unix = [int(first.timestamp()) + 10 * n for n in range(720)]
    wall = [datetime.fromtimestamp(at, ZoneInfo(zone)) for at in unix]
    rows = "\n".join(f"{at:%Y-%m-%d %H:%M:%S},{n % 30}" for n, at in enumerate(wall))

    ride = ride_of(f"time,speed (km/h)\n{rows}".encode(), time_zone=zone)

    assert ride.started_us == unix[0] * 1_000_000
    assert ride.rows.times_us.tolist() == [(at - unix[0]) * 1_000_000 for at in unix]


def test_a_tcx_without_a_zone_goes_through_the_doubled_hour_too() -> None:
    zone = ZoneInfo("Europe/Berlin")
    unix = [int(BACK["Europe/Berlin"].replace(tzinfo=zone).timestamp()) + 60 * n for n in range(90)]
    points = "".join(
        f"<Trackpoint><Time>{datetime.fromtimestamp(at, zone):%Y-%m-%dT%H:%M:%S}</Time>"
        f"<DistanceMeters>{300 * n}</DistanceMeters></Trackpoint>"
        for n, at in enumerate(unix)
    )
    data = (
        "<TrainingCenterDatabase><Activities><Activity Sport='Biking'>"
        f"<Lap StartTime='{datetime.fromtimestamp(unix[0], zone):%Y-%m-%dT%H:%M:%S}'>"
        f"<Track>{points}</Track></Lap></Activity></Activities></TrainingCenterDatabase>"
    )

    ride = ride_of(data.encode(), "ride.tcx", time_zone="Europe/Berlin")

    assert ride.rows.times_us.tolist() == [(at - unix[0]) * 1_000_000 for at in unix]
    assert ride.metadata.laps[0].to_s == unix[-1] - unix[0]


def test_seconds_that_begin_at_zero_again_go_on_where_they_were() -> None:
    data = "seconds,speed (km/h)\n" + "\n".join(
        f"{n},{20 + n % 3}" for part in (300, 200) for n in range(part)
    )

    ride = ride_of(data.encode(), "log_2025-07-04_18-05-09.csv")

    assert np.diff(ride.rows.times_us).tolist() == [1_000_000] * 499
    assert ride.intake is not None
    assert ride.intake.restarts == {"time": 1}
