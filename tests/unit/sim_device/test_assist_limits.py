"""Goal: whatever the rider does, the motor's torque stays inside every limit and ends when it must.

Method: each cut-off and limit on its own against numbers worked out by hand from thesis_checks 2
and 5, then hypothesis over rough rides for what must hold always.
"""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from firmware_protocol._generated import LimitFlags
from sim_device.firmware.python.law import assist_run
from tests.fakes.thesis import THESIS

CONFIG = THESIS
GEAR_RATIO = CONFIG["gear_ratio"]
TORQUE_CONSTANT, RESISTANCE_OHM = 0.112, 0.25
STEP_S = 0.01
FIXED, FUZZY = 2, 3

Outputs = dict[str, npt.NDArray[Any]]


def run(torque_nm: Any, config: dict[str, Any] | None = None, **changes: Any) -> Outputs:
    readings = {
        "torque_raw_counts": np.asarray(torque_nm, np.float64) * 100,
        "speed_kmh": 10.0,
        "cadence_rpm": 60.0,
        "motor_speed_rpm": 500.0,
        "battery_voltage_v": 36.0,
        "mode": FUZZY,
        "brake": 0,
        **changes,
    }
    return assist_run({**CONFIG, **(config or {})}, readings)


def switched(first: float, then: float, at: int = 300, length: int = 400) -> Any:
    return np.where(np.arange(length) < at, first, then)


def has(outputs: Outputs, flag: LimitFlags, index: int = -1) -> bool:
    return bool(outputs["limit_flags"][index] & flag)


def test_the_brake_takes_the_torque_away_in_the_same_step() -> None:
    outputs = run(np.full(400, 40.0), brake=switched(0, 1))

    assert outputs["motor_torque_nm"][299] > 1.0
    assert outputs["motor_torque_nm"][300] == 0.0
    assert has(outputs, LimitFlags.BRAKE)
    assert not has(outputs, LimitFlags.RAMP_UP)


def test_back_pedalling_takes_the_torque_away_in_the_same_step() -> None:
    outputs = run(np.full(400, 40.0), cadence_rpm=switched(60, -1))

    assert outputs["motor_torque_nm"][300] == 0.0
    assert has(outputs, LimitFlags.PEDAL_STOP)


def test_standing_cranks_end_the_assist_after_150_ms() -> None:
    torque_nm = run(np.full(400, 40.0), cadence_rpm=switched(60, 0))["motor_torque_nm"]

    last_forward = 299
    assert torque_nm[last_forward + 14] > 0.0
    assert torque_nm[last_forward + 15] == 0.0


def test_a_bike_that_was_just_switched_on_does_not_push_without_pedalling() -> None:
    assert not run(np.full(100, 60.0), cadence_rpm=0.0)["motor_torque_nm"].any()


@pytest.mark.parametrize(("speed_kmh", "assisted"), [(24.99, True), (25.0, False), (40.0, False)])
def test_there_is_no_assist_at_and_above_25_kmh(speed_kmh: float, assisted: bool) -> None:
    outputs = run(np.full(300, 40.0), speed_kmh=speed_kmh)

    assert (outputs["motor_torque_nm"][-1] > 0.0) == assisted
    assert has(outputs, LimitFlags.SPEED_CUTOFF) != assisted


@pytest.mark.parametrize(("speed_kmh", "share"), [(22.9, 1.0), (23.5, 0.75), (24.5, 0.25)])
def test_a_soft_cutoff_takes_its_share_once(speed_kmh: float, share: float) -> None:
    hard = run(np.full(1000, 20.0), speed_kmh=speed_kmh)["motor_torque_nm"][-1]

    soft = run(np.full(1000, 20.0), {"assist_cutoff_band_kmh": 2.0}, speed_kmh=speed_kmh)

    assert soft["motor_torque_nm"][-1] == pytest.approx(share * hard, rel=1e-3)


def test_a_low_battery_ends_the_assist() -> None:
    outputs = run(np.full(400, 40.0), battery_voltage_v=switched(36.0, 29.9))

    assert outputs["motor_torque_nm"][300] == 0.0
    assert has(outputs, LimitFlags.BATTERY_VOLTAGE)


