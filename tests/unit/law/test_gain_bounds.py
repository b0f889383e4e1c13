"""Goal: what the linter says of a gain between the table's points never understates it, and hardly
overstates it.

Method: random and hostile tables (points as near as the unit takes them, at the ends of their
ranges, rules that are flat, steep, monotone or a chessboard) are sampled densely through the unit's
own C: on and beside the points, and between them. A bound must not be below anything that was seen.
That it is not far above is measured against the largest that the law was seen to do.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from backend.core.fuzzy_table import LABELS, LEAST_STEPS, RANGES, THESIS_TABLE, FuzzyTable
from backend.law.gain_bounds import AGREED, AGREED_SHARE, ROUNDING, Change, gain_range, largest_rise
from sim_device.firmware.python import law
from tests import counts

TABLES = counts.of(10_000, share=50)
BLOCKS = 20
QUESTIONS = (
    ("speed", 1, math.inf, 0.001),
    ("rate", -1, math.inf, 0.001),
    ("speed", 1, 1.0, 0.06),
    ("speed", -1, 1.0, 0.06),
)
"""As the linter asks: axis, sign, distance, and the change below which it is silent."""
BLUR_MAX = 0.001
"""What a search may overstate that ends before law and proof agree; one of 100 tables may."""
Floats = npt.NDArray[np.float64]


def hostile_points(random: np.random.Generator, field: str) -> tuple[float, ...]:
    """Five points within their range: spread, or as near to each other as the unit takes them."""
    (low, high), step = RANGES[field], LEAST_STEPS[field]
    steps = step * 10.0 ** random.uniform(0.0, 3.0 * random.random(), 4)
    steps[random.random(4) < 0.3] = step
    span = steps.sum()
    if span > (high - low) * 0.999:
        steps = step + (steps - step) * ((high - low) * 0.999 - 4 * step) / span
    first = random.choice([low, random.uniform(low, high - steps.sum()), high - steps.sum()])
    points = first + np.concatenate(([0.0], np.cumsum(steps)))
    return tuple(float(point) for point in np.clip(points, low, high))


def hostile_rules(random: np.random.Generator) -> npt.NDArray[np.int64]:
    kind = random.integers(5)
    if kind == 0:
        return random.integers(0, 5, (5, 5))
    if kind == 1:
        falling = -np.sort(-random.integers(0, 5, (5, 5)), axis=0)
        return np.sort(falling, axis=1)
    flat = np.full((5, 5), random.integers(5))
    if kind == 2:
        return flat
    if kind == 3:
        flat[random.integers(5), random.integers(5)] = random.integers(5)
        return flat
    board = np.indices((5, 5)).sum(axis=0) % 2
    return np.where(board, random.integers(5), random.integers(5))


def hostile_table(random: np.random.Generator) -> FuzzyTable:
    return FuzzyTable(
        name="hostile",
        inference="weighted_average" if random.random() < 0.25 else "mamdani_centroid",
        speed_points_kmh=hostile_points(random, "speed_points_kmh"),
        torque_rate_points=hostile_points(random, "torque_rate_points"),
        gain_points=hostile_points(random, "gain_points"),
        rules=tuple(tuple(LABELS[label] for label in row) for row in hostile_rules(random)),
    )


def samples(random: np.random.Generator, points: tuple[float, ...], beside: float) -> Floats:
    """Coordinates on the points, one float32 beside them, `beside` away from them, and between."""
    exact = np.asarray(points, np.float32)
    between = np.concatenate([np.linspace(a, b, 9)[1:-1] for a, b in pairwise(points)])
    found = np.concatenate(
        (
            exact,
            np.nextafter(exact, np.float32(np.inf)),
            np.nextafter(exact, np.float32(-np.inf)),
            exact + beside if math.isfinite(beside) else exact,
            between.astype(np.float32),
            random.uniform(points[0], points[-1], 20).astype(np.float32),
        )
    )
    return np.unique(np.clip(found, exact[0], exact[-1]).astype(np.float64))


def seen(
    table: FuzzyTable, axis: str, sign: int, distance: float, random: np.random.Generator
) -> float:
    """The largest rise between two samples of one line, by the unit's C."""
    along, lines = table.speed_points_kmh, table.torque_rate_points
    if axis == "rate":
        along, lines = lines, along
    places, across = samples(random, along, distance), samples(random, lines, math.inf)
    speeds, rates = (places, across) if axis == "speed" else (across, places)
    gains = law.gain_surface(table.to_parameters(), speeds, rates).astype(np.float64)
    gains = sign * (gains if axis == "speed" else gains.T)
    if math.isinf(distance):
        return float((gains - np.minimum.accumulate(gains, axis=0)).max())
    apart = places[None, :] - places[:, None]
    near = (apart >= 0.0) & (apart <= distance)
    starts, ends = np.nonzero(near)
    return float((gains[ends] - gains[starts]).max())


