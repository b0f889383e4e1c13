"""An S3 server of one's own for a test, moto's in its own process, and a bad way to it."""

from __future__ import annotations

import http.client
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import httpx
import pytest
from pyarrow.fs import FileSelector, S3FileSystem

from backend.store.bucket import bucket_place

PATIENCE_S = 60.0
# Moto looks at no signature; the client must have something to sign with.
KEYS = {"AWS_ACCESS_KEY_ID": "AKIA17EXAMPLE", "AWS_SECRET_ACCESS_KEY": "hunter2"}


class S3Server:
    """Listens on a free port of 127.0.0.1 until `stop`; what it holds goes with it."""

    def __init__(self, log: Path) -> None:
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port: int = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"
        self._log = log.open("wb")
        words = ["-m", "moto.server", "-H", "127.0.0.1", "-p", str(self.port)]
        self._process = subprocess.Popen(
            [sys.executable, *words], stdout=self._log, stderr=subprocess.STDOUT
        )
        self._buckets = 0
        until_s = time.monotonic() + PATIENCE_S
        while not self._answers():
            if self._process.poll() is not None or time.monotonic() > until_s:
                pytest.fail(f"No S3 server: {log.read_text()}", pytrace=False)
            time.sleep(0.05)

    def new_bucket(self) -> str:
        """The name of an empty bucket."""
        self._buckets += 1
        name = f"spindle-{self._buckets}"
        httpx.put(f"{self.url}/{name}", trust_env=False).raise_for_status()
        return name

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()
        self._log.close()

    def _answers(self) -> bool:
        try:
            return httpx.get(f"{self.url}/moto-api/data.json", trust_env=False).is_success
        except httpx.TransportError:
            return False


def keys_in(server: S3Server, url: str) -> set[str]:
    """What is in a bucket below its prefix, by another connection than the store's."""
    place = bucket_place(url)
    s3 = S3FileSystem(endpoint_override=server.url.removeprefix("http://"), scheme="http")
    base = f"{place.bucket}/{place.prefix}"
    found = s3.get_file_info(FileSelector(base.rstrip("/"), recursive=True, allow_not_found=True))
    return {one.path.removeprefix(base) for one in found if one.is_file}


class QuietServer(ThreadingHTTPServer):
    """A client or a server that was killed is what is looked at, no fault of the gate."""

    def handle_error(self, request: Any, client_address: Any) -> None:
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


OF_A_CONNECTION = {"content-length", "transfer-encoding", "connection", "expect"}
Meddle = Callable[[str, str], int | None]


def passes(name: str) -> bool:
    """Whether a header is of the request, not of the connection."""
    return name.lower() not in OF_A_CONNECTION


class Gate:
    """Passes requests on to an S3 server, or answers itself.

    meddle: of a method and a path, the status to answer with, None to pass on; it may wait, too.
    requests: method and path of each that came.
    """

    def __init__(self, server: S3Server) -> None:
        self.meddle: Meddle = lambda method, path: None
        self.requests: list[tuple[str, str]] = []
        gate = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def answer(self) -> None:
                body = self.body()
                gate.requests.append((self.command, self.path))
                status = gate.meddle(self.command, self.path)
                if status is not None:
                    self.reply(status, [], b"")
                    return
                there = http.client.HTTPConnection("127.0.0.1", server.port)
                headers = {name: value for name, value in self.headers.items() if passes(name)}
                there.request(self.command, self.path, body, headers)
                reply = there.getresponse()
                kept = [one for one in reply.getheaders() if passes(one[0])]
                length = reply.getheader("content-length") if self.command == "HEAD" else None
                self.reply(reply.status, kept, reply.read(), length)
                there.close()

            def body(self) -> bytes:
                """Of a request, in chunks or not."""
                if self.headers.get("transfer-encoding") != "chunked":
                    return self.rfile.read(int(self.headers.get("content-length", 0)))
                pieces = []
                while size := int(self.rfile.readline().partition(b";")[0], 16):
                    pieces.append(self.rfile.read(size))
                    self.rfile.readline()
                while self.rfile.readline().strip():
                    pass
                return b"".join(pieces)

            def reply(
                self, status: int, headers: Any, body: bytes, length: str | None = None
            ) -> None:
                self.send_response(status)
                for name, value in headers:
                    self.send_header(name, value)
                self.send_header("Content-Length", length or str(len(body)))
                self.end_headers()
                if self.command != "HEAD":
                    self.wfile.write(body)

            do_GET = do_PUT = do_POST = do_DELETE = do_HEAD = answer

            def log_message(self, format: str, *words: object) -> None:
                pass

        self._server = QuietServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self._server.server_address[1]}"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
