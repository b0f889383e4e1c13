"""Goal: tests that share a server or a ride make it once, not once for each worker.

Method: a small folder of tests is run by two workers with the scheduler of tests/parts.py, and each
test notes which worker ran it. A scheduler that is never asked would not be noticed otherwise: the
tests pass, only slower.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests import parts

ROOT = Path(__file__).resolve().parents[2]
SAMPLE = """
import os, pathlib
import pytest

@pytest.mark.parametrize("number", range(6))
def test_note(number):
    with pathlib.Path("workers.txt").open("a") as notes:
        notes.write(f"{__file__} {os.environ['PYTEST_XDIST_WORKER']}\\n")
"""


@pytest.mark.slow
def test_the_tests_of_a_file_run_on_one_worker(tmp_path: Path) -> None:
    for name in ("one", "two", "three"):
        (tmp_path / f"test_{name}.py").write_text(SAMPLE)
    (tmp_path / "conftest.py").write_text("from tests.parts import pytest_xdist_make_scheduler\n")

    subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "--dist", "load", "-n", "2", "."],
        cwd=tmp_path,
        env={"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin"},
        check=True,
        capture_output=True,
        timeout=120,
    )

    notes = [line.split() for line in (tmp_path / "workers.txt").read_text().splitlines()]
    assert len(notes) == 18
    assert len({tuple(note) for note in notes}) == 3
    assert {worker for _, worker in notes} == {"gw0", "gw1"}


def test_what_is_spread_exists_and_its_tests_are_parts_of_their_own() -> None:
    for path in parts.SPREAD:
        assert (ROOT / path).is_file(), f"{path} is no file; mend SPREAD in tests/parts.py"
        assert parts.part_of(f"{path}::test_a[1]") != parts.part_of(f"{path}::test_a[2]")
    own = "tests/architecture/test_a_file_is_one_part.py"
    assert parts.part_of(f"{own}::test_a") == parts.part_of(f"{own}::test_b[x::y]") == own
