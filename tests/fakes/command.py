"""The `spindle` command within this process: its words, its exit code and what it printed."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

from backend.cli import main
from sim_device import __main__ as simulator
from tests.fakes.server import SpindleServer

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Ran:
    """One run of the command, as subprocess.CompletedProcess has it."""

    returncode: int
    stdout: str
    stderr: str


def spindle(
    server: SpindleServer | None, *words: str | Path, stdin: str = "", **environment: str
) -> Ran:
    """Runs the command, against this server. `sim` and `scenario` do not end their process here.

    environment: SPINDLE_* for the run; those of the test's own environment are not passed on.
    """
    at = ["--server", server.url] if server is not None else []
    given = [*map(str, words), *at]
    if given[:1] in (["sim"], ["scenario"]):
        return _ran(lambda: simulator.main(["--as", "spindle", *given]), stdin, environment)
    return _ran(lambda: main(given), stdin, environment)


def refused_start(data: Path | str, *words: str | Path, **environment: str) -> Ran:
    """A `spindle serve` that must end before it serves; AssertionError where it would begin."""
    folder = ("--port", "0", "--device", "none", "--data", data)
    begun = mock.patch("backend.main.AnnouncingServer.run", side_effect=AssertionError("It starts"))
    ended_by = signal.getsignal(signal.SIGTERM)
    try:
        with begun:
            return spindle(None, "serve", *folder, *words, **environment)
    finally:
        signal.signal(signal.SIGTERM, ended_by)


def spindle_process(*words: str | Path, **streams: int) -> subprocess.CompletedProcess[str]:
    """Runs the command as a shell does, in a process of its own: two seconds of a core.

    streams: as of subprocess.run, which is asked for what was printed without them. SPINDLE_* of
    the test's own environment are not passed on.
    """
    return subprocess.run(
        [sys.executable, "-m", "backend.cli", *map(str, words)],
        cwd=ROOT,
        env=_foreign_variables(),
        text=True,
        timeout=60,
        check=False,
        **({"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | streams),
    )


def _ran(work: Callable[[], int], stdin: str, environment: dict[str, str]) -> Ran:
    out, err = _captured(), _captured()
    with (
        _environment(environment),
        mock.patch.object(sys, "stdin", io.TextIOWrapper(io.BytesIO(stdin.encode()), "utf-8")),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            code = work()
        except SystemExit as wrong_usage:
            code = int(wrong_usage.code or 0)
    return Ran(code, _text(out), _text(err))


def _captured() -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(), "utf-8", newline="")


def _text(stream: io.TextIOWrapper) -> str:
    stream.flush()
    raw = stream.buffer
    assert isinstance(raw, io.BytesIO)
    return raw.getvalue().decode()


@contextlib.contextmanager
def _environment(given: dict[str, str]) -> Iterator[None]:
    with mock.patch.dict(os.environ, _foreign_variables() | given, clear=True):
        yield


def _foreign_variables() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
