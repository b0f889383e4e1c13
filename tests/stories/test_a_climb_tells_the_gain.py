"""Goal: who has no masses at hand learns from a climb and two coast-downs whether the torque sensor
tells the truth, and from a tape how far the wheel goes.

Method: a simulated unit in virtual time whose sensor was drawn with another gain than its
configuration says; its zero is set right, its gain is left. The climb must find the planted gain
inside its own stated uncertainty, and agree once that gain is in the unit. Over HTTP and from the
shell.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.fakes.server import ServerHere, SpindleServer, eventually

pytestmark = pytest.mark.slow

# sim_device/scenarios/calibration.toml, `drifted`.
PLANTED_GAIN, PLANTED_ZERO_COUNTS = 0.94, 180.0
GRADE_DEG, GRAVITY_MS2, MASS_KG = 2.0, 9.80665, 100.0
GAIN = "sensor_gain_nm_per_count"
MARGIN_S = 3.0
PUSH, COAST, CLIMB, REST = 30.0, 55.0, 120.0, 40.0
CIRCUMFERENCE_M = 2 * math.pi * 0.33


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    device = "sim:one?clock=virtual&scenario=none&seed=4&sensor=drifted"
    with ServerHere(tmp_path_factory.mktemp("climb"), [device]) as running:
        yield running


def ridden(server: SpindleServer, device: str) -> int:
    """Two coast-downs on the level, then a climb on the legs alone; the ride's number."""
    known = {ride["id"] for ride in server.get("/rides")["items"]}
    level = {"grade_deg": 0.0, "wind_ms": 0.0}
    for _ in range(2):
        legs = {"kind": "constant", "torque_nm": 60.0, "cadence_rpm_max": 90.0}
        server.simulate(device, brake=False, assist_mode=0, rider=legs, road=level)
        server.advance(device, PUSH)
        server.simulate(device, rider={"kind": "off"})
        server.advance(device, COAST)
    legs = {"kind": "constant", "torque_nm": 50.0, "cadence_rpm_max": 90.0}
    server.simulate(device, rider=legs, road=level | {"grade_deg": GRADE_DEG})
    server.advance(device, CLIMB)
    server.simulate(device, brake=True, rider={"kind": "off"}, road=level)
    server.advance(device, REST)

    def done() -> list[int]:
        rides = server.get("/rides")["items"]
        return [one["id"] for one in rides if one["id"] not in known and one["state"] == "done"]

    return eventually(done, bool)[0]


def way_m(server: SpindleServer, ride: int, from_s: float, to_s: float) -> float:
    """By the unit's speed, whose wheel is the simulated one."""
    answer = server.client.get(f"/rides/{ride}/export", params={"format": "csv"})
    rows = csv.DictReader(answer.text.splitlines())
    told = [(float(row["t_s"]), float(row["speed_kmh"])) for row in rows if row["speed_kmh"]]
    there = [one for one in told if from_s <= one[0] <= to_s]
    times, speeds = zip(*there, strict=True)
    return float(np.trapezoid(speeds, times)) / 3.6


def question(server: SpindleServer, ride: int) -> dict[str, Any]:
    """Windows inside what was ridden; the rise is that of the road."""
    windows = []
    for begin in (PUSH, 2 * PUSH + COAST):
        windows.append({"ride_id": ride, "from_s": begin + MARGIN_S, "rise_m": 0.0})
        windows[-1]["to_s"] = begin + COAST - MARGIN_S
    begin = 2 * (PUSH + COAST) + MARGIN_S
    end = begin + CLIMB - 2 * MARGIN_S
    rise_m = way_m(server, ride, begin, end) * math.sin(math.radians(GRADE_DEG))
    return {
        "climb": {"ride_id": ride, "from_s": begin, "to_s": end, "rise_m": rise_m},
        "coast_downs": windows,
        "mass_kg": MASS_KG,
        "mass_limit_kg": 0.5,
        "gravity": {"gravity_ms2": GRAVITY_MS2, "standard_ms2": 1e-4},
        "rise_limit_m": 0.2,
        "wind_limit_ms": 0.1,
    }


