"""Goal: the motor does what the law says on the active configuration, and nothing when a sensor
lies. Method: real firmware on the bench board with a steady rider on the pedals.

One rider throughout: 30 Nm (3000 counts at 0.01 Nm a count) at 60 rpm and 10 km/h on a fixed
ratio of 1, so that the motor's shaft gets 30 Nm / 40.34 = 0.744 Nm once the filter has settled
(gear ratio of thesis text 4.10; no limit is reached).
"""

import math

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import Event, EvtFaultClearRequest, FaultFlags, LimitFlags, Status
from tests.fakes.bench_unit import BenchUnit

RIDER_NM = 30.0
GEAR_RATIO = 40.34
RIDING = {"speed_kmh": 10.0, "motor_speed_rpm": 2420.0}
OFF, TOUR, SPORT = 0, 2, 3
SETTLED_S = 5.0
"""Ten time constants of the torque filter: e**-10 is left."""


@pytest.fixture
def unit() -> BenchUnit:
    unit = BenchUnit()
    unit.hello()
    unit.inputs(torque_raw_counts=3000.0, cadence_rpm=60.0, **RIDING)
    unit.inputs(mode_selected=TOUR)
    unit.advance(SETTLED_S)
    return unit


def fault_events(unit: BenchUnit) -> list[tuple[Event | int, object]]:
    return [
        (event.code, event.fields["fault_flags"])
        for event in unit.events
        if event.code in (Event.FAULT_SET, Event.FAULT_CLEARED)
    ]


def stop(unit: BenchUnit) -> None:
    unit.inputs(speed_kmh=0.0, motor_speed_rpm=0.0)


def test_the_motor_gets_the_riders_torque_times_the_ratio(unit: BenchUnit) -> None:
    assert unit.motor_nm() == pytest.approx(RIDER_NM / GEAR_RATIO, rel=1e-3)


def test_without_a_choice_on_the_handlebar_the_mode_at_start_counts(unit: BenchUnit) -> None:
    unit.inputs(mode_selected=255)
    unit.advance(1.0)
    gain_of_sport = unit.output().fuzzy_gain

    unit.inputs(mode_selected=SPORT)
    unit.advance(1.0)

    assert gain_of_sport > 0.0
    # A speed of pulses that are timed to microseconds is not the same to the last bit.
    assert unit.output().fuzzy_gain == pytest.approx(gain_of_sport, rel=1e-5)


def test_a_mode_that_does_not_exist_counts_as_no_choice(unit: BenchUnit) -> None:
    unit.inputs(mode_selected=17)

    unit.advance(1.0)

    assert unit.output().fuzzy_gain > 0.0


def test_a_new_configuration_works_from_the_next_control_step_on_the_same_filter(
    unit: BenchUnit,
) -> None:
    filtered = unit.output().rider_torque_filtered_nm
    stop(unit)
    changes = {"mode_ratios": [0.0, 0.5, 0.25, 1.0, 1.5], "assist_ramp_down_nm_per_s": 2000.0}
    assert unit.write(changes).status == Status.OK
    unit.inputs(**RIDING)

    unit.advance(0.01)

    assert unit.output().rider_torque_filtered_nm == pytest.approx(filtered, rel=1e-6)
    assert unit.output().assist_ratio == pytest.approx(0.25)
    unit.advance(0.5)
    assert unit.motor_nm() == pytest.approx(0.25 * RIDER_NM / GEAR_RATIO, rel=1e-3)


def test_a_staged_configuration_moves_nothing(unit: BenchUnit) -> None:
    before = unit.motor_nm()
    transaction = unit.begin()

    unit.stage(transaction, {"mode_ratios": [0.0, 0.5, 0.25, 1.0, 1.5]})
    unit.advance(1.0)

    assert unit.motor_nm() == pytest.approx(before, rel=1e-3)


@pytest.mark.parametrize("reading", [math.nan, math.inf, 32767.0, -32768.0, 1e30], ids=str)
def test_a_torque_sensor_that_lies_stops_the_motor_at_once(unit: BenchUnit, reading: float) -> None:
    filtered = unit.output().rider_torque_filtered_nm

    unit.inputs(torque_raw_counts=reading)
    unit.advance(0.01)

    assert unit.motor_nm() == 0.0
    assert unit.output().limit_flags & LimitFlags.INPUT_REFUSED
    assert unit.output().rider_torque_filtered_nm == filtered


@pytest.mark.parametrize(
    ("broken", "flag"),
    [
        ({"torque_raw_counts": math.nan}, FaultFlags.TORQUE_SENSOR),
        ({"torque_raw_counts": 32767.0}, FaultFlags.TORQUE_SENSOR),
        ({"speed_kmh": math.nan}, FaultFlags.SPEED_SENSOR),
        ({"speed_kmh": 200.0}, FaultFlags.SPEED_SENSOR),
        ({"battery_voltage_v": 29.9}, FaultFlags.BATTERY_LOW),
        ({"battery_voltage_v": math.nan}, FaultFlags.BATTERY_LOW),
    ],
    ids=str,
)
def test_a_fault_is_told_once_when_it_comes_and_once_when_it_is_over(
    unit: BenchUnit, broken: dict[str, float], flag: FaultFlags
) -> None:
    healthy = {"torque_raw_counts": 3000.0, "speed_kmh": 10.0, "battery_voltage_v": 36.0}
    unit.inputs(**broken)
    unit.advance(3.0)
    during = unit.faults()

    unit.inputs(**healthy)
    unit.advance(3.0)
    stop(unit)
    unit.ask(EvtFaultClearRequest(0xFFFF))

    assert during == flag
    assert unit.faults() == 0
    assert fault_events(unit) == [(Event.FAULT_SET, flag), (Event.FAULT_CLEARED, flag)]


def test_a_spark_on_the_torque_sensor_is_no_fault(unit: BenchUnit) -> None:
    unit.inputs(torque_raw_counts=math.nan)
    unit.advance(0.05)

    unit.inputs(torque_raw_counts=3000.0)
    unit.advance(1.0)

    assert fault_events(unit) == []
    assert unit.motor_nm() > 0.0


def test_a_battery_that_recovers_a_little_stays_low(unit: BenchUnit) -> None:
    unit.inputs(battery_voltage_v=29.5)
    unit.advance(1.0)

    unit.inputs(battery_voltage_v=30.5)
    unit.advance(5.0)

    assert unit.faults() == FaultFlags.BATTERY_LOW


def test_events_are_numbered_without_a_gap_from_the_boot_on(unit: BenchUnit) -> None:
    unit.boot()
    unit.inputs(speed_kmh=math.nan)
    unit.advance(1.0)
    stop(unit)
    unit.advance(2.0)
    unit.ask(EvtFaultClearRequest(0xFFFF))
    unit.advance(0.1)

    assert [event.seq for event in unit.events] == [0, 1, 2]
    assert unit.events[0].code == Event.BOOT
    assert unit.events[0].fields == {"boot_id": 2, "reset_cause": 0}
    assert unit.events[1].t_us == 100_000


def test_an_event_the_line_had_no_room_for_leaves_a_gap_in_the_numbers() -> None:
    unit = BenchUnit()
    unit.line_room(0)
    for _ in range(40):
        unit.inputs(battery_voltage_v=29.9)
        unit.advance_unread(1.0)
        unit.inputs(battery_voltage_v=36.0)
        unit.advance_unread(2.0)
    unit.line_room(lib.BENCH_LINE_BYTES)
    unit.advance(0.1)
    unit.inputs(battery_voltage_v=29.9)
    unit.advance(1.0)

    assert unit.events[-1].seq == 81
    assert len(unit.events) < 82
