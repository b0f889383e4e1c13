"""Goal: no table, mode, limit or rider makes the motor give more than the market allows, at any
speed and not only at the points of a table.

Method: the numbers of the laws (peers 5: EN 15194, SI 2015/24, 36 CFR 1.4, Japan's 1-3, GB 17761),
one by one; then hypothesis over rough rides under configurations made to break them. The envelope
is computed here, in double precision and from the law texts.
"""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import LimitFlags, Market
from firmware_protocol.parameters import default_config
from firmware_protocol.spelling import member_of
from sim_device.firmware.python.law import assist_run

GEAR_RATIO = 40.34
STEP_S = 0.01
CUTOFF_KMH = {
    "eu_epac": 25.0,
    "uk": 15.5 * 1.609344,
    "us_class_1": 20 * 1.609344,
    "us_class_2": 20 * 1.609344,
    "us_class_3": 28 * 1.609344,
    "japan": 24.0,
    "china": 25.0,
}
WALK_KMH = {
    "eu_epac": 6.0,
    "uk": 6.0,
    "us_class_1": 3.7 * 1.609344,
    "us_class_2": 3.7 * 1.609344,
    "us_class_3": 3.7 * 1.609344,
    "japan": 0.0,
    "china": 6.0,
}
BAND_KMH = {"eu_epac": 1.0, "uk": 1.0, "china": 1.0}
CONTINUOUS_W = {"eu_epac": 250.0, "uk": 250.0, "china": 400.0}
PEAK_W = {"us_class_1": 750.0, "us_class_2": 750.0, "us_class_3": 750.0}

# What a maker with no care could build: the law must hold it all the same.
BEYOND = {
    "mode_ratios": [0.0, 3.0, 3.0, 3.0, 3.0],
    "mode_tapers": ["none"] * 5,
    "assist_cutoff_kmh": 99.0,
    "assist_cutoff_extra_kmh": 99.0,
    "assist_cutoff_band_kmh": 0.0,
    "motor_torque_nm_max": 20.0,
    "battery_current_a_max": 200.0,
    "motor_speed_rpm_max": 30000.0,
    "pedal_stop_ms": 1000,
}


def run(market: str, steps: int = 400, **given: Any) -> dict[str, npt.NDArray[Any]]:
    config = {**default_config(), **BEYOND, "market": market, **given.pop("config", {})}
    readings = {
        "torque_raw_counts": np.full(steps, 3000.0),
        "speed_kmh": 10.0,
        "cadence_rpm": 60.0,
        "motor_speed_rpm": 300.0,
        "battery_voltage_v": 60.0,
        "mode": 2,
        "brake": 0,
    }
    return assist_run(config, {**readings, **given}, in_range=False)


