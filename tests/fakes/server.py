"""The real server on a free port: on a thread of the test's process, or as its own process."""

from __future__ import annotations

import contextlib
import socket
import ssl
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Self, TypeVar

import httpx
import uvicorn

from backend.device.families import FAMILIES, Families
from backend.listening import listening_socket, server_config
from backend.main import build_app, open_services
from backend.services import Services
from backend.settings import load
from spindle.client import Spindle
from spindle.testing.server import PATIENCE_S, RunningServer
from tests.fakes import simulated_unit
from tests.run import started

Answer = TypeVar("Answer")

LOOK_EVERY_S = 0.05
# A unit takes the next configuration two seconds of its time after the one before.
WRITES_EVERY_S = 2.0


@contextlib.contextmanager
def serving(config: uvicorn.Config, listening: socket.socket) -> Iterator[tuple[str, int]]:
    """Any application on a thread of its own; the address it answers at."""
    server = uvicorn.Server(config)
    thread = threading.Thread(target=lambda: server.run(sockets=[listening]), daemon=True)
    thread.start()
    try:
        yield listening.getsockname()
    finally:
        server.should_exit = True
        thread.join(PATIENCE_S)


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


def api_client(url: str, ca: Path | None = None, origin: str | None = None) -> httpx.Client:
    """Asks the API of the server at `url`. ca: the certificate it shows, where it speaks TLS.
    origin: the site whose page asks, as a browser names it."""
    return httpx.Client(
        verify=True if ca is None else ssl.create_default_context(cafile=ca),
        base_url=f"{url}/api/v1",
        headers=None if origin is None else {"origin": origin},
        timeout=30.0,
        trust_env=False,
        # The server closes idle connections after 5 s; one in use at that moment is reset.
        limits=httpx.Limits(keepalive_expiry=2.0),
    )


class SpindleServer:
    """A server whose API is asked in plain JSON, as a browser does. `client` is for refusals."""

    url: str
    client: httpx.Client

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

    def add_unit(self, url: str) -> str:
        """The id of a unit that is added, once it is ready."""
        device = self.ask("POST", "/devices", json={"url": url})["id"]
        eventually(lambda: self.get(f"/devices/{device}")["state"], lambda state: state == "ready")
        return str(device)

    def all_ready(self, count: int) -> None:
        """Wait until `count` units are ready; they become so in any order."""
        for number in range(count):
            self.ready_device(number)

    def simulate(self, device: str, **change: Any) -> dict[str, Any]:
        """Changes the simulation behind a unit."""
        answer: dict[str, Any] = self.ask("PUT", f"/devices/{device}/simulation", json=change)
        return answer

    def advance(self, device: str, seconds: float) -> dict[str, Any]:
        """Lets time pass for a unit with a virtual clock."""
        path = f"/devices/{device}/simulation/advance"
        answer: dict[str, Any] = self.ask("POST", path, json={"seconds": seconds})
        return answer

    def until_writable(self, device: str) -> None:
        """Lets time pass until the memory of a unit with a virtual clock takes the next write."""
        self.advance(device, WRITES_EVERY_S)

    def configure(self, device: str, reason: str = "a story", **parameters: Any) -> dict[str, Any]:
        """Writes parameters to a unit with a virtual clock."""
        self.until_writable(device)
        body = {"parameters": parameters, "reason": reason}
        answer: dict[str, Any] = self.ask("PATCH", f"/devices/{device}/config", json=body)
        return answer

    def stand_still(self, device: str) -> None:
        """Brakes the bike until wheel and motor rest: what writing a configuration needs."""
        Spindle(self.url).unit(device).stand_still()


class ServerProcess(RunningServer, SpindleServer):
    """The server as its own process, its simulated units as processes of their own."""

    def start(self) -> Self:
        super().start()
        own = self.data / "tls" / "certificate.pem"
        self.client = api_client(self.url, own if self.url.startswith("https") else None)
        return self


class ServerHere(SpindleServer):
    """The server on a thread of this process, with its simulated units.

    Nothing of it can be killed; the rest, sockets, store and readers of files, is as in a process
    of its own, which costs two seconds of a core more. Arguments as of RunningServer; families: the
    makes of units it knows. services: what is behind its API, once it is started.
    """

    services: Services

    def __init__(
        self,
        data: Path,
        devices: Sequence[str] = (),
        families: Families = FAMILIES,
        **environment: str,
    ) -> None:
        self._settings = load({"data": str(data), "device": list(devices)}, environment)
        self._families = families
        self._closing = contextlib.ExitStack()

    def start(self) -> Self:
        """Starts it; it answers at `url` from then on."""
        started.HERE.note(started.SERVER_HERE)
        with contextlib.ExitStack() as opening:
            settings = self._settings
            port = opening.enter_context(listening_socket(settings.host, 0))
            reach = partial(simulated_unit.opener, flash_folder=settings.data / "units")
            services = opening.enter_context(open_services(settings, self._families, reach))
            certificate = services.addresses.certificate
            tls = None if certificate is None else certificate.context()
            server = uvicorn.Server(server_config(build_app(settings, services), tls=tls))
            thread = threading.Thread(target=server.run, kwargs={"sockets": [port]})
            thread.start()

            def end() -> None:
                server.should_exit = True
                services.uploads.close()
                thread.join()

            opening.callback(end)
            self.services = services
            self.url = "http://{}:{}".format(*port.getsockname())
            ca = None
            if certificate is not None:
                # No certificate is for 0.0.0.0.
                self.url = f"https://127.0.0.1:{port.getsockname()[1]}"
                ca = certificate.certificate
            self.client = opening.enter_context(api_client(self.url, ca))
            self._closing = opening.pop_all()
        return self

    def stop(self) -> None:
        """Ends it as Ctrl-C does; twice is allowed."""
        self._closing.close()

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *_: object) -> None:
        self.stop()
