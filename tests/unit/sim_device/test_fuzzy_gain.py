"""Goal: the unit's closed-form gain is the exact centroid the thesis describes.

Method: three oracles that share no code with it: the set-point table of drive_unit 4.6, a float64
integration of the clipped polygons over all their corners, and bilinear interpolation for the
weighted average.
"""

from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from firmware_protocol._generated import Label
from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import LawRefused, gain_points, gain_surface

THESIS = default_config()
SPEEDS_KMH = [5, 10, 15, 20, 25]
RATES = [0, 0.225, 0.45, 0.675, 0.9]
THESIS_SURFACE = [
    [0.300, 0.300, 0.400, 0.467, 0.467],
    [0.300, 0.300, 0.400, 0.400, 0.467],
    [0.200, 0.300, 0.300, 0.400, 0.400],
    [0.100, 0.200, 0.200, 0.300, 0.300],
    [0.100, 0.100, 0.200, 0.200, 0.200],
]
EDGE_TO_EDGE = [0.0, 0.1, 0.25, 0.4, 0.5]
FLOAT32_ERROR = 1e-6
"""Tolerance the reference asks for between engines and our float32 (fuzzy_controller 2)."""


def triangle(x: Any, left: float, peak: float, right: float) -> Any:
    return np.clip(np.minimum((x - left) / (peak - left), (right - x) / (right - peak)), 0, None)


def memberships(points: list[float], value: float) -> list[float]:
    value = min(max(value, points[0]), points[-1])
    return [float(np.interp(value, points, row)) for row in np.eye(len(points))]


def reference_centroid(table: dict[str, Any], speed_kmh: float, rate: float) -> float:
    """Plain Mamdani in float64: every rule, then area and moment over all corners of the union."""
    peaks = table["fuzzy_gain_points"]
    feet = [2 * peaks[0] - peaks[1], *peaks, 2 * peaks[-1] - peaks[-2]]
    speed_levels = memberships(table["fuzzy_speed_points_kmh"], speed_kmh)
    rate_levels = memberships(table["fuzzy_torque_rate_points"], rate)
    levels = [0.0] * 5
    for row, speed_level in enumerate(speed_levels):
        for column, rate_level in enumerate(rate_levels):
            label = Label[table["fuzzy_rules"][row][column]]
            levels[label] = max(levels[label], min(speed_level, rate_level))

    def sets_at(x: Any) -> Any:
        return np.array([np.minimum(levels[k], triangle(x, *feet[k : k + 3])) for k in range(5)])

    corners = {0.0, 0.5, *feet}
    for k, level in enumerate(levels):
        corners |= {
            feet[k] + level * (feet[k + 1] - feet[k]),
            feet[k + 2] - level * (feet[k + 2] - feet[k + 1]),
        }
    inside = sorted(corner for corner in corners if 0 <= corner <= 0.5)
    crossings = set(inside)
    for start, end in pairwise(inside):
        first, last = sets_at(start), sets_at(end)
        for a, b in combinations(range(5), 2):
            gap_first, gap_last = first[a] - first[b], last[a] - last[b]
            if gap_first * gap_last < 0:
                crossings.add(start + (end - start) * gap_first / (gap_first - gap_last))
    x = np.array(sorted(crossings))
    height = sets_at(x).max(axis=0)
    middle = (x[1:] + x[:-1]) / 2
    middle_height = (height[1:] + height[:-1]) / 2
    width = np.diff(x)
    area = (width * middle_height).sum()
    moment = (
        width * (x[:-1] * height[:-1] + 4 * middle * middle_height + x[1:] * height[1:]) / 6
    ).sum()
    return float(moment / area)


def table_with(gain_points_: list[float], rules: list[list[str]] | None = None) -> dict[str, Any]:
    return {
        **THESIS,
        "fuzzy_gain_points": gain_points_,
        "fuzzy_rules": rules or THESIS["fuzzy_rules"],
    }


@st.composite
def tables(draw: st.DrawFn) -> dict[str, Any]:
    def increasing(low: float, high: float) -> list[float]:
        steps = draw(st.lists(st.floats(0.05, 1), min_size=6, max_size=6))
        shares = np.cumsum(steps) / sum(steps)
        return [float(low + (high - low) * share) for share in shares[:5]]

    labels = st.sampled_from(["NB", "NS", "ZO", "PS", "PB"])
    row = st.lists(labels, min_size=5, max_size=5)
    return {
        "fuzzy_inference": "mamdani_centroid",
        "fuzzy_speed_points_kmh": increasing(0, 30),
        "fuzzy_torque_rate_points": increasing(0, 1.4),
        "fuzzy_gain_points": draw(st.sampled_from([EDGE_TO_EDGE, increasing(0, 0.5)])),
        "fuzzy_rules": draw(st.lists(row, min_size=5, max_size=5)),
    }


def test_the_thesis_table_gives_the_thesis_surface_at_its_points() -> None:
    surface = gain_surface(THESIS, SPEEDS_KMH, RATES)

    np.testing.assert_allclose(surface, THESIS_SURFACE, atol=0.0005)
    assert surface.max() == pytest.approx(0.5 - 0.1 / 3, abs=FLOAT32_ERROR)


def test_standstill_counts_as_the_first_speed() -> None:
    still = gain_points(THESIS, [0, 0, 5, 5], [0, 0.9, 0, 0.9])

    assert still[0] == still[2] == pytest.approx(0.3, abs=FLOAT32_ERROR)
    assert still[1] == still[3]


def test_inputs_beyond_the_table_are_clamped() -> None:
    beyond = gain_points(THESIS, [-3, 60, 12, 12], [0.3, 0.3, -5, 7])
    edge = gain_points(THESIS, [0, 25, 12, 12], [0.3, 0.3, 0, 0.9])

    np.testing.assert_array_equal(beyond, edge)


