"""`python -m backend.dev`, which is `make dev`: both halves with live reload, in one terminal.

The backend starts again when a Python file or the built C extension changes; the pages come from
Vite, which passes what they ask of the API on to the backend. Settings are those of the server:
`SPINDLE_DEVICE=/dev/ttyUSB0 make dev`.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from socket import socket

import uvicorn
from uvicorn.supervisors.statreload import StatReload

from backend.core.hosts import bracketed
from backend.errors import LinkError, SpindleError
from backend.listening import listening_socket
from backend.main import serve_on
from backend.settings import CHECKOUT, Settings, load

FRONTEND = CHECKOUT / "frontend"
VITE = FRONTEND / "node_modules" / "vite" / "bin" / "vite.js"
WATCHED = ("backend", "firmware_protocol", "sim_device")
NATIVE = CHECKOUT / "sim_device" / "firmware" / "python" / "_native.abi3.so"
STOP_S = 10


class Reload(StatReload):
    """uvicorn's, which looks at Python files; ours also at the C as `make native` builds it."""

    def iter_py_files(self) -> Iterator[Path]:
        """Every file whose change starts the backend again."""
        yield from super().iter_py_files()
        yield NATIVE


def main() -> int:
    """Runs until Ctrl-C or SIGTERM; the process's exit code."""
    node = shutil.which("node")
    if node is None or not VITE.exists():
        sys.stderr.write("make dev: Node or the browser's modules are missing; run: make setup\n")
        return 1
    # The way from Vite to the backend does not leave this machine.
    settings = replace(load({}), tls="off")
    listening = a_socket(settings)
    host, port = listening.getsockname()[:2]
    origin = f"http://{bracketed(host)}:{port}"
    folders = [str(CHECKOUT / name) for name in WATCHED]
    config = uvicorn.Config(
        "backend.dev:main", reload=True, reload_dirs=folders, log_level="warning"
    )
    sys.stdout.write(f"The pages: at the address Vite prints. The API: {origin}/api/docs\n")
    sys.stdout.flush()
    with pages(node, origin):
        Reload(config, partial(backend, settings), [listening]).run()
    return 0


def a_socket(settings: Settings) -> socket:
    """The server's port, or a free one if something listens there."""
    try:
        return listening_socket(settings.host, settings.port)
    except LinkError as taken:
        sys.stderr.write(f"{taken.message} make dev takes a free one.\n")
        return listening_socket(settings.host, 0)


def backend(settings: Settings, sockets: list[socket]) -> None:
    """One life of the backend, in a process of its own."""
    # Ctrl-C reaches the whole terminal. The supervisor ends this process with SIGTERM, once.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        serve_on(sockets[0], settings)
    except SpindleError as error:
        sys.stderr.write(f"The backend cannot start: {error.message}\n")


@contextlib.contextmanager
def pages(node: str, origin: str) -> Iterator[None]:
    """Vite's server until the context ends. It looks for a free port by itself and prints it."""
    vite = subprocess.Popen(
        [node, str(VITE), "--clearScreen", "false"],
        cwd=FRONTEND,
        env={**os.environ, "SPINDLE_ORIGIN": origin},
        stdin=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        vite.terminate()
        try:
            vite.wait(STOP_S)
        except subprocess.TimeoutExpired:
            vite.kill()
            vite.wait()


if __name__ == "__main__":
    sys.exit(main())
