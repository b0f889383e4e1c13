"""Makes the folder of a release: what this version leaves on a disk, for every later one to open.

Usage: python -m tests.releases.make VERSION [CODE]

CODE is a checkout of that version with its C extension built, this one by default. Its server runs
one simulated unit in virtual time: a ride that coasts, a configuration with a reason, a small file
that was made here, a name somebody wrote, a calibration that was written, restored and closed, and
one that is open. What the version says of all that is kept beside its data.
"""

from __future__ import annotations

import getpass
import io
import json
import os
import re
import shutil
import socket
import sqlite3
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import Any

from tests.fakes.fit_file import commute, fit_file
from tests.fakes.server import ServerProcess, SpindleServer, eventually

HERE = Path(__file__).resolve().parent
UNIT = "sim:release?seed=7&clock=virtual&scenario=none"
BYTES_MAX = 300_000
RIDE_S, COAST_S, REST_S = 20, 8, 40
CHANGED = {"torque_filter_s": 0.33, "mode_ratios": [0.0, 0.25, 0.5, 1.0, 1.5]}
REASON = "for the release"
NAME = "Evening loop"
TABLE = "Softer start"
# Zero, two loads up and down: nine captures of one side.
BENCH = {
    "arm_m": 0.17,
    "arm_limit_m": 0.0003,
    "gravity": {"gravity_ms2": 9.81, "standard_ms2": 1e-4},
    "masses": [{"name": "discs", "mass_kg": 10.0, "mass_class": "M3"}],
    "loads_kg": [10.0, 25.0],
    "full_scale_nm": 80.0,
    "strokes": 2,
    "sides": ["right"],
}
# Its sensor has the noise that a capture asks for; on the workbench nobody rides it.
NOISY = "stop_and_go"
HANGS_S = 15
# The unit spares its flash: so long after one write it takes the next.
SPARES_S = 120
CALIBRATION = ("id", "state", "author", "opened_at", "closed_at", "setup", "captures", "result")
ZERO = ("ride_id", "zero_nm", "zero_counts", "reason")
# What a running server needs and the next one makes anew.
LEFT_OUT = shutil.ignore_patterns("*-wal", "*-shm", "*.lock", "collecting")


def lived(data: Path) -> dict[str, Any]:
    """Lives a little with the server of the current folder; what it said of it at the end."""
    server = ServerProcess(data, [UNIT]).start()
    device = server.ready_device()
    server.ask("PATCH", f"/devices/{device}/config", json={"parameters": CHANGED, "reason": REASON})
    rider = {"kind": "legs", "torque_nm": 25.0, "cadence_rpm_max": 90.0}
    server.simulate(device, scenario=None, seed=42, brake=False, assist_mode=3, rider=rider)
    advance(server, device, RIDE_S)
    server.simulate(device, rider={"kind": "off"})
    advance(server, device, COAST_S)
    server.simulate(device, brake=True)
    advance(server, device, REST_S)
    (ride,) = rides_done(server, 1)
    server.ask("PATCH", f"/rides/{ride['id']}", json={"name": NAME})
    answer = server.client.post("/rides/import?name=commute.fit", content=fit_file(commute(300)))
    assert answer.is_success, answer.text
    table = server.get("/library/even") | {"name": TABLE}
    kept = server.client.post("/library", json=table).json()
    calibrations = calibrated(server, device)
    answers = {
        "device": device,
        "calibrations": calibrations,
        "zeros": zeros(server, device),
        "library": [{"id": kept["id"], "document": server.get(f"/library/{kept['id']}")}],
        "parameters": server.get(f"/devices/{device}/config")["parameters"],
        "revisions": [
            {"generation": one["generation"], "reason": one["reason"]}
            for one in server.get(f"/devices/{device}/config/revisions")["items"]
        ],
        "rides": [
            {name: one[name] for name in ("id", "name", "origin", "row_count", "summary")}
            for one in rides_done(server, 2)
        ],
    }
    server.stop()
    return answers


def calibrated(server: SpindleServer, device: str) -> list[dict[str, Any]]:
    """A calibration that is closed, its old record restored, and one with two captures that is
    open; none of a version that had none."""
    if server.client.get("/calibrations").status_code == 404:
        return []
    server.simulate(device, scenario=NOISY)
    for captures, closing in ((9, ("write", "restore", "close")), (2, ())):
        job = server.ask("POST", "/calibrations", json={"device_id": device})
        path = f"/calibrations/{job['id']}"
        server.ask("PUT", f"{path}/setup", json=BENCH)
        for _ in range(captures):
            job = captured(server, device, path)
        if closing:
            server.ask("DELETE", f"{path}/captures/{captures}?reason={REASON}")
            job = captured(server, device, path)
            server.ask("POST", f"{path}/fit")
        for verb in closing:
            advance(server, device, SPARES_S)
            server.ask("POST", f"{path}/{verb}")
    server.simulate(device, scenario=None, workbench=None)
    return [
        {name: one[name] for name in CALIBRATION}
        for one in (server.get(f"/calibrations/{job['id']}") for job in listed(server))
    ]