@pytest.mark.slow
@pytest.mark.slow
def test_the_closed_form_is_the_exact_centroid_of_the_thesis_table() -> None:
    speeds, rates = np.linspace(0, 26, 53), np.linspace(-0.1, 1.0, 34)
    expected = [[reference_centroid(THESIS, v, r) for r in rates] for v in speeds]

    np.testing.assert_allclose(gain_surface(THESIS, speeds, rates), expected, atol=FLOAT32_ERROR)


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(tables(), st.floats(-2, 32), st.floats(-0.5, 1.5))
@pytest.mark.slow
def test_the_closed_form_is_exact_for_any_table(
    table: dict[str, Any], speed_kmh: float, rate: float
) -> None:
    gain = float(gain_points(table, [speed_kmh], [rate])[0])

    assert gain == pytest.approx(reference_centroid(table, speed_kmh, rate), abs=5e-6)
    assert 0.0 <= gain <= 0.5


@pytest.mark.parametrize("points", [[0.0, 0.1, 0.2, 0.3, 0.4], [0.1, 0.11, 0.12, 0.13, 0.5]])
def test_outermost_sets_are_cut_where_the_universe_ends(points: list[float]) -> None:
    table = table_with(points)
    cells = [(5, 0.9), (20, 0), (25, 0), (5, 0)]

    gains = gain_points(table, *zip(*cells, strict=True))

    expected = [reference_centroid(table, *cell) for cell in cells]
    np.testing.assert_allclose(gains, expected, atol=FLOAT32_ERROR)


def test_the_weighted_average_is_bilinear_between_the_cells() -> None:
    table = {**THESIS, "fuzzy_inference": "weighted_average"}
    cells = np.array(
        [[THESIS["fuzzy_gain_points"][Label[x]] for x in row] for row in THESIS["fuzzy_rules"]]
    )
    speeds, rates = np.linspace(5, 25, 41), np.linspace(0, 0.9, 37)

    surface = gain_surface(table, speeds, rates)

    along_rate = np.array([np.interp(rates, RATES, row) for row in cells])
    expected = np.array([np.interp(speeds, SPEEDS_KMH, column) for column in along_rate.T]).T
    np.testing.assert_allclose(surface, expected, atol=FLOAT32_ERROR)


def test_the_weighted_average_of_a_monotone_table_is_monotone() -> None:
    table = {**THESIS, "fuzzy_inference": "weighted_average"}

    surface = gain_surface(table, np.linspace(0, 26, 521), np.linspace(0, 0.9, 361))

    assert np.diff(surface, axis=0).max() <= FLOAT32_ERROR
    assert np.diff(surface, axis=1).min() >= -FLOAT32_ERROR


def test_the_centroid_ripples_no_more_than_the_reference_measured() -> None:
    surface = gain_surface(THESIS, np.arange(0, 25.01, 0.125), np.linspace(0, 0.9, 145))

    rise = (surface - np.minimum.accumulate(surface, axis=0)).max()
    fall = (np.maximum.accumulate(surface, axis=1) - surface).max()
    assert rise == pytest.approx(0.0091, abs=1e-4)
    assert fall == pytest.approx(0.0090, abs=1e-4)


@pytest.mark.slow
def test_a_point_alone_and_in_a_long_batch_gives_the_same_bits() -> None:
    random = np.random.default_rng(4)
    speeds, rates = random.uniform(-1, 27, 1000), random.uniform(-0.1, 1, 1000)

    batch = gain_points(THESIS, speeds, rates)
    single = np.array(
        [gain_points(THESIS, [v], [r])[0] for v, r in zip(speeds, rates, strict=True)]
    )

    np.testing.assert_array_equal(batch.view(np.uint32), single.view(np.uint32))


@pytest.mark.parametrize("inference", ["mamdani_centroid", "weighted_average"])
@pytest.mark.parametrize("broken", [np.nan, np.inf, -np.inf])
def test_a_coordinate_that_is_not_finite_gives_no_gain(inference: str, broken: float) -> None:
    table = {**THESIS, "fuzzy_inference": inference}

    gains = gain_points(table, [broken, 10, 10], [0.1, broken, 0.1])

    assert np.isnan(gains).tolist() == [True, True, False]


@pytest.mark.parametrize(
    "change",
    [
        {"fuzzy_speed_points_kmh": [5, 10, 10, 20, 25]},
        {"fuzzy_torque_rate_points": [0, 0.2, float("nan"), 0.6, 0.9]},
        {"fuzzy_gain_points": [0.1, 0.2, 0.3, 0.4, 0.6]},
        {"fuzzy_gain_points": [-0.1, 0.2, 0.3, 0.4, 0.5]},
        {"fuzzy_gain_points": [0.1, 0.2, 0.3, 0.4]},
        {"fuzzy_inference": "MOM"},
        {"fuzzy_rules": [["XX"] * 5] * 5},
    ],
)
def test_a_table_the_unit_cannot_compute_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(LawRefused, match="fuzzy table"):
        gain_points({**THESIS, **change}, [10], [0.1])


def test_vectors_of_unequal_length_are_refused() -> None:
    with pytest.raises(LawRefused, match="pairs"):
        gain_points(THESIS, [10, 11], [0.1])


@pytest.mark.parametrize("values", [[1j], ["a"], [[1.0]]])
def test_what_is_no_vector_of_numbers_is_refused(values: Any) -> None:
    with pytest.raises(LawRefused, match="vector of numbers"):
        gain_points(THESIS, values, [0.1])
