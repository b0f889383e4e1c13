"""Goal: what is generated is what the source says. Method: generate again and compare."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_registrys_files_are_what_the_registry_says() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "firmware_protocol.generate", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )

    assert run.returncode == 0, run.stdout + run.stderr


def test_the_lock_files_name_no_registry() -> None:
    run = subprocess.run(
        [ROOT / ".ci" / "check-locks"], cwd=ROOT, capture_output=True, text=True, check=False
    )

    assert run.returncode == 0, run.stdout + run.stderr
