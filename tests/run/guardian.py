"""Ends what a run of the tests leaves behind: `python guardian.py MARK FOLDER`, beside the run.

It waits until its standard input closes, which happens however the run ends, by itself, by Ctrl-C
or by SIGKILL. Then it ends each process that has the mark in its environment, and removes the
folder unless the run has said `keep`. What it had to end, or could not, it prints. Processes are
looked for in /proc; on a system without it none is ended.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path

VARIABLE = "TESTS_OF_RUN"
PROC = Path("/proc")
LOOK_EVERY_S = 0.05
# Workers and readers end by themselves once nobody talks to them; and a little later when asked.
GRACE_S = 2.0
SIGNALS = (signal.SIGTERM, signal.SIGKILL)


def marked(mark: str) -> dict[int, str]:
    """The processes of the run: their numbers and commands. One that ended is none."""
    wanted = f"{VARIABLE}={mark}".encode()
    found = {}
    for folder in PROC.glob("[0-9]*"):
        try:
            if wanted in (folder / "environ").read_bytes().split(b"\0"):
                words = (folder / "cmdline").read_bytes().split(b"\0")
                found[int(folder.name)] = b" ".join(words).decode(errors="replace").strip()
        except OSError:
            continue
    return found


def gone(mark: str, within_s: float = GRACE_S) -> dict[int, str]:
    """Those of the run that are still there after so long."""
    deadline_s = time.monotonic() + within_s
    while (left := marked(mark)) and time.monotonic() < deadline_s:
        time.sleep(LOOK_EVERY_S)
    return left


def end_all(mark: str) -> list[str]:
    """Ends every process of the run; a line for each that did not end by itself."""
    told = []
    left = gone(mark)
    for number in SIGNALS:
        for pid, words in left.items():
            told.append(f"{number.name} to process {pid}: {words[:100]}")
            with contextlib.suppress(OSError):
                os.kill(pid, number)
        left = gone(mark) if left else left
    return told + [f"process {pid} does not end: {words[:100]}" for pid, words in left.items()]


def main(words: Sequence[str]) -> None:
    """Waits for the end of the run, then leaves nothing of it."""
    mark, folder = words
    wishes = sys.stdin.read().split()
    told = end_all(mark)
    if "keep" not in wishes:
        shutil.rmtree(folder, ignore_errors=True)
        with contextlib.suppress(OSError):
            Path(folder).parent.rmdir()
    # After Ctrl-C there may be nobody who reads it.
    with contextlib.suppress(OSError):
        sys.stdout.write("\n".join(told))
        sys.stdout.flush()


if __name__ == "__main__":
    # Ctrl-C in the terminal ends the run; what it leaves is still to be ended.
    for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(each, signal.SIG_IGN)
    main(sys.argv[1:])