def test_the_motor_torque_limit_holds_and_is_told() -> None:
    outputs = run(np.full(400, 80.0), motor_speed_rpm=300.0)

    assert outputs["motor_torque_nm"].max() == pytest.approx(2.0)
    assert outputs["limit_flags"][-1] == LimitFlags.MOTOR_TORQUE


LOSSLESS = {"motor_temperature_degc": 20.0, "battery_current_a": 0.0}
"""A motor of copper alone, and cold: all the battery's power is the law's to give."""


def test_twelve_amperes_of_battery_leave_the_power_equation_fulfilled() -> None:
    outputs = run(np.full(400, 80.0), speed_kmh=24.0, motor_speed_rpm=2476.0, **LOSSLESS)

    current_a = outputs["motor_torque_nm"][-1] / TORQUE_CONSTANT
    back_emf_v = TORQUE_CONSTANT * 2476.0 * 2 * np.pi / 60
    assert current_a * (current_a * RESISTANCE_OHM + back_emf_v) == pytest.approx(36 * 12, rel=1e-4)
    assert has(outputs, LimitFlags.BATTERY_CURRENT)


def test_at_25_kmh_the_battery_leaves_at_most_1_45_nm() -> None:
    outputs = run(np.full(400, 100.0), speed_kmh=24.99, motor_speed_rpm=2579.3, **LOSSLESS)

    assert 1.35 < outputs["motor_torque_nm"].max() <= 1.45


def test_back_emf_and_the_highest_speed_leave_no_torque() -> None:
    slow_battery = run(np.full(400, 80.0), motor_speed_rpm=2800.0, battery_voltage_v=31.0)
    too_fast = run(np.full(400, 80.0), motor_speed_rpm=3000.0, battery_voltage_v=42.0)

    assert not slow_battery["motor_torque_nm"].any()  # 0.112 V s x 293 rad/s = 32.8 V > 31 V
    assert not too_fast["motor_torque_nm"].any()
    assert has(slow_battery, LimitFlags.MOTOR_SPEED)
    assert has(too_fast, LimitFlags.MOTOR_SPEED)


def test_the_ramp_goes_on_from_what_was_given_not_from_what_was_asked() -> None:
    outputs = run(np.full(500, 40.0), brake=switched(1, 0, at=300, length=500))

    crank_nm = outputs["motor_torque_nm"][300:] * GEAR_RATIO
    assert crank_nm[0] == pytest.approx(2.0, rel=1e-3)  # 200 Nm/s for 10 ms
    assert has(outputs, LimitFlags.RAMP_UP, 300)
    assert not has(outputs, LimitFlags.RAMP_UP)


def test_easing_off_lowers_the_assist_no_faster_than_the_gentle_ramp() -> None:
    outputs = run(switched(40.0, 0.0), {"torque_filter_s": 0.02})

    crank_nm = outputs["motor_torque_nm"] * GEAR_RATIO
    assert np.diff(crank_nm).min() == pytest.approx(-4.0, rel=1e-3)  # 400 Nm/s for 10 ms
    assert has(outputs, LimitFlags.RAMP_DOWN, 302)


def test_flags_stay_silent_where_there_is_nothing_to_hold_back() -> None:
    outputs = run(np.zeros(100), cadence_rpm=0.0, brake=1, speed_kmh=30.0, mode=FIXED)

    assert not outputs["limit_flags"].any()


readings = st.fixed_dictionaries(
    {
        "seed": st.integers(0, 2**32 - 1),
        "torque_nm": st.floats(0, 300),
        "motor_speed_rpm": st.floats(-100, 3500),
        "battery_voltage_v": st.floats(20, 45),
        "mode": st.integers(0, 4),
        "band_kmh": st.sampled_from([0.0, 3.0]),
    }
)


