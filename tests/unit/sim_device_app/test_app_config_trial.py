"""Goal: a configuration on trial is given up by itself, unless somebody says in time that it stays.

Method: real firmware on the bench board. Whatever ends the trial (time, reset, the host), what is
active is read back through the wire and compared with what was active before or was committed.
"""

import pytest

from firmware_protocol import parameters
from firmware_protocol._generated import (
    Bank,
    ByeRequest,
    CfgBeginRequest,
    CfgCommitRequest,
    CfgCommitResponse,
    CfgConfirmRequest,
    CfgInfoRequest,
    CfgRollbackRequest,
    CfgRollbackResponse,
    CfgSlotsRequest,
    CfgSlotsResponse,
    CfgStatusRequest,
    CfgStatusResponse,
    ConfigState,
    Event,
    EvtFaultListRequest,
    RollbackCause,
    SlotState,
    Status,
)
from tests.fakes.bench_unit import BenchUnit, crc32
from tests.fakes.maker import Maker, provision, write_with_the_makers_word

TRIAL_S = 10
CHANGES = {"assist_cutoff_kmh": 19.0, "mode_names": ["a", "b", "c", "d", "e"]}


def status(unit: BenchUnit) -> CfgStatusResponse:
    message = unit.ask(CfgStatusRequest()).message
    assert isinstance(message, CfgStatusResponse)
    return message


def slots(unit: BenchUnit) -> CfgSlotsResponse:
    message = unit.ask(CfgSlotsRequest()).message
    assert isinstance(message, CfgSlotsResponse)
    return message


def confirm(unit: BenchUnit) -> Status | int:
    generation, image = unit.read_image()
    return unit.ask(CfgConfirmRequest(generation, crc32(image))).status


def test_what_is_on_trial_is_active_and_says_how_long_it_has(unit: BenchUnit) -> None:
    expected = parameters.pack_image(unit.config() | CHANGES)

    response = unit.write(CHANGES, confirm_s=TRIAL_S)

    assert response.message == CfgCommitResponse(2, crc32(expected), ConfigState.PROVISIONAL)
    assert unit.read_image() == (2, expected)
    now = status(unit)
    assert (now.state, now.generation, now.crc32) == (ConfigState.PROVISIONAL, 2, crc32(expected))
    assert TRIAL_S * 1000 - 10 <= now.confirm_left_ms <= TRIAL_S * 1000
    assert unit.ask(CfgInfoRequest()).message.state == ConfigState.PROVISIONAL
    (event,) = [event for event in unit.events if event.code == Event.CONFIG_PROVISIONAL]
    assert event.fields == {"generation": 2, "crc32": crc32(expected), "confirm_s": TRIAL_S}


def test_a_confirmed_trial_stays_for_good(unit: BenchUnit) -> None:
    unit.write(CHANGES, confirm_s=TRIAL_S)
    tried = unit.read_image()

    assert confirm(unit) == Status.OK

    unit.advance(2 * TRIAL_S)
    assert unit.read_image() == tried
    assert status(unit).state == ConfigState.IDLE
    assert unit.event_codes()[-1] == Event.CONFIG_COMMITTED
    unit.boot()
    assert unit.read_image() == tried


def test_confirming_twice_is_no_mistake_because_an_answer_may_be_lost(unit: BenchUnit) -> None:
    unit.write(CHANGES, confirm_s=TRIAL_S)
    confirm(unit)

    assert confirm(unit) == Status.OK
    assert unit.event_codes().count(Event.CONFIG_COMMITTED) == 1


@pytest.mark.parametrize("ending", ["time-out", "restart", "asked"])
def test_whatever_ends_a_trial_brings_back_exactly_what_was_there(
    unit: BenchUnit, ending: str
) -> None:
    before = unit.read_image()
    unit.write(CHANGES, confirm_s=TRIAL_S)

    if ending == "time-out":
        unit.advance(TRIAL_S - 0.1)
        assert unit.read_image() != before
        unit.advance(0.1)
        cause = RollbackCause.TIME_OUT
    elif ending == "restart":
        unit.boot()
        cause = RollbackCause.RESTART
    else:
        response = unit.ask(CfgRollbackRequest())
        assert response.message == CfgRollbackResponse(before[0], crc32(before[1]))
        cause = RollbackCause.ASKED

    assert unit.read_image() == before
    now = status(unit)
    assert (now.state, now.rollback_cause, now.rolled_back_generation) == (0, cause, 2)
    (event,) = [event for event in unit.events if event.code == Event.CONFIG_ROLLED_BACK]
    assert event.fields == {"generation": before[0], "crc32": crc32(before[1])}
    unit.boot()
    assert unit.read_image() == before
    assert Event.CONFIG_ROLLED_BACK not in unit.event_codes()


