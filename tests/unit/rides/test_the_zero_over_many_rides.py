"""Goal: a planted drift is found inside the stated uncertainty, and what cannot be told is said.

Method: zeros of rides drawn from a seed with a known share of temperature, of age, steps at
calibrations and scatter; the forecast against the day on which the planted line crosses the level;
Student's quantile against SciPy.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import t as student_t

from backend.core.statistics import NORMAL_95, student
from backend.rides.diagnosis.zero_trend import (
    ACT_NM,
    MONTH_DAYS,
    WATCH_NM,
    Trend,
    Zeros,
    crossing,
    level_of,
    trend_of,
)
from tests import counts

SEEDS = 400


def drawn(
    seed: int,
    rides: int = 30,
    per_month: float = 0.1,
    per_k: float = 0.02,
    scatter_nm: float = 0.05,
    calibrated_day: float | None = None,
) -> Zeros:
    """Rides of 300 days, by the weather of a year; each calibration sets the zero anew."""
    random = np.random.default_rng(seed)
    days = np.sort(random.uniform(0.0, 300.0, rides))
    weather = 12.0 + 9.0 * np.sin(2.0 * np.pi * days / 365.0 + random.uniform(0.0, 6.0))
    degc = weather + random.normal(0.0, 4.0, rides)
    stretch = (days > (np.inf if calibrated_day is None else calibrated_day)).astype(np.intp)
    sigma = random.uniform(0.01, 0.06, rides)
    zero = np.array([0.4, -0.3])[stretch] + per_month * days / MONTH_DAYS + per_k * (degc - 20.0)
    zero += random.normal(0.0, 1.0, rides) * np.hypot(sigma, scatter_nm)
    # The thermometer tells whole degrees.
    return Zeros(zero, sigma, np.round(degc), days, stretch)


def trend_in(zeros: Zeros, stretch: int | None = None) -> Trend:
    found = trend_of(zeros, int(zeros.stretch[-1]) if stretch is None else stretch)
    assert isinstance(found, Trend), found
    return found


@pytest.mark.large_count
def test_planted_drift_lies_inside_the_stated_uncertainty() -> None:
    seeds = range(counts.of(SEEDS))
    age, warmth, today = [], [], []
    for seed in seeds:
        draw = np.random.default_rng(10_000 + seed)
        month, kelvin = draw.uniform(-0.15, 0.15), draw.uniform(-0.03, 0.03)
        rides, spread = int(draw.integers(8, 60)), draw.uniform(0.0, 0.1)
        calibrated = draw.choice([None, 150.0])
        found = trend_in(drawn(seed, rides, month, kelvin, spread, calibrated))
        assert found.per_k is not None
        assert found.typical_degc is not None
        age.append(found.per_month.low <= month <= found.per_month.high)
        warmth.append(found.per_k.low <= kelvin <= found.per_k.high)
        line, half = found.band(np.array([330.0]), int(found.stretches[-1]))
        step = 0.4 if len(found.stretches) == 1 else -0.3
        truth = step + month * 330.0 / MONTH_DAYS + kelvin * (found.typical_degc - 20.0)
        today.append(abs(line[0] - truth) <= half[0])

    assert np.mean(age) >= 0.9
    assert np.mean(warmth) >= 0.9
    # Three standard deviations of a share of 0.9.
    assert np.mean(today) >= 0.9 - 3.0 * np.sqrt(0.9 * 0.1 / len(seeds))


def test_a_calibration_in_the_middle_is_a_step_and_no_drift() -> None:
    zeros = drawn(3, rides=40, per_month=0.12, calibrated_day=150.0)

    with_step = trend_in(zeros)
    without = trend_in(replace(zeros, stretch=np.zeros(40, np.intp)))

    assert with_step.per_month.low <= 0.12 <= with_step.per_month.high
    assert not without.per_month.low <= 0.12 <= without.per_month.high
    now, _ = with_step.band(np.array([300.0]), 1)
    before, _ = with_step.band(np.array([300.0]), 0)
    assert before[0] - now[0] == pytest.approx(0.7, abs=0.15)


@pytest.mark.large_count
def test_the_forecast_s_interval_holds_the_day_on_which_the_planted_line_crosses() -> None:
    seeds = range(counts.of(SEEDS))
    inside = []
    for seed in seeds:
        found = trend_in(drawn(seed, rides=40, per_month=0.15))
        act = crossing(found, ACT_NM, today=300.0, stretch_now=0)
        watch = crossing(found, WATCH_NM, today=300.0, stretch_now=0)
        assert (act.state, watch.state) == ("expected", "over"), "1.5 Nm in ten months, from 0.4"
        assert act.day is not None
        assert act.earliest_day is not None
        assert act.latest_day is not None
        assert act.earliest_day < act.day < act.latest_day
        at_typical_nm = 0.4 + 0.02 * (float(found.typical_degc or 0.0) - 20.0)
        truth_day = (ACT_NM - at_typical_nm) / 0.15 * MONTH_DAYS
        # Told are whole days, each as its first.
        inside.append(act.earliest_day - 1.0 <= truth_day <= act.latest_day)

    assert np.mean(inside) >= 0.9 - 3.0 * np.sqrt(0.9 * 0.1 / len(seeds))


def test_a_zero_that_does_not_move_crosses_nothing() -> None:
    found = trend_in(drawn(2, rides=60, per_month=0.0, scatter_nm=0.02))

    act = crossing(found, ACT_NM, today=300.0, stretch_now=0)

    assert (act.state, act.day, act.latest_day) == ("not_in_sight", None, None)


def test_a_ride_under_a_foot_is_left_out_and_moves_nothing() -> None:
    sound = drawn(5, rides=20)
    pressed = sound.zero_nm.copy()
    pressed[[4, 11]] += [4.0, 5.5]

    found = trend_in(replace(sound, zero_nm=pressed))

    assert np.flatnonzero(~found.used).tolist() == [4, 11]
    assert found.per_month.low <= 0.1 <= found.per_month.high


def test_without_a_thermometer_age_alone_is_told() -> None:
    zeros = drawn(6, rides=40, per_k=0.0)
    blind = replace(zeros, temperature_degc=np.full(40, np.nan))

    found = trend_in(blind)

    assert (found.per_k, found.no_per_k, found.typical_degc) == (None, "no_thermometer", None)
    assert found.per_month.low <= 0.1 <= found.per_month.high
    indoors = replace(zeros, temperature_degc=np.full(40, 20.0))
    assert trend_in(indoors).no_per_k == "same_weather"


def test_rides_without_a_temperature_are_left_out_where_others_have_one() -> None:
    zeros = drawn(7, rides=20)
    degc = zeros.temperature_degc.copy()
    degc[:3] = np.nan

    assert (
        trend_in(replace(zeros, temperature_degc=degc)).used.tolist() == [False] * 3 + [True] * 17
    )


def test_what_is_not_enough_is_said() -> None:
    zeros = drawn(8, rides=30)

    assert trend_of(zeros.only(np.arange(30) < 0), 0) == "few_rides"
    assert trend_of(zeros.only(np.arange(30) < 1), 0) == "few_rides"
    assert trend_of(zeros.only(np.arange(30) < 5), 0) == "few_rides"
    assert trend_of(replace(zeros, days=zeros.days / 30.0), 0) == "short_time"
    assert trend_of(zeros, 1) == "none_since_calibration"


def test_levels_are_of_either_sign() -> None:
    assert [level_of(nm) for nm in (0.9, -0.9, 1.0, -2.9, 3.0, -4.0)] == [
        *("ok", "ok", "watch", "watch", "act", "act")
    ]


@pytest.mark.parametrize("freedom", [3, 5, 10, 100])
def test_student_s_quantile_is_that_of_scipy(freedom: int) -> None:
    assert student(NORMAL_95, freedom) == pytest.approx(student_t.ppf(0.975, freedom), rel=0.01)
