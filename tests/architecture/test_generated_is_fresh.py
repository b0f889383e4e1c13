"""Goal: what is generated is what the source says. Method: generate again and compare."""

import json
import subprocess
import sys
import tomllib
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


def test_the_promises_of_the_last_release_are_written_down() -> None:
    """`python -m firmware_protocol.generate.released` writes them when the version grows."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    released = json.loads((ROOT / "firmware_protocol" / "released.json").read_text())

    assert released["version"] == project["version"]


def test_the_lock_files_name_no_registry() -> None:
    run = subprocess.run(
        [ROOT / ".ci" / "check-locks"], cwd=ROOT, capture_output=True, text=True, check=False
    )

    assert run.returncode == 0, run.stdout + run.stderr