def excess(change: Change) -> float:
    """How far the proof ends from what the law does, beyond what it is meant to."""
    allowed = max(AGREED, AGREED_SHARE * change.at_least) + 2 * ROUNDING
    return change.at_most - change.at_least - allowed


@pytest.mark.large_count
@pytest.mark.parametrize("block", range(BLOCKS))
def test_a_bound_is_never_below_what_the_unit_does(block: int) -> None:
    random = np.random.default_rng(block)
    blurred = 0
    for number in range(TABLES // BLOCKS):
        table = hostile_table(random)
        axis, sign, distance, least = QUESTIONS[number % len(QUESTIONS)]

        change = largest_rise(table, axis, sign, distance, least)

        told = f"{table}: {axis} {sign} {distance} {change}"
        assert change.at_most >= seen(table, axis, sign, distance, random), told
        assert change.at_most >= change.at_least >= 0.0, told
        if change.at_most > least and excess(change) > 0.0:
            blurred += 1
            assert excess(change) < BLUR_MAX, told
    assert blurred <= 1 + TABLES // BLOCKS // 100


@pytest.mark.slow
def test_the_gains_range_holds_all_gains_and_little_more() -> None:
    random = np.random.default_rng(7)
    for _ in range(60):
        table = hostile_table(random)
        speeds = samples(random, table.speed_points_kmh, math.inf)
        rates = samples(random, table.torque_rate_points, math.inf)
        gains = law.gain_surface(table.to_parameters(), speeds, rates).astype(np.float64)

        for low, high, some in (
            (*gain_range(table), gains),
            (*gain_range(table, first_rate_only=True), gains[:, 0]),
        ):
            assert low <= some.min() <= some.max() <= high
            assert high <= 0.5 + AGREED


def test_a_bound_below_what_matters_is_only_told_to_be_below_it() -> None:
    change = largest_rise(THESIS_TABLE, "speed", distance=1.0, least=0.06)

    assert change.at_most <= 0.06


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_bilinear_gain_is_known_exactly(question: Any) -> None:
    """Its rises are sums over the table's corners: fuzzy_controller 5, no rise and no fall."""
    table = FuzzyTable.from_json(THESIS_TABLE.to_json() | {"inference": "weighted_average"})
    axis, sign, distance, least = question

    change = largest_rise(table, axis, sign, distance, least)

    expected = 0.02 if (sign, distance) == (-1, 1.0) else 0.0  # 0.1 within 5 km/h
    assert change.at_least == pytest.approx(expected, abs=1e-6)
    assert change.at_most == pytest.approx(change.at_least + ROUNDING)


@pytest.mark.slow
def test_the_thesis_table_ripples_as_the_reference_measured_it() -> None:
    rise = largest_rise(THESIS_TABLE, "speed")
    fall = largest_rise(THESIS_TABLE, "rate", sign=-1)
    within_1_km_h = largest_rise(THESIS_TABLE, "speed", sign=-1, distance=1.0)

    # fuzzy_controller 5: .0091, .0090 and .035 on a grid, which cannot see more than there is.
    assert 0.0090 < rise.at_most <= 0.0092
    assert 0.0090 <= fall.at_most <= 0.0092
    assert 0.035 <= within_1_km_h.at_most <= 0.0354
