"""The real server as its own process on a free port, for stories and for browsers."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import httpx

Answer = TypeVar("Answer")

# Generous: what is tested is that it comes, not how fast; a machine that runs tests is busy.
PATIENCE_S = 30.0
LOOK_EVERY_S = 0.05


def eventually(
    look: Callable[[], Answer],
    until: Callable[[Answer], object] = bool,
    within_s: float = PATIENCE_S,
) -> Answer:
    """What `look` gives once `until` is true of it; AssertionError if that never comes."""
    deadline_s = time.monotonic() + within_s
    while True:
        seen = look()
        if until(seen):
            return seen
        if time.monotonic() > deadline_s:
            raise AssertionError(f"Not within {within_s:g} s; last seen: {seen!r}")
        time.sleep(LOOK_EVERY_S)


class SpindleServer:
    """`spindle serve` on a free port of loopback.

    data: its folder. devices: urls, none for a server without units. `client` asks its API.
    """

    def __init__(self, data: Path, devices: Sequence[str] = ("sim",), **environment: str) -> None:
        self.data = data
        self.devices = tuple(devices)
        self.environment = environment
        self.url = ""
        self._process: subprocess.Popen[str] | None = None
        self._lines: queue.Queue[str] = queue.Queue()

    def start(self) -> SpindleServer:
        """Starts it and waits for the line that tells its address."""
        words = [sys.executable, "-m", "backend.cli", "serve", "--port", "0"]
        words += ["--data", str(self.data)]
        for device in self.devices or ("none",):
            words += ["--device", device]
        kept = {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
        self._process = subprocess.Popen(
            words,
            cwd=Path(__file__).resolve().parents[2],
            env={**kept, **self.environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        threading.Thread(target=self._read, args=(self._process,), daemon=True).start()
        said = []
        deadline_s = time.monotonic() + PATIENCE_S
        while "http://" not in (said or [""])[-1]:
            try:
                said.append(self._lines.get(timeout=max(0.0, deadline_s - time.monotonic())))
            except queue.Empty:
                self.kill()
                raise AssertionError("The server did not start:\n" + "".join(said)) from None
        self.url = next(word for word in said[-1].split() if word.startswith("http://"))
        self.client = httpx.Client(base_url=f"{self.url}/api/v1", timeout=30.0, trust_env=False)
        return self

    @property
    def pid(self) -> int:
        """The server's process id."""
        assert self._process is not None
        return self._process.pid

    def get(self, path: str, **request: Any) -> Any:
        """The JSON of a GET that must succeed."""
        return self.ask("GET", path, **request)

    def ask(self, method: str, path: str, **request: Any) -> Any:
        """The JSON of a request that must succeed."""
        response = self.client.request(method, path, **request)
        assert response.is_success, f"{method} {path}: {response.status_code} {response.text}"
        return response.json() if response.content else None

    def ready_device(self, number: int = 0) -> str:
        """The id of the number-th unit, once it is ready."""
        devices = eventually(
            lambda: self.get("/devices")["items"],
            lambda items: len(items) > number and items[number]["state"] == "ready",
        )
        return str(devices[number]["id"])

    def simulate(self, device: str, **change: Any) -> dict[str, Any]:
        """Changes the simulation behind a unit."""
        answer: dict[str, Any] = self.ask("PUT", f"/devices/{device}/simulation", json=change)
        return answer

    def stand_still(self, device: str) -> None:
        """Brakes the bike until wheel and motor rest: what writing a configuration needs."""
        self.simulate(device, scenario=None, rider={"kind": "off"}, brake=True)
        eventually(
            lambda: self.get(f"/devices/{device}/snapshot")["channels"],
            lambda now: abs(now["speed_kmh"]) < 0.01 and abs(now["motor_speed_rpm"]) < 0.1,
        )

    @property
    def exit_code(self) -> int | None:
        """How it ended, None while it runs."""
        assert self._process is not None
        return self._process.poll()

    def stop(self, ending: signal.Signals = signal.SIGINT) -> str:
        """Stops it as Ctrl-C does; everything it has said since the address."""
        assert self._process is not None
        if self._process.poll() is None:
            self._process.send_signal(ending)
        self._process.wait(PATIENCE_S)
        return self._said()

    def kill(self) -> None:
        """Ends it with no chance to tidy up, as a power cut does."""
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait(PATIENCE_S)

    def _said(self) -> str:
        lines = []
        while not self._lines.empty():
            lines.append(self._lines.get_nowait())
        return "".join(lines)

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            self._lines.put(line)
