"""Goal: the order of dates, whose a power is and what any column is are asked for and taken through
the API; what a column cannot be is refused and changes nothing.

Method: the application over a real store and the real reader, in process; dates and header of the
files `c18d_us_ampm.csv` and `c03_wheellog.csv` that people reported.
"""

from __future__ import annotations

from typing import Any

import pytest

from backend.core.ride import Ride, iso_utc
from backend.imports.mapping import TableMapping
from backend.imports.service import Uploads
from backend.store import Store
from tests.fakes.api import api_with, client_of
from tests.unit.imports.conftest import reader

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROWS = 40
ZONE = {"time_zone": "Europe/Berlin"}
# Neither 36 V times its amperes nor beside a cadence.
POWER = "time,speed (km/h),voltage (V),power"
POWER_ROW = "2025-05-01 10:00:{n:02},20,36,1{n:02}"
POWERS = ["rider_power_w", "motor_power_w", "battery_power_w", ""]


def table(header: str, row: str) -> bytes:
    return "\n".join([header, *(row.format(n=n) for n in range(ROWS)), ""]).encode()


class Desk:
    """A table that waits for an answer, asked about and answered through the API."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._uploads = Uploads(store, reader=reader)
        mapping = TableMapping(store, self._uploads)
        self.client = client_of(api_with(uploads=self._uploads, tables=mapping))

    def send(self, header: str, row: str) -> str:
        upload = self._uploads.receive_file("table.csv", table(header, row))
        assert upload.code == "needs_mapping"
        return f"/api/v1/uploads/{upload.id}/mapping"

    def question(self, address: str) -> dict[str, Any]:
        answer: dict[str, Any] = self.client.get(address).json()
        return answer

    def say(self, address: str, **answer: object) -> dict[str, Any]:
        became = self.client.put(address, json=ZONE | answer)
        assert became.status_code == 200, became.text
        return dict(became.json())

    def ride(self, became: dict[str, Any]) -> Ride:
        (ride_id,) = became["ride_ids"]
        return self._store.rides.get(ride_id)


@pytest.fixture
def desk(store: Store) -> Desk:
    return Desk(store)


def columns(question: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {column["name"]: column for column in question["columns"]}


def channels(ride: Ride) -> set[str]:
    return {channel.name for channel in ride.channels}


@pytest.mark.parametrize(("order", "month"), [("month_first", "09-05"), ("day_first", "05-09")])
def test_a_date_of_two_readings_is_asked_and_read_as_said(
    desk: Desk, order: str, month: str
) -> None:
    address = desk.send("timestamp,speed (mph),cadence", "9/5/2025 5:12:{n:02} PM,13.42,75")
    asked = desk.question(address)

    became = desk.say(address, date_order=order)

    assert asked["date_order"] is True
    assert columns(asked)["timestamp"]["samples"][0] == "9/5/2025 5:12:00 PM"
    # Both days are of Berlin's summer time.
    assert iso_utc(desk.ride(became).started_us)[:19] == f"2025-{month}T15:12:00"
    (known,) = desk.client.get("/api/v1/tables").json()["items"]
    assert known["answer"]["date_order"] == order


def test_a_power_of_nobody_known_is_asked_and_is_whose_its_owner_says(desk: Desk) -> None:
    address = desk.send(POWER, POWER_ROW)
    asked = desk.question(address)

    became = desk.say(address, channels={"power": "battery_power_w"})

    assert columns(asked)["power"]["channels"] == POWERS
    assert channels(desk.ride(became)) & set(POWERS) == {"battery_power_w"}


def test_the_power_of_a_logger_that_is_known_is_not_asked(desk: Desk) -> None:
    header = "date,time,speed,voltage,phase_current,current,power,totaldistance,system_temp"
    address = desk.send(header, "2025-05-10,14:03:{n:02}.000,21.60,81.64,18.00,9.00,734.76,1,31")

    asked = desk.question(address)

    assert (asked["kind"], asked["date_order"]) == ("a WheelLog log", False)
    assert columns(asked)["power"]["channel"] == "battery_power_w"
    assert [one["name"] for one in asked["columns"] if one["channels"]] == []


def test_a_column_that_can_hardly_be_read_is_shown_and_left_out(desk: Desk) -> None:
    address = desk.send("time,speed (km/h),cadence", "2025-05-01 10:00:{n:02},ca. 2x{n},80")
    asked = columns(desk.question(address))["speed (km/h)"]

    became = desk.say(address, channels={"speed (km/h)": ""})

    assert asked["unread"] == ROWS
    assert (asked["samples"][0], asked["channels"]) == ("ca. 2x0", ["speed_kmh", ""])
    assert channels(desk.ride(became)) == {"cadence_rpm"}


def test_any_column_is_what_its_owner_says_in_the_unit_that_is_said(desk: Desk) -> None:
    address = desk.send("time,tempo,v2 (mph),cadence", "2025-05-01 10:00:{n:02},5,11,80")
    asked = desk.question(address)

    said = {"tempo": "speed_kmh", "cadence": "heart_rate_bpm"}
    became = desk.say(address, channels=said, units={"tempo": "m/s"})

    offered = {one["name"]: one["units"] for one in asked["offered_channels"]}
    assert offered["speed_kmh"] == ["km/h", "m/s", "mph"]
    assert offered["rider_power_w"] == []
    assert columns(asked)["v2 (mph)"]["unit"] == "mph"
    ride = desk.ride(became)
    assert {"speed_kmh", "heart_rate_bpm"} <= channels(ride)
    assert ride.summary is not None
    assert ride.summary.speed_kmh_max == pytest.approx(18.0)


def test_an_answer_that_opens_a_question_is_kept_and_the_question_asked(desk: Desk) -> None:
    """With a voltage beside it, the power may be anybody's."""
    address = desk.send("time,speed (km/h),pack,power", POWER_ROW)
    first = desk.question(address)

    waits = desk.say(address, channels={"pack": "battery_voltage_v"})
    second = desk.question(address)
    both = {"pack": "battery_voltage_v", "power": "motor_power_w"}
    became = desk.say(address, channels=both)

    assert columns(first)["power"]["channels"] == []
    assert (waits["code"], waits["ride_ids"]) == ("needs_mapping", [])
    assert columns(second)["power"]["channels"] == POWERS
    assert second["answer"]["channels"] == {"pack": "battery_voltage_v"}
    assert {"battery_voltage_v", "motor_power_w"} <= channels(desk.ride(became))


