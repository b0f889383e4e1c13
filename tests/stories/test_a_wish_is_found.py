"""Goal: settings for a wish are found on a ride and tried on it, and one sees what rides became.

Method: a simulated unit in virtual time, one ride of a minute and a half from a standstill in a
mode that its table rules.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.fakes.ride_in_time import end_ride, ride_on
from tests.fakes.server import ServerHere, SpindleServer, eventually

pytestmark = pytest.mark.slow

RUNNING = ("waiting", "riding", "proving")


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    unit = "sim:wish?seed=5&clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("wish"), [unit]) as running:
        yield running


@pytest.fixture(scope="module")
def ride(desk: SpindleServer) -> int:
    """The number of a recorded ride."""
    device = desk.ready_device()
    ride_on(desk, device, 10.0)
    # Uphill, so that the motor has work that a twin can be held to.
    ride_on(desk, device, 85.0, road={"grade_deg": 1.0})
    return int(end_ride(desk, device)["id"])


def test_settings_for_a_wish_are_found_and_tried_and_nothing_is_written(
    desk: SpindleServer, ride: int
) -> None:
    unit = desk.ready_device()
    before = desk.get(f"/devices/{unit}/config")
    wish = {"ride_ids": [ride], "objective": "more_range", "knobs": ["ratio", "band"]}

    begun = desk.ask("POST", "/proposals", json=wish | {"target_pct": 10.0})
    job = eventually(
        lambda: desk.get(f"/proposals/{begun['id']}"), lambda job: job["state"] not in RUNNING
    )
    (chosen,) = (one for one in job["candidates"] if one["recommended"])
    settings = {"parameters": chosen["parameters"]}
    again = desk.ask("POST", f"/rides/{ride}/again", json=settings)
    opened = desk.ask("POST", f"/rides/{ride}/replay", json=settings)

    assert set(chosen["parameters"]) <= {"mode_ratios", "assist_cutoff_band_kmh"}
    assert again["duration_s"]["replayed"] == pytest.approx(chosen["duration_s"]["after"])
    assert opened["motor_work_wh"]["difference"] < 0.0
    assert desk.get(f"/devices/{unit}/config") == before


def test_the_rides_since_a_change_stand_beside_those_before(desk: SpindleServer, ride: int) -> None:
    unit = desk.ready_device()
    desk.configure(unit, pedal_stop_ms=240)
    path = f"/devices/{unit}/config/revisions"
    newest = desk.get(path)["items"][0]["seq"]

    changed = desk.get(f"{path}/{newest}/since")

    # The newest change of the unit came after its only ride.
    assert changed["before"]["ride_ids"] == [ride]
    assert changed["after"]["ride_ids"] == []
    assert changed["motor_wh_per_km_after"] == "too_few"
    assert desk.client.get(f"{path}/99/since").status_code == 404
