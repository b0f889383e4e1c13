"""Goal: who reaches the port and never shakes hands is let go as anybody else who is silent, keeps
nobody out, and is written nowhere; who does shake hands is served.

Method: a real uvicorn on loopback whose handshakes have patience of tenths of a second.
"""

from __future__ import annotations

import contextlib
import http.client
import logging
import socket
import ssl
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import uvicorn
from fastapi import FastAPI, Request

from backend.server.certificate import ServerCertificate, own_certificate
from backend.web.connections import PatientProtocol
from backend.web.tls_handshake import TlsHandshake
from tests.fakes import server

PATIENCE_S = 20.0
BROKEN = b"\x16\x03\x01\x00\x05hello"
PLAIN = b"GET /value HTTP/1.1\r\nHost: x\r\n\r\n"


class FewHandshakes(TlsHandshake):
    connections_max = 50


class ImpatientHandshake(TlsHandshake):
    handshake_s = 0.3


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> ServerCertificate:
    folder: Path = tmp_path_factory.mktemp("tls")
    return own_certificate(folder, ["127.0.0.1"], datetime.now(UTC))


@contextlib.contextmanager
def serving(
    handshake: type[TlsHandshake], certificate: ServerCertificate
) -> Iterator[tuple[str, int]]:
    app = FastAPI()

    @app.post("/value")
    async def value(request: Request) -> list[Any]:
        return [request.url.scheme, len(await request.body())]

    http: Any = partial(handshake, certificate.context(), PatientProtocol)
    with socket.create_server(("127.0.0.1", 0), backlog=512) as listening:
        config = uvicorn.Config(app, http=http, lifespan="off", log_config=None)
        with server.serving(config, listening) as address:
            yield address


def answer_at(address: tuple[str, int], certificate: ServerCertificate, body: bytes) -> bytes:
    trusting = ssl.create_default_context(cafile=certificate.certificate)
    asking = http.client.HTTPSConnection(*address, timeout=PATIENCE_S, context=trusting)
    with contextlib.closing(asking):
        asking.request("POST", "/value", body)
        return asking.getresponse().read()


def ends(talker: socket.socket) -> bytes:
    """What the server says until it closes the connection."""
    talker.settimeout(PATIENCE_S)
    received = b""
    with contextlib.suppress(ConnectionResetError):
        while piece := talker.recv(4096):
            received += piece
    return received


def test_who_shakes_hands_is_served(certificate: ServerCertificate) -> None:
    with serving(TlsHandshake, certificate) as address:
        for length in (0, 1, 1_000_000):
            answer = answer_at(address, certificate, b"x" * length)
            assert answer == f'["https",{length}]'.encode()


def test_a_request_right_behind_the_handshake_is_not_lost(certificate: ServerCertificate) -> None:
    trusting = ssl.create_default_context(cafile=certificate.certificate)
    with serving(TlsHandshake, certificate) as address:
        for _ in range(20):
            to_client, to_server = ssl.MemoryBIO(), ssl.MemoryBIO()
            tls = trusting.wrap_bio(to_client, to_server, server_hostname="127.0.0.1")
            with socket.create_connection(address, timeout=PATIENCE_S) as talker:
                while True:
                    try:
                        tls.do_handshake()
                        break
                    except ssl.SSLWantReadError:
                        talker.sendall(to_server.read())
                        to_client.write(talker.recv(65536))
                tls.write(b"POST /value HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
                # The last word of the handshake and the request in one piece.
                talker.sendall(to_server.read())
                to_client.write(ends(talker))
            assert tls.read(65536).startswith(b"HTTP/1.1 200")


@pytest.mark.parametrize(
    "beginning", [PLAIN, b"\x16\x03\x01\x00\x05hello", b"\x00", b"SSH-2.0-x\n"]
)
def test_who_speaks_something_else_is_let_go_without_a_word(
    certificate: ServerCertificate, beginning: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    with serving(ImpatientHandshake, certificate) as address:
        with socket.create_connection(address) as talker:
            talker.sendall(beginning)
            assert b"HTTP" not in ends(talker)
        with socket.create_connection(address):
            pass
        assert answer_at(address, certificate, b"abc") == b'["https",3]'

    assert caplog.records == []


@pytest.mark.parametrize("beginning", [b"", b"\x16", b"\x16\x03\x01\x02\x00\x01"])
def test_a_handshake_that_never_comes_ends_the_connection(
    certificate: ServerCertificate, beginning: bytes
) -> None:
    with (
        serving(ImpatientHandshake, certificate) as address,
        socket.create_connection(address) as talker,
    ):
        talker.sendall(beginning)
        assert ends(talker) == b""


def test_two_hundred_silent_sockets_keep_nobody_out(certificate: ServerCertificate) -> None:
    with contextlib.ExitStack() as held:
        address = held.enter_context(serving(FewHandshakes, certificate))
        silent = [held.enter_context(socket.create_connection(address)) for _ in range(200)]

        assert answer_at(address, certificate, b"abc") == b'["https",3]'
        # Those that came first; fifty may stay.
        assert [ends(one) for one in silent[:150]] == [b""] * 150


def test_a_server_that_stops_waits_for_no_handshake(certificate: ServerCertificate) -> None:
    with contextlib.ExitStack() as held:
        with serving(TlsHandshake, certificate) as address:
            silent = held.enter_context(socket.create_connection(address))
            assert answer_at(address, certificate, b"") == b'["https",0]'

        assert ends(silent) == b""
