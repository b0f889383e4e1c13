"""A unit to tune: the small honest one behind a real thread, its revision log one in memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from backend.tuning.service import Tuning
from backend.units.service import Devices
from firmware_protocol.parameters import unpack_image
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

URL = "socket://bench:1"
NOW_S = 1_700_000_000.0
KEY = f"ebl:{b'FAKE-UNIT-01'.hex()}"


@dataclass
class Bench:
    unit: FakeUnit
    tuning: Tuning
    revisions: MemoryRevisions
    id: str

    @property
    def held(self) -> dict[str, object]:
        """What the unit holds."""
        return dict(unpack_image(self.unit.image))


@pytest.fixture
def bench() -> Iterator[Bench]:
    unit, revisions = FakeUnit(), MemoryRevisions()
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add(URL)
    yield Bench(unit, Tuning(devices, revisions, lambda: NOW_S), revisions, device.id)
    devices.close()
