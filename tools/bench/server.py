"""The server as a user has it: ready when, how large, and does an hour's recording lose a sample.

The hour is one hour of the unit's own time at 100 Hz: the simulated unit runs faster than real
time, everything else (firmware, line, session, recorder, disk) is what a real hour goes through.
"""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.bench.figures import Figure

SPEED_FACTOR = 30
HOUR_S = 3600
READY_WITHIN_S = 30
ROOT = Path(__file__).resolve().parents[2]


def run() -> list[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        with serving(Path(folder) / "idle", "sim") as (process, address, ready_s):
            time.sleep(5)
            resident_mb = resident_bytes(process.pid) / 1e6
            cpu_pct = cpu_share_pct(process.pid, 5)
        with serving(Path(folder) / "hour", f"sim:hour?speed={SPEED_FACTOR}&scenario=none") as (
            _process,
            address,
            _ready,
        ):
            recorded = record_an_hour(address)
    return [
        Figure("server ready after its start", f"{ready_s:.1f} s", "<= 3 s", ready_s <= 3),
        Figure("server's memory with one unit", f"{resident_mb:.0f} MB", "< 200 MB",
               resident_mb < 200, f"{cpu_pct:.1f} % of a core while it records"),
        recorded,
    ]  # fmt: skip


@contextmanager
def serving(
    data: Path, *devices: str, ready_within_s: float = READY_WITHIN_S
) -> Iterator[tuple["subprocess.Popen[bytes]", str, float]]:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    address = f"http://127.0.0.1:{port}/api/v1"
    command = [sys.executable, "-m", "backend.cli", "serve", "--port", str(port)]
    command += ["--data", str(data)]
    for device in devices:
        command += ["--device", device]
    start = time.perf_counter()
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL)
    try:
        while not all_ready(address):
            if time.perf_counter() - start > ready_within_s:
                raise TimeoutError(f"no unit ready at {address} after {ready_within_s} s")
            time.sleep(0.02)
        yield process, address, time.perf_counter() - start
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(60)


def all_ready(address: str) -> bool:
    try:
        devices = ask(address, "/health")["devices"]
    except OSError:
        return False
    return bool(devices) and all(device["state"] == "ready" for device in devices)


def record_an_hour(address: str) -> Figure:
    device = ask(address, "/devices")["items"][0]["id"]
    rider = {"rider": {"kind": "legs", "torque_nm": 25.0}, "road": {"grade_deg": 0.5}}
    ask(address, f"/devices/{device}/simulation", "PUT", rider)
    start = time.perf_counter()
    time.sleep(HOUR_S / SPEED_FACTOR + 2)
    link = ask(address, f"/devices/{device}")["link"]
    ask(address, f"/devices/{device}/simulation", "PUT", {"rider": {"kind": "off"}, "brake": True})
    ride = finished_ride(address)
    wall_s = time.perf_counter() - start
    summary = ask(address, f"/rides/{ride['id']}")
    rows = summary["row_count"]
    lost = link["stream_rows_lost"]
    gaps = sum(gap.get("rows") or 0 for gap in summary["gaps"])
    whole = lost == 0 and gaps == 0 and rows >= HOUR_S * 100
    return Figure(
        "an hour's recording at 100 Hz: samples lost",
        f"{lost + gaps} of {rows:,} rows",
        "0",
        whole,
        f"recorded in {wall_s:.0f} s, {SPEED_FACTOR} times real time",
    )


def finished_ride(address: str) -> dict[str, Any]:
    for _ in range(600):
        rides = ask(address, "/rides")["items"]
        if rides and rides[0]["state"] == "done":
            return rides[0]
        time.sleep(0.2)
    raise TimeoutError("the ride did not close itself")


def ask(address: str, path: str, method: str = "GET", body: object = None) -> Any:
    request = urllib.request.Request(
        address + path,
        method=method,
        data=None if body is None else json.dumps(body).encode(),
        headers={"Content-Type": "application/json"},
    )
    with urllib.request.urlopen(request, timeout=10) as answer:
        return json.load(answer)


def resident_bytes(pid: int) -> int:
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def cpu_share_pct(pid: int, seconds: float) -> float:
    """Per cent of a core that a process takes from now on."""
    with cpu_share(pid) as share:
        time.sleep(seconds)
    return share.pct


@dataclass
class CpuShare:
    """Per cent of a core, once it was measured."""

    pct: float = 0.0


@contextmanager
def cpu_share(pid: int) -> Iterator[CpuShare]:
    """The share of a core that a process takes inside."""

    def ticks() -> int:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        return int(fields[11]) + int(fields[12])

    share, before, start = CpuShare(), ticks(), time.perf_counter()
    yield share
    lasted_s = time.perf_counter() - start
    share.pct = 100 * (ticks() - before) / os.sysconf("SC_CLK_TCK") / lasted_s
