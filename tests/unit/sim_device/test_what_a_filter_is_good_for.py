"""Goal: the two torque filters differ on the road in the way docs/torque-filter.md says.

Method: the commute with each in virtual time, the same every time; differences, not numbers.
"""

from __future__ import annotations

from typing import Any

import pytest

from tools.reproduction.table_rides import (
    Ride,
    column_shares,
    mean_kmh,
    ridden,
    ripple_pct,
    start_s,
    wh_per_km,
)

pytestmark = pytest.mark.slow

TABLE = "thesis-rescaled"
HALF_TURN: dict[str, Any] = {"torque_filter": "half_turn"}
FACTORY: dict[str, Any] = {"torque_filter_s": 0.5}


@pytest.fixture(scope="module")
def half_turn() -> Ride:
    return ridden(TABLE, "commute", HALF_TURN)


@pytest.fixture(scope="module")
def factory() -> Ride:
    return ridden(TABLE, "commute", FACTORY)


def test_half_a_turn_is_the_more_even_and_takes_no_more(half_turn: Ride, factory: Ride) -> None:
    assert ripple_pct(half_turn) < 0.75 * ripple_pct(factory)
    assert wh_per_km(half_turn)[0] <= 1.01 * wh_per_km(factory)[0]
    assert mean_kmh(half_turn) == pytest.approx(mean_kmh(factory), rel=0.02)


def test_half_a_turn_keeps_the_stroke_out_of_the_columns(half_turn: Ride, factory: Ride) -> None:
    assert column_shares(half_turn, TABLE)[1:].sum() < 0.5 * column_shares(factory, TABLE)[1:].sum()


def test_half_a_turn_is_no_slower_away() -> None:
    with_half_turn = start_s("thesis-table", "legs", HALF_TURN)

    assert with_half_turn <= start_s("thesis-table", "legs", FACTORY)