def test_a_unit_that_a_said_channel_lacks_is_asked_next(desk: Desk) -> None:
    address = desk.send("time,tempo,cadence", "2025-05-01 10:00:{n:02},5,80")

    desk.say(address, channels={"tempo": "speed_kmh"})

    tempo = columns(desk.question(address))["tempo"]
    assert (tempo["channel"], tempo["units"]) == ("speed_kmh", ["km/h", "m/s", "mph"])


@pytest.mark.parametrize(
    ("wrong", "code", "says"),
    [
        ({}, "answer_incomplete", "power"),
        ({"channels": {"power": "watts"}}, "answer_wrong", "power cannot be watts"),
        (
            {"channels": {"power": "", "pedals": "cadence_rpm"}},
            "answer_wrong",
            "no column pedals",
        ),
        ({"channels": {"power": "", "time": "cadence_rpm"}}, "answer_wrong", "time tells"),
        (
            {"channels": {"power": "speed_kmh"}, "units": {"power": "W"}},
            "answer_wrong",
            "power is in km/h, m/s, mph; not in W",
        ),
        ({"date_order": "year_first", "channels": {"power": ""}}, "invalid", "date_order"),
        ({"channels": {"power": None}}, "invalid", "channels"),
    ],
)
def test_what_cannot_be_is_refused_and_changes_nothing(
    desk: Desk, wrong: dict[str, object], code: str, says: str
) -> None:
    address = desk.send(POWER, POWER_ROW)

    refused = desk.client.put(address, json=ZONE | wrong)

    problem = refused.json()
    assert refused.status_code == 422
    assert (problem["code"], bool(problem["errors"])) == (code, True)
    assert says in problem["detail"] + problem["errors"][0]["field"]
    assert desk.client.get("/api/v1/tables").json() == {"items": []}
    assert desk.question(address)["answer"] is None


def test_a_date_that_is_asked_needs_an_order(desk: Desk) -> None:
    address = desk.send("timestamp,speed (mph)", "9/5/2025 5:12:{n:02} PM,13.42")

    refused = desk.client.put(address, json=ZONE)

    assert refused.status_code == 422
    assert [error["field"] for error in refused.json()["errors"]] == ["date_order"]
