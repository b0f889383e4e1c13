"""Goal: a server that cannot start says in one line what, where and what to do; a command whose
reader leaves says nothing.

Method: the command with every wrong setting at hand, in this process, where a server that began to
serve would fail the test; a few in a process of their own, as a shell sees them.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Protocol

import pytest

from backend.cli import main
from tests.fakes.command import refused_start, spindle_process


class Result(Protocol):
    """How a command ended, whichever process it ran in."""

    @property
    def returncode(self) -> int: ...

    @property
    def stderr(self) -> str: ...


def is_told(result: Result, code: int, *says: str) -> None:
    """One line for people (and one for each field), the exit code, no trace."""
    assert result.returncode == code, result.stderr
    assert "Traceback" not in result.stderr
    assert len(result.stderr.splitlines()) <= 2, result.stderr
    for words in says:
        assert words in result.stderr


@pytest.mark.parametrize(
    ("db", "says"),
    [
        ("nonsense", "sqlite:///"),
        ("://", "sqlite:///"),
        ("postgres://user:secret@host/x", "no such kind"),
        ("mysql://x/y", "no such kind"),
        ("sqlite+nope:///x.db", "driver"),
        ("sqlite://", "forgotten"),
        ("sqlite:///:memory:", "forgotten"),
        ("sqlite:///file:spindle.db?uri=true", "sqlite:///path"),
    ],
)
def test_a_database_that_is_none_is_wrong_usage(tmp_path: Path, db: str, says: str) -> None:
    result = refused_start(tmp_path, SPINDLE_DB=db)

    is_told(result, 2, says)
    assert "secret" not in result.stderr


def test_a_driver_that_is_not_installed_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # What import finds is as if it were not there.
    monkeypatch.setitem(sys.modules, "psycopg", None)

    result = refused_start(tmp_path, SPINDLE_DB="postgresql+psycopg://u:secret@h/x")

    is_told(result, 2, "pip install psycopg")
    assert "secret" not in result.stderr


def test_a_process_that_cannot_start_ends_with_the_same_words_and_codes(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    for code, words, says in (
        (2, ("--port", "99999", "--data", tmp_path), "port is '99999'"),
        (1, ("--port", "0", "--data", tmp_path / "file"), str(tmp_path / "file")),
    ):
        is_told(spindle_process("serve", "--device", "none", *words), code, says)


def test_a_database_where_none_can_be_says_where(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    is_told(refused_start(tmp_path, SPINDLE_DB="sqlite:////proc/nope/x.db"), 1, "/proc/nope")
    is_told(refused_start(tmp_path, SPINDLE_DB=f"sqlite:///{tmp_path}/file/x.db"), 1, "file")
    is_told(refused_start(tmp_path, SPINDLE_DB=f"sqlite:///{tmp_path}"), 1, str(tmp_path))


def test_a_data_folder_that_cannot_be_says_where_and_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    for data in (tmp_path / "file", tmp_path / "file" / "below", "/proc/nope", "/dev/null"):
        is_told(refused_start(data), 1, str(data), "--data")
    is_told(refused_start("x" * 300), 2, "x" * 300)


def test_objects_where_none_can_be_say_where(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    for objects in ("ftp://bucket", "nonsense", "s3://KEY:hunter2@bucket"):
        start = refused_start(tmp_path / "data", SPINDLE_OBJECTS=objects)
        is_told(start, 2, "The URL of the objects")
        assert "hunter2" not in start.stderr
    for objects in ("file:///proc/nope", f"file://{tmp_path}/file"):
        is_told(refused_start(tmp_path / "data", SPINDLE_OBJECTS=objects), 1)


def test_a_host_that_is_none_is_said(tmp_path: Path) -> None:
    for host in ("a..b", "no-such-host.invalid"):
        result = refused_start(tmp_path, SPINDLE_HOST=host, SPINDLE_AUTH="off")

        is_told(result, 1, host)


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="needs to mount")
def test_a_folder_that_may_only_be_read_says_so(tmp_path: Path) -> None:
    if subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", tmp_path], check=False
    ).returncode:
        pytest.skip("may not mount here")
    try:
        is_told(refused_start(tmp_path), 1, str(tmp_path), "Read-only")
        is_told(refused_start(tmp_path / "below"), 1, str(tmp_path), "Read-only")
    finally:
        subprocess.run(["umount", tmp_path], check=True)


COMMANDS = (
    "--help",
    "device list --json",
    "ride show 1",
    "lint --table /none",
    "--nonsense",
)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_reader_that_leaves_ends_a_command_quietly(
    command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SPINDLE_PORT", "1")
    with os.fdopen(nobody_reads(), "w") as out:
        monkeypatch.setattr(sys, "stdout", out)
        try:
            code = main(command.split())
        except SystemExit as usage:
            code = int(usage.code or 0)
        # What Python does at its end raises nothing.
        out.flush()

    assert code in (0, 1, 2)


def nobody_reads() -> int:
    """The writing end of a pipe whose reader has left."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


def test_a_reader_that_leaves_a_process_leaves_no_trace() -> None:
    writing = nobody_reads()

    simulator = spindle_process("scenario", "list", stdout=writing)
    both = spindle_process(
        "ride", "list", "--server", "http://127.0.0.1:1", stdout=writing, stderr=writing
    )

    os.close(writing)
    assert (simulator.returncode, simulator.stderr) == (0, "")
    assert both.returncode == 0
