"""Goal: a ride is not lost when no Spindle was there, and not there twice when one was.

A simulated unit rides with and without the server watching; its own log is fetched over the wire.
What is fetched must agree with what was recorded live, sample by sample where both have one.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from tests.fakes import command
from tests.fakes.ride_in_time import end_ride, legs, ride_on
from tests.fakes.server import ServerHere, SpindleServer, eventually

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server with one unit, standing."""
    unit = "sim:logger?seed=31&clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("memory"), [unit]) as running:
        running.ready_device(0)
        yield running


def logs(server: SpindleServer, device: str) -> list[dict[str, Any]]:
    items: list[dict[str, Any]] = server.get(f"/devices/{device}/logs")["items"]
    return items


def closed(items: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [item for item in items if item["state"] == "closed"]


def ride_a_bit(server: SpindleServer, device: str) -> dict[str, Any]:
    """A quarter of a minute, until the unit has closed its log; the ride as the server has it."""
    before = len(closed(logs(server, device)))
    ride_on(server, device, 15.0, rider=legs(cadence_rpm_max=80.0))
    ride = end_ride(server, device)
    assert len(closed(logs(server, device))) == before + 1
    return ride


@contextmanager
def time_goes_by(server: SpindleServer, device: str) -> Iterator[None]:
    """The unit reads and erases its memory in time of its own, which then passes by itself."""
    server.simulate(device, clock="real")
    yield
    server.simulate(device, clock="virtual")


def fetched(server: SpindleServer, device: str, log_id: int) -> dict[str, Any]:
    path = f"/devices/{device}/logs/{log_id}/download"
    with time_goes_by(server, device):
        begun = server.client.post(path)
        assert begun.status_code == 202
        assert begun.headers["location"].endswith(path)
        done: dict[str, Any] = eventually(
            lambda: server.get(path), lambda seen: seen["state"] in ("done", "failed")
        )
    assert done["state"] == "done", done
    return done


def test_a_ride_that_was_recorded_live_is_found_to_be_the_same_and_not_stored_twice(
    workshop: SpindleServer,
) -> None:
    device = workshop.ready_device(0)
    ride = ride_a_bit(workshop, device)
    log = closed(logs(workshop, device))[-1]
    assert log["confirmed"] is False
    assert abs(log["duration_s"] - ride["summary"]["duration_s"]) < 5.0

    done = fetched(workshop, device, log["log_id"])

    assert done["duplicate_of"] == done["ride_id"] == ride["id"]
    assert f"ride {ride['id']}" in done["detail"]
    assert done["received"] == done["length"] == log["length"]
    assert [item["id"] for item in workshop.get("/rides")["items"]] == [ride["id"]]
    assert done["confirmed"] is True
    assert logs(workshop, device)[-1]["confirmed"] is True
    upload = workshop.get(f"/uploads/{done['upload_id']}")
    assert (upload["state"], upload["code"]) == ("complete", "duplicate")


def test_a_ride_nobody_watched_comes_from_the_unit_s_log_with_what_it_was_made_with(
    tmp_path: Path,
) -> None:
    flash = tmp_path / "flash"
    unit = f"sim:alone?seed=32&clock=virtual&scenario=none&flash={flash}"
    with ServerHere(tmp_path / "first", [unit]) as first:
        device = first.ready_device(0)
        ride_a_bit(first, device)

    with ServerHere(tmp_path / "second", [unit]) as second:
        device = second.ready_device(0)
        waiting = closed(logs(second, device))
        assert waiting
        assert all(log["started_at"] is None for log in waiting)
        assert second.get("/rides")["items"] == []
        done = fetched(second, device, waiting[-1]["log_id"])

        assert done["duplicate_of"] is None
        ride = second.get(f"/rides/{done['ride_id']}")
        assert ride["origin"] == "imported"
        unit = second.get(f"/devices/{device}")
        assert ride["device"]["device_serial"] == unit["identity"]["serial_number"]
        assert (ride["unit_key"], ride["bike_id"]) == (unit["unit_key"], unit["bike_id"])
        assert ride["bike_id"] is not None
        found = second.get(f"/rides?device={device}")["items"]
        assert [one["id"] for one in found] == [ride["id"]]
        assert ride["device"]["gear_ratio"] == pytest.approx(40.34)
        assert ride["completeness"] == 1.0
        assert ride["period_us"] == 100_000
        assert ride["summary"]["rider_wh"] > 0
        assert ride["summary"]["distance_km"] > 0.01
        assert ride["notes"] == ""
        since_s = datetime.now(UTC) - datetime.fromisoformat(ride["started_at"])
        assert timedelta(0) < since_s < timedelta(minutes=10)

        again = fetched(second, device, waiting[-1]["log_id"])
        assert again["duplicate_of"] == ride["id"]
        assert len(second.get("/rides")["items"]) == 1


def test_what_cannot_be_fetched_is_refused_with_the_reason(workshop: SpindleServer) -> None:
    device = workshop.ready_device(0)

    unknown = workshop.client.post(f"/devices/{device}/logs/4711/download")
    never = workshop.client.get(f"/devices/{device}/logs/4711/download")
    nowhere = workshop.client.get("/devices/nobody/logs")

    assert [answer.status_code for answer in (unknown, never, nowhere)] == [404, 404, 404]
    assert "4711" in unknown.json()["detail"]


def test_the_command_lists_and_fetches(workshop: SpindleServer) -> None:
    device = workshop.ready_device(0)
    ride_a_bit(workshop, device)
    newest = closed(logs(workshop, device))[-1]["log_id"]

    def spindle(*words: str) -> str:
        done = command.spindle(workshop, *words)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert str(newest) in spindle("api", "GET", "/devices/{unit}/logs")
    refused = workshop.client.delete(f"/devices/{device}/logs/{newest}")
    assert (refused.status_code, refused.json()["code"]) == (409, "not_confirmed")
    with time_goes_by(workshop, device):
        assert "ride" in spindle("device", "download", str(newest))
        assert "erases" in spindle("api", "DELETE", f"/devices/{{unit}}/logs/{newest}")
    assert newest not in [log["log_id"] for log in logs(workshop, device)]
