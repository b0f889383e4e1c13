"""Goal: from raw counts to motor torque, the law does what the thesis and its checks say.

Method: rides of constant or scripted readings through the unit's own C; expected values are worked
out by hand from thesis 4.1 and 4.6 and from thesis_checks I-13 to I-16.
"""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from firmware_protocol._generated import LimitFlags
from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import AssistLaw, LawRefused, assist_run, gain_points

FIXED, FUZZY, OFF = 2, 3, 0
GEAR_RATIO = 40.34
COUNTS_PER_NM = 100.0
STEP_S = 0.01

Outputs = dict[str, npt.NDArray[Any]]


def ride(
    torque_nm: Any, speed_kmh: Any = 10.0, mode: Any = FUZZY, **changes: Any
) -> dict[str, Any]:
    """Readings of a rider who pedals on; `changes` overrides any of them."""
    torque = np.asarray(torque_nm, np.float64)
    readings = {
        "torque_raw_counts": torque * COUNTS_PER_NM,
        "speed_kmh": speed_kmh,
        "cadence_rpm": 30.0,
        "motor_speed_rpm": 500.0,
        "battery_voltage_v": 36.0,
        "mode": mode,
        "brake": 0,
    }
    return {**readings, **changes}


def run(readings: dict[str, Any], **config: Any) -> Outputs:
    return assist_run({**default_config(), **config}, readings)


def steady(torque_nm: float, seconds: float = 10.0, **arguments: Any) -> Outputs:
    return run(ride(np.full(round(seconds / STEP_S), torque_nm), **arguments))


def test_counts_become_newton_metres_through_offset_and_gain() -> None:
    outputs = run(
        ride([0.0], torque_raw_counts=[1250.0]),
        sensor_offset_counts=250.0,
        sensor_gain_nm_per_count=0.02,
    )

    assert outputs["rider_torque_nm"][0] == pytest.approx(20.0)


def test_the_average_reaches_63_percent_of_a_step_after_its_time_constant() -> None:
    filtered = steady(30.0)["rider_torque_filtered_nm"]

    assert filtered[round(0.5 / STEP_S) - 1] / 30.0 == pytest.approx(1 - np.exp(-1), abs=0.01)
    assert filtered[-1] == pytest.approx(30.0, abs=1e-3)


def test_the_average_takes_the_two_strokes_of_a_turn_out_of_the_torque() -> None:
    seconds = np.arange(0, 20, STEP_S)
    legs = 30.0 * (1 - 0.8 * np.cos(2 * 2 * np.pi * seconds))

    filtered = run(ride(legs))["rider_torque_filtered_nm"][seconds > 10]

    # A first-order low-pass of 0.5 s passes 1 / sqrt(1 + (2 pi 2 Hz 0.5 s)^2) = 0.157 of 2 Hz.
    assert (filtered.max() - filtered.min()) / 2 == pytest.approx(0.157 * 24.0, rel=0.05)
    assert filtered.mean() == pytest.approx(30.0, rel=0.01)


@pytest.mark.parametrize(
    ("speed_kmh", "ratio"),
    [(0, 1), (15, 1), (18, 2 / 3), (20, 4 / 9), (24, 0), (25, 0), (30, 0)],
)
def test_the_fixed_law_tapers_from_15_to_24_kmh(speed_kmh: float, ratio: float) -> None:
    outputs = steady(20.0, speed_kmh=speed_kmh, mode=FIXED)

    assert outputs["assist_ratio"][-1] == pytest.approx(ratio, abs=0.005)
    assert bool(outputs["limit_flags"][-1] & LimitFlags.TAPER) == (speed_kmh > 15)


def test_fixed_assist_at_the_motor_is_the_riders_torque_through_the_gears() -> None:
    assert steady(20.0, mode=FIXED)["motor_torque_nm"][-1] == pytest.approx(
        20.0 / GEAR_RATIO, rel=1e-4
    )


def test_the_fuzzy_law_adds_its_gain_to_the_ratio_and_has_no_taper() -> None:
    outputs = steady(20.0, speed_kmh=20.0)

    assert outputs["fuzzy_gain"][-1] == pytest.approx(0.1, abs=0.005)
    assert outputs["assist_ratio"][-1] == pytest.approx(1.1, abs=0.005)
    assert outputs["motor_torque_nm"][-1] == pytest.approx(1.1 * 20.0 / GEAR_RATIO, rel=0.005)


def test_the_gain_never_compounds() -> None:
    torque_nm = steady(24.0, seconds=20.0)["motor_torque_nm"][round(10 / STEP_S) :]

    assert np.ptp(torque_nm) / torque_nm.mean() < 0.005


def test_the_gain_of_a_ride_is_the_gain_of_the_table_to_the_bit() -> None:
    random = np.random.default_rng(5)
    torque = np.abs(np.cumsum(random.normal(0, 2, 2000)))
    speed = np.linspace(0, 24.9, 2000).astype(np.float32)

    outputs = run(ride(torque, speed_kmh=speed))

    table = gain_points(default_config(), speed, outputs["torque_rate"])
    np.testing.assert_array_equal(outputs["fuzzy_gain"], table)


def test_the_torque_rate_is_the_relative_rise_over_its_interval() -> None:
    rising = 20.0 + 40.0 * np.arange(0, 1, STEP_S)

    outputs = run(ride(rising), torque_filter_s=0.02, torque_rate_interval_ms=100)

    # A ramp stays a ramp behind the filter: 4 Nm in 0.1 s over the torque of 0.1 s ago.
    filtered = outputs["rider_torque_filtered_nm"]
    np.testing.assert_allclose(
        outputs["torque_rate"][30:], filtered[30:] / filtered[20:-10] - 1, rtol=1e-4
    )
    assert outputs["torque_rate"][99] == pytest.approx(4.0 / (filtered[99] - 4.0), rel=0.01)