@settings(max_examples=60, deadline=None)
@given(readings)
def test_no_ride_breaks_a_limit_or_outruns_the_ramp(draw: dict[str, Any]) -> None:
    random = np.random.default_rng(draw["seed"])
    steps = 400
    speed_kmh = np.abs(np.cumsum(random.normal(0, 0.6, steps)) + 22)
    motor_rpm = draw["motor_speed_rpm"] * random.uniform(0.5, 1, steps)
    voltage_v = draw["battery_voltage_v"] * random.uniform(0.8, 1, steps)
    brake = random.random(steps) < 0.02
    cadence = np.where(random.random(steps) < 0.05, -1.0, 60.0)

    outputs = run(
        draw["torque_nm"] * random.uniform(-0.1, 1, steps),
        {"assist_cutoff_band_kmh": draw["band_kmh"]},
        speed_kmh=speed_kmh,
        cadence_rpm=cadence,
        motor_speed_rpm=motor_rpm,
        battery_voltage_v=voltage_v,
        brake=brake,
        mode=draw["mode"],
    )

    torque_nm = outputs["motor_torque_nm"].astype(np.float64)
    speed_rad_s = np.maximum(motor_rpm, 0) * 2 * np.pi / 60
    current_a = torque_nm / TORQUE_CONSTANT
    power_w = current_a * (current_a * RESISTANCE_OHM + TORQUE_CONSTANT * speed_rad_s)
    assert torque_nm.min() >= 0.0
    assert torque_nm.max() <= 2.0
    assert (power_w <= 12.0 * voltage_v * (1 + 1e-5)).all()
    assert (current_a * RESISTANCE_OHM + TORQUE_CONSTANT * speed_rad_s)[torque_nm > 0].max(
        initial=0.0
    ) <= voltage_v.max() * (1 + 1e-5)
    must_be_zero = (
        (speed_kmh.astype(np.float32) >= 25.0)
        | brake
        | (cadence < 0)
        | (voltage_v < 30.0 - 1e-4)
        | (motor_rpm >= 3000.001)
    )
    assert not torque_nm[must_be_zero].any()
    rises_nm = np.diff(torque_nm, prepend=0.0) * GEAR_RATIO
    assert rises_nm.max() <= 200.0 * STEP_S * (1 + 1e-4)
    assert (torque_nm[outputs["limit_flags"] == 0] <= 2.0).all()


@settings(max_examples=60, deadline=None)
@given(st.floats(0, 200), st.floats(0, 200), st.floats(0, 30), st.integers(0, 2**32 - 1))
def test_under_the_fixed_law_more_torque_is_never_less_assist(
    one_nm: float, other_nm: float, speed_kmh: float, seed: int
) -> None:
    less, more = sorted((one_nm, other_nm))
    legs = np.random.default_rng(seed).uniform(0.2, 1, 300)

    weak = run(less * legs, speed_kmh=speed_kmh, mode=FIXED)["motor_torque_nm"]
    strong = run(more * legs, speed_kmh=speed_kmh, mode=FIXED)["motor_torque_nm"]

    assert (strong >= weak - 1e-6).all()


@settings(max_examples=60, deadline=None)
@given(st.floats(1.5, 200), st.floats(1.5, 200), st.floats(0, 30))
def test_under_the_fuzzy_law_more_steady_torque_is_never_less_assist(
    one_nm: float, other_nm: float, speed_kmh: float
) -> None:
    less, more = sorted((one_nm, other_nm))

    weak = run(np.full(600, less), speed_kmh=speed_kmh)["motor_torque_nm"][-1]
    strong = run(np.full(600, more), speed_kmh=speed_kmh)["motor_torque_nm"][-1]

    assert strong >= weak - 1e-6


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 4))
def test_every_answer_is_a_number_whatever_the_sensors_say(seed: int, mode: int) -> None:
    random = np.random.default_rng(seed)
    wild = random.choice([0.0, -1.0, 1e6, -1e6, 1e-30, 25.0, 3.0], (5, 300))

    outputs = run(
        wild[0] / 100,
        speed_kmh=wild[1],
        cadence_rpm=wild[2],
        motor_speed_rpm=wild[3],
        battery_voltage_v=wild[4],
        mode=mode,
    )

    for name in ("rider_torque_filtered_nm", "torque_rate", "assist_ratio", "motor_torque_nm"):
        assert np.isfinite(outputs[name]).all(), name
    assert (outputs["torque_rate"] >= 0.0).all()
    assert (outputs["torque_rate"] <= np.float32(0.9)).all()
