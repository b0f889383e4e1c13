"""Goal: the error test's figures are the ones the thesis' own readings give.

Method: tables 3-1 and 5-1 of the thesis go in; the exact values of thesis_checks 3, recomputed
there by hand, must come out to 1e-9.
"""

import pytest

from backend.calibration.figures import evaluate, reading_error_pct
from backend.errors import InvalidRequest

LOAD_NM = [0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100]
FORWARD = [
    [0, 10.05, 20.22, 30.18, 40.26, 50.25, 60.60, 70.38, 80.34, 90.77, 100.65],
    [0, 10.16, 20.11, 30.14, 40.33, 50.18, 60.26, 70.14, 80.32, 90.65, 100.16],
    [0, 10.34, 20.49, 30.25, 40.21, 50.16, 60.73, 70.19, 80.15, 90.24, 100.78],
]
REVERSE = [
    [0, 10.14, 20.16, 30.35, 40.61, 50.14, 60.39, 70.61, 80.14, 90.15, 100.34],
    [0, 10.08, 20.35, 30.07, 40.14, 50.36, 60.15, 70.43, 80.06, 90.99, 100.43],
    [0, 10.11, 20.13, 30.25, 40.16, 50.15, 60.25, 70.22, 80.94, 90.88, 100.21],
]

LOAD_5_1_NM = [10, 20, 30, 40, 50, 60, 70]
GROUPS_5_1 = [
    [10.09, 19.94, 30.04, 40.02, 50.09, 60.03, 70.06],
    [9.95, 20.04, 29.96, 39.98, 49.95, 59.97, 69.92],
    [10.10, 19.99, 30.04, 40.06, 49.91, 59.99, 69.96],
]


def test_table_3_1_gives_the_recomputed_figures() -> None:
    figures = evaluate(100, LOAD_NM, FORWARD, REVERSE)

    assert figures.linearity_pct == pytest.approx(0.613333333333333, abs=1e-9)
    assert figures.hysteresis_pct == pytest.approx(0.133333333333333, abs=1e-9)
    assert figures.repeatability_pct.deviation == pytest.approx(0.56, abs=1e-9)
    assert figures.repeatability_pct.range == pytest.approx(0.88, abs=1e-9)
    assert figures.total_pct.deviation == pytest.approx(0.841163215764677, abs=1e-9)
    assert figures.total_pct.range == pytest.approx(1.08090497064060, abs=1e-9)
    assert figures.fit.slope == pytest.approx(1.00418939393939, abs=1e-9)
    assert figures.fit.offset_nm == pytest.approx(0.0796212121212121, abs=1e-9)


def test_linearity_against_a_fitted_line_is_told_apart_from_the_gain_error() -> None:
    against = evaluate(100, LOAD_NM, FORWARD, REVERSE).linearity_against_line_pct

    assert against.least_squares == pytest.approx(0.156666666666667, abs=1e-9)
    assert against.through_zero == pytest.approx(0.136796536796537, abs=1e-9)
    assert against.end_point == pytest.approx(0.227833333333333, abs=1e-9)


def test_the_worst_readings_are_named() -> None:
    worst = evaluate(100, LOAD_NM, FORWARD, REVERSE).worst

    assert worst["linearity_load_nm"] == 90
    assert worst["hysteresis_load_nm"] == 60
    assert worst["repeatability_deviation_load_nm"] == 80
    assert worst["repeatability_range_direction"] == "reverse"
    assert worst["reading_error_nm"] == pytest.approx(0.99, abs=1e-9)


def test_table_5_1_has_one_percent_of_error_not_nine_tenths() -> None:
    errors = [reading_error_pct(LOAD_5_1_NM, group) for group in GROUPS_5_1]

    assert errors == pytest.approx([0.9, 0.5, 1.0], abs=1e-9)
    assert reading_error_pct(LOAD_5_1_NM, GROUPS_5_1) == pytest.approx(1.0, abs=1e-9)


def test_a_perfect_sensor_has_no_error_at_all() -> None:
    figures = evaluate(100, LOAD_NM, [LOAD_NM, LOAD_NM], [LOAD_NM, LOAD_NM])

    assert figures.total_pct.range == pytest.approx(0.0, abs=1e-12)
    assert figures.fit.slope == pytest.approx(1.0)


def test_every_argument_at_fault_is_named() -> None:
    with pytest.raises(InvalidRequest) as refused:
        evaluate(0, [10, 10], [[10, 10]], [[10, float("nan")], [10, 10]])

    named = {(fault.field, fault.code) for fault in refused.value.fields}
    assert named == {
        ("full_scale_nm", "out_of_range"),
        ("load_nm", "wrong_shape"),
        ("forward", "wrong_shape"),
        ("reverse", "not_finite"),
    }


def test_readings_no_spindle_can_give_are_refused() -> None:
    with pytest.raises(InvalidRequest, match="beyond"):
        evaluate(100, [0, 10], [[0, 10], [0, 1e308]], [[0, 10], [0, 10]])


@pytest.mark.parametrize("ragged", [[[1, 2], [1]], "abc", [[None, 1], [1, 1]]])
def test_readings_that_are_no_table_are_refused(ragged: object) -> None:
    with pytest.raises(InvalidRequest):
        evaluate(100, [0, 10], [[0, 10], [0, 10]], ragged)
