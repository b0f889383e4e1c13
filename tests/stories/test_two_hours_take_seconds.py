"""Goal: a unit under test lives through minutes in seconds, driven by the API, and repeatably.

Times are the unit's own. Two units with the same seed live the same life; the recorder sees every
row of it, which is checked by counting: 100 rows a second.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests.fakes.server import ServerHere, SpindleServer, eventually

RIDE_S = 60
REST_S = 40


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """Three units in virtual time that stand still."""
    devices = [f"sim:{name}?clock=virtual&scenario=none" for name in ("one", "two", "three")]
    with ServerHere(tmp_path_factory.mktemp("virtual"), devices) as running:
        running.all_ready(3)
        yield running


def named(server: SpindleServer, name: str) -> str:
    """The id of the unit `sim:name`; they become ready in any order."""
    devices = server.get("/devices")["items"]
    return next(str(one["id"]) for one in devices if one["url"].startswith(f"sim:{name}"))


def ride(server: SpindleServer, device: str) -> dict[str, Any]:
    """A minute's ride, the same for every unit, and the rest that ends it; its record."""
    server.simulate(
        device,
        scenario=None,
        seed=42,
        brake=False,
        assist_mode=3,
        rider={"kind": "legs", "torque_nm": 25.0, "cadence_rpm_max": 90.0},
    )
    server.advance(device, RIDE_S)
    server.simulate(device, rider={"kind": "off"}, brake=True)
    server.advance(device, REST_S)
    rides = eventually(
        lambda: [
            ride
            for ride in server.get("/rides")["items"]
            if ride["device"]["device_id"] == device and ride["state"] == "done"
        ]
    )
    return dict(rides[0])


def test_time_passes_only_when_it_is_told_to(server: SpindleServer) -> None:
    device = named(server, "three")
    before = server.get(f"/devices/{device}/simulation")

    after = server.advance(device, 12.5)
    later = server.get(f"/devices/{device}/simulation")

    assert after["t_s"] - before["t_s"] == pytest.approx(12.5, abs=1e-9)
    assert later["t_s"] == after["t_s"]
    assert later["advance_left_s"] == 0.0


def test_a_ride_in_virtual_time_is_recorded_whole_and_twice_the_same(
    server: SpindleServer,
) -> None:
    rides = [ride(server, named(server, name)) for name in ("one", "two")]

    speeds = []
    for one in rides:
        assert one["gaps"] == []
        assert one["completeness"] == 1.0
        assert RIDE_S * 100 < one["row_count"] < (RIDE_S + REST_S) * 100
        series = server.get(f"/rides/{one['id']}/series?channels=speed_kmh&px=4000&to_s={RIDE_S}")
        trace = series["channels"][0]
        speeds.append(np.array([trace["min"], trace["max"]], dtype=float))
    for device in (named(server, "one"), named(server, "two")):
        link = server.get(f"/devices/{device}")["link"]
        assert link["stream_rows_lost"] == 0
    assert speeds[0].max() > 10.0
    assert rides[0]["row_count"] == rides[1]["row_count"]
    assert np.array_equal(speeds[0], speeds[1])


def test_the_dashboard_has_ridden_as_far_as_the_record_says(server: SpindleServer) -> None:
    device = named(server, "three")

    recorded = ride(server, device)
    seen = server.get(f"/devices/{device}/dashboard")

    assert seen["distance_km"] == pytest.approx(recorded["summary"]["distance_km"], rel=0.01)
    assert seen["missing_s"] == 0.0
    assert seen["speed_kmh"] == 0.0
    assert seen["range_km"] is None
