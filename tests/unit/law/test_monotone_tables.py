"""Goal: a table that only rises with torque rate and only falls with speed is felt so everywhere,
not only at its points, where the weighted average is used.

Method: such tables drawn at random with random peaks, asked of the unit's C on a fine grid. Each
step may fall by the rounding of float32 alone.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.core.fuzzy_table import LABELS, FuzzyTable
from backend.law import law_defaults, surface, torque_surface

ROUNDING = 1e-6
FINE = 80
SPORT = 3


@st.composite
def monotone_rules(draw: st.DrawFn) -> tuple[tuple[str, ...], ...]:
    """Labels that do not fall along a row and do not rise down a column."""
    drawn = draw(st.lists(st.integers(0, 4), min_size=25, max_size=25))
    # Sorting the columns leaves the rows sorted.
    cells = np.sort(np.sort(np.reshape(drawn, (5, 5)), axis=1), axis=0)[::-1]
    return tuple(tuple(LABELS[cell] for cell in row) for row in cells)


def increasing(low: float, high: float, step: float) -> st.SearchStrategy[tuple[float, ...]]:
    """Five points, at least two steps apart."""
    places = st.lists(st.integers(0, round((high - low) / step) - 8), min_size=5, max_size=5)
    return places.map(
        lambda drawn: tuple(
            round(low + (place + 2 * index) * step, 3) for index, place in enumerate(sorted(drawn))
        )
    )


tables = st.builds(
    FuzzyTable,
    name=st.just("drawn"),
    inference=st.just("weighted_average"),
    speed_points_kmh=increasing(0.0, 45.0, 0.5),
    torque_rate_points=increasing(0.0, 2.0, 0.02),
    gain_points=increasing(0.0, 0.5, 0.02),
    rules=monotone_rules(),
)


@pytest.mark.slow
@given(tables)
@settings(max_examples=300, deadline=None)
def test_a_monotone_table_gives_a_monotone_surface(table: FuzzyTable) -> None:
    speeds = np.linspace(0.0, 50.0, FINE)
    rates = np.linspace(0.0, 2.2, FINE)

    gain = surface(table, speeds, rates)

    assert np.diff(gain, axis=1).min() >= -ROUNDING
    assert np.diff(gain, axis=0).max() <= ROUNDING


@pytest.mark.slow
@given(tables)
@settings(max_examples=40, deadline=None)
def test_what_is_asked_at_the_crank_is_monotone_too_and_no_limit_adds_to_it(
    table: FuzzyTable,
) -> None:
    config = {**law_defaults(), **table.to_parameters()}
    config["mode_tables"] = [0] * 5

    torque = torque_surface(config, SPORT, 30.0, np.linspace(0, 25, 9), np.linspace(0, 1, 9))

    assert np.diff(torque.demanded_nm, axis=1).min() >= -30.0 * 2 * ROUNDING
    assert np.diff(torque.demanded_nm, axis=0).max() <= 30.0 * 2 * ROUNDING
    assert (torque.delivered_nm <= torque.demanded_nm * (1.0 + ROUNDING)).all()
