"""Goal: a workshop has one cable and twenty bikes a day, and what was meant for one of them is
never done to the next: an old ETag and a request that names its unit are refused at another one.

Method: two simulated units, factory-fresh, one after the other behind one address; asked over HTTP.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest

from tests.fakes.cable import A, B, Cable

CHANGE = {"parameters": {"pedal_stop_ms": 200}, "reason": "later stop"}
# What has no ETag: each of them changes the unit or what is kept of it.
FOR_A_UNIT = [
    ("POST", "config/confirm", None),
    ("POST", "config/rollback", None),
    ("POST", "faults/clear", None),
    ("POST", "live", {"parameters": {"motor_torque_nm_max": 1.5}, "ttl_s": 30}),
    ("DELETE", "live", None),
    ("POST", "marks", None),
    ("PUT", "simulation", {"speed": 2.0}),
    ("POST", "logs/1/download", None),
    ("DELETE", "logs/1", None),
]


@pytest.fixture
def cable(tmp_path: Path) -> Iterator[Cable]:
    with Cable(tmp_path) as made:
        yield made


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
