"""Goal: a unit of another make works as far as it can, and what it cannot do is refused by name.

Method: the whole server, in this process, with a second family: eight settings, no clock, no trial,
no serial number (tests/fakes/tiny), behind a real TCP port.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from websockets.sync.client import connect

from backend.device.families import FAMILIES
from tests.fakes.server import ServerHere, SpindleServer, eventually
from tests.fakes.tiny.motor import SETTINGS, TinyMotor, listening
from tests.fakes.tiny.unit import TinyUnit

# A server and a unit for every test: left out of `make test-fast`.
pytestmark = [pytest.mark.slow]

NAME = "the cargo bike"
CANNOT = [
    ("GET", "/parts/fuzzy_table", None, "fuzzy_table"),
    ("GET", "/parts/assist_modes", None, "assist_modes"),
    ("GET", "/parts/calibration", None, "calibrate"),
    ("GET", "/parts/limits", None, "limits"),
    ("GET", "/trial-values", None, "live_set"),
    ("POST", "/trial-values", {"parameters": {"pedal_stop_ms": 300}, "ttl_s": 30}, "live_set"),
    ("DELETE", "/trial-values", None, "live_set"),
    ("GET", "/logs", None, "logs"),
    ("GET", "/simulation", None, "simulation"),
    ("PUT", "/simulation", {"brake": True}, "simulation"),
    ("POST", "/simulation/advance", {"seconds": 1}, "simulation"),
    ("POST", "/config/confirm", None, "unit_trial"),
    ("POST", "/config/rollback", None, "unit_trial"),
    ("PATCH", "/config", {"parameters": {"pedal_stop_ms": 300}, "confirm_s": 20}, "unit_trial"),
]


class Workshop:
    """A dealer's browser, and the motor on the bench."""

    def __init__(self, server: SpindleServer, motor: TinyMotor, url: str) -> None:
        self.server = server
        self.client = server.client
        self.motor = motor
        self.url = url

    def ask(self, method: str, path: str, body: object = None) -> Any:
        """The JSON of a request that must succeed."""
        return self.server.ask(method, path, json=body)

    def refused(self, method: str, path: str, body: object = None) -> tuple[int, dict[str, Any]]:
        """Status and problem of a request that must not."""
        response = self.client.request(method, path, json=body)
        assert not response.is_success, response.text
        return response.status_code, response.json()

    def connect(self, name: str | None = NAME) -> str:
        """Add the unit, wait until it is ready; its path."""
        named = {} if name is None else {"name": name}
        device = self.ask("POST", "/devices", {"url": self.url, **named})["id"]
        self.until_it_is(device, "ready")
        return f"/devices/{device}"

    def until_it_is(self, device: str, state: str) -> None:
        eventually(lambda: self.ask("GET", f"/devices/{device}")["state"], lambda now: now == state)


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    motor = TinyMotor()
    with (
        listening(motor) as url,
        ServerHere(tmp_path, families={**FAMILIES, TinyUnit.family: TinyUnit}) as server,
    ):
        yield Workshop(server, motor, url)


def test_it_says_what_it_is_and_what_it_can_do(workshop: Workshop) -> None:
    device = workshop.connect()

    (listed,) = workshop.ask("GET", "/devices")["items"]

    assert listed["id"] == device.removeprefix("/devices/")
    assert (listed["family"], listed["unit_key"]) == ("tiny", f"tiny:name:{NAME}")
    assert sorted(listed["capabilities"]) == [
        "read_config",
        "restart_to_apply",
        "stream",
        "write_config",
    ]
    identity = listed["identity"]
    assert (identity["model"], identity["firmware_version"]) == ("Tiny", "1.2")
    # What it does not tell is not made up.
    assert identity["serial_number"] is identity["schema_hash"] is None
    assert identity["hardware_revision"] is None


def test_its_settings_are_written_read_back_and_wait_for_its_restart(workshop: Workshop) -> None:
    device = workshop.connect()
    found = workshop.ask("GET", f"{device}/config")

    change = workshop.ask(
        "PATCH",
        f"{device}/config",
        {"parameters": {"speed_limit_kmh": 32}, "reason": "downhill"},
    )

    assert found["parameters"]["speed_limit_kmh"] == SETTINGS[1]
    assert workshop.motor.settings == {**SETTINGS, 1: 32}
    assert (change["state"], change["verified"]) == ("needs_restart", False)
    assert change["parameters"] == {**found["parameters"], "speed_limit_kmh": 32}
    newest, oldest = workshop.ask("GET", f"{device}/config/revisions")["items"]
    assert newest["changed"] == [{"name": "speed_limit_kmh", "old": 25, "new": 32}]
    assert (newest["reason"], oldest["crc32"]) == ("downhill", found["crc32"])


def test_its_rows_are_its_own_and_bound_what_is_written(workshop: Workshop) -> None:
    device = workshop.connect()

    rows = workshop.ask("GET", f"{device}/parameters")["items"]
    status, problem = workshop.refused(
        "PATCH",
        f"{device}/config",
        {"parameters": {"speed_limit_kmh": 90, "pedal_sensor": "mind"}},
    )

    assert [row["id"] for row in rows] == list(SETTINGS)
    assert rows[-1]["choices"] == ["cadence", "torque"]
    assert status == 422
    assert [fault["field"] for fault in problem["errors"]] == ["speed_limit_kmh", "pedal_sensor"]
    assert workshop.motor.settings == SETTINGS


