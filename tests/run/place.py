"""The folder of one run: in memory where there is room, with everything that the run writes.

Tests wait for the disk too often, and what is left must be found. TMPDIR points into it, so that
browsers, databases and simulated units keep their files there, too.
"""

from __future__ import annotations

import getpass
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

IN_MEMORY = Path("/dev/shm")
ROOM_BYTES = 4_000_000_000
# Users of another name, PostgreSQL's, pass through to a folder of their own.
PASSABLE = 0o711


def in_memory() -> bool:
    """Whether the tests' files fit into memory, and programs may be run from there."""
    if not os.access(IN_MEMORY, os.W_OK) or shutil.disk_usage(IN_MEMORY).free < ROOM_BYTES:
        return False
    with tempfile.TemporaryDirectory(dir=IN_MEMORY) as folder:
        probe = Path(folder) / "probe"
        probe.write_text("#!/bin/sh\n")
        probe.chmod(0o700)
        try:
            return subprocess.run([probe], check=False).returncode == 0
        except OSError:
            return False


def mark_of(pid: int) -> str | None:
    """What tells a process from every other; None where there is none of this number."""
    try:
        started = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[19]
    except OSError:
        return None
    return f"{pid}-{started}"


def of_this_run() -> Path:
    """A new folder; those that earlier runs kept for a look are removed."""
    root = IN_MEMORY if in_memory() else Path(tempfile.gettempdir())
    runs = root / f"spindle-tests-{getpass.getuser()}"
    folder = runs / (mark_of(os.getpid()) or f"{os.getpid()}-0")
    (folder / "tmp").mkdir(parents=True)
    for each in (runs, folder, folder / "tmp"):
        each.chmod(PASSABLE)
    for earlier in runs.iterdir():
        if mark_of(int(earlier.name.partition("-")[0])) != earlier.name and earlier != folder:
            shutil.rmtree(earlier, ignore_errors=True)
    return folder
