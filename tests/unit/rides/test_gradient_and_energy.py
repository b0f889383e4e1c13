"""Goal: gradient, climb, energy by group and range are those of a road that is known.

Method: roads of known slope ridden at known speed with known powers, with a barometer's noise and
with gaps; every figure follows from the road by hand.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.distance import row_distances
from backend.rides.insight.charge import charge_of
from backend.rides.insight.energy_split import by_gradient, energy_shares
from backend.rides.insight.gradient import climb_of, climbed, gradient_pct

STEP_S, SPEED_KMH = 1.0, 18.0
STEP_M = SPEED_KMH / 3.6 * STEP_S


def road(*parts: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(metres, slope %) one after the other: start of each second, its length, its height."""
    slopes = np.concatenate([np.full(round(metres / STEP_M), slope) for metres, slope in parts])
    height = np.append(0.0, np.cumsum(slopes / 100.0 * STEP_M))[:-1]
    return np.arange(len(slopes)) * STEP_S, np.full(len(slopes), STEP_S), height


def test_a_slope_is_found_under_a_barometers_noise() -> None:
    start_s, seconds, height = road((1000, 0.0), (1000, 5.0), (1000, -3.0))
    noisy = height + np.random.default_rng(1).normal(0.0, 0.3, len(height))
    way = row_distances({"speed_kmh": np.full(len(height), SPEED_KMH)}, start_s, seconds)
    assert way is not None

    found = gradient_pct(noisy, way, start_s)

    middles = {0.0: slice(20, 180), 5.0: slice(220, 380), -3.0: slice(420, 580)}
    for slope, rows in middles.items():
        assert found[rows] == pytest.approx(slope, abs=1.2)
        assert found[rows].mean() == pytest.approx(slope, abs=0.1)


def test_no_gradient_reaches_over_a_gap_or_a_jump_of_the_height() -> None:
    # Two flat streets, the second 200 m higher: between them lie 300 s without a sample.
    start_s = np.concatenate((np.arange(100.0), np.arange(400.0, 500.0)))
    height = np.where(start_s < 300.0, 0.0, 200.0)
    odometer = np.concatenate((np.arange(100) * 5.0, 500.0 + 1500.0 + np.arange(100) * 5.0))
    way = row_distances({"distance_m": odometer}, start_s, np.ones(200))
    assert way is not None

    assert np.nanmax(np.abs(gradient_pct(height, way, start_s))) == pytest.approx(0.0, abs=1e-9)
    assert way.lost_m == pytest.approx(1505.0)
    assert way.step_m.sum() == pytest.approx(99 * 5.0 * 2)
    climb = climb_of(height, way, start_s)
    assert climb is not None
    assert (climb.ascent_m, climb.descent_m, climb.highest_m) == (0.0, 0.0, 200.0)


def test_a_way_without_heights_or_too_short_has_no_gradient() -> None:
    start_s, seconds, height = road((40, 5.0))
    way = row_distances({"speed_kmh": np.full(len(height), SPEED_KMH)}, start_s, seconds)
    assert way is not None

    assert not np.isfinite(gradient_pct(height, way, start_s)).any()
    assert climb_of(np.full(len(height), np.nan), way, start_s) is None
    assert row_distances({}, start_s, seconds) is None


@pytest.mark.parametrize(
    ("heights", "ascent_m"),
    [
        ([0, 1, 2, 1, 2, 1, 2, 0], 0.0),  # waves of 2 m are a barometer's
        ([0, 2, 4, 3, 6, 5, 9], 9.0),  # dips of less than 3 m belong to one climb
        ([0, 5, 1, 7], 11.0),  # a dip of 4 m parts two
        ([10, 0, 4], 4.0),  # a climb begins at its foot
    ],
)
def test_a_climb_counts_from_three_metres_on(heights: list[float], ascent_m: float) -> None:
    assert climbed(np.array(heights, np.float64)) == ascent_m