def test_a_backup_brings_everything_back(workshop: Workshop) -> None:
    device = workshop.connect()
    backup = workshop.ask("GET", f"{device}/config")["parameters"]
    changed = {"parameters": {"pedal_sensor": "cadence", "assist_levels": 9}}
    workshop.ask("PATCH", f"{device}/config", changed)
    assert workshop.motor.settings == {**SETTINGS, 4: 9, 8: 0}

    workshop.ask("PATCH", f"{device}/config", {"parameters": backup})

    assert workshop.motor.settings == SETTINGS


def test_a_setting_it_does_not_keep_is_named(workshop: Workshop) -> None:
    device = workshop.connect()
    workshop.motor.stuck = {5}

    status, problem = workshop.refused(
        "PATCH", f"{device}/config", {"parameters": {"start_current_pct": 50, "battery_low_v": 33}}
    )

    assert status == 502
    assert [fault["field"] for fault in problem["errors"]] == ["start_current_pct"]


def test_a_write_made_for_other_settings_is_refused(workshop: Workshop) -> None:
    device = workshop.connect()
    seen = workshop.client.get(f"{device}/config").headers["etag"]
    workshop.motor.settings[3] = 26

    response = workshop.client.patch(
        f"{device}/config",
        json={"parameters": {"assist_levels": 3}},
        headers={"if-match": seen},
    )

    assert response.status_code == 412
    assert workshop.motor.settings == {**SETTINGS, 3: 26}


def test_without_a_name_it_is_read_and_to_write_it_has_to_be_named(workshop: Workshop) -> None:
    device = workshop.connect(name=None)

    config = workshop.ask("GET", f"{device}/config")
    status, problem = workshop.refused(
        "PATCH", f"{device}/config", {"parameters": {"assist_levels": 3}}
    )

    assert config["parameters"]["assist_levels"] == SETTINGS[4]
    assert (status, problem["code"]) == (409, "name_first")
    assert workshop.motor.settings == SETTINGS


def test_its_revisions_are_found_under_its_name_on_another_port(workshop: Workshop) -> None:
    device = workshop.connect()
    workshop.ask("PATCH", f"{device}/config", {"parameters": {"assist_levels": 3}})
    workshop.ask("DELETE", device)

    with listening(workshop.motor) as workshop.url:
        device = workshop.connect()
        newest = workshop.ask("GET", f"{device}/config/revisions")["items"][0]

    assert newest["changed"] == [{"name": "assist_levels", "old": SETTINGS[4], "new": 3}]


def test_what_it_cannot_do_is_refused_by_name(
    workshop: Workshop, subtests: pytest.Subtests
) -> None:
    device = workshop.connect()

    for method, path, body, capability in CANNOT:
        with subtests.test(method=method, path=path):
            status, problem = workshop.refused(method, f"{device}{path}", body)

            assert (status, problem["code"]) == (409, "capability_missing")
            assert [fault["field"] for fault in problem["errors"]] == [capability]
            assert workshop.motor.settings == SETTINGS


def test_every_question_about_it_has_an_answer_or_a_reason(workshop: Workshop) -> None:
    device = workshop.connect()
    paths = workshop.ask("GET", "/openapi.json")["paths"]
    asked = [
        path.replace("/api/v1/devices/{device_id}", device)
        for path, methods in paths.items()
        if "get" in methods and path.count("{") == 1 and "{device_id}" in path
    ]

    answers = {path: workshop.client.get(path).status_code for path in asked}

    assert len(answers) > 10
    assert {status for status in answers.values() if status not in (200, 404, 409)} == set(), (
        answers
    )


def test_it_is_watched_live(workshop: Workshop) -> None:
    device = workshop.connect()
    workshop.motor.speed_kmh, workshop.motor.cadence_rpm = 18.2, 64.0

    riding = {"speed_kmh": 18.2, "cadence_rpm": 64.0}
    eventually(
        lambda: workshop.ask("GET", f"{device}/snapshot")["channels"], lambda now: now == riding
    )
    with connect(f"ws{str(workshop.client.base_url)[4:]}{device[1:]}/live", proxy=None) as socket:
        texts = [json.loads(socket.recv(10)) for _ in range(2)]
        frame = bytes(socket.recv(10))  # type: ignore[arg-type]

    assert [channel["name"] for channel in texts[1]["channels"]] == ["speed_kmh", "cadence_rpm"]
    # The contract's layout: 20 bytes of header, then int16 counts of 0.1 km/h and 0.1 rpm.
    assert [int.from_bytes(frame[at : at + 2], "little") for at in (20, 22)] == [182, 640]


def test_its_rides_are_recorded(workshop: Workshop) -> None:
    device = workshop.connect()
    workshop.motor.speed_kmh = 18.0
    eventually(
        lambda: workshop.ask("GET", "/rides")["items"],
        lambda rides: rides and rides[0]["row_count"] >= 5,
    )
    workshop.ask("DELETE", device)

    (ride,) = eventually(
        lambda: workshop.ask("GET", "/rides")["items"],
        lambda rides: rides[0]["state"] == "done",
    )

    assert ride["unit_key"] == f"tiny:name:{NAME}"
    assert ride["summary"]["speed_kmh_max"] == pytest.approx(18.0)
    # It measures no torque: nobody knows what the rider put in.
    assert ride["summary"]["rider_wh"] is ride["summary"]["motor_wh"] is None


def test_a_silent_unit_is_lost_and_taken_up_again(workshop: Workshop) -> None:
    device = workshop.connect()
    workshop.motor.silent = True
    workshop.until_it_is(device.removeprefix("/devices/"), "lost")

    status, problem = workshop.refused("GET", f"{device}/config")
    workshop.motor.silent = False
    workshop.until_it_is(device.removeprefix("/devices/"), "ready")

    assert (status, problem["code"]) == (504, "not_connected")
    assert workshop.ask("GET", f"{device}/config")["parameters"]["assist_levels"] == SETTINGS[4]