def captured(server: SpindleServer, device: str, path: str) -> dict[str, Any]:
    """The next step of a calibration, hung and taken."""
    job = server.get(path)
    state = job["steps"][job["next_step"]]["state"]
    server.simulate(device, workbench={"side": state["side"], "mass_kg": state["mass_kg"]})
    advance(server, device, HANGS_S)
    given = {name: value for name, value in state.items() if name != "sensor_degc"}
    taken: dict[str, Any] = server.ask("POST", f"{path}/captures", json=given)
    return taken


def listed(server: SpindleServer) -> list[dict[str, Any]]:
    """Every calibration, newest first."""
    found: list[dict[str, Any]] = server.get("/calibrations")["items"]
    return found


def zeros(server: SpindleServer, device: str) -> list[dict[str, Any]]:
    """What the rides tell of the sensor's zero, once all are looked at; none of a version that did
    not watch it."""
    if not server.client.get(f"/devices/{device}/sensor-drift").is_success:
        return []
    drift = eventually(
        lambda: server.get(f"/devices/{device}/sensor-drift"), lambda answer: bool(answer["rides"])
    )
    return [{name: ride[name] for name in ZERO} for ride in drift["rides"]]


def rides_done(server: SpindleServer, count: int) -> list[dict[str, Any]]:
    """The rides once there are so many and all are over."""
    return eventually(
        lambda: [ride for ride in server.get("/rides")["items"] if ride["state"] == "done"],
        lambda rides: len(rides) == count,
    )


def advance(server: SpindleServer, device: str, seconds: float) -> None:
    server.ask("POST", f"/devices/{device}/simulation/advance", json={"seconds": seconds})
    eventually(
        lambda: server.get(f"/devices/{device}/simulation"),
        lambda simulation: simulation["advance_left_s"] == 0.0,
    )


def tidied(data: Path, target: Path) -> None:
    """A copy of a closed data folder without what only a running server needs."""
    shutil.copytree(data, target, ignore=LEFT_OUT)
    with sqlite3.connect(target / "spindle.db") as database:
        database.execute("PRAGMA journal_mode = DELETE")
        database.execute("VACUUM")
    database.close()


def names_of_this_machine(folder: Path, *more: Path) -> list[str]:
    """Files that name this machine, its user or its folders: nobody else's business."""
    names = {socket.gethostname(), str(Path.cwd()), str(Path.home()), *map(str, more)}
    user = getpass.getuser()
    # Two or three letters are in any compressed file by chance.
    pattern = re.compile(
        b"|".join(re.escape(name.encode()) for name in names if len(name) > 3)
        + b"|/(?:home|tmp|var|Users|dev/shm)/|\\b" + re.escape(user.encode()) + b"@"
    )  # fmt: skip
    return [str(path) for path in folder.rglob("*") if path.is_file()
            and pattern.search(path.read_bytes())]  # fmt: skip


def main() -> None:
    version = sys.argv[1]
    code = Path(sys.argv[2] if len(sys.argv) > 2 else ".").resolve()
    target = HERE / version
    if target.exists():
        sys.exit(f"{target} is there already: a release is made once.")
    os.chdir(code)
    with tempfile.TemporaryDirectory() as folder:
        answers = lived(Path(folder) / "data")
        made = Path(folder) / "made"
        tidied(Path(folder) / "data", made)
        names = names_of_this_machine(made, Path(folder), code)
        if names:
            sys.exit(f"These name this machine: {names}")
        packed = io.BytesIO()
        with tarfile.open(fileobj=packed, mode="w:xz") as archive:
            for path in sorted(made.rglob("*")):
                archive.add(path, path.relative_to(made), recursive=False, filter=nobody)
        if len(packed.getvalue()) > BYTES_MAX:
            sys.exit(f"{len(packed.getvalue())} bytes are more than {BYTES_MAX}: ride less.")
    target.mkdir()
    (target / "data.tar.xz").write_bytes(packed.getvalue())
    (target / "answers.json").write_text(json.dumps(answers, indent=1) + "\n", encoding="utf-8")
    print(f"{target}: {len(packed.getvalue())} bytes")


def nobody(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    """Without the user who made it."""
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry


if __name__ == "__main__":
    main()
