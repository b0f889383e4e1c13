"""The image that runs on the emulated board, for the tests that look at it."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim_device import emulator


@pytest.fixture(scope="session")
def image() -> Path:
    """unit.elf, built."""
    reason = emulator.missing()
    if reason is not None:
        pytest.fail(reason, pytrace=False)
    return emulator.build("unit")
