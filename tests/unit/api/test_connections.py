"""Goal: sockets that do not talk, or do not listen, are let go, and never keep out those that do;
who sends too much is answered, who leaves in the middle is no fault of the server's.

Method: a real uvicorn on loopback with patience of tenths of a second; 200 sockets at most.
"""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import json
import socket
import threading
from collections.abc import AsyncIterator, Iterator

import pytest
import uvicorn
from fastapi import FastAPI, Request
from fastapi.responses import StreamingResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from backend.web import problem
from backend.web.connections import PatientProtocol
from backend.web.safety import BodyBound
from tests.fakes import server

PATIENCE_S = 20.0


class Impatient(PatientProtocol):
    head_s = 0.3
    body_s = 0.3
    check_every_s = 0.05
    connections_max = 100


class PatientWithBodies(Impatient):
    body_s = 60.0


class PatientWithHeads(PatientWithBodies):
    head_s = 60.0


class PatientButWithReaders(PatientWithHeads):
    read_s = 0.3


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
    protocol: type[PatientProtocol], app: ASGIApp | None = None
) -> Iterator[tuple[str, int]]:
    with socket.create_server(("127.0.0.1", 0), backlog=512) as listening:
        config = uvicorn.Config(
            app or small_app(), http=protocol, lifespan="off", log_level="error", log_config=None
        )
        with server.serving(config, listening) as address:
            yield address


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


def test_a_burst_of_silent_sockets_goes_as_one_came_after_the_other() -> None:
    """They wait in the system's queue while the loop is busy, and come all at once."""
    app = small_app()

    @app.get("/busy")
    async def busy() -> int:
        began.set()
        go_on.wait(PATIENCE_S)
        return 1

    began, go_on = threading.Event(), threading.Event()
    with contextlib.ExitStack() as held:
        address = held.enter_context(serving(PatientWithHeads, app))
        keeping = http.client.HTTPConnection(*address, timeout=PATIENCE_S)
        keeping.request("GET", "/busy")
        assert began.wait(PATIENCE_S)
        silent = [held.enter_context(socket.create_connection(address)) for _ in range(300)]
        go_on.set()

        # A hundred may stay.
        assert [ends(one) for one in silent[:200]] == [b""] * 200
        keeping.close()


def test_who_asks_and_does_not_read_is_let_go() -> None:
    """What is left of the answer holds a file open."""
    let_go = threading.Event()

    async def endless() -> AsyncIterator[bytes]:
        while True:
            yield b"x" * 65536
            await asyncio.sleep(0)

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await StreamingResponse(endless())(scope, receive, send)
        finally:
            let_go.set()

    serving_it = serving(PatientButWithReaders, answer)
    with serving_it as address, socket.create_connection(address) as one:
        one.sendall(b"GET /large HTTP/1.1\r\nHost: x\r\n\r\n")

        assert let_go.wait(PATIENCE_S)


@pytest.mark.parametrize("declared", [True, False])
def test_who_sends_too_much_is_told_so(declared: bool) -> None:
    """And not left with a broken connection while it still sends."""
    app = small_app()
    problem.install(app)
    bound = BodyBound(app, 1024, 4096, ())
    with serving(PatientProtocol, bound) as address:
        asking = http.client.HTTPConnection(*address, timeout=PATIENCE_S)
        pieces = (b"x" * 65536 for _ in range(200))
        headers = {"content-length": str(65536 * 200)} if declared else {}
        asking.request("POST", "/value", pieces, headers, encode_chunked=not declared)
        answer = asking.getresponse()

        assert answer.status == 413
        assert json.loads(answer.read())["code"] == "too_large"
        asking.close()


def test_who_leaves_in_the_middle_of_a_body_is_no_fault(caplog: pytest.LogCaptureFixture) -> None:
    left = threading.Event()
    app = FastAPI()
    problem.install(app)

    @app.post("/value")
    async def take(request: Request) -> int:
        try:
            return sum([len(piece) async for piece in request.stream()])
        finally:
            left.set()

    with serving(PatientProtocol, app) as address:
        with socket.create_connection(address) as leaving:
            leaving.sendall(b"POST /value HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\nabc")
        assert left.wait(PATIENCE_S)
        # The server has dealt with it once it has answered the next.
        asking = http.client.HTTPConnection(*address, timeout=PATIENCE_S)
        asking.request("POST", "/value", b"")
        assert asking.getresponse().read() == b"0"
        asking.close()

    assert [record.getMessage() for record in caplog.records if record.levelname == "ERROR"] == []
