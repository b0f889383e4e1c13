"""Goal: what is dangerous ends the assist in time, keeps what the bike did, and does not let the
motor start again by itself.

Method: real firmware on the bench board; each sensor says what it says when its part breaks. Times
are those of docs/safety.md; levels are from thesis_checks 5 (A14) and 6. EN 15194 4.2.13: pedalling
is no action of the rider, so it clears nothing.
"""

from typing import Any

import pytest

from firmware_protocol._generated import (
    FAULTS,
    Event,
    EvtFaultFreezeRequest,
    FaultFlags,
    LimitFlags,
    Severity,
    Status,
)
from tests.fakes.bench_unit import BenchUnit

TOUR = 2
GEAR_RATIO = 40.34
RIDING: dict[str, Any] = {
    "torque_raw_counts": 3000.0,
    "cadence_rpm": 56.27,  # as fast as motor and wheel: 40.34, and 44 to 14 teeth
    "speed_kmh": 22.0,
    "motor_speed_rpm": 2270.0,
    "battery_voltage_v": 38.0,
    "mode_selected": TOUR,
    "motor_current_a": 5.0,
    "battery_current_a": 4.0,
    "motor_temperature_degc": 60.0,
    "controller_temperature_degc": 45.0,
}
STANDING = {"speed_kmh": 0.0, "motor_speed_rpm": 0.0, "cadence_rpm": 0.0, "torque_raw_counts": 0.0}

# What breaks, the fault, and the longest time from there to a motor without torque.
LATCHED = [
    ({"torque_raw_counts": 32767.0}, FaultFlags.TORQUE_SENSOR, 0.01),
    ({"torque_raw_counts": float("nan")}, FaultFlags.TORQUE_SENSOR, 0.01),
    ({"speed_kmh": float("nan")}, FaultFlags.SPEED_SENSOR, 0.01),
    ({"speed_age_ms": 1001}, FaultFlags.SPEED_SENSOR, 0.1),
    ({"motor_current_a": 30.0}, FaultFlags.OVER_CURRENT, 0.02),
    ({"battery_current_a": 19.0}, FaultFlags.OVER_CURRENT, 0.02),
    ({"battery_voltage_v": 26.5}, FaultFlags.UNDER_VOLTAGE, 0.01),
    ({"battery_cut": 1}, FaultFlags.BATTERY_CUT, 0.01),
    ({"motor_temperature_degc": 130.0}, FaultFlags.MOTOR_TEMPERATURE, 0.1),
    ({"controller_temperature_degc": 100.0}, FaultFlags.CONTROLLER_TEMPERATURE, 0.1),
    ({"speed_kmh": 2.0}, FaultFlags.SPEED_MISMATCH, 1.0),
    ({"motor_speed_rpm": 0.0}, FaultFlags.MOTOR_HALL, 0.5),
    ({"motor_speed_rpm": 400.0}, FaultFlags.MOTOR_HALL, 0.5),
]
MENDED = {**RIDING, "speed_age_ms": 0, "battery_cut": 0, "torque_age_ms": 0}


@pytest.fixture
def unit() -> BenchUnit:
    unit = BenchUnit()
    unit.hello()
    unit.inputs(**RIDING)
    unit.advance(4.0)
    assert unit.motor_nm() > 0.1
    return unit


@pytest.mark.parametrize(("broken", "flag", "seconds"), LATCHED, ids=str)
def test_a_hazard_ends_the_assist_in_time_and_keeps_it_ended(
    unit: BenchUnit, broken: dict[str, Any], flag: FaultFlags, seconds: float
) -> None:
    unit.inputs(**broken)
    unit.advance(seconds + 0.01)
    assert unit.motor_nm() == 0.0
    unit.advance(1.0)
    assert unit.faults() & flag

    unit.inputs(**MENDED)
    unit.advance(5.0)  # the rider pedals on

    assert unit.motor_nm() == 0.0
    assert unit.faults() & flag
    assert unit.clear_faults() & flag  # not while the bike rolls


