"""Goal: what the unit tells arrives once and in full, however many frames the line loses. Method:
the real firmware and the real session on a simulated line in virtual time; the battery is the clock
of the story, so that the test knows every event that must be told.
"""

from __future__ import annotations

import random

import pytest

from backend.device.ebl.session.event_deduplicator import Arrival, EventDeduplicator
from backend.device.states import LinkStatistics, UnitEvent
from firmware_protocol._generated import BootEvent, FaultClearedEvent, FaultSetEvent
from firmware_protocol.codec import Event
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.serial_wire import SerialWire

LOW_V, GOOD_V = 29.0, 40.0
# A low battery is a fault after half a second, and over after another two at the most.
TELLING_S = 3.0


@pytest.mark.parametrize("loss", [0.0, 0.1, 0.4])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_every_fault_is_told_exactly_once(loss: float, seed: int) -> None:
    unit = BenchUnit()
    wire = SerialWire(unit, loss=loss, seed=seed).connect()
    heard: list[str] = []

    for turn in range(8):
        unit.inputs(battery_voltage_v=LOW_V if turn % 2 == 0 else GOOD_V)
        wire.run(TELLING_S)
        heard += names(wire)
    wire.loss = 0.0
    wire.run(TELLING_S)
    heard += names(wire)

    assert sorted(heard) == ["FAULT_CLEARED"] * 4 + ["FAULT_SET"] * 4
    assert wire.session.unit_state.faults_active == ()


def test_a_fault_told_late_does_not_come_back_to_life() -> None:
    unit = BenchUnit()
    wire = SerialWire(unit).connect()
    wire.loss = 1.0
    unit.inputs(battery_voltage_v=LOW_V)
    wire.run(0.6)
    wire.loss = 0.0
    unit.inputs(battery_voltage_v=GOOD_V)

    wire.run(TELLING_S)

    assert sorted(names(wire)) == ["FAULT_CLEARED", "FAULT_SET"]
    assert wire.session.unit_state.faults_active == ()


def names(wire: SerialWire) -> list[str]:
    told = [event for event in wire.session.next_events() if isinstance(event, UnitEvent)]
    return [event.name for event in told if event.name.startswith("FAULT")]


def told(seq: int, again: bool = False) -> Event:
    return Event(seq, FaultSetEvent.CODE, 0, FaultSetEvent(1), retransmit=again)


def test_numbers_are_kept_over_a_new_greeting_and_forgotten_after_a_restart() -> None:
    deduplicator = EventDeduplicator(LinkStatistics())
    deduplicator.handshake_done(boot_id=7)
    assert deduplicator.classify(told(3)) is Arrival.IN_ORDER

    deduplicator.handshake_done(boot_id=7)
    assert deduplicator.classify(told(3, again=True)) is Arrival.AGAIN
    deduplicator.classify(Event(0, BootEvent.CODE, 0, BootEvent(8, 0)))

    assert deduplicator.classify(told(1)) is Arrival.IN_ORDER
    assert deduplicator.classify(told(3)) is Arrival.AFTER_A_GAP


def test_what_came_late_is_no_longer_lost() -> None:
    statistics = LinkStatistics()
    deduplicator = EventDeduplicator(statistics)
    deduplicator.handshake_done(boot_id=1)
    deduplicator.classify(told(65534))

    assert deduplicator.classify(told(1)) is Arrival.AFTER_A_GAP
    assert statistics.unit_events_lost == 2
    assert deduplicator.classify(told(65535, again=True)) is Arrival.LATE
    assert deduplicator.classify(told(0, again=True)) is Arrival.LATE
    assert deduplicator.classify(told(0, again=True)) is Arrival.AGAIN

    assert (statistics.unit_events_lost, statistics.unit_events_again) == (0, 1)


def test_the_book_holds_no_more_than_it_needs() -> None:
    deduplicator = EventDeduplicator(LinkStatistics())
    chance = random.Random(3)

    for _ in range(5000):
        seq = chance.randrange(1 << 16)
        deduplicator.classify(Event(seq, FaultClearedEvent.CODE, 0, FaultClearedEvent(1)))

    assert len(deduplicator._recent_seqs) <= 64
    assert len(deduplicator._missing) <= 64
