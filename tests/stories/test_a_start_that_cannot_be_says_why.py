"""Goal: a server that cannot start says in one line what, where and what to do; a command whose
reader leaves says nothing.

Method: the real command in a process of its own, with every wrong setting at hand.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SPINDLE = [sys.executable, "-m", "backend.cli"]

pytestmark = pytest.mark.slow


def start(data: Path | str, **environment: str) -> subprocess.CompletedProcess[str]:
    """A `spindle serve` that must end by itself."""
    kept = {name: value for name, value in os.environ.items() if "SPINDLE" not in name}
    words = [*SPINDLE, "serve", "--port", "0", "--device", "none", "--data", str(data)]
    return subprocess.run(
        words,
        cwd=ROOT,
        env={**kept, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def is_told(result: subprocess.CompletedProcess[str], code: int, *says: str) -> None:
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
    result = start(tmp_path, SPINDLE_DB=db)

    is_told(result, 2, says)
    assert "secret" not in result.stderr


def test_a_driver_that_is_not_installed_is_named(tmp_path: Path) -> None:
    pytest.importorskip("sqlalchemy")
    try:
        import psycopg  # noqa: F401
    except ImportError:
        is_told(
            start(tmp_path, SPINDLE_DB="postgresql+psycopg://u:secret@h/x"),
            2,
            "pip install psycopg",
        )
    else:
        pytest.skip("psycopg is here")


def test_a_database_where_none_can_be_says_where(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    is_told(start(tmp_path, SPINDLE_DB="sqlite:////proc/nope/x.db"), 1, "/proc/nope")
    is_told(start(tmp_path, SPINDLE_DB=f"sqlite:///{tmp_path}/file/x.db"), 1, "file")
    is_told(start(tmp_path, SPINDLE_DB=f"sqlite:///{tmp_path}"), 1, str(tmp_path))


def test_a_data_folder_that_cannot_be_says_where_and_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    for data in (tmp_path / "file", tmp_path / "file" / "below", "/proc/nope", "/dev/null"):
        is_told(start(data), 1, str(data), "--data")
    is_told(start("x" * 300), 2, "x" * 300)


def test_objects_where_none_can_be_say_where(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    for objects in ("s3://bucket", "nonsense", "file:///proc/nope", f"file://{tmp_path}/file"):
        is_told(start(tmp_path / "data", SPINDLE_OBJECTS=objects), 1)


def test_a_host_that_is_none_is_said(tmp_path: Path) -> None:
    for host in ("a..b", "no-such-host.invalid"):
        result = start(tmp_path, SPINDLE_HOST=host, SPINDLE_AUTH="off")

        is_told(result, 1, host)


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="needs to mount")
def test_a_folder_that_may_only_be_read_says_so(tmp_path: Path) -> None:
    if subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", tmp_path], check=False
    ).returncode:
        pytest.skip("may not mount here")
    try:
        is_told(start(tmp_path), 1, str(tmp_path), "Read-only")
        is_told(start(tmp_path / "below"), 1, str(tmp_path), "Read-only")
    finally:
        subprocess.run(["umount", tmp_path], check=True)


COMMANDS = (
    "--help",
    "scenario list",
    "scenario --help",
    "device list --json",
    "ride show 1",
    "lint --table /none",
    "--nonsense",
)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_reader_that_leaves_ends_a_command_quietly(command: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    environment = {**os.environ, "SPINDLE_PORT": "1"}
    result = subprocess.run(
        [*SPINDLE, *command.split()],
        cwd=ROOT,
        env=environment,
        stdout=writing,
        stderr=subprocess.PIPE,
        text=True,
        timeout=60,
        check=False,
    )
    os.close(writing)

    assert "Broken" not in result.stderr
    assert "Traceback" not in result.stderr
    assert result.returncode in (0, 1, 2)


def test_a_reader_that_leaves_both_ends_leaves_no_trace() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    result = subprocess.run(
        [*SPINDLE, "ride", "list", "--server", "http://127.0.0.1:1"],
        cwd=ROOT,
        stdout=writing,
        stderr=writing,
        timeout=60,
        check=False,
    )
    os.close(writing)

    assert result.returncode == 0