@pytest.mark.parametrize(("broken", "flag", "seconds"), LATCHED, ids=str)
def test_a_hazard_is_cleared_at_standstill_once_its_cause_is_gone(
    unit: BenchUnit, broken: dict[str, Any], flag: FaultFlags, seconds: float
) -> None:
    unit.inputs(**broken)
    unit.advance(seconds + 0.2)
    unit.inputs(**{**MENDED, **STANDING})
    unit.advance(0.5)
    too_early = unit.clear_faults()
    unit.advance(1.0)

    assert too_early & flag
    assert unit.clear_faults() & flag == 0
    assert (Event.FAULT_CLEARED, flag) in [
        (event.code, event.fields["fault_flags"] & flag)
        for event in unit.events
        if event.code == Event.FAULT_CLEARED
    ]
    unit.inputs(**MENDED)
    unit.advance(3.0)
    assert unit.motor_nm() > 0.1


def test_a_hazard_whose_cause_stays_is_not_cleared(unit: BenchUnit) -> None:
    unit.inputs(motor_temperature_degc=131.0)
    unit.advance(1.0)
    unit.inputs(**STANDING, motor_temperature_degc=111.0)  # cooler, and still hot
    unit.advance(2.0)
    assert unit.clear_faults() == FaultFlags.MOTOR_TEMPERATURE

    unit.inputs(motor_temperature_degc=109.0)
    unit.advance(2.0)
    assert unit.clear_faults() == 0


def test_switching_off_and_on_clears_a_hazard_that_is_over(unit: BenchUnit) -> None:
    unit.inputs(motor_current_a=40.0)
    unit.advance(0.5)
    unit.inputs(**MENDED)

    unit.boot()
    unit.advance(3.0)

    assert unit.faults() == 0
    assert unit.motor_nm() > 0.1


def test_a_fault_keeps_what_the_bike_did(unit: BenchUnit) -> None:
    unit.inputs(battery_cut=1)
    unit.advance(0.1)

    bit = int(FaultFlags.BATTERY_CUT).bit_length() - 1
    assert unit.ask(EvtFaultFreezeRequest(bit)).status == Status.OK


def test_a_sag_of_the_battery_is_no_fault(unit: BenchUnit) -> None:
    unit.inputs(battery_voltage_v=29.5)
    unit.advance(0.3)
    assert unit.motor_nm() == 0.0

    unit.inputs(battery_voltage_v=36.0)
    unit.advance(2.0)

    assert unit.faults() == 0
    assert unit.motor_nm() > 0.1


def test_an_interrupted_rotor_comes_back_by_itself(unit: BenchUnit) -> None:
    unit.inputs(torque_age_ms=60)
    unit.advance(0.15)
    ramped_out = unit.motor_nm()
    unit.advance(0.2)
    assert unit.faults() == FaultFlags.TORQUE_LINK

    unit.inputs(torque_age_ms=0)
    unit.advance(3.0)

    assert ramped_out == 0.0
    assert unit.faults() == 0
    assert unit.motor_nm() > 0.1


def turns(unit: BenchUnit, count: int, swing: float) -> None:
    """About a turn of the cranks a second, with legs of 30 Nm and this much up and down."""
    for step in range(count * 20):
        unit.inputs(torque_raw_counts=3000.0 + swing * (1 if step % 10 < 5 else -1))
        unit.advance(0.05)


def test_a_reading_that_stops_following_the_legs_is_stuck(unit: BenchUnit) -> None:
    turns(unit, 5, swing=600.0)
    assert unit.faults() == 0

    turns(unit, 7, swing=0.0)

    assert unit.faults() == FaultFlags.TORQUE_STUCK
    assert unit.motor_nm() == 0.0


def test_a_servo_that_pushes_evenly_is_not_a_stuck_sensor(unit: BenchUnit) -> None:
    turns(unit, 30, swing=0.0)

    assert unit.faults() == 0


