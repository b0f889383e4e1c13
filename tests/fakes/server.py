"""The real server as its own process on a free port, for stories and for browsers."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, Self, TypeVar

import httpx

from spindle.client import rests
from spindle.testing.server import PATIENCE_S, RunningServer

Answer = TypeVar("Answer")

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


def api_client(url: str) -> httpx.Client:
    """Asks the API of the server at `url`."""
    return httpx.Client(
        base_url=f"{url}/api/v1",
        timeout=30.0,
        trust_env=False,
        # The server closes idle connections after 5 s; one in use at that moment is reset.
        limits=httpx.Limits(keepalive_expiry=2.0),
    )


class SpindleServer(RunningServer):
    """A server whose API is asked in plain JSON, as a browser does. `client` is for refusals."""

    def start(self) -> Self:
        super().start()
        self.client = api_client(self.url)
        return self

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

    def all_ready(self, count: int) -> None:
        """Wait until `count` units are ready; they become so in any order."""
        for number in range(count):
            self.ready_device(number)

    def simulate(self, device: str, **change: Any) -> dict[str, Any]:
        """Changes the simulation behind a unit."""
        answer: dict[str, Any] = self.ask("PUT", f"/devices/{device}/simulation", json=change)
        return answer

    def stand_still(self, device: str) -> None:
        """Brakes the bike until wheel and motor rest: what writing a configuration needs."""
        self.simulate(device, scenario=None, rider={"kind": "off"}, brake=True)
        eventually(
            lambda: self.get(f"/devices/{device}/snapshot")["channels"],
            rests,
        )
