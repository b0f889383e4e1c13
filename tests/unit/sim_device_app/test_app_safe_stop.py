"""Goal: a program that hangs, stumbles or computes nonsense ends with a motor without torque, says
why, and does not drive on by itself.

Method: the bench board's loop is stopped in parts, its clock jumps, and the law's memory is damaged
behind its back. Times are those of docs/safety.md.
"""

import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol._generated import (
    Event,
    EvtFaultFreezeRequest,
    FaultFlags,
    ResetCause,
    StartInfoRequest,
    StartInfoResponse,
)
from tests.fakes.bench_unit import BenchUnit
from tests.unit.sim_device_app.test_app_protections import RIDING, STANDING

PERIOD_US = 10_000
ALL_FAULTS = 0x7FFF_7FFF
OWN_STOPS = [ResetCause.WATCHDOG, ResetCause.FAULT_HANDLER, ResetCause.DEADLINE]
HURTS = {0: "what it remembers", 1: "a point of its table", 2: "its limit", 3: "its gear"}


@pytest.fixture
def unit() -> BenchUnit:
    unit = BenchUnit()
    unit.hello()
    unit.inputs(**{**RIDING, "speed_kmh": 15.0, "mode_selected": 3})
    unit.inputs(motor_speed_rpm=1540.0, cadence_rpm=38.2)
    unit.advance(4.0)
    assert unit.motor_nm() > 0.1
    return unit


def start_info(unit: BenchUnit) -> StartInfoResponse:
    message = unit.ask(StartInfoRequest()).message
    assert isinstance(message, StartInfoResponse)
    return message


def due(next_us: int, now_us: int) -> tuple[list[int], int]:
    """The times of all steps that are due at once, and when the next one is."""
    following, step_us = ffi.new("uint64_t *", next_us), ffi.new("uint64_t *")
    steps = []
    while lib.steps_due(following, now_us, step_us):
        steps.append(int(step_us[0]))
    return steps, int(following[0])


@pytest.mark.parametrize("which", HURTS, ids=HURTS.get)
def test_damaged_memory_of_the_law_gives_no_torque_and_a_latched_fault(
    unit: BenchUnit, which: int
) -> None:
    lib.bench_hurt_law(unit.board, which)
    torques = []
    for _ in range(300):
        unit.advance(0.01)
        torques.append(unit.motor_nm())

    assert torques == [0.0] * 300
    assert unit.faults() & FaultFlags.LAW_RESULT
    told = [event for event in unit.events if event.code == Event.FAULT_SET]
    assert told[-1].fields["fault_flags"] & FaultFlags.LAW_RESULT
    freeze = unit.ask(EvtFaultFreezeRequest(17))
    assert freeze.message is not None


def test_a_lost_result_is_cleared_at_standstill_and_never_by_pedalling(unit: BenchUnit) -> None:
    lib.bench_hurt_law(unit.board, 0)
    unit.advance(3.0)
    assert unit.clear_faults() & FaultFlags.LAW_RESULT  # the bike rolls
    assert unit.motor_nm() == 0.0

    unit.inputs(**STANDING)
    unit.advance(2.0)
    assert unit.clear_faults() == 0

    unit.inputs(**{**RIDING, "speed_kmh": 15.0, "motor_speed_rpm": 1540.0, "cadence_rpm": 38.2})
    unit.advance(3.0)
    assert unit.motor_nm() > 0.1


def test_the_watchdog_is_kicked_once_a_step_and_only_by_a_loop_that_lives(unit: BenchUnit) -> None:
    before = lib.bench_kicks(unit.board)
    unit.advance(1.0)
    lively = lib.bench_kicks(unit.board) - before

    lib.bench_hang(unit.board, lib.BENCH_HANG_POLLS)
    before = lib.bench_kicks(unit.board)
    lib.bench_advance_us(unit.board, 1_000_000)

    assert lively == 100
    assert lib.bench_kicks(unit.board) == before


def test_steps_that_stop_coming_end_with_the_motor_off_and_no_more_kicks(unit: BenchUnit) -> None:
    lib.bench_hang(unit.board, lib.BENCH_HANG_STEPS)
    before = lib.bench_kicks(unit.board)

    lib.bench_advance_us(unit.board, 99_000)
    assert not lib.bench_motor_is_off(unit.board)
    lib.bench_advance_us(unit.board, 2_000)

    assert lib.bench_motor_is_off(unit.board)
    assert unit.motor_nm() == 0.0
    assert lib.bench_kicks(unit.board) <= before + 1
    lib.bench_hang(unit.board, 0)
    unit.advance(1.0)
    assert unit.motor_nm() == 0.0
    assert lib.bench_kicks(unit.board) <= before + 1

    unit.boot()
    unit.advance(0.01)

    assert unit.events[0].fields["reset_cause"] == ResetCause.DEADLINE


@pytest.mark.parametrize("cause", list(ResetCause))
def test_a_start_says_its_cause_and_one_of_its_own_making_is_a_latched_fault(
    unit: BenchUnit, cause: ResetCause
) -> None:
    lib.bench_reset_cause(unit.board, cause)

    unit.boot()
    unit.advance(3.0)  # the rider pedals on

    boot = unit.events[0]
    assert (boot.code, boot.fields["reset_cause"]) == (Event.BOOT, cause)
    assert start_info(unit).reset_cause == cause
    stopped = cause in OWN_STOPS
    assert bool(unit.faults() & FaultFlags.SAFE_STOP) == stopped
    assert (unit.motor_nm() == 0.0) == stopped
    unit.inputs(**STANDING)
    unit.advance(2.0)
    assert unit.clear_faults() == 0


def test_missed_steps_are_counted_and_the_assist_begins_anew(unit: BenchUnit) -> None:
    before_nm = unit.motor_nm()
    lib.bench_hang(unit.board, lib.BENCH_HANG_STEPS | lib.BENCH_HANG_POLLS)
    lib.bench_advance_us(unit.board, 80_000)
    lib.bench_hang(unit.board, 0)

    unit.advance(0.01)
    first_nm = unit.motor_nm()
    unit.advance(2.0)

    assert start_info(unit).steps_missed == 8
    assert first_nm <= 200.0 * 0.01 / 40.34 * 1.001  # one step of the ramp, from nothing
    assert unit.motor_nm() == pytest.approx(before_nm, rel=0.02)
    assert unit.faults() == 0


def test_steps_in_time_are_never_missed(unit: BenchUnit) -> None:
    unit.advance(5.0)

    assert start_info(unit).steps_missed == 0


def test_a_loop_a_little_late_makes_up_for_it_and_one_much_later_gives_up() -> None:
    assert due(50_000, 49_999) == ([], 50_000)
    assert due(50_000, 50_000) == ([50_000], 60_000)
    assert due(50_000, 79_999) == ([50_000, 60_000, 70_000], 80_000)
    assert due(50_000, 80_000) == ([80_000], 90_000)
    assert due(50_000, 3_600_000_000 + 57_123) == ([3_600_050_000], 3_600_060_000)


def test_no_lateness_makes_a_burst_and_every_step_keeps_its_place() -> None:
    for late_us in [*range(0, 200_000, 777), 10**9, 10**12]:
        steps, next_us = due(50_000, 50_000 + late_us)

        assert 1 <= len(steps) <= 3
        assert all(step % PERIOD_US == 0 for step in steps)
        assert 50_000 + late_us - PERIOD_US < steps[-1] <= 50_000 + late_us
        assert next_us == steps[-1] + PERIOD_US
