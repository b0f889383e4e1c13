"""The image that runs on the emulated board, for the tests that look at it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from sim_device import emulator


@pytest.fixture(scope="session")
def image() -> Path:
    """unit.elf, built; without the tools for it the test is skipped, but not in CI."""
    reason = emulator.missing()
    if reason is not None and os.environ.get("CI") != "true":
        pytest.skip(reason)
    return emulator.build("unit")
