"""Goal: whatever becomes of a run of the tests, none of its processes lives on and none of its
files is kept but those of failed tests; and a run that tries or starts too much fails.

Method: small folders of tests are run with the guard of tests/run, some to their end and one until
it is killed.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from tests.fakes.server import eventually
from tests.run import again, guardian, place, started

ROOT = Path(__file__).resolve().parents[2]
# One plugin, the one that tries again: loading all of them takes longer than the test.
WORDS = ("-q", "-p", "no:cacheprovider", "-p", "pytest_rerunfailures", ".")
CONFTEST = """
import pytest
from tests.run import again, guard, started

@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    guard.guarded(config)
    started.counted(config)
    again.told(config)
"""
STUBBORN = """
import pathlib, signal, subprocess, sys, time
FOREVER = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(600)"

def test_starts_what_does_not_end(tmp_path):
    child = subprocess.Popen([sys.executable, "-c", FOREVER], start_new_session=True)
    (tmp_path / "file").write_text("left")
    pathlib.Path("told.txt").write_text(f"{child.pid} {tmp_path}\\n")
    WAIT
"""
BY_CHANCE = """
import pytest

@pytest.mark.flaky(reruns=1)
@pytest.mark.parametrize("number", range(COUNT))
def test_passes_the_second_time(number, seen={}):
    seen[number] = seen.get(number, 0) + 1
    assert seen[number] > 1
"""

pytestmark = pytest.mark.slow


def run_of(folder: Path, test: str) -> subprocess.Popen[str]:
    """A run of its own, not a part of the one around it."""
    (folder / "conftest.py").write_text(CONFTEST)
    (folder / "test_one.py").write_text(test)
    kept = {name: value for name, value in os.environ.items() if name != guardian.VARIABLE}
    return subprocess.Popen(
        [sys.executable, "-m", "pytest", *WORDS],
        cwd=folder,
        env={**kept, "PYTHONPATH": str(ROOT), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def left_by(folder: Path) -> tuple[Path, Path]:
    """Where the process and the file of STUBBORN are found, once the test has said it."""
    told = eventually(
        lambda: (folder / "told.txt").read_text() if (folder / "told.txt").exists() else "",
        lambda text: text.endswith("\n"),
    )
    pid, kept = told.split()
    return Path("/proc") / pid, Path(kept)


@pytest.mark.skipif(not guardian.PROC.is_dir(), reason="processes are looked for in /proc")
def test_a_run_that_is_killed_leaves_no_process_and_no_file(tmp_path: Path) -> None:
    run = run_of(tmp_path, STUBBORN.replace("WAIT", "time.sleep(600)"))
    process, kept = left_by(tmp_path)
    assert process.exists()
    assert kept.exists()

    run.send_signal(signal.SIGKILL)
    run.wait()

    eventually(lambda: not process.exists())
    eventually(lambda: not kept.exists())


@pytest.mark.skipif(not guardian.PROC.is_dir(), reason="processes are looked for in /proc")
def test_a_run_says_what_did_not_end_by_itself(tmp_path: Path) -> None:
    run = run_of(tmp_path, STUBBORN.replace("WAIT", ""))

    said, _ = run.communicate()

    process, kept = left_by(tmp_path)
    assert run.returncode == 0, said
    assert f"SIGKILL to process {process.name}" in said
    eventually(lambda: not process.exists())
    assert not kept.exists()


def test_files_of_a_failed_test_are_kept_until_the_next_run(tmp_path: Path) -> None:
    failing = "def test_one(tmp_path):\n    (tmp_path / 'look').write_text('')\n    assert 0\n"

    said, _ = run_of(tmp_path, failing).communicate()
    kept = Path(said.rsplit("until the next run: ", 1)[1].splitlines()[0])
    assert list(kept.rglob("look"))
    run_of(tmp_path, "def test_one():\n    pass\n").communicate()

    assert not kept.exists()


@pytest.mark.parametrize("count", [again.MOST, again.MOST + 1])
def test_three_tests_may_be_tried_again_and_are_named(tmp_path: Path, count: int) -> None:
    run = run_of(tmp_path, BY_CHANCE.replace("COUNT", str(count)))

    said, _ = run.communicate()

    assert said.count("tried again: test_one.py::test_passes_the_second_time") == count
    assert run.returncode == (0 if count <= again.MOST else 1), said


def test_a_run_that_starts_too_many_servers_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(started, "MOST", {started.SERVER: 2})
    words = [sys.executable, "-m", "backend.cli", "serve", "--port", "0"]

    counts = Counter([started.kind_of(words)] * 3)

    assert started.too_many(Counter({started.SERVER: 2})) == []
    assert "3 servers of their own were started, 2 at most" in started.too_many(counts)[0]


def test_a_command_and_a_unit_are_told_apart() -> None:
    program = [sys.executable, "-m"]

    assert started.kind_of([*program, "backend.cli", "device", "list"]) == started.COMMAND
    assert started.kind_of([*program, "sim_device", "unit", "--pty", "x"]) == started.UNIT
    assert started.kind_of(["/usr/bin/gcc", "-c", "x.c"]) == started.COMPILER
    assert started.kind_of(["git", "ls-files"]) == started.OTHER


def test_a_number_that_is_used_again_is_another_process() -> None:
    own = place.mark_of(os.getpid())

    assert own is None or own.startswith(f"{os.getpid()}-")
    assert place.mark_of(2**22 + 1) is None
