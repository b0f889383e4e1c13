"""Goal: a bike that is switched on with a foot on its pedal says so, keeps its zero, and assists
once the foot has left; a calibration takes no zero of it unless somebody says what he saw.

Method: a simulated unit in virtual time whose scenario begins with a push on a braked crank.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from firmware_protocol._generated import FAULT_BY_NAME
from tests.fakes.server import ServerHere, SpindleServer

pytestmark = pytest.mark.slow

# Long enough to notice that what a sensor says at the start is no zero.
SWITCHED_ON_S = 5.0
PUSH = {"kind": "constant", "torque_nm": 30.0, "cadence_rpm_max": 90.0}
SCENARIO = """
doc = "A foot rests on the pedal of a braked bike, from switching on."
seed = 3

[bike.sensor]
noise_nm = 0.06

[[phases]]
seconds = 36000
rider = "constant"
torque_nm = 30
assist_mode = 3
brake = true
"""
SETUP: dict[str, Any] = {
    "arm_m": 0.17,
    "arm_limit_m": 0.0003,
    "gravity": {"gravity_ms2": 9.81, "standard_ms2": 1e-4},
    "masses": [{"name": "discs", "mass_kg": 10.0, "mass_class": "M2"}],
    "loads_kg": [10.0, 25.0, 40.0],
    "full_scale_nm": 80.0,
}
ZERO = {"kind": "zero", "side": "right", "direction": "loading"}


class Bike:
    def __init__(self, server: SpindleServer) -> None:
        self.server = server
        self.device = server.ready_device()
        server.advance(self.device, SWITCHED_ON_S)

    def faults(self) -> list[dict[str, Any]]:
        listed = self.server.get(f"/devices/{self.device}/faults")["items"]
        return [fault for fault in listed if fault["active"]]

    def channels(self) -> dict[str, Any]:
        told: dict[str, Any] = self.server.get(f"/devices/{self.device}/snapshot")["channels"]
        return told

    def zero_counts(self) -> float:
        parameters = self.server.get(f"/devices/{self.device}/config")["parameters"]
        return float(parameters["sensor_offset_counts"])

    def ride(self) -> float:
        """Pedals from a standstill; what the motor gives at ten kilometres an hour."""
        self.server.simulate(self.device, brake=False, rider=PUSH)
        for _ in range(30):
            self.server.advance(self.device, 1.0)
            if (rolling := self.channels())["speed_kmh"] > 10:
                return float(rolling["motor_torque_nm"])
        raise AssertionError(f"It rolls at {rolling['speed_kmh']} km/h after half a minute.")


@pytest.fixture
def bike(tmp_path: Path) -> Iterator[Bike]:
    scenario = tmp_path / "foot.toml"
    scenario.write_text(SCENARIO, encoding="utf-8")
    unit = f"sim:foot?clock=virtual&scenario={scenario}"
    with ServerHere(tmp_path / "data", [unit]) as server:
        yield Bike(server)


def test_it_is_told_with_what_to_do_and_ends_when_the_foot_leaves(bike: Bike) -> None:
    (told,) = bike.faults()
    zero = bike.zero_counts()
    assert told["name"] == "foot_at_start"
    assert told["description"] == FAULT_BY_NAME["FOOT_AT_START"].rider_text
    assert bike.ride() == 0.0
    assert [fault["name"] for fault in bike.faults()] == ["foot_at_start"]

    bike.server.stand_still(bike.device)
    bike.server.advance(bike.device, 10.0)
    assert bike.faults() == []
    bike.server.simulate(bike.device, assist_mode=3)

    assert bike.ride() > 0.1
    assert bike.zero_counts() == zero


def test_a_calibration_takes_no_zero_of_a_foot(bike: Bike) -> None:
    assert bike.faults()
    job = bike.server.ask("POST", "/calibrations", json={"device_id": bike.device})
    path = f"/calibrations/{job['id']}"
    bike.server.ask("PUT", f"{path}/setup", json=SETUP)
    bike.server.advance(bike.device, 5.0)
    assert bike.server.get(f"{path}/reading")["steady"]

    refused = bike.server.client.post(f"{path}/captures", json=ZERO)
    assert refused.status_code == 409
    assert refused.json()["code"] == "foot_on_pedal"

    # Somebody looked: the zero has moved by 30 Nm.
    looked = {**ZERO, "pedals_free": True}
    taken = bike.server.ask("POST", f"{path}/captures", json=looked)
    assert taken["captures"][0]["mean_counts"] == pytest.approx(3000.0, abs=10.0)

    # And a load is a load, whatever hung there when the unit was switched on.
    bike.server.advance(bike.device, 5.0)
    assert bike.server.get(f"{path}/reading")["steady"]
    load = {"kind": "load", "side": "right", "mass_kg": 10.0, "direction": "loading"}
    assert len(bike.server.ask("POST", f"{path}/captures", json=load)["captures"]) == 2
