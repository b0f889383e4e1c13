"""Goal: people lose databases and start servers twice; no ride is lost or ended by that.

Method: real servers and the real command. A bike records; a second server is started on the same
database; the first is killed; the database is deleted; every step says what it did.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.fakes.server import ServerProcess, SpindleServer, eventually

PATIENCE_S = 60.0


def spindle(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """One run of the command, to its end."""
    kept = {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
    return subprocess.run(
        [sys.executable, "-m", "backend.cli", *words],
        env={**kept, **environment},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def begin_to_ride(server: SpindleServer) -> None:
    server.simulate(
        server.ready_device(),
        scenario=None,
        brake=False,
        assist_mode=3,
        rider={"kind": "legs", "torque_nm": 25.0, "cadence_rpm_max": 90.0},
    )


def longer_than(server: SpindleServer, rows: int) -> dict[str, Any]:
    """The newest ride once it has more rows."""
    rides = eventually(
        lambda: server.get("/rides")["items"],
        lambda items: items and items[0]["row_count"] > rows,
    )
    newest: dict[str, Any] = rides[0]
    return newest


@pytest.mark.long
def test_a_store_survives_a_second_server_a_crash_and_a_lost_database(tmp_path: Path) -> None:
    data = tmp_path / "data"
    server = ServerProcess(data, ["sim:one?seed=21&speed=5"]).start()
    begin_to_ride(server)
    ride = longer_than(server, 500)

    # A second server on the same database, with a folder of its own for everything else.
    database = f"sqlite:///{data}/spindle.db"
    second = spindle(
        *("serve", "--port", "0", "--device", "none", "--data", str(tmp_path / "second")),
        SPINDLE_DB=database,
    )
    assert second.returncode == 1
    assert "Another Spindle is using" in second.stderr
    assert "Traceback" not in second.stderr
    again = longer_than(server, ride["row_count"] + 500)
    assert (again["id"], again["state"]) == (ride["id"], "live")

    # The server dies in the middle of the ride.
    server.kill()
    server = ServerProcess(data, []).start()
    cut = server.get(f"/rides/{ride['id']}")
    assert (cut["state"], cut["cut_short"]) == ("done", True)
    server.ask("PATCH", f"/rides/{ride['id']}", json={"name": "Tour", "notes": "headwind"})
    whole = server.get(f"/rides/{ride['id']}")
    server.stop()

    # The database is deleted, and somebody starts the server as if nothing had happened.
    (data / "spindle.db").unlink()
    refused = spindle("serve", "--port", "0", "--device", "none", "--data", str(data))
    assert refused.returncode == 1
    assert "spindle store check" in refused.stderr
    assert "spindle store rebuild" in refused.stderr
    check = spindle("store", "check", "--data", str(data), "--json")
    assert check.returncode == 1
    assert json.loads(check.stdout)["database"]["state"] == "missing"
    rebuilt = spindle("store", "rebuild", "--data", str(data), "--json")
    assert rebuilt.returncode == 0, rebuilt.stderr
    assert json.loads(rebuilt.stdout)["rides"] == 1

    server = ServerProcess(data, []).start()
    (back,) = server.get("/rides")["items"]
    said = server.stop()
    # Only the number may be another.
    assert {**back, "id": 0} == {**whole, "id": 0}
    assert said == ""
