"""Goal: a ride records itself, ends itself, loses nothing, and survives a server that is killed.

Simulated units in virtual time: the recorder goes by the unit's own clock. Figures are checked
against physics (distance is the integral of speed, energy of power), not against the code that made
the summary.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.fakes.ride_in_time import recorded_ride, ride_on, rides_of
from tests.fakes.server import ServerHere, ServerProcess, SpindleServer, eventually

UNITS = [f"sim:{name}?clock=virtual&scenario=none" for name in ("one", "two")]


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server with two units side by side."""
    with ServerHere(tmp_path_factory.mktemp("workshop"), UNITS) as running:
        running.all_ready(len(UNITS))
        yield running


@pytest.fixture(scope="module")
def ride(workshop: SpindleServer) -> dict[str, Any]:
    return recorded_ride(workshop, workshop.ready_device(0))


def whole_series(server: SpindleServer, ride: dict[str, Any], *channels: str) -> dict[str, Any]:
    """Every row of the ride: at ten thousand pixels and more rows, window by window."""
    step_s = 60.0
    columns: dict[str, list[float | None]] = {name: [] for name in channels}
    for start in range(math.ceil(ride["summary"]["duration_s"] / step_s) + 1):
        # A row's width off the end, so that no row is in two windows.
        window = {"from_s": start * step_s, "to_s": (start + 1) * step_s - 0.005, "px": 8000}
        part = server.get(
            f"/rides/{ride['id']}/series", params={"channels": ",".join(channels), **window}
        )
        assert part["kind"] == "rows"
        for channel in part["channels"]:
            columns[channel["name"]] += channel["min"]
    return {name: np.array(values, dtype=float) for name, values in columns.items()}


def test_a_ride_ends_itself_and_no_sample_is_missing(ride: dict[str, Any]) -> None:
    assert ride["origin"] == "recorded"
    assert ride["period_us"] == 10_000
    assert ride["completeness"] == 1.0
    assert ride["gaps"] == []
    assert ride["row_count"] == pytest.approx(ride["summary"]["duration_s"] * 100.0 + 1, abs=1)


def test_the_summary_is_what_physics_makes_of_the_samples(
    workshop: SpindleServer, ride: dict[str, Any]
) -> None:
    rows = whole_series(
        workshop,
        ride,
        "speed_kmh",
        "rider_torque_nm",
        "cadence_rpm",
        "motor_torque_nm",
        "motor_speed_rpm",
    )
    summary = ride["summary"]
    hours = 0.01 / 3600.0
    radians = 2.0 * math.pi / 60.0

    assert len(rows["speed_kmh"]) == ride["row_count"]
    distance_km = rows["speed_kmh"].sum() * hours
    rider_wh = (rows["rider_torque_nm"] * rows["cadence_rpm"]).sum() * radians * hours
    motor_wh = (rows["motor_torque_nm"] * rows["motor_speed_rpm"]).sum() * radians * hours
    assert summary["distance_km"] == pytest.approx(distance_km, rel=1e-3)
    assert summary["rider_wh"] == pytest.approx(rider_wh, rel=2e-3)
    assert summary["motor_wh"] == pytest.approx(motor_wh, rel=2e-3)
    assert summary["speed_kmh_max"] == pytest.approx(rows["speed_kmh"].max(), abs=0.01)
    assert 0.0 < summary["motor_wh"] != summary["rider_wh"] > 0.0


def test_a_moment_of_the_ride_is_explained_down_to_what_the_motor_gave(
    workshop: SpindleServer, ride: dict[str, Any]
) -> None:
    device = workshop.ready_device(0)
    rows = whole_series(workshop, ride, "motor_torque_nm", "fuzzy_gain")
    config = workshop.get(f"/devices/{device}/config")["parameters"]

    why = workshop.get(f"/rides/{ride['id']}/why", params={"t_s": 15.0})
    steady = {
        name: why["readings"][name]
        for name in ("speed_kmh", "cadence_rpm", "battery_voltage_v", "motor_temperature_degc")
    }
    steady |= {"mode": why["mode"], "torque_rate": why["torque_rate"]}
    steady |= {"rider_torque_nm": why["rider_torque_nm"]}
    held = workshop.ask("POST", f"/devices/{device}/why", json=steady)
    unconnected = workshop.ask("POST", "/why", json=steady)

    delivered_nm = float(rows["motor_torque_nm"][1500]) * config["gear_ratio"]
    assert why["delivered_nm"] == pytest.approx(delivered_nm, abs=0.01)
    assert sum(step["torque_nm"] for step in why["steps"]) == pytest.approx(delivered_nm, abs=0.01)
    assert why["gain"] == pytest.approx(float(rows["fuzzy_gain"][1500]), abs=0.01)
    assert 1 <= len(why["rules"]) <= 4
    assert (held["config_source"], unconnected["config_source"]) == ("unit", "given")
    assert held["gain"] == unconnected["gain"] == pytest.approx(why["gain"], abs=1e-3)
    assert held["moment"]["kind"] == "steady"
    cuts = workshop.get(f"/rides/{ride['id']}/cuts")["items"]
    assert all(cut["to_s"] > cut["from_s"] for cut in cuts)


def test_a_ride_can_be_named_drawn_exported_and_deleted(workshop: SpindleServer) -> None:
    ride = recorded_ride(workshop, workshop.ready_device(1))
    path = f"/rides/{ride['id']}"

    named = workshop.ask("PATCH", path, json={"name": "Test loop", "notes": "tailwind"})
    figure = workshop.get(f"{path}/figure")
    csv = workshop.client.get(f"{path}/export", params={"format": "csv"})
    unknown = workshop.client.get(f"{path}/series", params={"channels": "altitude"})
    workshop.ask("DELETE", path)

    assert (named["name"], named["notes"]) == ("Test loop", "tailwind")
    assert {"data", "layout"} == set(figure)
    assert len(csv.text.splitlines()) == ride["row_count"] + 1
    assert "attachment" in csv.headers["content-disposition"]
    assert unknown.status_code == 422
    assert workshop.client.get(path).status_code == 404


