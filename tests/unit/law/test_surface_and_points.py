"""Goal: the backend's preview is the unit's gain, and refuses what has no answer.

Method: thesis values at the set points; coordinates that are not finite must be named.
"""

from dataclasses import replace

import numpy as np
import pytest

from backend.core.fuzzy_table import THESIS_TABLE
from backend.errors import InvalidRequest
from backend.law import points, surface


def test_rows_are_speeds_and_columns_are_torque_rates() -> None:
    gain = surface(THESIS_TABLE, [5, 25], [0, 0.45, 0.9])

    np.testing.assert_allclose(gain, [[0.3, 0.4, 0.4667], [0.1, 0.2, 0.2]], atol=1e-4)


def test_points_are_the_surface_at_single_places() -> None:
    gain = points(THESIS_TABLE, [3, 20], [0.675, 0.0])

    np.testing.assert_allclose(gain, [0.4667, 0.1], atol=1e-4)


def test_the_weighted_average_reaches_the_highest_peak() -> None:
    table = replace(THESIS_TABLE, inference="weighted_average")

    assert points(table, [0], [0.9])[0] == pytest.approx(0.5)


@pytest.mark.parametrize("broken", [float("nan"), float("inf"), 1e60])
def test_a_coordinate_that_is_not_finite_is_refused_by_place(broken: float) -> None:
    with pytest.raises(InvalidRequest) as of_surface:
        surface(THESIS_TABLE, [5, broken], [0])
    with pytest.raises(InvalidRequest) as of_points:
        points(THESIS_TABLE, [5], [broken])

    assert [fault.field for fault in of_surface.value.fields] == ["speeds_kmh[1]"]
    assert [fault.field for fault in of_points.value.fields] == ["torque_rates[0]"]


def test_what_is_no_list_of_numbers_is_refused() -> None:
    with pytest.raises(InvalidRequest):
        surface(THESIS_TABLE, ["fast"], [0])
    with pytest.raises(InvalidRequest):
        surface(THESIS_TABLE, [[5]], [0])
    with pytest.raises(InvalidRequest):
        points(THESIS_TABLE, [5, 6], [0])


def test_a_grid_beyond_all_need_is_refused_before_it_is_computed() -> None:
    with pytest.raises(InvalidRequest, match="coarser"):
        surface(THESIS_TABLE, np.zeros(2000), np.zeros(2000))


def test_a_number_beyond_the_units_floats_is_called_that_and_not_infinite() -> None:
    with pytest.raises(InvalidRequest) as refused:
        surface(THESIS_TABLE, [5.0, 1e39], [0.0])

    (fault,) = refused.value.fields
    assert (fault.field, fault.code) == ("speeds_kmh[1]", "out_of_range")
    assert "1e+39" in fault.message
