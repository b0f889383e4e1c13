"""Files are read in a child process with limits on time and memory, never in the server.

A file that kills its reader is refused with the reason.
"""

from __future__ import annotations

import json
import os
import signal
import struct
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np

from backend.domain.channels import Counts, channel_from_json
from backend.domain.intake import Intake
from backend.domain.noted import noted_from_json
from backend.domain.ride import RideContext, RideRows
from backend.domain.ride_events import RideEvent
from backend.ingest.outcome import TOO_SLOW, ImportedRide, Outcome, rejected
from backend.ingest.worker import CPU_S, DATA_BYTES, OUT_OF_MEMORY

ROOT = Path(__file__).resolve().parents[2]
# CPU time is what the child's own limit counts; the wall clock also covers a stuck disk.
WALL_S = 3 * CPU_S
STDERR_SHOWN = 300


class ReadingStopped(Exception):
    """Spindle stops: the file was not read to its end, and nothing is known of it."""


class Children:
    """The children that read at present, so that a stop can end them; safe from any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._running: set[subprocess.Popen[bytes]] = set()
        self._stopped = False

    def stop(self) -> None:
        """End every child, and begin no other."""
        with self._lock:
            self._stopped = True
            for child in self._running:
                child.kill()

    def run(self, command: list[str], wall_s: float) -> subprocess.CompletedProcess[bytes]:
        """A command to its end. Raises ReadingStopped, subprocess.TimeoutExpired."""
        # One thread: a pool of them would count against the memory limit without being used.
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
        with self._lock:
            self._check()
            child = subprocess.Popen(
                command,
                cwd=ROOT,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                # Ctrl-C in a terminal is meant for the server: a child that died of it would
                # look like one that its file killed.
                start_new_session=True,
                creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
            )
            self._running.add(child)
        try:
            out, err = child.communicate(timeout=wall_s)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            raise
        finally:
            with self._lock:
                self._running.discard(child)
        with self._lock:
            self._check()
        return subprocess.CompletedProcess(command, child.returncode, out, err)

    def _check(self) -> None:
        if self._stopped:
            raise ReadingStopped


def read_in_child(
    path: Path, name: str, wall_s: float = WALL_S, children: Children | None = None
) -> Outcome:
    """A file -> what came of it; the death of its reader is an outcome too.

    path: where the bytes are. name: what the file was called, which may decide the format. wall_s:
    how long the child may take. children: whose `stop` ends it. Raises ReadingStopped after that.
    """
    children = children or Children()
    command = [sys.executable, "-m", "backend.ingest.worker", str(path), printable(name)]
    try:
        done = children.run(command, wall_s)
    except subprocess.TimeoutExpired:
        return rejected(TOO_SLOW, f"Reading took longer than {wall_s:g} s and was stopped.")
    if done.returncode == 0:
        return decode(done.stdout)
    if done.returncode == -getattr(signal, "SIGXCPU", 0):
        return rejected(TOO_SLOW, f"Reading took more than {CPU_S} s of computing; stopped.")
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
        intake=None if entry["intake"] is None else Intake(**entry["intake"]),
        noted=noted_from_json(entry["noted"]),
    )
    return ride, at
