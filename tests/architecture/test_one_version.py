"""Goal: whoever asks which version this is gets one answer.

Method: everywhere it is written, compared with `pyproject.toml`.
"""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import backend

ROOT = Path(__file__).resolve().parents[2]
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]


def test_package_and_pages_have_the_version_of_the_project() -> None:
    pages = json.loads((ROOT / "frontend/package.json").read_text(encoding="utf-8"))
    lock = json.loads((ROOT / "frontend/package-lock.json").read_text(encoding="utf-8"))

    assert backend.__version__ == VERSION
    assert pages["version"] == VERSION
    assert {lock["version"], lock["packages"][""]["version"]} == {VERSION}


def test_the_unit_tells_it_too() -> None:
    source = ROOT / "sim_device/firmware/app/requests/system_service.c"
    found = re.search(r"firmware_version\[3\] = \{(.+)\};", source.read_text(encoding="utf-8"))

    assert found is not None
    assert found[1].replace(", ", ".") == VERSION


def test_the_changelog_begins_with_it() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    releases = [line.split()[1] for line in text.splitlines() if line.startswith("## ")]

    assert next((name for name in releases if name != "Unreleased"), VERSION) == VERSION