def test_a_ride_tells_where_its_energy_went(workshop: SpindleServer, ride: dict[str, Any]) -> None:
    path = f"/rides/{ride['id']}"
    energy = workshop.get(f"{path}/energy")
    effort = workshop.client.get(f"{path}/effort", params={"threshold_power_w": 160}).json()
    wrong = workshop.client.get(f"{path}/effort", params={"threshold_power_w": -1})

    summary = ride["summary"]
    for figure in ("rider_wh", "motor_wh", "battery_wh", "distance_km"):
        assert energy["total"][figure] == pytest.approx(summary[figure], rel=1e-3)
    assert energy["modes"][0]["name"], "its configuration is known"
    assert energy["range_refused"] in {"short_way", "little_used"}
    assert effort["power"]["reference"] == 160.0
    assert effort["power_curve"][-1]["power_w"] > 0.0
    assert wrong.status_code == 422


def test_a_replay_with_nothing_changed_is_what_the_motor_did_and_with_the_motor_off_none(
    workshop: SpindleServer, ride: dict[str, Any]
) -> None:
    modes = [{"name": "off", "law": "off", "ratio": 0.0}] * 5
    path, off = f"/rides/{ride['id']}/replay", {"modes": modes, "mode_at_start": 0}

    answer = workshop.ask("POST", path, json={})
    without = workshop.ask("POST", path, json={"assist_modes": off})

    assert answer["config_source"] == "ride"
    # The record has counts of the wire where the unit had float32, hence not to the bit.
    recorded = answer["motor_work_wh"]["recorded"]
    assert answer["motor_work_wh"]["replayed"] == pytest.approx(recorded, rel=0.02)
    assert without["motor_work_wh"]["replayed"] == 0.0
    assert without["motor_work_wh"]["difference"] < 0.0


def test_a_ride_says_where_in_the_table_it_was(
    workshop: SpindleServer, ride: dict[str, Any]
) -> None:
    channels = ("torque_rate", "motor_torque_demanded_nm", "cadence_rpm", "assist_mode")
    rows = whole_series(workshop, ride, *channels)
    rates = [0.0, 0.05, 0.1, 0.2, 0.4]
    points = {"speed_points_kmh": [5, 10, 15, 20, 25], "torque_rate_points": rates}

    answer = workshop.ask("POST", "/rides/table-use", json={"ride_ids": [ride["id"]], **points})
    second = workshop.ask("POST", "/rides/table-use", json={"table": "second", **points})
    refused = workshop.client.post(
        "/rides/table-use", json=points | {"torque_rate_points": [0, 0.2, 0.1, 0.3, 0.4]}
    )

    acts = (rows["motor_torque_demanded_nm"] > 0.0) & (rows["cadence_rpm"] > 0.0)
    assert set(rows["assist_mode"][acts]) == {3.0}
    assert answer["assisted_s"] == pytest.approx(np.count_nonzero(acts) / 100.0)
    # A set's membership is a hat: 1 at its point, 0 at its neighbours, level beyond the ends.
    hats = [np.interp(rows["torque_rate"][acts], rates, hat).sum() / 100.0 for hat in np.eye(5)]
    assert [column["seconds"] for column in answer["columns"]] == pytest.approx(hats, abs=1e-6)
    assert sum(map(sum, answer["cells"]["seconds"])) == pytest.approx(answer["assisted_s"])
    motor_wh = sum(map(sum, answer["cells"]["motor_wh"]))
    assert motor_wh == pytest.approx(ride["summary"]["motor_wh"], rel=0.05)
    assert ride["id"] in [one["id"] for one in second["rides_without"]]
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["field"] == "torque_rate_points[2]"


def test_two_units_are_two_bikes(workshop: SpindleServer) -> None:
    one, two = workshop.ready_device(0), workshop.ready_device(1)

    workshop.configure(one, torque_filter_s=0.31)
    ride_on(workshop, one, 5.0)

    other = workshop.get(f"/devices/{two}/config")["parameters"]
    speeds = [workshop.get(f"/devices/{unit}/snapshot")["channels"]["speed_kmh"]
              for unit in (one, two)]  # fmt: skip
    assert one != two
    assert other["torque_filter_s"] == pytest.approx(0.5)
    assert speeds[0] > 5.0
    assert speeds[1] == 0.0


def test_a_killed_server_leaves_no_simulator_and_finishes_the_ride_at_its_next_start(
    tmp_path: Path,
) -> None:
    server = ServerProcess(tmp_path / "data", UNITS[:1]).start()
    device = server.ready_device()
    children = children_of(server.pid)
    ride_on(server, device, 12.0)
    live = eventually(
        lambda: rides_of(server, device), lambda found: found and found[0]["row_count"] > 1000
    )[0]

    server.kill()

    assert children
    eventually(lambda: [pid for pid in children if is_running(pid)], lambda left: not left)
    with ServerHere(tmp_path / "data") as again:
        ride = again.get(f"/rides/{live['id']}")
    assert ride["state"] == "done"
    assert ride["row_count"] >= live["row_count"]
    assert ride["completeness"] == 1.0
    assert ride["summary"]["distance_km"] > 0.0


def children_of(pid: int) -> list[int]:
    """Processes whose parent is `pid`."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(stat.parent.name))
    return found


def is_running(pid: int) -> bool:
    """Whether a process is there and not only waiting to be reaped."""
    try:
        state = (Path("/proc") / str(pid) / "stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"