def test_the_law_runs_on_what_is_on_trial_and_then_no_more(unit: BenchUnit) -> None:
    riding = {"speed_kmh": 10.0, "motor_speed_rpm": 2420.0}
    unit.inputs(mode_selected=2, cadence_rpm=60.0, torque_raw_counts=2000.0, **riding)
    unit.advance(2.0)
    assert unit.output().motor_torque_nm > 0.0

    unit.inputs(speed_kmh=0.0, motor_speed_rpm=0.0)  # nothing is written on the way
    unit.write({"motor_torque_nm_max": 0.0}, confirm_s=TRIAL_S)
    unit.inputs(**riding)
    unit.advance(1.0)
    on_trial = unit.output().motor_torque_nm
    unit.advance(TRIAL_S)

    assert on_trial == 0.0
    assert unit.output().motor_torque_nm > 0.0


def test_nobody_writes_over_the_way_back(unit: BenchUnit) -> None:
    before = unit.read_image()
    unit.write(CHANGES, confirm_s=TRIAL_S)
    generation, image = unit.read_image()

    response = unit.ask(CfgBeginRequest(generation, crc32(image)))

    assert (response.status, response.detail) == (Status.BUSY, TRIAL_S)
    assert unit.read_image(Bank.PREVIOUS) == before


def test_only_what_is_on_trial_can_be_confirmed(unit: BenchUnit) -> None:
    unit.write(CHANGES, confirm_s=TRIAL_S)
    generation, image = unit.read_image()

    other = unit.ask(CfgConfirmRequest(generation - 1, crc32(image)))
    changed = unit.ask(CfgConfirmRequest(generation, crc32(image) ^ 1))

    assert other.status == Status.STALE_BASE
    assert changed.status == Status.CRC_MISMATCH
    assert status(unit).state == ConfigState.PROVISIONAL


def test_without_a_trial_there_is_nothing_to_return_from(unit: BenchUnit) -> None:
    assert unit.ask(CfgRollbackRequest()).status == Status.STATE


def test_a_host_that_leaves_and_comes_back_finds_the_trial_as_it_was(unit: BenchUnit) -> None:
    unit.write(CHANGES, confirm_s=TRIAL_S)
    unit.ask(ByeRequest())
    unit.advance(4.0)
    unit.hello(nonce=b"returned")

    now = status(unit)

    assert now.state == ConfigState.PROVISIONAL
    assert 5900 <= now.confirm_left_ms <= 6000
    assert confirm(unit) == Status.OK


def test_a_unit_without_a_configuration_tries_its_first_one_too() -> None:
    maker = Maker()
    unit = BenchUnit(provisioned=False)
    provision(unit, maker)
    default = unit.read_image()
    write_with_the_makers_word(unit, maker, CHANGES, confirm_s=TRIAL_S)
    assert unit.ask(EvtFaultListRequest()).message.fault_flags != 0

    unit.advance(TRIAL_S)
    assert unit.read_image() == default
    write_with_the_makers_word(unit, maker, CHANGES, confirm_s=TRIAL_S)
    confirm(unit)

    assert unit.ask(EvtFaultListRequest()).message.fault_flags == 0


def test_the_slots_say_what_they_hold_and_how_often_they_were_erased(unit: BenchUnit) -> None:
    unit.write(CHANGES, confirm_s=TRIAL_S)
    trial = slots(unit)
    unit.ask(CfgRollbackRequest())
    returned = slots(unit)
    for cutoff in (18.0, 17.0, 16.0):
        unit.write({"assist_cutoff_kmh": cutoff})

    assert (trial.active_slot, trial.states) == (
        1,
        bytes([SlotState.CONFIRMED, SlotState.PROVISIONAL]),
    )
    assert (returned.active_slot, returned.states) == (
        0,
        bytes([SlotState.CONFIRMED, SlotState.VOID]),
    )
    last = slots(unit)
    assert last.states == bytes([SlotState.CONFIRMED] * 2)
    assert sorted(last.generations) == [3, 4]
    assert last.erases == (2, 3)


def test_the_flash_is_not_written_twice_within_two_seconds(unit: BenchUnit) -> None:
    unit.write({"assist_cutoff_kmh": 18.0})
    active = unit.read_image()
    transaction = unit.begin()
    unit.stage(transaction, {"assist_cutoff_kmh": 17.0})
    unit.advance(0.5)

    wait_ms = status(unit).commit_wait_ms

    assert 1400 <= wait_ms <= 1500
    assert unit.read_image() == active
    unit.advance(wait_ms / 1000)
    assert status(unit).commit_wait_ms == 0


def test_a_commit_too_soon_names_the_time_to_wait_and_can_be_repeated(unit: BenchUnit) -> None:
    unit.write({"assist_cutoff_kmh": 18.0})
    transaction = unit.begin()
    image = unit.stage(transaction, {"assist_cutoff_kmh": 17.0})
    commit = CfgCommitRequest(transaction, crc32(image), 0, 0)

    refused = unit.ask(commit)
    unit.advance(refused.detail / 1000)

    assert refused.status == Status.RATE_LIMIT
    assert 0 < refused.detail <= 2000
    assert unit.ask(commit).status == Status.OK
