"""Goal: the unit tells what it asks of its motor, what the motor can give and what it gives, and
says so when the crank is faster than the motor can be.

Method: a rider at 90 rpm in a low gear, through the wire, against what the physics really passes
through the motor's clutch; the law alone against thesis eq. 4.8 worked out by hand. A motor of
3,000 r/min behind 40.34 keeps up to 74.4 rpm.
"""

import math
from typing import Any

import numpy as np
import pytest

from firmware_protocol._generated import CHANNELS, LimitFlags, StrSnapshotRequest
from firmware_protocol.layout import MISSING
from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import assist_run
from sim_device.lockstep import LockstepUnit
from spindle.testing import DriveUnit
from tests.fakes.bench_unit import BenchUnit

GEAR_RATIO = 40.34
KEEPS_UP_RPM = 3000.0 / GEAR_RATIO
TORQUE_CONSTANT, RESISTANCE_OHM = 0.112, 0.25
DRAG_NM_S = 1.2e-4
RIDE_S = 55.0
TOLD = (
    "motor_torque_nm",
    "motor_torque_demanded_nm",
    "motor_torque_available_nm",
    "limit_flags",
    "cadence_rpm",
    "fault_flags",
)


@pytest.fixture(scope="module")
def told() -> dict[str, Any]:
    """Rows (n,) of the ride as a host sees them."""
    unit = DriveUnit(1, scenario="spinning")
    unit.advance(RIDE_S)
    return dict(unit.trace(*TOLD))


def test_at_90_rpm_the_unit_asks_the_motor_has_nothing_and_gives_nothing(
    told: dict[str, Any],
) -> None:
    outrun = (told["cadence_rpm"] > 80.0) & (told["motor_torque_demanded_nm"] > 0.2)

    assert outrun.sum() > 1500  # fifteen seconds
    assert 85.0 < told["cadence_rpm"][outrun].max() < 100.0
    assert told["motor_torque_available_nm"][outrun].max() == 0.0
    assert told["motor_torque_nm"][outrun].max() == 0.0
    flags = told["limit_flags"][outrun].astype(int)
    assert (flags & LimitFlags.MOTOR_SPEED != 0).all()
    assert not told["fault_flags"].any()


def test_below_74_rpm_the_motor_helps_again(told: dict[str, Any]) -> None:
    hill = (told["t_s"] > 38.0) & (told["t_s"] < 48.0)

    assert told["cadence_rpm"][hill].max() < KEEPS_UP_RPM
    assert told["motor_torque_nm"][hill].mean() > 0.4


def test_what_the_unit_takes_for_delivered_is_what_passes_the_clutch() -> None:
    """By the motor's current; a motor that runs up to its clutch is the part that is not passed."""
    unit, wire = LockstepUnit(1, scenario="spinning"), DriveUnit(1, scenario="spinning")
    passed = []
    for _ in range(round(RIDE_S * 100)):
        unit.advance(0.01)
        passed.append(unit.observe()["motor_torque_nm"])
    wire.advance(RIDE_S)
    told_nm = wire.trace("motor_torque_nm")["motor_torque_nm"]

    assert np.nanmean(told_nm) == pytest.approx(np.mean(passed), rel=0.02)
    assert np.mean(passed) > 0.2


def law(cadence_rpm: float, motor_speed_rpm: float, **changes: float) -> dict[str, Any]:
    """The law's answer after two seconds of a steady push of 60 Nm."""
    readings = {
        "torque_raw_counts": np.full(200, 6000.0),
        "speed_kmh": 12.0,
        "cadence_rpm": cadence_rpm,
        "motor_speed_rpm": motor_speed_rpm,
        "battery_voltage_v": 37.0,
        "battery_current_a": 0.0,
        "motor_temperature_degc": 20.0,
        "mode": 2,
        "brake": 0,
        **changes,
    }
    answer = assist_run(default_config(), readings)
    return {name: values[-1] for name, values in answer.items()}


def test_a_motor_in_step_with_the_crank_has_what_back_emf_and_its_speed_leave() -> None:
    speed_rpm = 73.0 * GEAR_RATIO
    back_emf_v = TORQUE_CONSTANT * speed_rpm * 2 * math.pi / 60
    by_voltage_nm = TORQUE_CONSTANT * (37.0 - back_emf_v) / RESISTANCE_OHM
    by_speed_nm = 2.0 * (3000.0 - speed_rpm) / 100.0  # its regulator fades over 100 r/min

    answer = law(73.0, speed_rpm, battery_voltage_v=37.0)

    available_nm = min(by_voltage_nm, by_speed_nm)
    assert answer["motor_torque_available_nm"] == pytest.approx(available_nm, rel=1e-3)


def test_a_motor_that_still_runs_up_has_what_it_will_have_at_the_crank_s_speed() -> None:
    in_step = law(73.0, 73.0 * GEAR_RATIO)
    behind = law(73.0, 500.0)

    assert behind["motor_torque_available_nm"] == in_step["motor_torque_available_nm"]


def test_what_is_asked_is_before_ramps_and_limits_and_ends_with_a_cut_off() -> None:
    outrun, braked = law(90.0, 0.0), law(60.0, 2420.0, brake=1)

    # 60 Nm at 1:1, of which the average over the stroke has 98 % after two seconds.
    assert outrun["motor_torque_demanded_nm"] == pytest.approx(60.0 / GEAR_RATIO, rel=0.03)
    assert (outrun["motor_torque_nm"], outrun["motor_torque_available_nm"]) == (0.0, 0.0)
    assert outrun["limit_flags"] == LimitFlags.MOTOR_SPEED
    assert braked["motor_torque_demanded_nm"] == 0.0
    assert braked["motor_torque_available_nm"] > 0.5


def test_nobody_knows_what_is_available_where_the_input_is_refused() -> None:
    answer = law(60.0, 2420.0, battery_voltage_v=math.nan)

    assert answer["motor_torque_demanded_nm"] == 0.0
    assert np.isnan(answer["motor_torque_available_nm"])


@pytest.mark.parametrize(
    ("current_a", "speed_rpm", "delivered_nm"),
    [
        (8.0, 2400.0, 0.112 * 8.0 - DRAG_NM_S * 2400.0 * math.pi / 30),
        (0.336, 2998.0, 0.0),  # free, at its top speed
        (0.0, 1500.0, 0.0),  # let go, and spinning down
        (math.nan, 2400.0, None),
    ],
)
def test_the_delivered_torque_is_by_the_current_or_missing(
    current_a: float, speed_rpm: float, delivered_nm: float | None
) -> None:
    unit = BenchUnit()
    unit.hello()
    unit.inputs(motor_current_a=current_a, motor_speed_rpm=speed_rpm)
    unit.advance(0.02)
    (channel,) = (row for row in CHANNELS if row.name == "motor_torque_nm")

    values = unit.ask(StrSnapshotRequest(bytes([channel.id]))).message.values

    count = int.from_bytes(values, "little", signed=True)
    if delivered_nm is None:
        assert count == MISSING
    else:
        assert count * float(channel.scale) == pytest.approx(delivered_nm, abs=2e-4)