@pytest.mark.parametrize(
    ("rest_nm", "drifted"), [(2.0, False), (4.0, True), (-4.0, True), (20.0, False)]
)
def test_a_zero_that_moved_is_seen_at_rest_and_a_foot_or_a_weight_is_not(
    unit: BenchUnit, rest_nm: float, drifted: bool
) -> None:
    unit.inputs(**{**STANDING, "torque_raw_counts": 100.0 * rest_nm})
    unit.advance(9.0)
    assert (unit.faults() == FaultFlags.TORQUE_DRIFT) == drifted

    unit.inputs(torque_raw_counts=0.0)
    unit.advance(12.0)
    assert unit.faults() == 0


def switched_on(unit: BenchUnit, torque_nm: float) -> None:
    """Standing, with so much on the pedals."""
    unit.inputs(**{**STANDING, "torque_raw_counts": 100.0 * torque_nm})
    unit.boot()


@pytest.mark.parametrize(("load_nm", "is_a_foot"), [(7.0, False), (9.0, True), (-9.0, True)])
def test_a_foot_at_switching_on_is_told_until_it_leaves(
    unit: BenchUnit, load_nm: float, is_a_foot: bool
) -> None:
    zero = unit.config()["sensor_offset_counts"]
    switched_on(unit, load_nm)
    unit.advance(1.5)
    assert (unit.faults() == FaultFlags.FOOT_AT_START) == is_a_foot

    unit.inputs(torque_raw_counts=0.0)
    unit.advance(1.5)
    assert unit.faults() == 0
    assert unit.config()["sensor_offset_counts"] == zero


def test_a_foot_of_the_start_that_pedals_gets_no_assist_until_it_has_left(unit: BenchUnit) -> None:
    switched_on(unit, 30.0)
    unit.advance(1.5)
    unit.inputs(**RIDING)
    turns(unit, 5, swing=2900.0)  # a dead spot is no foot that has left
    while_pushing = unit.motor_nm()

    unit.inputs(torque_raw_counts=0.0)
    unit.advance(1.5)
    unit.inputs(**RIDING)
    unit.advance(3.0)

    assert while_pushing == 0.0
    assert unit.faults() == 0
    assert unit.motor_nm() > 0.1


def test_a_foot_that_comes_after_free_pedals_or_rides_off_at_once_is_none_of_the_start(
    unit: BenchUnit,
) -> None:
    switched_on(unit, 0.0)
    unit.advance(0.2)
    unit.inputs(torque_raw_counts=3000.0)
    unit.advance(3.0)
    assert unit.faults() == 0

    switched_on(unit, 30.0)
    unit.advance(0.5)
    unit.inputs(**RIDING)
    unit.advance(3.0)
    assert unit.faults() == 0
    assert unit.motor_nm() > 0.1


def test_a_foot_that_leaves_a_moved_zero_behind_is_told_as_that(unit: BenchUnit) -> None:
    switched_on(unit, 30.0)
    unit.advance(1.5)
    unit.inputs(torque_raw_counts=500.0)
    unit.advance(12.0)

    assert unit.faults() == FaultFlags.TORQUE_DRIFT


def test_a_sensor_that_breaks_is_told_instead_of_a_foot(unit: BenchUnit) -> None:
    unit.inputs(**{**STANDING, "torque_raw_counts": 32767.0})
    unit.boot()
    unit.advance(3.0)
    assert unit.faults() == FaultFlags.TORQUE_SENSOR

    switched_on(unit, 30.0)
    unit.advance(1.5)
    assert unit.faults() == FaultFlags.FOOT_AT_START
    unit.inputs(torque_raw_counts=32767.0)
    unit.advance(1.5)
    assert unit.faults() == FaultFlags.TORQUE_SENSOR


