"""Goal: a shell finds settings for a wish on a ride, tries them on it, and sees what rides became.

Method: a simulated unit in virtual time, one ride of a minute and a half from a standstill in a
mode that its table rules, and the command.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fakes.command import spindle
from tests.fakes.ride_in_time import end_ride, ride_on
from tests.fakes.server import ServerHere, SpindleServer

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    unit = "sim:wish?seed=5&clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("wish"), [unit]) as running:
        yield running


@pytest.fixture(scope="module")
def ride(desk: SpindleServer) -> str:
    """The number of a recorded ride."""
    device = desk.ready_device()
    ride_on(desk, device, 10.0)
    # Uphill, so that the motor has work that a twin can be held to.
    ride_on(desk, device, 85.0, road={"grade_deg": 1.0})
    return str(end_ride(desk, device)["id"])


def test_settings_for_a_wish_are_found_kept_and_tried_and_nothing_is_written(
    desk: SpindleServer, ride: str, tmp_path: Path
) -> None:
    unit = desk.ready_device()
    before = desk.get(f"/devices/{unit}/config")
    wish = ["propose", ride, "--knobs", "ratio,band", "--target-pct", "10"]

    told = spindle(desk, *wish, "--save", "ten per cent further", "--json")
    assert told.returncode == 0, told.stderr
    job = json.loads(told.stdout)
    kept = next(r for r in desk.get("/library")["items"] if r["name"] == "ten per cent further")
    document = tmp_path / "kept.json"
    document.write_text(json.dumps(desk.get(f"/library/{kept['id']}")))
    tried = spindle(desk, "ride", "replay", ride, "--settings", document, "--closed-loop")
    opened = spindle(desk, "ride", "replay", ride, "--settings", document, "--json")

    assert told.returncode == 0, told.stderr
    (chosen,) = (one for one in job["candidates"] if one["recommended"])
    assert set(chosen["parameters"]) <= {"mode_ratios", "assist_cutoff_band_kmh"}
    again = desk.ask("POST", f"/rides/{ride}/again", json={"parameters": chosen["parameters"]})
    assert again["duration_s"]["replayed"] == pytest.approx(chosen["duration_s"]["after"])
    assert tried.returncode == 0, tried.stderr
    assert f"{again['battery_wh']['replayed']:.6g}" in tried.stdout
    assert json.loads(opened.stdout)["motor_work_wh"]["difference"] < 0.0
    assert desk.get(f"/devices/{unit}/config") == before


def test_a_wish_is_told_as_a_table_and_one_that_cannot_be_with_the_reason(
    desk: SpindleServer, ride: str
) -> None:
    found = spindle(desk, "propose", ride, "--knobs", "ratio")
    none = spindle(desk, "propose", "4711")

    assert found.returncode == 0, found.stderr
    assert "done after" in found.stdout
    assert "nine of ten" in found.stdout
    assert "mode_ratios: [" in found.stdout
    assert none.returncode == 1
    assert "4711" in none.stderr


def test_the_rides_since_a_change_stand_beside_those_before(desk: SpindleServer, ride: str) -> None:
    unit = desk.ready_device()
    spindle(desk, "device", "set", "pedal_stop_ms=240", "--reason", "a try")
    since = spindle(desk, "ride", "since", "--json")
    changed = json.loads(since.stdout)
    told = spindle(desk, "ride", "since", str(changed["seq"]), "--unit", unit)
    never = spindle(desk, "ride", "since", "99")

    # The newest change of the unit came after its only ride.
    assert changed["before"]["ride_ids"] == [int(ride)]
    assert changed["after"]["ride_ids"] == []
    assert told.returncode == 0, told.stderr
    assert ["rides", "1", "0"] in [line.split() for line in told.stdout.splitlines()]
    assert "too_few" in told.stdout
    assert never.returncode == 1
    assert "99" in never.stderr
