"""Goal: a rider whose torque sensor drifts sees it from ride to ride, calibrates it, and sees that
it holds.

Method: a simulated unit in virtual time; while it stands its zero walks by 4 Nm a minute, between
rides that coast. What is told is judged by what was planted, over HTTP and from the shell.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.fakes.server import ServerHere, SpindleServer, eventually

DRIFT_NM_PER_S = 4.0 / 60.0
REST_S = 40


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    device = "sim:one?clock=virtual&scenario=none&seed=4"
    with ServerHere(tmp_path_factory.mktemp("drifting"), [device]) as running:
        yield running


def coasting_ride(server: SpindleServer, device: str, drift_s: float) -> dict[str, Any]:
    """The zero walks for so long; then a ride that coasts twice. What the watch then tells."""
    known = len(drift(server, device)["rides"])
    server.simulate(device, brake=True, faults={"torque_sensor": "drifting"})
    server.advance(device, drift_s)
    server.simulate(device, faults={"torque_sensor": "sound"})
    for _ in range(2):
        legs = {"kind": "legs", "torque_nm": 30.0, "cadence_rpm_max": 90.0}
        server.simulate(device, brake=False, assist_mode=3, rider=legs)
        server.advance(device, 15.0)
        server.simulate(device, rider={"kind": "off"})
        server.advance(device, 13.0)
    server.simulate(device, brake=True)
    server.advance(device, REST_S)
    return eventually(lambda: drift(server, device), lambda told: len(told["rides"]) > known)


def drift(server: SpindleServer, device: str) -> dict[str, Any]:
    told: dict[str, Any] = server.get(f"/devices/{device}/sensor-drift")
    return told


@pytest.mark.long
def test_a_drift_is_seen_calibrated_and_gone(server: SpindleServer) -> None:
    device = server.ready_device()
    assert (drift(server, device)["rides"], drift(server, device)["level"]) == ([], None)

    sound = coasting_ride(server, device, drift_s=0.5)
    moved = coasting_ride(server, device, drift_s=30.0)
    far = coasting_ride(server, device, drift_s=25.0)

    assert [told["level"] for told in (sound, moved, far)] == ["ok", "watch", "act"]
    zeros_nm = [told["latest"]["zero_nm"] for told in (sound, moved, far)]
    assert zeros_nm[1] - zeros_nm[0] == pytest.approx(30.0 * DRIFT_NM_PER_S, abs=0.1)
    assert zeros_nm[2] - zeros_nm[1] == pytest.approx(25.0 * DRIFT_NM_PER_S, abs=0.1)
    assert far["latest"]["temperature_degc"] == pytest.approx(20.0, abs=1.0)
    assert far["no_trend"] == "few_rides"

    checks = {one["name"]: one for one in server.get(f"/devices/{device}/checks")["checks"]}
    assert (checks["drift"]["passed"], checks["drift"]["value"]) == (False, zeros_nm[2])
    assert [checks[name]["passed"] for name in ("battery", "motor", "flash", "line")] == [True] * 4

    offset = {"sensor_offset_counts": round(far["latest"]["zero_counts"], 1)}
    body = {"parameters": offset, "reason": "zero had moved"}
    server.ask("PATCH", f"/devices/{device}/config", json=body)
    calibrated = drift(server, device)
    assert (calibrated["level"], calibrated["latest"]) == (None, None)
    assert [one["reason"] for one in calibrated["calibrations"]] == ["zero had moved"]

    again = coasting_ride(server, device, drift_s=0.5)

    assert again["level"] == "ok"
    assert again["latest"]["zero_nm"] == pytest.approx(0.0, abs=0.2)

    server.ask("DELETE", f"/rides/{again['latest']['ride_id']}")
    assert drift(server, device)["latest"] is None
    assert len(drift(server, device)["rides"]) == 3
