"""Goal: the unit's clock is known to half a round trip, and its skew to a few millionths.

Method: a made-up unit whose clock is a known line, and delays that are added on either way. The
bound is arithmetic: with delays d1 and d2 the middle is wrong by (d1 - d2) / 2, at most half of the
trip.
"""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.device.ebl.session.clock_sync import ClockEstimator, ClockSample

START_US = 40_000_000


def exchange(
    sent_us: int, there_us: int, back_us: int, offset_us: float = 0.0, rate: float = 1.0
) -> ClockSample:
    """One exchange with a unit whose clock reads offset + rate x host time."""
    heard_us = round(offset_us + rate * (sent_us + there_us))
    return ClockSample(sent_us, heard_us, heard_us, sent_us + there_us + back_us)


def test_nothing_is_known_before_the_first_sample() -> None:
    assert ClockEstimator().estimate is None


@pytest.mark.slow
@given(
    delays=st.lists(st.tuples(st.integers(0, 200_000), st.integers(0, 200_000)), min_size=1),
    offset_us=st.integers(-(10**12), 10**12),
)
def test_the_offset_is_wrong_by_no_more_than_half_the_shortest_trip(
    delays: list[tuple[int, int]], offset_us: int
) -> None:
    estimator = ClockEstimator()
    for number, (there_us, back_us) in enumerate(delays):
        sent_us = START_US + number * 100_000
        estimator.add(exchange(sent_us, there_us, back_us, START_US + abs(offset_us)))

    estimate = estimator.estimate

    assert estimate is not None
    kept = delays[-64:]
    assert estimate.round_trip_us == min(there + back for there, back in kept)
    error_us = estimate.unit_at(estimate.host_us) - (estimate.host_us + START_US + abs(offset_us))
    assert abs(error_us) <= estimate.uncertainty_us + 1.0


@pytest.mark.parametrize("skew_ppm", [-120.0, -3.0, 0.0, 40.0, 250.0])
def test_the_skew_of_a_crystal_shows_through_a_jittery_line(skew_ppm: float) -> None:
    noise = random.Random(7)
    estimator = ClockEstimator()
    rate = 1.0 + skew_ppm / 1e6
    for number in range(64):
        there_us = 1000 + round(noise.expovariate(1 / 4000))
        back_us = 1000 + round(noise.expovariate(1 / 4000))
        estimator.add(exchange(START_US + number * 10_000_000, there_us, back_us, 5e6, rate))

    estimate = estimator.estimate

    assert estimate is not None
    assert estimate.skew_ppm == pytest.approx(skew_ppm, abs=5.0)


def test_there_and_back_again_is_where_one_was() -> None:
    estimator = ClockEstimator()
    for number in range(20):
        estimator.add(exchange(START_US + number * 10_000_000, 900, 900, 3e6, 1.0001))
    estimate = estimator.estimate
    assert estimate is not None

    unit_us = estimate.unit_at(250_000_000.0)

    assert estimate.host_at(unit_us) == pytest.approx(250_000_000.0, abs=1.0)
    assert unit_us == pytest.approx(3e6 + 1.0001 * 250_000_000.0, abs=50.0)


def test_a_moment_is_too_short_to_tell_a_skew() -> None:
    estimator = ClockEstimator()
    estimator.add(exchange(START_US, 100, 3000))
    estimator.add(exchange(START_US + 1_000_000, 3000, 100))

    assert estimator.estimate is not None
    assert estimator.estimate.skew_ppm == 0.0


def test_an_answer_before_its_question_is_no_sample() -> None:
    estimator = ClockEstimator()

    assert not estimator.add(ClockSample(1000, 500, 900, 1100))
    assert not estimator.add(ClockSample(1000, 900, 500, 1100))
    assert estimator.estimate is None