def test_a_silent_sensor_is_no_foot_that_has_left(unit: BenchUnit) -> None:
    switched_on(unit, 30.0)
    unit.advance(1.5)
    unit.inputs(torque_age_ms=1000, torque_raw_counts=0.0)
    unit.advance(3.0)
    assert unit.faults() == FaultFlags.FOOT_AT_START | FaultFlags.TORQUE_LINK

    unit.inputs(torque_age_ms=0, torque_raw_counts=3000.0)
    unit.advance(1.5)
    assert unit.faults() == FaultFlags.FOOT_AT_START


def test_the_zero_of_a_cold_sensor_is_no_foot(unit: BenchUnit) -> None:
    """The stored zero is corrected for temperature first: 20 counts a kelvin, 50 K colder."""
    unit.inputs(**STANDING)
    unit.advance(3.0)
    told = {"sensor_offset_counts_per_k": 20.0, "sensor_reference_degc": 20.0}
    assert unit.write(told).status == Status.OK
    unit.inputs(sensor_temperature_degc=-30.0)

    switched_on(unit, -10.0)
    unit.advance(2.0)

    assert unit.faults() == 0


def test_a_motor_in_an_easy_gear_is_not_a_lost_speed_sensor(unit: BenchUnit) -> None:
    unit.inputs(speed_kmh=9.0)  # the configured gear would give 22 km/h; a big cog gives 9
    unit.advance(3.0)

    assert unit.faults() == 0


def test_a_motor_that_cannot_say_how_fast_it_turns_gives_nothing_and_latches(
    unit: BenchUnit,
) -> None:
    unit.inputs(motor_speed_rpm=float("nan"))
    unit.advance(0.02)
    at_once = unit.motor_nm()
    unit.advance(0.5)
    unit.inputs(**MENDED)
    unit.advance(5.0)

    assert at_once == unit.motor_nm() == 0.0
    assert unit.faults() == FaultFlags.MOTOR_HALL
    bit = int(FaultFlags.MOTOR_HALL).bit_length() - 1
    assert unit.ask(EvtFaultFreezeRequest(bit)).status == Status.OK


@pytest.mark.parametrize("motor_speed_rpm", [0.0, 2900.0])
def test_a_motor_that_fast_legs_outrun_has_lost_nothing_and_is_asked_for_nothing(
    unit: BenchUnit, motor_speed_rpm: float
) -> None:
    unit.inputs(cadence_rpm=110.0, motor_speed_rpm=motor_speed_rpm)  # the legs would want 4437
    unit.inputs(speed_kmh=20.0)
    unit.advance(3.0)

    assert unit.motor_nm() == 0.0
    assert unit.output().limit_flags & LimitFlags.MOTOR_SPEED
    assert unit.faults() == 0


def wheel_turns(
    unit: BenchUnit, seconds: float, motor_rpm: tuple[float, float], jitter_kmh: float = 0.0
) -> None:
    """The motor's speed goes from one to another; the wheel's sensor says one speed, give or take,
    three times a second, as one magnet does at 22 km/h."""
    steps = round(3.0 * seconds)
    first_rpm, last_rpm = motor_rpm
    for step in range(steps):
        rpm = first_rpm + (last_rpm - first_rpm) * step / steps
        unit.inputs(
            speed_kmh=22.0 + jitter_kmh * (step % 2),
            motor_speed_rpm=rpm,
            cadence_rpm=rpm / GEAR_RATIO,
        )
        unit.advance(1.0 / 3.0)


def test_a_speed_that_stays_while_the_motor_gets_faster_is_stuck(unit: BenchUnit) -> None:
    wheel_turns(unit, 3.0, motor_rpm=(2270.0, 2270.0))
    assert unit.faults() == 0  # nothing says yet that it is not true

    wheel_turns(unit, 3.0, motor_rpm=(2270.0, 2600.0))

    assert unit.faults() == FaultFlags.SPEED_STUCK
    assert unit.motor_nm() == 0.0
    unit.inputs(**MENDED)
    unit.advance(5.0)
    assert unit.motor_nm() == 0.0