@pytest.mark.long
@pytest.mark.board_long
def test_a_planted_gain_is_found_and_gone_once_it_is_written(
    server: SpindleServer, tmp_path: Path
) -> None:
    device = server.ready_device()
    server.simulate(device, brake=True)
    server.advance(device, 5.0)
    server.configure(device, sensor_offset_counts=PLANTED_ZERO_COUNTS)
    asked = question(server, ridden(server, device))

    told = server.ask("POST", "/calibration/climb", json=asked)

    found = told["balance"]
    assert abs(found["gain_ratio"] - 1 / PLANTED_GAIN) <= found["expanded"] < 0.04
    assert (found["agrees"], found["en"] > 1) == (False, True)
    assert told["resistance"]["rolling_n"] == pytest.approx(0.00864 * 100 * GRAVITY_MS2, rel=0.05)
    assert told["resistance"]["air_ns2_m2"] == pytest.approx(0.24, rel=0.05)
    assert told["calibrated"]["source"] == "unknown"
    assert found["motor_energy_j"] == pytest.approx(0.0, abs=5.0)

    ride_id, begin_s, end_s = (asked["climb"][name] for name in ("ride_id", "from_s", "to_s"))
    window = {"ride_id": ride_id, "from_s": begin_s, "to_s": end_s}
    turned = server.ask("POST", "/calibration/cadence", json=window)
    assert turned["agrees"]
    # One turn of the crank is 44/14 of the wheel.
    wheel_turns = way_m(server, ride_id, begin_s, end_s) / CIRCUMFERENCE_M
    assert turned["turns"] == pytest.approx(wheel_turns * 14 / 44, rel=2e-3)
    by_the_crank = {"turns": turned["turns"] * 44 / 14}
    pulses = server.ask("POST", "/calibration/wheel/pulses", json=window | by_the_crank)["pulses"]
    assert (pulses["nearest_integer"], pulses["agrees"]) == (36, True)

    gain = server.get(f"/devices/{device}/config")["parameters"][GAIN]
    server.configure(device, **{GAIN: gain / PLANTED_GAIN})
    again = server.ask("POST", "/calibration/climb", json=question(server, ridden(server, device)))[
        "balance"
    ]

    assert abs(again["gain_ratio"] - 1.0) <= again["expanded"]
    assert again["agrees"]

    short = asked | {"climb": {**asked["climb"], "rise_m": None}}
    refused = server.client.post("/calibration/climb", json=short)
    assert refused.status_code == 422
    assert [one["code"] for one in refused.json()["errors"]] == ["missing_channel"]


def test_a_rolled_wheel_is_told_beside_the_unit_s(server: SpindleServer) -> None:
    device = server.ready_device()
    larger_m = [2 * 1.03 * CIRCUMFERENCE_M + error for error in (-0.002, 0.0, 0.002)]
    rolls = {"distances_m": larger_m, "turns": 2, "tape_limit_m": 0.003, "device_id": device}

    told = server.ask("POST", "/calibration/wheel/roll-out", json=rolls)

    beside = told["unit_comparison"]
    assert (beside["agrees"], beside["in_band"]) == (False, True)
    assert told["measured"]["circumference_m"] == pytest.approx(1.03 * CIRCUMFERENCE_M, abs=1e-4)
    assert beside["difference_pct"] == pytest.approx(3.0, abs=0.01)
    limit = beside["cut_off"]
    assert limit["true_kmh"] == pytest.approx(1.03 * limit["limit_kmh"], rel=1e-4)
    assert not limit["lawful"]
    same = rolls | {"distances_m": [2.0734, 2.0735], "turns": 1}
    assert server.ask("POST", "/calibration/wheel/roll-out", json=same)["unit_comparison"]["agrees"]
    ride = server.get("/rides")["items"]
    if ride:
        body = {"ride_id": ride[0]["id"]}
        refused = server.client.post("/calibration/wheel/track", json=body)
        assert [one["code"] for one in refused.json()["errors"]] == ["missing_channel"]
