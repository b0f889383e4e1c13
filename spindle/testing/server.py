"""A Spindle server of one's own for a test: a process on a free port, ended with the test."""

from __future__ import annotations

import os
import queue
import re
import signal
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Sequence
from pathlib import Path
from typing import Self

# Generous: what is tested is that it comes, not how fast; a machine that runs tests is busy.
PATIENCE_S = 60.0
ADDRESS = re.compile(r"https?://\S+")


class ServerDied(AssertionError):
    """The server did not start, or did not end; its own words follow."""


class RunningServer:
    """`spindle serve` on a free port of loopback, with a data folder of its own.

    devices: urls, none for a server without units. environment: SPINDLE_* for the process; those of
    the test's own environment are not passed on.
    """

    def __init__(self, data: Path, devices: Sequence[str] = ("sim",), **environment: str) -> None:
        self.data = data
        self.devices = tuple(devices)
        self.environment = environment
        self.url = ""
        self._process: subprocess.Popen[str] | None = None
        self._lines: queue.Queue[str] = queue.Queue()

    def start(self) -> Self:
        """Start it and wait for the line that tells its address. Raises ServerDied."""
        words = [sys.executable, "-m", "backend.cli", "serve", "--port", "0"]
        words += ["--data", str(self.data)]
        for device in self.devices or ("none",):
            words += ["--device", device]
        kept = {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
        self._process = subprocess.Popen(
            words,
            env={**kept, **self.environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        # A test that fails before it stops its server must not leave it running.
        weakref.finalize(self, self._process.kill)
        threading.Thread(target=self._read, args=(self._process,), daemon=True).start()
        lines: list[str] = []
        deadline_s = time.monotonic() + PATIENCE_S
        while not (found := ADDRESS.search((lines or [""])[-1])):
            try:
                lines.append(self._lines.get(timeout=max(0.0, deadline_s - time.monotonic())))
            except queue.Empty:
                self.kill()
                raise ServerDied("The server did not start:\n" + "".join(lines)) from None
        self.url = found.group()
        return self

    @property
    def pid(self) -> int:
        """The server's process id."""
        assert self._process is not None
        return self._process.pid

    @property
    def exit_code(self) -> int | None:
        """How it ended, None while it runs."""
        assert self._process is not None
        return self._process.poll()

    def stop(self, ending: signal.Signals = signal.SIGINT) -> str:
        """Stop it as Ctrl-C does; everything it printed since the address."""
        assert self._process is not None
        if self._process.poll() is None:
            self._process.send_signal(ending)
        self._process.wait(PATIENCE_S)
        return self.output()

    def output(self) -> str:
        """What it printed since the address, or since the last call."""
        lines = []
        while not self._lines.empty():
            lines.append(self._lines.get_nowait())
        return "".join(lines)

    def kill(self) -> None:
        """End it with no chance to tidy up, as a power cut does."""
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait(PATIENCE_S)

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            self._lines.put(line)
