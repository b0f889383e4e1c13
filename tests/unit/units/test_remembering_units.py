"""Goal: what happened to a unit's configuration is in the log without anybody having to look.

The unit is the small honest one behind a real thread, the revision log one in memory.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import cast

import pytest

from backend.core.revision import Revision, RevisionLog
from backend.device.configuration import ConfigImage
from backend.device.states import UnitEvent
from backend.store import UnitSighting
from backend.tuning.revisions import ROLLED_BACK_REASON, RevisionBook
from backend.tuning.service import Tuning
from backend.units.memory import UnitMemory
from backend.units.records import UnitStore
from backend.units.service import Devices
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.server import eventually
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import Heard, UnitOpener


class Units:
    """Those that were noted, in order."""

    def __init__(self) -> None:
        self.noted: list[UnitSighting] = []

    def note_unit(self, unit: UnitSighting) -> None:
        self.noted.append(unit)


KEY = f"ebl:{b'FAKE-UNIT-01'.hex()}"


@dataclass
class Bench:
    unit: FakeUnit
    devices: Devices
    tuning: Tuning
    revisions: MemoryRevisions
    units: Units
    heard: Heard
    id: str


@pytest.fixture
def bench() -> Iterator[Bench]:
    unit, revisions, units, heard = FakeUnit(), MemoryRevisions(), Units(), Heard()
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    tuning = Tuning(devices, revisions)
    memory = UnitMemory(
        devices, cast(RevisionLog, revisions), cast(UnitStore, units), tuning.note_trial_end
    )
    devices.watch(lambda device_id, event: heard(event))
    device = devices.add("socket://bench:1")
    devices.watch(memory.follow)
    yield Bench(unit, devices, tuning, revisions, units, heard, device.id)
    devices.close()
    memory.close()


def test_a_trial_that_ran_out_is_in_the_log_at_once_with_its_reason(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=30)

    bench.unit.give_up_trial()

    newest = eventually(
        lambda: bench.revisions.kept[KEY][-1], lambda row: row.reason == ROLLED_BACK_REASON
    )
    assert (newest.generation, newest.parameters["pedal_stop_ms"]) == (7, 150)


def test_a_device_tells_how_long_a_trial_still_runs_and_why_the_last_one_ended(
    bench: Bench,
) -> None:
    before = bench.devices.get(bench.id).config
    assert before is not None
    assert (before.remaining_s, before.rollback_cause) == (None, None)

    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=60)
    bench.heard.wait_for(UnitEvent, name="CONFIG_PROVISIONAL")
    running = bench.devices.get(bench.id).config
    assert running is not None
    assert running.remaining_s is not None
    assert 0.0 < running.remaining_s <= 60.0
    assert running.expires_at is not None
    assert running.expires_at > datetime.now(UTC)

    bench.tuning.rollback_config(bench.id)
    eventually(
        lambda: bench.devices.get(bench.id).config,
        lambda stamp: stamp is not None and stamp.rollback_cause == "asked",
    )


def test_a_unit_that_gave_a_trial_up_by_restarting_says_so(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=60)

    bench.unit.restart()

    stamp = eventually(
        lambda: bench.devices.get(bench.id).config,
        lambda stamp: stamp is not None and stamp.rollback_cause is not None,
    )
    assert stamp is not None
    assert (stamp.rollback_cause, stamp.remaining_s) == ("restart", None)
    newest = eventually(lambda: bench.revisions.kept[KEY][-1], lambda row: row.generation == 7)
    assert newest.reason == ROLLED_BACK_REASON


def test_what_was_noted_since_one_looked_is_not_noted_again() -> None:
    class LookedBefore(MemoryRevisions):
        def list(self, unit_key: str, limit: int = 1000) -> Sequence[Revision]:
            return ()

    log = LookedBefore()
    log.append(KEY, {"pedal_stop_ms": 150}, crc32=7)

    RevisionBook(log).back_up(KEY, ConfigImage(1, 7, {"pedal_stop_ms": 150}))

    assert len(log.kept[KEY]) == 1