def test_shifting_to_keep_the_cadence_does_not_hide_a_stuck_speed(unit: BenchUnit) -> None:
    wheel_turns(unit, 2.0, motor_rpm=(2270.0, 2450.0))  # faster by a twelfth
    assert unit.faults() == 0
    wheel_turns(unit, 2.0, motor_rpm=(2110.0, 2270.0))  # the next cog, and again

    assert unit.faults() == FaultFlags.SPEED_STUCK


def test_a_speed_that_stuck_while_coasting_does_not_fit_the_gear_any_more(unit: BenchUnit) -> None:
    unit.inputs(torque_raw_counts=0.0, cadence_rpm=0.0, motor_speed_rpm=0.0)
    unit.advance(3.0)  # downhill, and the sensor keeps saying 22 km/h
    unit.inputs(**{**RIDING, "motor_speed_rpm": 2800.0, "cadence_rpm": 2800.0 / GEAR_RATIO})
    unit.advance(1.0)

    assert unit.faults() == FaultFlags.SPEED_STUCK
    assert unit.motor_nm() == 0.0


def test_a_speed_that_sticks_from_switching_on_is_seen_when_the_bike_moves(unit: BenchUnit) -> None:
    unit.boot()
    unit.inputs(**{**STANDING, "speed_kmh": 12.5})
    unit.advance(5.0)
    for step in range(20):  # away within two seconds
        unit.inputs(cadence_rpm=3.0 * step, motor_speed_rpm=3.0 * step * GEAR_RATIO)
        unit.inputs(torque_raw_counts=3000.0)
        unit.advance(0.1)

    assert unit.faults() == FaultFlags.SPEED_STUCK
    assert unit.motor_nm() == 0.0


def test_a_shift_at_a_true_speed_is_not_a_stuck_sensor(unit: BenchUnit) -> None:
    for rpm in (2270.0, 1945.0, 1675.0, 2605.0):
        wheel_turns(unit, 4.0, motor_rpm=(rpm, rpm), jitter_kmh=0.02)

    assert unit.faults() == 0


def test_a_bench_at_one_speed_is_not_a_stuck_sensor_whatever_the_assist_does(
    unit: BenchUnit,
) -> None:
    for _ in range(3):
        unit.inputs(mode_selected=0)
        for rpm in (2270.0, 900.0, 0.0):  # without torque the motor runs out
            unit.inputs(motor_speed_rpm=rpm)
            unit.advance(1.0)
        unit.inputs(mode_selected=TOUR)
        unit.advance(0.04)
        for rpm in (800.0, 1600.0, 2200.0, 2270.0):  # and spins up with it
            unit.inputs(motor_speed_rpm=rpm)
            unit.advance(0.04)
        unit.advance(3.0)

    assert unit.motor_nm() > 0.1
    assert unit.faults() == 0


def test_the_walk_button_pushes_the_bike_through_the_whole_unit(unit: BenchUnit) -> None:
    unit.inputs(**{**STANDING, "walk_button": 0})
    unit.advance(3.0)

    unit.inputs(walk_button=1, speed_kmh=3.0)
    unit.advance(1.0)
    pushed = unit.motor_nm()
    unit.inputs(walk_button=0)
    unit.advance(0.02)

    assert 0.1 < pushed <= 1.0
    assert unit.motor_nm() == 0.0


def test_every_fault_says_what_to_do(unit: BenchUnit) -> None:
    assert [fault.name for fault in FAULTS] == [flag.name for flag in FaultFlags]
    for fault in FAULTS:
        assert fault.rider_text.endswith(".")
        assert len(fault.mechanic_text) > len("Check it.")
    latched = {fault.name for fault in FAULTS if fault.severity == Severity.LATCHED}
    assert {flag.name for _, flag, _ in LATCHED} <= latched
