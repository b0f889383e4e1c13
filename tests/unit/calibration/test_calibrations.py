"""Goal: a page finds all of a calibration in the answers, and every refusal names what is at fault.

Method: the routes over the use cases with a small honest unit and a made sensor; requests as a page
sends them.
"""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.calibration.certificate import evaluate
from tests.fakes.api import api_with, client_of
from tests.unit.calibration.calibration_job import LOADS_KG, TRUE_GAIN, Workshop

pytestmark = pytest.mark.slow

API = "/api/v1/calibrations"
SETUP: dict[str, Any] = {
    "arm_m": 0.17,
    "arm_limit_m": 0.0003,
    "gravity": {"gravity_ms2": 9.81, "standard_ms2": 1e-4},
    "masses": [{"name": "discs", "mass_kg": 10.0, "mass_class": "M2"}],
    "loads_kg": list(LOADS_KG),
    "full_scale_nm": 80.0,
}


@pytest.fixture
def client(bench: Workshop) -> TestClient:
    return client_of(api_with(author="Ada", calibrations=bench.use))


def opened(client: TestClient, bench: Workshop) -> str:
    answer = client.post(API, json={"device_id": bench.device})
    assert answer.status_code == 201, answer.text
    path: str = answer.headers["location"]
    assert client.put(f"{path}/setup", json=SETUP).status_code == 200
    return path


def capture_all(client: TestClient, bench: Workshop, path: str) -> dict[str, Any]:
    """As a page does: what is next, until nothing is."""
    job: dict[str, Any] = client.get(path).json()
    while job["next_step"] is not None:
        state = job["steps"][job["next_step"]]["state"]
        bench.hang(state["mass_kg"], state["crank_angle_deg"])
        told = {name: value for name, value in state.items() if name != "sensor_degc"}
        answer = client.post(f"{path}/captures", json=told)
        assert answer.status_code == 201, answer.text
        job = answer.json()
    return job


def test_the_whole_way_is_in_the_answers(client: TestClient, bench: Workshop) -> None:
    path = opened(client, bench)
    again = client.post(API, json={"device_id": bench.device})
    assert (again.status_code, again.headers["location"]) == (200, path)

    captured = capture_all(client, bench, path)
    fitted = client.post(f"{path}/fit").json()
    written = client.post(f"{path}/write", params={"reason": "spring service"}).json()
    bench.hang(30.0)
    verified = client.post(f"{path}/verify", json={"side": "right", "mass_kg": 30.0}).json()
    closed = client.post(f"{path}/close").json()
    file = client.get(f"{path}/certificate").json()

    states = [job["state"] for job in (captured, fitted, written, verified, closed)]
    assert states == ["capturing", "fitted", "written", "verified", "closed"]
    assert captured["captures"][0]["fitted_nm"] is not None
    assert fitted["worked"]["fit"]["coefficients"]["gain_nm_per_count"] == pytest.approx(
        TRUE_GAIN, rel=1e-3
    )
    lines = {line["name"]: line for line in fitted["record"]}
    gain = lines["sensor_gain_nm_per_count"]
    assert gain["free_min"] < gain["planned"] < gain["free_max"]
    assert not gain["beyond"]
    (change,) = written["changes"]
    assert (change["kind"], change["author"], change["reason"]) == (
        "write",
        "Ada",
        "spring service",
    )
    assert change["record"]["sensor_gain_nm_per_count"] == gain["planned"]
    assert change["before"]["sensor_gain_nm_per_count"] == gain["found"]
    assert verified["worked"]["verifications"][0]["unseen"]
    assert evaluate(file).reproduced
    (listed,) = client.get(API, params={"unit_key": closed["unit_key"]}).json()["items"]
    assert listed == {name: closed[name] for name in listed}
    assert listed["result"]["verified"]
    assert client.get(API, params={"unit_key": "ebl:another"}).json()["items"] == []


def test_the_reading_tells_why_it_may_not_be_taken(client: TestClient, bench: Workshop) -> None:
    path = opened(client, bench)
    silent = client.get(f"{path}/reading").json()
    bench.hang(10.0, seconds=1.0)
    short = client.get(f"{path}/reading").json()
    refused = client.post(f"{path}/captures", json={"kind": "zero"})
    bench.hang(10.0, seconds=5.0)
    steady = client.get(f"{path}/reading").json()

    assert [one["code"] for one in silent["reasons"]] == ["no_readings"]
    assert silent["raw_counts"] == []
    assert [one["code"] for one in short["reasons"]] == ["too_short"]
    assert (refused.status_code, refused.json()["code"]) == (409, "not_steady")
    assert [one["code"] for one in refused.json()["errors"]] == ["too_short"]
    assert (steady["steady"], steady["reasons"]) == (True, [])
    assert 5.0 <= steady["steady_s"] <= 6.5
    assert len(steady["raw_counts"]) == len(steady["t_s"]) <= 250
    assert steady["t_s"][-1] <= 0
    assert {check["code"]: check["passed"] for check in steady["checks"]}["standing"] is True


def test_gravity_of_a_place_is_worked_out_here(client: TestClient, bench: Workshop) -> None:
    """Normal gravity at 45 degrees and sea level by WGS 84: 9.80620 m/s^2."""
    path = opened(client, bench)
    place = {"gravity": {"latitude_deg": 45.0, "height_m": 0.0}}

    job = client.put(f"{path}/setup", json={**SETUP, **place}).json()

    assert job["setup"]["gravity"]["gravity_ms2"] == pytest.approx(9.80620, abs=1e-5)
    assert job["setup"]["gravity"]["standard_ms2"] > 0


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "code"),
    [
        ("POST", "", {"device_id": "nobody"}, 404, "not_found"),
        ("GET", "/9", None, 404, "not_found"),
        ("POST", "/1/fit", None, 409, "too_few_captures"),
        ("POST", "/1/write", None, 409, "not_fitted"),
        ("POST", "/1/restore", None, 409, "not_written"),
        ("GET", "/1/certificate", None, 409, "not_fitted"),
        ("DELETE", "/1/captures/7", None, 404, "not_found"),
        ("POST", "/1/captures", {"kind": "load"}, 422, "invalid_state"),
        ("PUT", "/1/setup", {**SETUP, "arm_m": 17}, 422, "invalid"),
        ("PUT", "/1/setup", {**SETUP, "loads_kg": [10, 10]}, 422, "invalid_setup"),
    ],
)
def test_what_cannot_be_is_refused_by_name(
    client: TestClient,
    bench: Workshop,
    method: str,
    path: str,
    body: Any,
    status: int,
    code: str,
) -> None:
    opened(client, bench)

    answer = client.request(method, f"{API}{path}", json=body)

    assert (answer.status_code, answer.json()["code"]) == (status, code)


def test_a_unit_that_cannot_be_calibrated_is_refused_by_capability(
    client: TestClient, bench: Workshop, monkeypatch: pytest.MonkeyPatch
) -> None:
    unit = bench.devices.unit(bench.device)
    lacking = unit.capabilities - {"calibrate"}
    monkeypatch.setattr(type(unit), "capabilities", property(lambda _: lacking))

    answer = client.post(API, json={"device_id": bench.device})

    assert (answer.status_code, answer.json()["code"]) == (409, "capability_missing")
