"""Goal: a rule that is written at a halt of a ride is in force from that moment on, in every answer
about the ride and in the unit's own log of it.

Method: a simulated unit in virtual time, ridden before and after the write. What it sent of its
gain is the measure for what is worked out here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest

from tests.fakes.ride_in_time import end_ride, ride_on
from tests.fakes.server import ServerHere, SpindleServer, eventually

RIDDEN_S, HALT_S = 30.0, 10.0


@dataclass(frozen=True)
class Changed:
    """A ride on whose half every rule became PB."""

    server: SpindleServer
    device: str
    ride: dict[str, Any]
    seq: int

    def why(self, t_s: float) -> dict[str, Any]:
        answer: dict[str, Any] = self.server.get(f"/rides/{self.ride['id']}/why?t_s={t_s}")
        return answer


@pytest.fixture(scope="module")
def changed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Changed]:
    unit = "sim:one?seed=11&clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("changed"), [unit]) as server:
        device = server.ready_device()
        ride_on(server, device, RIDDEN_S)
        server.simulate(device, rider={"kind": "off"}, brake=True)
        server.advance(device, HALT_S)
        rules = [["PB"] * 5 for _ in range(5)]
        server.configure(device, "at the lights", fuzzy_rules=rules)
        ride_on(server, device, RIDDEN_S)
        ride = end_ride(server, device)
        seq = server.get(f"/devices/{device}/config/revisions")["items"][0]["seq"]
        yield Changed(server, device, ride, seq)


def settings_of(ride: dict[str, Any]) -> list[dict[str, Any]]:
    return [event for event in ride["events"] if event["kind"] == "settings"]


def test_the_change_is_on_the_ride_at_its_moment(changed: Changed) -> None:
    (event,) = settings_of(changed.ride)

    unit = changed.server.get(f"/devices/{changed.device}")
    assert event["value"] == unit["config"]["crc32"]
    assert event["t_s"] == pytest.approx(RIDDEN_S + HALT_S, abs=3.0)
    assert changed.ride["device"]["config_crc32"] != event["value"]


def test_why_goes_by_the_rule_of_the_moment(changed: Changed) -> None:
    (event,) = settings_of(changed.ride)
    moments = [5.0, 12.0, 20.0, event["t_s"] + 5.0, event["t_s"] + 12.0, event["t_s"] + 20.0]

    told = [changed.why(t_s) for t_s in moments]

    cells = [{label for row in one["table"]["rules"] for label in row} for one in told]
    assert [cell == {"PB"} for cell in cells] == [False] * 3 + [True] * 3
    for one in told:
        assert one["recorded"]["fuzzy_gain"] == pytest.approx(one["gain"], abs=0.005)
        assert one["differs"] == []


def test_no_twin_and_no_side_is_made_of_two_settings(changed: Changed) -> None:
    server, number = changed.server, changed.ride["id"]

    again = server.client.post(f"/rides/{number}/again", json={})
    since = server.get(f"/devices/{changed.device}/config/revisions/{changed.seq}/since")

    assert (again.status_code, again.json()["code"]) == (422, "settings_changed")
    assert (since["before"]["ride_ids"], since["after"]["ride_ids"]) == ([], [])
    assert (since["during_ids"] == [number]) == (changed.ride["summary"]["distance_km"] >= 0.5)


def test_the_unit_s_own_log_says_the_same(changed: Changed) -> None:
    """Fetched by another Spindle, that has never seen the ride."""
    server, device = changed.server, changed.device
    (log,) = server.get(f"/devices/{device}/logs")["items"][-1:]
    server.client.delete(f"/rides/{changed.ride['id']}").raise_for_status()
    path = f"/devices/{device}/logs/{log['log_id']}/download"
    server.simulate(device, clock="real")
    server.client.post(path).raise_for_status()
    done = eventually(lambda: server.get(path), lambda seen: seen["state"] in ("done", "failed"))
    server.simulate(device, clock="virtual")

    ride = server.get(f"/rides/{done['ride_id']}")
    (of_log,), (recorded,) = settings_of(ride), settings_of(changed.ride)
    assert of_log["value"] == recorded["value"]
    # A recording begins up to 2 s before the bike moved, a unit's log when it did.
    assert -2.0 <= of_log["t_s"] - recorded["t_s"] <= 0.1
