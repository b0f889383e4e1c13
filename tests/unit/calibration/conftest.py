"""A workshop with a unit whose sensor is calibrated. A file that needs another has its own."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.unit.calibration.calibration_job import Workshop


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Workshop]:
    workshop = Workshop(tmp_path)
    yield workshop
    workshop.stop()
