"""Goal: sockets that do not talk are let go, and never keep out those that do.

Method: a real uvicorn on loopback with patience of tenths of a second; 200 sockets at most.
"""

from __future__ import annotations

import contextlib
import http.client
import socket
import threading
from collections.abc import Iterator

import pytest
import uvicorn
from fastapi import FastAPI, Request

from backend.web.connections import PatientProtocol

PATIENCE_S = 20.0


class Impatient(PatientProtocol):
    head_s = 0.3
    body_s = 0.3
    check_every_s = 0.05
    connections_max = 100


class PatientWithBodies(Impatient):
    body_s = 60.0


@pytest.fixture(scope="module")
def address() -> Iterator[tuple[str, int]]:
    with serving(Impatient) as listening:
        yield listening


def small_app() -> FastAPI:
    app = FastAPI()

    @app.get("/value")
    async def value() -> int:
        return 1

    @app.post("/value")
    async def take(request: Request) -> int:
        return len(await request.body())

    return app


@contextlib.contextmanager
def serving(
    protocol: type[PatientProtocol], app: FastAPI | None = None
) -> Iterator[tuple[str, int]]:
    with socket.create_server(("127.0.0.1", 0), backlog=256) as listening:
        config = uvicorn.Config(
            app or small_app(), http=protocol, lifespan="off", log_level="error"
        )
        server = uvicorn.Server(config)
        thread = threading.Thread(target=lambda: server.run(sockets=[listening]), daemon=True)
        thread.start()
        yield listening.getsockname()
        server.should_exit = True
        thread.join(PATIENCE_S)


def ends(talker: socket.socket) -> bytes:
    """What the server says until it closes the connection."""
    talker.settimeout(PATIENCE_S)
    said = b""
    with contextlib.suppress(ConnectionResetError):
        while piece := talker.recv(4096):
            said += piece
    return said


@pytest.mark.parametrize(
    "beginning",
    [b"", b"G", b"GET /value HTTP/1.1\r\nHost: x\r\nX-Slow: ", b"GET /value HTTP/1.1\r\n"],
)
@pytest.mark.slow
def test_a_head_that_never_comes_ends_the_connection(
    address: tuple[str, int], beginning: bytes
) -> None:
    with socket.create_connection(address) as talker:
        talker.sendall(beginning)

        assert ends(talker) == b""


def test_a_head_that_drips_ends_the_connection_too(address: tuple[str, int]) -> None:
    with socket.create_connection(address) as talker:
        talker.settimeout(0.05)
        ended = False
        for _ in range(400):
            try:
                talker.sendall(b"X")
                ended = talker.recv(1) == b""
            except TimeoutError:
                continue
            except OSError:
                ended = True
            if ended:
                break

    assert ended


def test_a_body_that_stops_ends_the_connection(address: tuple[str, int]) -> None:
    with socket.create_connection(address) as talker:
        talker.sendall(b"POST /value HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\nabc")

        ends(talker)


@pytest.mark.slow
def test_the_second_request_of_a_connection_may_not_drip_either(address: tuple[str, int]) -> None:
    with socket.create_connection(address) as talker:
        talker.sendall(b"GET /value HTTP/1.1\r\nHost: x\r\n\r\nGET /va")

        assert ends(talker).count(b"HTTP/1.1 200") == 1


def test_a_hundred_bodies_that_drip_do_not_keep_a_talker_out() -> None:
    begun = b"POST /value HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\nExpect: 100-continue\r\n\r\n"
    with contextlib.ExitStack() as held:
        address = held.enter_context(serving(PatientWithBodies))
        for _ in range(PatientWithBodies.connections_max):
            sender = held.enter_context(socket.create_connection(address))
            sender.sendall(begun)
            # From here on the server waits for this body.
            assert sender.recv(4096).startswith(b"HTTP/1.1 100")
        asking = http.client.HTTPConnection(*address, timeout=PATIENCE_S)
        asking.request("GET", "/value")

        assert asking.getresponse().read() == b"1"
        asking.close()


@pytest.mark.slow
def test_two_hundred_silent_sockets_do_not_keep_a_talker_out(address: tuple[str, int]) -> None:
    with contextlib.ExitStack() as held:
        silent = [held.enter_context(socket.create_connection(address)) for _ in range(200)]
        asking = http.client.HTTPConnection(*address, timeout=PATIENCE_S)
        asking.request("GET", "/value")

        assert asking.getresponse().read() == b"1"
        assert [ends(one) for one in silent] == [b""] * 200
        asking.close()