def test_each_band_has_its_own_energy_and_nothing_is_added_up() -> None:
    start_s, seconds, _ = road((1000, 0.0), (1000, 5.0))
    uphill = start_s >= 200.0
    columns = {
        "speed_kmh": np.full(400, SPEED_KMH),
        "rider_power_w": np.where(uphill, 180.0, 90.0),
        "motor_power_w": np.where(uphill, 270.0, 45.0),
        "battery_power_w": np.where(uphill, 360.0, 60.0),
    }
    columns["motor_power_w"][:10] = np.nan
    way = row_distances(columns, start_s, seconds)
    assert way is not None

    gradient = np.where(uphill, 5.0, 0.0)
    bands = energy_shares(columns, seconds, way.step_m, by_gradient(gradient), 6)
    level, up, nothing = bands[2], bands[3], bands[0]

    assert (level.seconds, level.distance_km) == pytest.approx((200.0, 1.0))
    assert (level.rider_wh, level.battery_wh) == pytest.approx((5.0, 60 * 200 / 3600))
    assert level.motor_wh == pytest.approx(45 * 190 / 3600)
    assert level.motor_per_rider == pytest.approx(0.5), "of the moments in which both are known"
    assert (up.rider_wh, up.motor_wh, up.motor_per_rider) == pytest.approx((10.0, 15.0, 1.5))
    assert (nothing.seconds, nothing.rider_wh, nothing.motor_per_rider) == (0.0, None, None)
    (without,) = energy_shares({}, seconds, None, np.zeros(400, np.intp), 1)
    assert (without.rider_wh, without.distance_km) == (None, None)


def ridden(km: float, used_pct: float, step_pct: float = 0.1) -> tuple[np.ndarray, ...]:
    """Charge that falls evenly from 80 % over `km`, read in steps."""
    rows = round(km * 1000.0 / STEP_M)
    charge = np.round((80.0 - used_pct * np.arange(rows) / rows) / step_pct) * step_pct
    return charge, np.full(rows, STEP_S), np.full(rows, STEP_M)


def starts_of(seconds: Values) -> Values:
    """When each row begins."""
    starts: Values = np.cumsum(seconds) - seconds
    return starts


def test_the_range_is_the_charge_left_over_the_charge_for_a_kilometre() -> None:
    charge, seconds, step_m = ridden(km=10.0, used_pct=20.0)
    told = charge_of(charge, None, starts_of(seconds), seconds, step_m)

    assert told is not None
    assert told.range_km == pytest.approx(60.0 * 10.0 / 20.0, rel=0.02)
    assert told.range_km_least is not None
    assert told.range_km_most is not None
    assert 0.95 < told.range_km_least / told.range_km < 1.0 < told.range_km_most / told.range_km
    assert told.step_pct == pytest.approx(0.1)


def test_a_hungry_third_makes_the_short_end_of_the_band() -> None:
    charge, seconds, step_m = ridden(km=9.0, used_pct=18.0)
    third = np.arange(len(charge)) * 3 // len(charge)
    power_w = np.choose(third, (100.0, 300.0, 200.0))

    told = charge_of(charge, power_w, starts_of(seconds), seconds, step_m)

    assert told is not None
    assert told.range_km is not None
    assert told.range_km_least == pytest.approx(told.range_km / 1.5, rel=0.02)
    assert told.range_km_most == pytest.approx(told.range_km / 0.5, rel=0.02)


@pytest.mark.parametrize(
    ("km", "used_pct", "step_pct", "why"),
    [
        (10.0, 2.0, 1.0, "little_used"),
        (10.0, 6.0, 5.0, "little_used"),
        (1.0, 20.0, 1.0, "short_way"),
        (10.0, -10.0, 1.0, "charged"),
    ],
)
def test_a_range_that_would_be_a_guess_is_refused(
    km: float, used_pct: float, step_pct: float, why: str
) -> None:
    told = charge_of(np.empty(0), None, np.empty(0), np.empty(0), None)
    charge, seconds, step_m = ridden(km, used_pct, step_pct)
    answer = charge_of(charge, None, starts_of(seconds), seconds, step_m)

    assert told is None
    assert answer is not None
    assert (answer.refused, answer.range_km) == (why, None)
    unknown = charge_of(charge, None, starts_of(seconds), seconds, None)
    assert unknown is not None
    assert unknown.refused == "no_distance"


def test_one_glitch_of_the_charge_moves_no_range() -> None:
    charge, seconds, step_m = ridden(km=10.0, used_pct=20.0)
    charge[-1] = 50.0
    told = charge_of(charge, None, starts_of(seconds), seconds, step_m)

    assert told is not None
    assert told.soc_pct_last == pytest.approx(60.0, abs=0.3)
