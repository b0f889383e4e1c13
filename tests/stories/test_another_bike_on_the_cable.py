"""Goal: a workshop has one cable and twenty bikes a day, and what was meant for one of them is
never done to the next: an old ETag and a request that names its unit are refused at another one,
and a backup brings another bike the set-up alone.

Method: two simulated units, factory-fresh, one after the other behind one address; asked over HTTP.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from urllib.parse import quote

from tests.fakes.cable import A, B, Cable
from tests.fakes.command import spindle

CHANGE = {"parameters": {"pedal_stop_ms": 200}, "reason": "later stop"}
# What has no ETag: each of them changes the unit or what is kept of it.
FOR_A_UNIT = [
    ("POST", "config/confirm", None),
    ("POST", "config/rollback", None),
    ("POST", "faults/clear", None),
    ("POST", "trial-values", {"parameters": {"motor_torque_nm_max": 1.5}, "ttl_s": 30}),
    ("DELETE", "trial-values", None),
    ("POST", "marks", None),
    ("PUT", "simulation", {"speed": 2.0}),
    ("POST", "logs/1/download", None),
    ("DELETE", "logs/1", None),
]


def ask(cable: Cable, method: str, path: str, headers: dict[str, str], body: Any = None) -> Any:
    """The whole answer to a request for the connection's unit."""
    url = f"/devices/{cable.device}/{path}"
    return cable.server.client.request(method, url, json=body, headers=headers)


def test_what_was_meant_for_a_is_refused_at_b_and_holds_for_a_again(cable: Cable) -> None:
    a = cable.key
    read = ask(cable, "GET", "config", {})
    assert read.json()["unit_key"] == a

    cable.plug(B)
    of_b = ask(cable, "GET", "config", {})
    same = ("generation", "crc32", "parameters")
    assert [of_b.json()[name] for name in same] == [read.json()[name] for name in same]
    assert of_b.headers["etag"] != read.headers["etag"]

    refused = ask(cable, "PATCH", "config", {"if-match": read.headers["etag"]}, CHANGE)
    assert (refused.status_code, refused.json()["code"]) == (412, "other_unit")
    for method, path, body in FOR_A_UNIT:
        refused = ask(cable, method, path, {"spindle-unit": quote(a)}, body)
        assert (refused.status_code, refused.json()["code"]) == (412, "other_unit"), path
    assert ask(cable, "GET", "config", {}).json() == of_b.json()

    cable.plug(A)
    named = {"if-match": read.headers["etag"], "spindle-unit": quote(a)}
    written = ask(cable, "PATCH", "config", named, CHANGE)
    assert (written.status_code, written.json()["unit_key"]) == (200, a)


# Of bike A: two settings of taste, and what was measured on this bike alone.
TASTE = {"pedal_stop_ms": 200, "torque_filter_s": 0.7}
MEASURED = {
    "sensor_gain_nm_per_count": 0.0105,
    "wheel_circumference_m": 2.105,
    "calibrated_at_utc_s": 1795650000,
    "calibration_number": 3,
    "calibration_certificate": [1, 2, 3, 4, 5, 6, 7, 8],
}


def test_a_backup_is_a_set_up_for_another_bike_and_all_of_it_for_its_own(
    cable: Cable, tmp_path: Path
) -> None:
    server, device, file = cable.server, cable.device, tmp_path / "a.json"
    fresh = server.get(f"/devices/{device}/config")["parameters"]
    body = {"parameters": TASTE | MEASURED, "read_from": cable.key}
    server.ask("PATCH", f"/devices/{device}/config", json=body)
    of_a = server.get(f"/devices/{device}/config")["parameters"]
    assert spindle(server, "device", "backup", "--output", file).returncode == 0

    cable.plug(B)
    restored = spindle(server, "device", "restore", file)
    assert restored.returncode == 0, restored.stderr
    of_b = server.get(f"/devices/{device}/config")["parameters"]
    assert {name for name in of_b if of_b[name] != fresh[name]} == set(TASTE)
    stays = next(line for line in restored.stdout.splitlines() if "stay with the unit" in line)
    assert all(name in stays for name in MEASURED)
    told = spindle(server, "device", "restore", file, "--json")
    assert json.loads(told.stdout) == {"changed": [], "left_out": sorted(MEASURED)}

    differing = json.loads(spindle(server, "device", "diff", file, "--json").stdout)
    assert set(differing["stays_with_unit"]) == set(MEASURED)

    # The same file sent whole by a program, with and without its word for whose it is.
    whole = {"parameters": of_a}
    for said in ({}, {"read_from": json.loads(file.read_text())["unit_key"]}):
        refused = ask(cable, "PATCH", "config", {}, whole | said)
        assert (refused.status_code, refused.json()["code"]) == (422, "of_another_unit")
    assert server.get(f"/devices/{device}/config")["parameters"] == of_b

    cable.plug(A)
    restored = spindle(server, "device", "restore", file)
    assert restored.returncode == 0, restored.stderr
    assert server.get(f"/devices/{device}/config")["parameters"] == of_a