def japan_ratio(speed_kmh: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    falling = 2.0 - (speed_kmh - 10.0) / 7.0
    return np.where(speed_kmh < 10, 2.0, np.where(speed_kmh < 24, falling, 0.0))


@pytest.mark.parametrize("market", CUTOFF_KMH)
def test_assist_ends_at_the_market_s_speed_whatever_is_configured(market: str) -> None:
    below = run(market, speed_kmh=CUTOFF_KMH[market] - 0.05)
    at = run(market, speed_kmh=CUTOFF_KMH[market] + 1e-5)

    assert below["motor_torque_nm"][-1] > 0.0
    assert not at["motor_torque_nm"].any()


@pytest.mark.parametrize("market", CUTOFF_KMH)
def test_a_lower_limit_of_the_unit_stays(market: str) -> None:
    lowered = {"assist_cutoff_kmh": 18.0, "assist_cutoff_extra_kmh": 0.0}

    assert run(market, speed_kmh=17.9, config=lowered)["motor_torque_nm"][-1] > 0.0
    assert not run(market, speed_kmh=18.0, config=lowered)["motor_torque_nm"].any()


@pytest.mark.parametrize(("band_kmh", "share"), [(0.0, 0.5), (1.0, 0.5), (2.0, 0.25), (5.0, 0.1)])
@pytest.mark.parametrize("market", BAND_KMH)
def test_assist_is_reduced_over_a_kilometre_per_hour_or_what_is_set_wider(
    market: str, band_kmh: float, share: float
) -> None:
    gentle = {"mode_ratios": [0.0, 0.5, 0.5, 0.5, 0.5], "assist_cutoff_band_kmh": band_kmh}

    full = run("us_class_1", speed_kmh=20.0, config=gentle)["motor_torque_nm"][-1]
    half_a_kmh_below = run(market, speed_kmh=CUTOFF_KMH[market] - 0.5, config=gentle)

    assert half_a_kmh_below["motor_torque_nm"][-1] == pytest.approx(share * full, rel=1e-4)
    assert half_a_kmh_below["limit_flags"][-1] & LimitFlags.SPEED_CUTOFF


def test_the_extra_speed_of_a_fast_market_does_nothing_in_a_slow_one() -> None:
    child = {"assist_cutoff_kmh": 15.0, "assist_cutoff_extra_kmh": 20.0}

    assert not run("eu_epac", speed_kmh=15.0, config=child)["motor_torque_nm"].any()
    assert run("us_class_3", speed_kmh=34.9, config=child)["motor_torque_nm"][-1] > 0.0


@pytest.mark.parametrize("market", CUTOFF_KMH)
def test_the_numbers_of_c_are_those_of_the_law(market: str) -> None:
    profile = lib.market_profile_of(member_of(Market, market))

    assert profile.cutoff_kmh == pytest.approx(CUTOFF_KMH[market])
    assert profile.band_kmh == BAND_KMH.get(market, 0.0)
    assert profile.walk_kmh == pytest.approx(WALK_KMH[market])
    assert profile.continuous_w == CONTINUOUS_W.get(market, 0.0)
    assert profile.peak_w == PEAK_W.get(market, 0.0)
    assert bool(profile.ratio_falls) == (market == "japan")


def test_a_number_that_is_no_market_allows_nothing() -> None:
    assert lib.market_profile_of(200).cutoff_kmh == 0.0


@pytest.mark.parametrize("market", CONTINUOUS_W)
def test_continuous_power_sinks_to_the_rating_and_stays_there(market: str) -> None:
    half_an_hour = round(1800 / STEP_S)
    outputs = run(
        market, half_an_hour, torque_raw_counts=np.full(half_an_hour, 9000.0), motor_speed_rpm=2400
    )

    power_w = outputs["motor_torque_nm"].astype(np.float64) * 2400 * np.pi / 30
    rated_w = CONTINUOUS_W[market]
    assert power_w[1000] > 1.2 * rated_w  # a start or a ramp may take more
    assert power_w.mean() < 1.05 * rated_w
    assert power_w[-6000:].max() < 1.01 * rated_w
    assert outputs["limit_flags"][-1] & LimitFlags.MARKET


@pytest.mark.parametrize("market", ["eu_epac", "uk", "china"])
def test_assist_outlives_pedalling_by_two_metres_at_most(market: str) -> None:
    speed_kmh = CUTOFF_KMH[market] - 0.1
    cadence = np.where(np.arange(500) < 400, 60.0, 0.0)

    torque_nm = run(market, 500, speed_kmh=speed_kmh, cadence_rpm=cadence)["motor_torque_nm"]

    metres = np.count_nonzero(torque_nm[400:]) * STEP_S * speed_kmh / 3.6
    assert 0.0 < metres <= 2.0


def test_japan_s_motor_does_not_outlive_the_push_by_more_than_a_second() -> None:
    pushed = np.where(np.arange(600) < 300, 3000.0, 0.0)

    outputs = run("japan", 600, torque_raw_counts=pushed, config={"torque_filter_s": 2.0})

    assert outputs["motor_torque_nm"][299] > 0.0
    assert not outputs["motor_torque_nm"][402:].any()


@pytest.mark.parametrize(
    "unseen",
    [{"torque_age_ms": 80}, {"torque_raw_counts": np.nan}],
    ids=["a stale reading", "a refused reading"],
)
def test_japan_s_second_passes_while_the_push_is_not_measured(unseen: dict[str, float]) -> None:
    steps = np.arange(900)
    readings = {"torque_raw_counts": np.where(steps < 300, 3000.0, 0.0), "torque_age_ms": 0}
    for name, value in unseen.items():
        readings[name] = np.where((steps >= 300) & (steps < 420), value, readings[name])

    outputs = run("japan", 900, **readings, config={"torque_filter_s": 2.0})

    assert outputs["motor_torque_nm"][299] > 0.0
    assert outputs["rider_torque_filtered_nm"][421] > 1.0  # the average outlives the push
    assert not outputs["motor_torque_nm"][402:].any()


@st.composite
def rough_rides(draw: st.DrawFn) -> tuple[dict[str, Any], dict[str, Any]]:
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    steps = 800

    def steps_of(low: float, high: float, length: int) -> Any:
        return np.repeat(random.uniform(low, high, steps // length), length)

    readings = {
        "torque_raw_counts": steps_of(-500, 20000, draw(st.sampled_from([1, 5, 40, 400]))),
        "speed_kmh": steps_of(-2, 50, draw(st.sampled_from([1, 10, 200]))),
        "cadence_rpm": steps_of(-10, 90, 100),
        "motor_speed_rpm": steps_of(-100, 9000, draw(st.sampled_from([1, 50]))),
        "battery_voltage_v": 60.0,
        "mode": np.repeat(random.integers(0, 5, steps // 100), 100),
        "brake": 0,
        "walk_button": np.repeat(random.random(steps // 50) < 0.4, 50),
        "torque_age_ms": np.where(random.random(steps) < 0.05, 80, 0),
    }
    labels = st.sampled_from(["NB", "NS", "ZO", "PS", "PB"])
    config = {
        **BEYOND,
        "mode_laws": draw(st.lists(st.sampled_from(["fixed", "fuzzy"]), min_size=5, max_size=5)),
        "mode_tapers": draw(
            st.lists(
                st.sampled_from(["taper_speeds", "none", "japan_1_to_1", "japan_2_to_1"]),
                min_size=5,
                max_size=5,
            )
        ),
        "mode_tables": draw(st.lists(st.integers(0, 1), min_size=5, max_size=5)),
        "fuzzy_rules": [[draw(labels) for _ in range(5)] for _ in range(5)],
        "torque_filter_s": draw(st.sampled_from([0.02, 0.5, 2.0])),
        "assist_ramp_up_nm_per_s": 2000.0,
        "assist_ramp_down_nm_per_s": draw(st.sampled_from([20.0, 2000.0])),
        "assist_cutoff_band_kmh": draw(st.sampled_from([0.0, 1.0])),
        "walk_speed_kmh": draw(st.sampled_from([0.0, 6.0])),
        "gear_ratio": GEAR_RATIO,
    }
    return readings, config


@pytest.mark.parametrize("market", CUTOFF_KMH)
@settings(max_examples=25, deadline=None)
@given(rough_rides())
@pytest.mark.slow
def test_no_ride_under_any_configuration_leaves_the_market_s_envelope(
    market: str, ride: tuple[dict[str, Any], dict[str, Any]]
) -> None:
    readings, changes = ride
    outputs = run(market, config=changes, **readings)
    torque_nm = outputs["motor_torque_nm"].astype(np.float64)
    speed_kmh = np.float32(readings["speed_kmh"]).astype(np.float64)
    power_w = torque_nm * np.maximum(readings["motor_speed_rpm"], 0) * np.pi / 30
    cadence = readings["cadence_rpm"]

    assert not torque_nm[speed_kmh >= np.float32(CUTOFF_KMH[market])].any()
    assert torque_nm.min() >= 0.0
    # Nobody pedals and nobody has for a second: what pushes is walk assist, and it is slow.
    pedalled = np.convolve(cadence > 0, np.ones(101))[: cadence.size] > 0.5
    alone = ~pedalled & (torque_nm > 0)
    assert (speed_kmh[alone] < max(WALK_KMH[market], 0.0)).all()
    assert (readings["walk_button"][alone] == 1).all()
    if market in PEAK_W:
        assert power_w.max() <= PEAK_W[market] * 1.001
    if market in CONTINUOUS_W:
        # Over any time t the mean is at most the rating times (1 + 60 s / t).
        energy_j = np.cumsum(power_w) * STEP_S
        bound_j = CONTINUOUS_W[market] * (STEP_S * np.arange(1, power_w.size + 1) + 60.0)
        assert (energy_j <= bound_j).all()
    if market == "japan":
        raw_nm = np.maximum(readings["torque_raw_counts"] * 0.01, 0.0)
        last_second = np.lib.stride_tricks.sliding_window_view(np.pad(raw_nm, (101, 0)), 102)
        allowed_nm = japan_ratio(speed_kmh) * last_second.max(axis=1)
        assert (torque_nm * GEAR_RATIO <= allowed_nm * 1.0001 + 1e-6).all()
