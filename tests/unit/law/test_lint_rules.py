"""Goal: the linter finds in a table what a rider would feel, and leaves the thesis' table alone.

Method: the figures fuzzy_controller 5 measured on the restored and on the misread table, and tables
with one planted fault each. What is told of the surface is a bound, up to 0.0001 or 0.5 % above
the figure (test_gain_bounds).
"""

from dataclasses import replace
from typing import Any

import pytest

from backend.core.assist_mode import AssistMode, AssistModes
from backend.core.fuzzy_table import THESIS_TABLE, FuzzyTable
from backend.law import LintReport, lint

MISREAD = replace(
    THESIS_TABLE, name="as scanned", rules=(("NB", "ZO", "ZO", "PS", "PB"), *THESIS_TABLE.rules[1:])
)


def codes(findings: Any) -> list[str]:
    return [finding.code for finding in findings]


def with_rule(row: int, column: int, label: str) -> FuzzyTable:
    rules = [list(labels) for labels in THESIS_TABLE.rules]
    rules[row][column] = label
    return replace(THESIS_TABLE, rules=tuple(map(tuple, rules)))


def modes(law: str, ratio: float) -> AssistModes:
    return AssistModes(tuple(AssistMode(f"slot {i}", law, ratio) for i in range(5)), 0)


@pytest.mark.slow
def test_the_thesis_table_has_no_errors_and_only_its_permanent_gain_to_explain() -> None:
    report = lint(THESIS_TABLE)

    assert report.errors == ()
    assert codes(report.warnings) == ["gain_at_steady_torque"]
    # The first column of table 4-2 goes from ZO to NB: 0.3 at 5 km/h, 0.1 at 25.
    assert "0.10 to 0.30, by the speed" in report.warnings[0].message
    assert codes(report.notes) == ["centroid_ripple"]


@pytest.mark.slow
def test_the_ripple_of_the_centroid_is_told_where_the_reference_measured_it() -> None:
    note = lint(THESIS_TABLE).notes[0]

    assert note.where is not None
    assert "up to 0.0092" in note.message  # 0.0091 measured on a grid
    assert note.values["at_most"] == pytest.approx(0.0091, abs=1.5e-4)
    assert note.where.endswith("torque rate 0.87")


def test_the_weighted_average_of_the_same_table_has_no_ripple() -> None:
    assert lint(replace(THESIS_TABLE, inference="weighted_average")).notes == ()


def test_the_misread_row_is_found_out() -> None:
    report = lint(MISREAD)

    rise = next(f for f in report.warnings if f.code == "gain_rises_with_speed")
    assert rise.values["at_most"] == pytest.approx(0.2, abs=1.1e-3)
    assert rise.where == "10.0 km/h, torque rate 0.00"
    assert {"label_step", "steep_gain"} <= set(codes(report.warnings))


@pytest.mark.slow
@pytest.mark.parametrize("inference", ["mamdani_centroid", "weighted_average"])
def test_a_cliff_between_close_points_is_found_wherever_it_stands(inference: str) -> None:
    rows = tuple((label,) * 5 for label in ("NB", "PB", "NB", "PB", "NB"))
    cliffs = replace(
        THESIS_TABLE,
        inference=inference,
        speed_points_kmh=(10.01, 10.11, 10.21, 10.31, 10.41),
        gain_points=(0.0, 0.12, 0.24, 0.36, 0.49),
        rules=rows,
    )

    found = {f.code: f.values["at_most"] for f in lint(cliffs).warnings if f.values}

    # The centroid of the outermost sets, cut or halved by the universe's ends, lies inside them.
    least = 0.49 if inference == "weighted_average" else 0.38
    assert least <= found["gain_rises_with_speed"] <= 0.4905
    assert least <= found["steep_gain"] <= 0.4905


def test_a_gain_that_falls_while_the_rider_pushes_harder_is_a_warning() -> None:
    falling = lint(with_rule(2, 4, "NB")).warnings

    assert "gain_falls_with_torque_rate" in codes(falling)


def test_labels_more_than_one_apart_are_named_by_cell() -> None:
    findings = [f for f in lint(with_rule(4, 4, "PB")).warnings if f.code == "label_step"]

    assert {finding.where for finding in findings} == {"rules[3][4]", "rules[4][3]"}


def test_equal_rows_and_columns_are_noted() -> None:
    flat = replace(THESIS_TABLE, rules=(("ZO",) * 5,) * 5)

    notes = [f for f in lint(flat).notes if f.code == "equal_neighbours"]

    assert len(notes) == 8


@pytest.mark.slow
@pytest.mark.parametrize(
    ("limits", "code"),
    [
        ({"assist_cutoff_kmh": 26.0}, "assist_above_cutoff"),
        ({"assist_cutoff_kmh": float("nan")}, "assist_above_cutoff"),
        ({"motor_torque_nm_max": 2.5}, "no_torque_limit"),
    ],
)
def test_limits_beyond_law_and_motor_are_errors(limits: dict[str, float], code: str) -> None:
    assert codes(lint(THESIS_TABLE, limits=limits).errors) == [code]


def test_rows_beyond_the_cutoff_are_noted() -> None:
    notes = lint(THESIS_TABLE, limits={"assist_cutoff_kmh": 20.0}).notes

    assert [f.where for f in notes if f.code == "row_not_reached"] == ["rules[4]"]


def test_a_demand_beyond_the_motor_says_from_which_rider_torque_on() -> None:
    warnings = lint(THESIS_TABLE, modes("fuzzy", 1.0), {"motor_torque_nm_max": 2.0}).warnings

    demand = [f for f in warnings if f.code == "demand_beyond_motor"]
    assert len(demand) == 5
    assert "2.55 Nm" in demand[0].message  # fuzzy_controller 5: 70 Nm with 40.34
    assert "55 Nm" in demand[0].message


@pytest.mark.slow
def test_a_demand_is_judged_with_the_units_own_gear() -> None:
    limits = {"motor_torque_nm_max": 2.0}
    low_gear, high_gear = (
        lint(THESIS_TABLE, modes("fuzzy", 1.0), limits, gear_ratio=ratio).warnings
        for ratio in (36.744, 60.0)
    )

    demand = [f for f in low_gear if f.code == "demand_beyond_motor"]
    assert "2.79 Nm" in demand[0].message  # fuzzy_controller 5: 70 Nm with 36.74
    assert "50 Nm" in demand[0].message
    assert "demand_beyond_motor" not in codes(high_gear)


@pytest.mark.slow
@pytest.mark.parametrize(("band_kmh", "told"), [(0.0, True), (0.9, True), (1.0, False)])
def test_a_cutoff_band_too_narrow_to_be_felt_is_told(band_kmh: float, told: bool) -> None:
    warnings = lint(THESIS_TABLE, limits={"assist_cutoff_band_kmh": band_kmh}).warnings

    found = [f for f in warnings if f.code == "cutoff_band_narrow"]
    assert [f.where for f in found] == (["assist_cutoff_band_kmh"] if told else [])


@pytest.mark.slow
def test_a_table_no_mode_uses_is_noted() -> None:
    assert "table_not_used" in codes(lint(THESIS_TABLE, modes("fixed", 0.5)).notes)
    assert "table_not_used" not in codes(lint(THESIS_TABLE, modes("fuzzy", 0.5)).notes)


def test_a_table_that_starts_fast_is_judged_over_its_own_speeds() -> None:
    shifted = replace(THESIS_TABLE, speed_points_kmh=(0.1, 0.2, 0.3, 0.4, 0.5))

    assert isinstance(lint(shifted), LintReport)
