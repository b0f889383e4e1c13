"""The `spindle` command within this process: its words, its exit code and what it printed."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

from backend.cli import main
from tests.fakes.server import SpindleServer


@dataclass(frozen=True)
class Ran:
    """One run of the command, as subprocess.CompletedProcess has it."""

    returncode: int
    stdout: str
    stderr: str


def spindle(
    server: SpindleServer | None, *words: str | Path, stdin: str = "", **environment: str
) -> Ran:
    """Runs the command, against this server.

    environment: SPINDLE_* for the run; those of the test's own environment are not passed on.
    """
    at = ["--server", server.url] if server is not None else []
    out, err = _captured(), _captured()
    with (
        _environment(environment),
        mock.patch.object(sys, "stdin", io.TextIOWrapper(io.BytesIO(stdin.encode()), "utf-8")),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            code = main([*map(str, words), *at])
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
    kept = {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
    with mock.patch.dict(os.environ, {**kept, **given}, clear=True):
        yield