def test_starting_to_pedal_is_the_fastest_rate_the_table_knows() -> None:
    outputs = steady(40.0, seconds=1.0)

    assert outputs["torque_rate"][0] == pytest.approx(0.9)
    assert outputs["torque_rate"].max() == pytest.approx(0.9)


def test_the_rate_keeps_its_memory_over_the_longest_interval() -> None:
    torque = np.where(np.arange(200) < 100, 10.0, 12.0)

    rate = run(ride(torque), torque_filter_s=0.02, torque_rate_interval_ms=500)["torque_rate"]

    assert rate[100 + 40] == pytest.approx(0.2, abs=0.001)
    assert rate[100 + 75] == pytest.approx(0.0, abs=0.001)


@pytest.mark.parametrize(("falling", "gain"), [("hold_zero_rate", 0.3), ("no_gain", 0.0)])
def test_falling_torque_holds_the_rate_at_zero_or_takes_the_gain_away(
    falling: str, gain: float
) -> None:
    torque = np.linspace(60, 30, 300)

    outputs = run(ride(torque), fuzzy_falling_torque=falling, torque_filter_s=0.02)

    assert outputs["torque_rate"][-1] == 0.0
    assert outputs["fuzzy_gain"][-1] == pytest.approx(gain, abs=1e-6)


def test_a_mode_that_is_off_asks_for_nothing_and_says_so() -> None:
    outputs = steady(40.0, mode=OFF)

    assert not outputs["motor_torque_nm"].any()
    assert np.isnan(outputs["fuzzy_gain"]).all()
    assert (outputs["limit_flags"] == LimitFlags.MODE_OFF).all()


def test_a_rider_below_the_smallest_pedal_torque_gets_no_assist() -> None:
    assert not steady(0.9)["motor_torque_nm"].any()
    assert steady(1.1)["motor_torque_nm"][-1] > 0.0


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("torque_raw_counts", np.nan),
        ("torque_raw_counts", np.inf),
        ("torque_raw_counts", 1e30),
        ("speed_kmh", np.nan),
        ("cadence_rpm", -np.inf),
        ("motor_speed_rpm", np.nan),
        ("battery_voltage_v", np.inf),
        ("mode", 5),
        ("mode", 255),
    ],
)
def test_a_broken_reading_gives_no_torque_and_leaves_the_average_alone(
    name: str, value: float
) -> None:
    law = AssistLaw(default_config())
    good = {key: float(reading) for key, reading in ride(40.0).items()}
    for _ in range(200):
        before = law.step(**good)

    broken = law.step(**{**good, name: value})
    after = law.step(**good)

    assert before["motor_torque_nm"] > 0.5
    assert broken["motor_torque_nm"] == 0.0
    assert broken["limit_flags"] == LimitFlags.INPUT_REFUSED
    assert np.isnan(broken["rider_torque_nm"])
    assert broken["rider_torque_filtered_nm"] == before["rider_torque_filtered_nm"]
    assert after["rider_torque_filtered_nm"] >= before["rider_torque_filtered_nm"]
    assert np.isfinite(after["motor_torque_nm"])


def test_two_instances_do_not_know_each_other() -> None:
    strong, weak = ride(np.full(300, 60.0)), ride(np.full(300, 5.0))
    alone = run(strong)["motor_torque_nm"]

    one, other = AssistLaw(default_config()), AssistLaw(default_config())
    mixed = []
    for index in range(300):
        mixed.append(
            one.step(**{**strong, "torque_raw_counts": strong["torque_raw_counts"][index]})
        )
        other.step(**{**weak, "torque_raw_counts": weak["torque_raw_counts"][index]})

    np.testing.assert_array_equal([row["motor_torque_nm"] for row in mixed], alone)


@pytest.mark.parametrize(
    "change",
    [
        {"gear_ratio": 0.0},
        {"gear_ratio": float("nan")},
        {"motor_resistance_ohm": 0.0},
        {"torque_rate_interval_ms": 5000},
        {"fixed_taper_start_kmh": 25.0, "fixed_taper_end_kmh": 20.0},
        {"mode_ratios": [0.0, float("inf"), 1.0, 1.0, 1.0]},
        {"mode_laws": ["off", "fixed", "fixed", "fuzzy", "TURBO"]},
        {"fuzzy_gain_points": [0.5, 0.4, 0.3, 0.2, 0.1]},
    ],
)
def test_an_impossible_configuration_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(LawRefused):
        AssistLaw({**default_config(), **change})


def test_a_missing_parameter_is_named() -> None:
    config = default_config()
    del config["gear_ratio"]

    with pytest.raises(LawRefused, match="gear_ratio"):
        AssistLaw(config)


def test_missing_and_unequal_readings_are_named() -> None:
    readings = ride([1.0, 2.0])

    with pytest.raises(LawRefused, match="unequal"):
        run({**readings, "speed_kmh": [1.0, 2.0, 3.0]})
    del readings["brake"]
    with pytest.raises(LawRefused, match="brake"):
        run(readings)


def test_the_noise_of_a_bike_at_rest_is_not_a_start() -> None:
    """Sensor noise of 0.06 Nm: thesis_checks 6, twelve bits and table 5-1's scatter."""
    noise_nm = np.random.default_rng(5).normal(0.0, 0.06, 6000)

    rest = run(ride(noise_nm, speed_kmh=0.0, cadence_rpm=0.0))
    start = run(ride(np.concatenate([noise_nm[:500], np.full(20, 10.0)]), speed_kmh=0.0))

    assert rest["torque_rate"].max() == 0.0
    assert np.ptp(rest["fuzzy_gain"]) == 0.0
    assert start["torque_rate"][505] == pytest.approx(0.9)
