"""Goal: a mechanic may try a change, and forgetting about it is safe.

The whole way is real: HTTP, the reader thread, the protocol, the unit's C and its flash. Whoever
neither keeps nor reverts gets back what was there.
"""

from __future__ import annotations

from typing import Any

import pytest

from tests.fakes.server import SpindleServer, eventually

SOON_S = 2
LONG_S = 120


@pytest.fixture
def before(server: SpindleServer, device: str) -> dict[str, Any]:
    """The configuration of a bike that stands."""
    config: dict[str, Any] = server.get(f"/devices/{device}/config")
    return config


def try_out(server: SpindleServer, device: str, filter_s: float, confirm_s: int) -> Any:
    body = {"parameters": {"torque_filter_s": filter_s}, "reason": "try", "confirm_s": confirm_s}
    return server.ask("PATCH", f"/devices/{device}/config", json=body)


def test_a_change_that_nobody_keeps_is_given_up_by_the_unit(
    server: SpindleServer, device: str, before: dict[str, Any]
) -> None:
    change = try_out(server, device, 0.81, SOON_S)

    assert (change["state"], change["verified"]) == ("provisional", True)
    stamp = server.get(f"/devices/{device}")["config"]
    assert (stamp["state"], stamp["generation"]) == ("provisional", change["generation"])
    assert stamp["expires_at"] is not None
    assert 0.0 <= stamp["remaining_s"] <= SOON_S
    server.advance(device, SOON_S + 0.5)
    eventually(
        lambda: server.get(f"/devices/{device}")["config"],
        lambda config: config["state"] == "committed" and config["rollback_cause"] == "time_out",
    )
    newest = eventually(
        lambda: server.get(f"/devices/{device}/config/revisions")["items"][0],
        lambda revision: revision["state"] == "verified",
    )
    assert newest["reason"] == "Returned to by the unit itself: the trial before was not confirmed."
    assert server.get(f"/devices/{device}/config") == before


def test_a_change_that_is_kept_stays(
    server: SpindleServer, device: str, before: dict[str, Any]
) -> None:
    change = try_out(server, device, 0.82, LONG_S)

    kept = server.ask("POST", f"/devices/{device}/config/confirm")

    assert (kept["state"], kept["verified"]) == ("committed", True)
    assert kept["crc32"] == change["crc32"]
    assert server.get(f"/devices/{device}")["config"]["state"] == "committed"
    newest = server.get(f"/devices/{device}/config/revisions")["items"][0]
    assert (newest["state"], newest["reason"]) == ("verified", "Kept after its trial: try")


def test_while_a_change_is_on_trial_no_other_is_written_over_the_way_back(
    server: SpindleServer, device: str, before: dict[str, Any]
) -> None:
    try_out(server, device, 0.84, LONG_S)

    response = server.client.patch(
        f"/devices/{device}/config", json={"parameters": {"torque_filter_s": 0.9}}
    )

    assert (response.status_code, response.json()["code"]) == (409, "busy")
    server.ask("POST", f"/devices/{device}/config/rollback")
    assert server.get(f"/devices/{device}/config") == before
