"""Goal: after a change whose answer was lost, what the server tells of it is what the unit holds.

Method: the whole way from `Tuning` through driver and session to the unit's real firmware. From the
moment the commit is on the line one direction of it is dead for a while, or the unit loses its
supply in the middle of a flash write; a twin booted from its flash says what is true.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import pytest

from backend.device.states import LinkState
from backend.errors import Conflict, NoAnswer
from backend.tuning.service import Tuning
from backend.tuning.trial_values import TrialTuning
from backend.units.service import Devices
from firmware_protocol._generated import (
    CfgBeginRequest,
    CfgCommitRequest,
    CfgConfirmRequest,
    CfgRollbackRequest,
    CfgSetRequest,
    LiveSetRequest,
)
from firmware_protocol.codec import Request, decode
from firmware_protocol.framing import FrameDecoder
from sim_device.lockstep import LockstepUnit
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.unit_link import UnitOpener
from tests.simulation.checker import Generation, boot_twin

pytestmark = pytest.mark.slow

Result = TypeVar("Result")

URL = "socket://bench:1"
OFF_S = 0.5
CHANGE = {"pedal_stop_ms": 222}


class FirmwareOnABadLine:
    """The firmware, a line that dies when a certain request is on it, and a supply that fails."""

    def __init__(self) -> None:
        self.unit = LockstepUnit(seed=1)
        self.boot_id = 1
        self.at: type = CfgCommitRequest
        self.dead_up_s = self.dead_down_s = 0.0
        self.cut_after_bytes: int | None = None
        self._decoder = FrameDecoder()
        self._now_s = 0.0
        self._up_until_s = self._down_until_s = self._boot_s = -1.0
        self._sprung = False

    def receive(self, data: bytes) -> None:
        for frame in self._decoder.feed(data):
            request = decode(frame)
            if not self._sprung and isinstance(request, Request):
                self._spring(isinstance(request.message, self.at))
        if self._now_s >= self._up_until_s and self.unit.unit.powered:
            self.unit.send(data)

    def _spring(self, is_it: bool) -> None:
        if not is_it:
            return
        self._sprung = True
        self._up_until_s = self._now_s + self.dead_up_s
        self._down_until_s = self._now_s + self.dead_down_s
        if self.cut_after_bytes is not None:
            self.unit.unit.cut_power_after(self.cut_after_bytes)

    def transmit(self) -> bytes:
        data = self.unit.receive()
        return data if self._now_s >= self._down_until_s else b""

    def advance(self, seconds: float) -> None:
        self._now_s += seconds
        if not self.unit.unit.powered:
            if self._boot_s < 0.0:
                self._boot_s = self._now_s + OFF_S
            elif self._now_s >= self._boot_s:
                self._boot()
            return
        self.unit.advance(seconds)

    def _boot(self) -> None:
        self._boot_s = -1.0
        self.boot_id += 1
        flash = self.unit.unit.flash()
        self.unit = LockstepUnit(seed=1, flash=flash, boot_id=self.boot_id)

    @property
    def truth(self) -> Generation:
        return boot_twin(self.unit.unit.flash())


@dataclass
class Bench:
    unit: FirmwareOnABadLine
    devices: Devices
    tuning: Tuning
    revisions: MemoryRevisions
    id: str


@pytest.fixture
def bench() -> Iterator[Bench]:
    unit, revisions = FirmwareOnABadLine(), MemoryRevisions()
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add(URL)
    assert device.state == LinkState.READY.value
    yield Bench(unit, devices, Tuning(devices, revisions), revisions, device.id)
    devices.close()


def outcome_of(change: Callable[[], object]) -> str:
    """What the caller is told, as an outcome."""
    try:
        change()
    except NoAnswer as error:
        return error.outcome or "untold"
    except Conflict:
        # Told as "no trial any more".
        return "unchanged"
    return "changed"


def when_it_answers(ask: Callable[[], Result], within_s: float = 30.0) -> Result:
    """Ask until there is an answer: a line that dies looks whole until its silence is noticed."""
    until_s = time.monotonic() + within_s
    while True:
        try:
            return ask()
        except NoAnswer:
            if time.monotonic() > until_s:
                raise
            time.sleep(0.05)


# Less than the requests are repeated for; longer than a session lives in silence.
DEAD_S = (0.4, 3.0)


@pytest.mark.parametrize("dead_s", DEAD_S)
@pytest.mark.parametrize("way", ["up", "down", "both"])
def test_a_write_over_a_line_that_dies_at_the_commit(bench: Bench, way: str, dead_s: float) -> None:
    bench.unit.dead_up_s = dead_s if way != "down" else 0.0
    bench.unit.dead_down_s = dead_s if way != "up" else 0.0
    before = bench.unit.truth

    told = outcome_of(lambda: bench.tuning.write_config(bench.id, CHANGE, "why"))

    changed = bench.unit.truth.values["pedal_stop_ms"] == 222
    assert told == ("changed" if changed else "unchanged")
    assert bench.unit.truth.number == before.number + changed
    if changed:
        assert bench.tuning.revisions(bench.id)[0].reason == "why"


@pytest.mark.parametrize("cut_after_bytes", [0, 1, 40, 200, 500, 700, 740, 760, 800, 1000])
def test_a_write_to_a_unit_that_loses_its_supply_in_the_commit(
    bench: Bench, cut_after_bytes: int
) -> None:
    bench.unit.cut_after_bytes = cut_after_bytes

    told = outcome_of(lambda: bench.tuning.write_config(bench.id, CHANGE))

    changed = bench.unit.truth.values["pedal_stop_ms"] == 222
    assert told == ("changed" if changed else "unchanged")


@pytest.mark.parametrize("dead_s", DEAD_S)
@pytest.mark.parametrize("word", ["confirm", "rollback"])
def test_the_word_that_ends_a_trial_is_lost_on_the_way_or_its_answer_is(
    bench: Bench, word: str, dead_s: float
) -> None:
    bench.tuning.write_config(bench.id, CHANGE, confirm_s=200)
    bench.unit.at = CfgConfirmRequest if word == "confirm" else CfgRollbackRequest
    bench.unit.dead_down_s = dead_s
    bench.unit.dead_up_s = dead_s if dead_s == DEAD_S[-1] else 0.0

    told = outcome_of(lambda: getattr(bench.tuning, f"{word}_config")(bench.id))

    stamp = bench.devices.get(bench.id).config
    assert stamp is not None
    kept = bench.unit.truth.values["pedal_stop_ms"] == 222
    config = when_it_answers(lambda: bench.tuning.read_config(bench.id))
    over = config.parameters["pedal_stop_ms"] != 222
    assert told == ("changed" if (kept if word == "confirm" else over) else "unchanged")


@pytest.mark.parametrize("dead_s", DEAD_S)
@pytest.mark.parametrize("way", ["up", "down"])
def test_values_tried_over_a_line_that_dies(bench: Bench, way: str, dead_s: float) -> None:
    live = TrialTuning(bench.devices)
    bench.unit.at = LiveSetRequest
    setattr(bench.unit, f"dead_{way}_s", dead_s)

    told = outcome_of(lambda: live.set(bench.id, CHANGE, 200))

    tried = when_it_answers(lambda: live.read(bench.id)).parameters == CHANGE
    assert told == ("changed" if tried else "unchanged")


@pytest.mark.parametrize("at", [CfgBeginRequest, CfgSetRequest, CfgCommitRequest])
def test_a_write_that_takes_too_long_is_taken_back_or_found_out(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, at: type
) -> None:
    monkeypatch.setattr("backend.device.ebl.unit.WRITE_S", 0.2)
    bench.unit.at = at
    bench.unit.dead_down_s = 2.0

    told = outcome_of(lambda: bench.tuning.write_config(bench.id, CHANGE, "late"))

    # What was not found done must not be done later either.
    now = when_it_answers(lambda: bench.tuning.read_config(bench.id)).parameters["pedal_stop_ms"]
    assert told == ("changed" if now == 222 else "unchanged")
    assert told == ("changed" if at is CfgCommitRequest else "unchanged")


def test_a_change_found_out_only_later_has_its_reason_in_the_log(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.units.outcome.OUTCOME_WAIT_S", 0.0)
    bench.unit.dead_down_s = 3.0

    told = outcome_of(lambda: bench.tuning.write_config(bench.id, CHANGE, "for the rain"))
    assert told == "unknown"
    when_it_answers(lambda: bench.tuning.note_trial_end(bench.id))

    newest = bench.tuning.revisions(bench.id)[0]
    assert (newest.reason, newest.state) == ("for the rain", "verified")
    assert newest.changed == [{"name": "pedal_stop_ms", "old": 150, "new": 222}]
