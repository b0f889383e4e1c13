"""Many units and many viewers on one server, all on this machine: are rows lost, and who answers?

Units are simulated in one process of their own, at 100 Hz, each ridden and recorded. Viewers are
WebSockets of one process, as many pages as that; a client asks for the rides all the while.

    python -m tools.bench.load [--units 100] [--viewers 50] [--seconds 60]
"""

import argparse
import asyncio
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import anyio
import numpy as np
import websockets

from tools.bench.figures import Figure
from tools.bench.server import ROOT, ask, cpu_share, resident_bytes, serving

HEADER = struct.Struct("<IIQHH")
REQUEST_EVERY_S = 0.2
SETTLE_S = 5.0


@dataclass(frozen=True)
class Load:
    """What came of it. rows_lost: on the way to the server, by it, and not saved."""

    units: int
    viewers: int
    seconds: float
    rows: int
    rows_lost: int
    rows_missed_by_viewers: int
    server_pct: float
    units_pct: float
    answered_ms: tuple[float, float]
    resident_mb: float
    stopped_s: float


def run() -> list[Figure]:
    return [figure_of(measured(units, 50, 30.0)) for units in (16, 32)]


def figure_of(load: Load) -> Figure:
    p50_ms, p99_ms = load.answered_ms
    return Figure(
        f"{load.units} units at 100 Hz, {load.viewers} viewers, {load.seconds:.0f} s: rows lost",
        f"{load.rows_lost} of {load.rows:,}",
        "0",
        load.rows_lost == 0,
        f"server {load.server_pct:.0f} %, units {load.units_pct:.0f} % of a core; GET /rides "
        f"{p50_ms:.0f} ms, p99 {p99_ms:.0f} ms; viewers missed {load.rows_missed_by_viewers}; "
        f"{load.resident_mb:.0f} MB; stopped in {load.stopped_s:.1f} s",
    )


def measured(units: int, viewers: int, seconds: float) -> Load:
    with ExitStack() as opened:
        data = Path(opened.enter_context(tempfile.TemporaryDirectory()))
        simulator, ports = opened.enter_context(simulated(units))
        urls = [f"socket://127.0.0.1:{port}" for port in ports]
        served = serving(data, *urls, ready_within_s=120.0)
        process, address, _ = served.__enter__()
        try:
            ids = [device["id"] for device in ask(address, "/devices")["items"]]
            for device in ids:
                ride = {"rider": {"kind": "legs", "torque_nm": 25.0}}
                ask(address, f"/devices/{device}/simulation", "PUT", ride)
            watching = opened.enter_context(watched(address, ids, viewers, seconds + 2 * SETTLE_S))
            time.sleep(SETTLE_S)
            before = counted(address, ids)
            start = time.perf_counter()
            answered: list[float] = []
            with cpu_share(process.pid) as server, cpu_share(simulator.pid) as simulation:
                while time.perf_counter() - start < seconds:
                    asked = time.perf_counter()
                    ask(address, "/rides?limit=50")
                    answered.append(1e3 * (time.perf_counter() - asked))
                    time.sleep(REQUEST_EVERY_S)
            after = counted(address, ids)
            missed = int(watching.communicate(timeout=60)[0])
            resident_mb = resident_bytes(process.pid) / 1e6
            stop = time.perf_counter()
        finally:
            served.__exit__(None, None, None)
        stopped_s = time.perf_counter() - stop
    rows, lost = after[0] - before[0], after[1] - before[1]
    tail = (float(np.percentile(answered, 50)), float(np.percentile(answered, 99)))
    return Load(
        units, viewers, seconds, rows, lost, missed, server.pct, simulation.pct, tail, resident_mb,
        stopped_s,
    )  # fmt: skip


@contextmanager
def simulated(units: int) -> Iterator[tuple["subprocess.Popen[str]", list[int]]]:
    command = [sys.executable, "-m", "sim_device", "unit", "--tcp", "0", "--count", str(units)]
    process = subprocess.Popen(
        [*command, "--scenario", "none"], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    try:
        yield process, [int(process.stdout.readline().split()[1]) for _ in range(units)]
    finally:
        process.kill()
        process.wait()


def counted(address: str, ids: list[str]) -> tuple[int, int]:
    """Rows that came and rows that were lost so far, of all units."""
    links = [ask(address, f"/devices/{device}")["link"] for device in ids]
    health = [device["recorder"] for device in ask(address, "/health")["devices"]]
    lost = sum(one["rows_lost"] + one["rows_missing"] for one in health)
    return (
        sum(link["stream_rows"] for link in links),
        sum(link["stream_rows_lost"] for link in links) + lost,
    )


@contextmanager
def watched(
    address: str, ids: list[str], viewers: int, seconds: float
) -> Iterator["subprocess.Popen[str]"]:
    """Viewers in a process of their own; it prints how many rows they missed."""
    words = [address.replace("http", "ws", 1), str(viewers), str(seconds), *ids]
    process = subprocess.Popen(
        [sys.executable, "-m", "tools.bench.load", "watch", *words],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


async def watch(address: str, ids: list[str], viewers: int, seconds: float) -> int:
    """Each viewer looks at one unit; rows that were said to be lost."""

    async def one(device: str) -> int:
        missed, until_s = 0, time.monotonic() + seconds
        async with websockets.connect(f"{address}/devices/{device}/live") as socket:
            while (left_s := until_s - time.monotonic()) > 0.0:
                try:
                    frame = await asyncio.wait_for(socket.recv(), left_s)
                except TimeoutError:
                    break
                if isinstance(frame, bytes):
                    missed += HEADER.unpack_from(frame)[1]
        return missed

    return sum(await asyncio.gather(*(one(ids[n % len(ids)]) for n in range(viewers))))


def main() -> None:
    if sys.argv[1:2] == ["watch"]:
        address, viewers, seconds, *ids = sys.argv[2:]
        print(anyio.run(watch, address, ids, int(viewers), float(seconds)))
        return
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--units", type=int, default=100)
    parser.add_argument("--viewers", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    options = parser.parse_args()
    figure = figure_of(measured(options.units, options.viewers, options.seconds))
    print(f"{figure.subject}: {figure.value}\n{figure.against}")


if __name__ == "__main__":
    main()
