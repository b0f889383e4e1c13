"""Goal: fit, budget and coverage are those of the GUM.

Method: the same captures through GTC, the uncertain numbers of New Zealand's measurement institute
(MSL): its weighted line, its own propagation of arm, masses and gravity through every load, its
effective degrees of freedom. Then by Monte Carlo (JCGM 101), which linearises nothing.
"""

import math

import numpy as np
import pytest
from GTC import reporting, type_a, type_b, ureal
from GTC import result as named

from backend.calibration.budget import Contribution, budget, effective_degrees_of_freedom, summed
from backend.calibration.fit import data_of, fit
from backend.calibration.paper.words import MEANING
from backend.core.statistics import coverage_factor
from tests.fakes.calibration_bench import OBEYS, SETUP, Workshop

CAPTURES = Workshop(OBEYS["table3_1"], 5).captures()
ROOT_3 = math.sqrt(3.0)


def test_the_line_and_its_covariance_are_those_of_gtc() -> None:
    found = fit(SETUP, CAPTURES)
    data = data_of(SETUP, CAPTURES)
    extra = (found.repeatability_nm / found.coefficients.gain_nm_per_count) ** 2

    theirs = type_a.line_fit_wls(
        data.load_nm.tolist(), data.counts.tolist(), np.sqrt(data.own_variance + extra).tolist()
    )

    offset, slope = theirs.a_b
    assert found.coefficients.offset_counts == pytest.approx(offset.x, abs=1e-9)
    assert 1 / found.coefficients.gain_nm_per_count == pytest.approx(slope.x, rel=1e-12)
    gain = 1 / slope
    assert math.sqrt(found.covariance[0][0]) == pytest.approx(offset.u, rel=1e-9)
    assert math.sqrt(found.covariance[1][1]) == pytest.approx(gain.u, rel=1e-9)
    # The repeatability explains the scatter exactly: squares equal degrees of freedom.
    assert theirs.ssr == pytest.approx(found.degrees_of_freedom, rel=1e-6)


def test_what_the_loads_share_moves_the_gain_as_gtc_says() -> None:
    """Loads as products of uncertain numbers that they share, and one line through them."""
    found = fit(SETUP, CAPTURES)
    data = data_of(SETUP, CAPTURES)
    arm = ureal(SETUP.arm_m, type_b.uniform(SETUP.arm_limit_m), label="arm")
    gravity = ureal(SETUP.gravity.gravity_ms2, SETUP.gravity.standard_ms2, label="gravity")
    share = ureal(1.0, type_b.uniform(SETUP.mass_limit_share), label="masses")
    by_number = {capture.number: capture.state.mass_kg for capture in CAPTURES}
    extra = (found.repeatability_nm / found.coefficients.gain_nm_per_count) ** 2
    weights = 1 / (data.own_variance + extra)

    loads = [by_number[number] * share * gravity * arm for number in data.numbers]
    total = float(weights.sum())
    mean_load = sum(w * x for w, x in zip(weights, loads, strict=True)) / total
    mean_counts = float(weights @ data.counts) / total
    rise = sum(
        w * (x - mean_load) * (y - mean_counts)
        for w, x, y in zip(weights, loads, data.counts, strict=True)
    )
    run = sum(w * (x - mean_load) ** 2 for w, x in zip(weights, loads, strict=True))
    gain = named(run / rise)

    place = found.names.index("gain_nm_per_count")
    assert gain.x == pytest.approx(found.coefficients.gain_nm_per_count, rel=1e-12)
    for cause, unknown in (("arm", arm), ("gravity", gravity), ("masses", share)):
        shift = next(common.shift[place] for common in found.common if common.cause == cause)
        assert abs(shift) == pytest.approx(abs(reporting.u_component(gain, unknown)), rel=1e-9)


