"""Files are read in a child process with limits on time and memory, never in the server.

A file that kills its reader is tried once more with the salvaging reader alone, because the fast
one is compiled code; then it is refused with the reason.
"""

from __future__ import annotations

import json
import os
import signal
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from backend.domain.channels import Counts, channel_from_json
from backend.domain.ride import RideContext, RideRows
from backend.domain.ride_events import RideEvent
from backend.ingest.outcome import REJECTED, ImportedRide, Outcome, rejected
from backend.ingest.worker import CPU_S, DATA_BYTES, OUT_OF_MEMORY

ROOT = Path(__file__).resolve().parents[2]
# CPU time is what the child's own limit counts; the wall clock also covers a stuck disk.
WALL_S = 3 * CPU_S
STDERR_SHOWN = 300


def read_in_child(path: Path, name: str) -> Outcome:
    """A file -> what came of it. Never raises on any contents.

    path: where the bytes are. name: what the file was called, which may decide the format.
    """
    outcome = run_child(path, name, "fast")
    if outcome.state == REJECTED and outcome.code in ("parser_crashed", "too_much_memory"):
        again = run_child(path, name, "salvage")
        if again.state != REJECTED:
            return again
    return outcome


def run_child(path: Path, name: str, way: str) -> Outcome:
    """One run of the reader; its death is an outcome too."""
    command = [sys.executable, "-m", "backend.ingest.worker", str(path), printable(name), way]
    # One thread: a pool of them would count against the memory limit without being used.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
    try:
        done = subprocess.run(
            command,
            cwd=ROOT,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=WALL_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return rejected("too_slow", f"Reading took longer than {WALL_S} s and was stopped.")
    if done.returncode == 0:
        return decode(done.stdout)
    if done.returncode == -getattr(signal, "SIGXCPU", 0):
        return rejected("too_slow", f"Reading took more than {CPU_S} s of computing; stopped.")
    if done.returncode == OUT_OF_MEMORY or b"memory allocation" in done.stderr:
        return rejected(
            "too_much_memory", f"Reading needed more than {DATA_BYTES >> 20} MB; stopped."
        )
    told = done.stderr.decode(errors="replace").strip()[-STDERR_SHOWN:]
    return rejected("parser_crashed", f"The reader died ({done.returncode}). {told}".strip())


def printable(name: str) -> str:
    """A file name that can be an argument of a command."""
    return "".join(c if c.isprintable() else "_" for c in name)[-200:] or "file"


def decode(answer: bytes) -> Outcome:
    """The child's answer. The child read hostile bytes, so its answer is checked, not trusted."""
    try:
        (length,) = struct.unpack_from("<I", answer)
        header = json.loads(answer[4 : 4 + length])
        at = 4 + length
        rides = []
        for entry in header["rides"]:
            ride, at = decode_ride(entry, answer, at)
            rides.append(ride)
        return Outcome(
            state=str(header["state"]),
            rides=tuple(rides),
            code=header["code"],
            detail=header["detail"],
            offset=header["offset"],
            completeness=header["completeness"],
        )
    except (struct.error, ValueError, KeyError, TypeError) as error:
        return rejected("parser_crashed", f"The reader's answer makes no sense: {error}.")


def decode_ride(entry: dict[str, Any], answer: bytes, at: int) -> tuple[ImportedRide, int]:
    """One ride of the answer, and where the next begins. Raises ValueError when it is cut."""
    rows = int(entry["rows"])
    channels = tuple(channel_from_json(channel) for channel in entry["channels"])
    times_us = np.frombuffer(answer, "<i8", rows, at).astype(np.int64)
    at += 8 * rows
    counts: dict[str, Counts] = {}
    for channel in channels:
        kind = channel.dtype.newbyteorder("<")
        counts[channel.name] = np.frombuffer(answer, kind, rows, at).astype(channel.dtype)
        at += kind.itemsize * rows
    period_us = entry["period_us"]
    ride = ImportedRide(
        started_us=int(entry["started_us"]),
        period_us=None if period_us is None else int(period_us),
        rows=RideRows(channels, times_us, counts),
        sport=entry["sport"],
        notes=tuple(str(note) for note in entry["notes"]),
        context=RideContext(**entry["context"]),
        start_known=bool(entry["start_known"]),
        events=tuple(RideEvent(**event) for event in entry["events"]),
    )
    return ride, at
