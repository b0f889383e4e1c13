"""Goal: people lose databases and start servers twice; no ride is lost or ended by that.

Method: real servers, the first one a process, and the command. A bike records; a second server is
started on the same database; the first is killed; the database is deleted; every step says what it
did.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.fakes.command import refused_start, spindle
from tests.fakes.ride_in_time import ride_on, rides_of
from tests.fakes.server import ServerHere, ServerProcess, eventually

pytestmark = pytest.mark.slow


def has_its_card(ride: dict[str, Any]) -> bool:
    """Whether what is made of a ride after it ended is there."""
    return bool(ride["speed_line_kmh"])


def test_a_store_survives_a_second_server_a_crash_and_a_lost_database(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    data = tmp_path / "data"
    server = ServerProcess(data, ["sim:one?seed=21&clock=virtual&scenario=none"]).start()
    device = server.ready_device()
    ride_on(server, device, 8.0)
    (ride,) = eventually(lambda: rides_of(server, device))

    # A second server on the same database, with a folder of its own for everything else.
    database = f"sqlite:///{data}/spindle.db"
    second = refused_start(tmp_path / "second", SPINDLE_DB=database)
    assert second.returncode == 1
    assert "Another Spindle is using" in second.stderr
    server.advance(device, 8.0)
    (again,) = eventually(
        lambda: rides_of(server, device), lambda one: one[0]["row_count"] > ride["row_count"] + 500
    )
    assert (again["id"], again["state"]) == (ride["id"], "live")

    # The server dies in the middle of the ride.
    server.kill()
    here = ServerHere(data)
    with here:
        cut = here.get(f"/rides/{ride['id']}")
        assert (cut["state"], cut["cut_short"]) == ("done", True)
        here.ask("PATCH", f"/rides/{ride['id']}", json={"name": "Tour", "notes": "headwind"})
        whole = eventually(lambda: here.get(f"/rides/{ride['id']}"), has_its_card)

    # The database is deleted, and somebody starts the server as if nothing had happened.
    (data / "spindle.db").unlink()
    refused = refused_start(data)
    assert refused.returncode == 1
    assert "spindle store check" in refused.stderr
    assert "spindle store rebuild" in refused.stderr
    check = spindle(None, "store", "check", "--data", data, "--json")
    assert check.returncode == 1
    assert json.loads(check.stdout)["database"]["state"] == "missing"
    rebuilt = spindle(None, "store", "rebuild", "--data", data, "--json")
    assert rebuilt.returncode == 0, rebuilt.stderr
    assert json.loads(rebuilt.stdout)["rides"] == 1

    caplog.clear()
    with here:
        (back,) = eventually(
            lambda: here.get("/rides")["items"], lambda rides: has_its_card(rides[0])
        )
    # Only the number may be another.
    assert {**back, "id": 0} == {**whole, "id": 0}
    assert caplog.messages == []