def test_a_budget_adds_up_as_gtc_adds_it() -> None:
    parts = [("a", 0.20, 4.0), ("b", 0.11, 46.0), ("c", 0.05, None)]

    ours = summed(np.array([50.0]), [Contribution(n, (u,), v) for n, u, v in parts])

    theirs = sum(ureal(0.0, u, math.inf if v is None else v) for _, u, v in parts)
    assert ours.combined_nm[0] == pytest.approx(theirs.u, rel=1e-12)
    assert ours.degrees_of_freedom[0] == pytest.approx(theirs.df, rel=1e-9)
    expanded = theirs.u * reporting.k_factor(theirs.df, 95.45)
    assert ours.expanded_nm[0] == pytest.approx(expanded, rel=1e-3)


@pytest.mark.parametrize("freedom", [1, 2, 3, 4, 5, 8, 20, 50, 1000])
def test_the_coverage_factor_is_students(freedom: int) -> None:
    assert coverage_factor(freedom) == pytest.approx(reporting.k_factor(freedom, 95.45), rel=1.5e-3)


def test_without_degrees_of_freedom_k_is_two() -> None:
    assert coverage_factor(None) == 2.0
    assert effective_degrees_of_freedom([0.1, 0.2], [None, None]) is None


def test_monte_carlo_agrees_with_what_fit_and_loads_leave_open() -> None:
    """JCGM 101: the captures and the loads drawn anew ten thousand times, a line each time."""
    found = fit(SETUP, CAPTURES)
    data = data_of(SETUP, CAPTURES)
    draw = np.random.default_rng(7)
    runs, size = 10_000, data.counts.size
    gain = found.coefficients.gain_nm_per_count
    deviation = np.sqrt(data.own_variance + (found.repeatability_nm / gain) ** 2)
    counts = data.load_nm / gain + found.coefficients.offset_counts
    counts = counts + draw.normal(0, deviation, (runs, size))
    share = 1 + draw.uniform(-1, 1, (runs, 1)) * SETUP.mass_limit_share
    share = share * (1 + draw.uniform(-1, 1, (runs, 1)) * SETUP.arm_limit_m / SETUP.arm_m)
    gravity = SETUP.gravity.standard_ms2 / SETUP.gravity.gravity_ms2
    share = share * (1 + draw.normal(0, gravity, (runs, 1)))
    tilt = np.radians(SETUP.level_limit_deg) * draw.uniform(-1, 1, (runs, 1))
    loads = data.load_nm * share * np.cos(tilt)
    weights = 1 / deviation**2
    mean_load = (loads @ weights) / weights.sum()
    mean_counts = (counts @ weights) / weights.sum()
    run = ((loads - mean_load[:, None]) ** 2) @ weights
    rise = ((loads - mean_load[:, None]) * (counts - mean_counts[:, None])) @ weights
    slope = rise / run
    offset = mean_counts - slope * mean_load

    # What the sensor would say at 100 Nm, read by each draw's line.
    seen = 100.0 / gain + found.coefficients.offset_counts
    drawn = (seen - offset) / slope
    causes = {"linearity", "hysteresis", "repeatability", "zero_return", "resolution", "step"}
    stated = budget(SETUP, CAPTURES, found, (100.0,), without=tuple(causes))

    # The root of the mean square, because the level's mean is not taken off; 1 % of 10,000 draws.
    spread = math.sqrt(float(np.mean((drawn - 100.0) ** 2)))
    assert stated.combined_nm[0] == pytest.approx(spread, rel=0.03)
    low, high = np.quantile(drawn, [0.02275, 0.97725])
    assert high - low <= 2 * stated.expanded_nm[0] * 1.02


def test_every_number_has_its_sentence() -> None:
    found = fit(SETUP, CAPTURES)
    causes = {entry.cause for entry in budget(SETUP, CAPTURES, found).contributions}

    assert causes | set(found.names) <= set(MEANING)
    assert all(sentence.endswith(".") for sentence in MEANING.values())
