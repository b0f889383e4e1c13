"""Goal: a head unit's file given to the server becomes a ride, and a broken one a clear reason.

Every kind of damage, of break and of answer is tested in tests/unit/imports; here a whole file and
a refused one pass real sockets. The file is written by tests/fakes/fit_file.py from the format's
public description.
"""

from __future__ import annotations

from typing import Any

import pytest

from tests.fakes.fit_file import START_S, fit_ride
from tests.fakes.server import SpindleServer


def imported(server: SpindleServer, name: str, content: bytes) -> dict[str, Any]:
    answer: dict[str, Any] = server.ask(
        "POST", "/rides/import", params={"name": name}, content=content
    )
    return answer


def test_a_fit_file_becomes_a_ride_with_the_figures_it_was_written_with(
    server: SpindleServer,
) -> None:
    content = fit_ride(START_S, [18.0] * 600, [80] * 600, [180] * 600)

    upload = imported(server, "evening loop.fit", content)

    assert upload["state"] == "complete"
    ride = server.get(f"/rides/{upload['ride_ids'][0]}")
    assert ride["origin"] == "imported"
    assert ride["name"] == "evening loop"
    assert ride["started_at"] == "2023-11-14T22:13:20Z"
    # 599 s at 18 km/h, 80 turns a minute, 180 W: 2.995 km and 29.95 Wh.
    assert ride["summary"]["distance_km"] == pytest.approx(2.995, rel=0.01)
    assert ride["summary"]["rider_wh"] == pytest.approx(29.95, rel=0.01)
    assert ride["summary"]["cadence_rpm_mean"] == pytest.approx(80.0)
    assert ride["summary"]["motor_wh"] is None
    series = server.get(f"/rides/{ride['id']}/series", params={"channels": "speed_kmh"})
    assert series["channels"][0]["max"][0] == pytest.approx(18.0, abs=0.01)
    original = server.client.get(f"/rides/{ride['id']}/export", params={"format": "original"})
    assert original.content == content


def test_a_page_saved_as_a_ride_is_refused_by_its_first_bytes(server: SpindleServer) -> None:
    upload = imported(server, "ride.fit", b"<!DOCTYPE html>" + bytes(3_000_000))

    assert (upload["state"], upload["code"]) == ("rejected", "unsupported_format")
    assert upload["received"] < 1_000_000
