"""Goal: the linter finds in a table what a rider would feel, and leaves the thesis' table alone.

Method: the figures fuzzy_controller 5 measured on the restored and on the misread table, and tables
with one planted fault each.
"""

from dataclasses import replace
from typing import Any

import pytest

from backend.control import LintReport, lint
from backend.domain.assist_mode import AssistMode, AssistModes
from backend.domain.fuzzy_table import THESIS_TABLE, FuzzyTable

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


def test_the_thesis_table_has_no_errors_and_only_its_permanent_gain_to_explain() -> None:
    report = lint(THESIS_TABLE)

    assert report.errors == ()
    assert codes(report.warnings) == ["gain_at_steady_torque"]
    assert codes(report.notes) == ["centroid_ripple"]


def test_the_ripple_of_the_centroid_is_told_where_the_reference_measured_it() -> None:
    note = lint(THESIS_TABLE).notes[0]

    assert "0.0091" in note.message
    assert note.where == "9.4 km/h, torque rate 0.87"


def test_the_weighted_average_of_the_same_table_has_no_ripple() -> None:
    assert lint(replace(THESIS_TABLE, inference="weighted_average")).notes == ()


def test_the_misread_row_is_found_out() -> None:
    report = lint(MISREAD)

    rise = next(f for f in report.warnings if f.code == "gain_rises_with_speed")
    assert "0.200" in rise.message
    assert rise.where == "10.0 km/h, torque rate 0.00"
    assert {"label_step", "steep_gain"} <= set(codes(report.warnings))


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


def test_a_table_no_mode_uses_is_noted() -> None:
    assert "table_not_used" in codes(lint(THESIS_TABLE, modes("fixed", 0.5)).notes)
    assert "table_not_used" not in codes(lint(THESIS_TABLE, modes("fuzzy", 0.5)).notes)


def test_a_table_that_starts_fast_is_judged_over_its_own_speeds() -> None:
    shifted = replace(THESIS_TABLE, speed_points_kmh=(0.1, 0.2, 0.3, 0.4, 0.5))

    assert isinstance(lint(shifted), LintReport)
