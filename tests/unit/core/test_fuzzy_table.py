"""Goal: a fuzzy table that exists is one the unit can compute, and survives every way it travels.

Method: the contract's example goes in and out as JSON and as parameters; every kind of wrong value
must be refused by the name of its field.
"""

from typing import Any

import pytest

from backend.core.fuzzy_table import (
    LEAST_STEPS,
    PARAMETER_NAMES,
    RANGES,
    THESIS_TABLE,
    FuzzyTable,
    stored_json,
)
from backend.errors import InvalidRequest
from firmware_protocol._generated import PARAMETER_BY_NAME
from firmware_protocol.parameters import default_config

CONTRACT_EXAMPLE: dict[str, Any] = {
    "name": "thesis 4-2",
    "inference": "mamdani_centroid",
    "speed_points_kmh": [5, 10, 15, 20, 25],
    "torque_rate_points": [0, 0.225, 0.45, 0.675, 0.9],
    "gain_points": [0.1, 0.2, 0.3, 0.4, 0.5],
    "rules": [
        ["ZO", "ZO", "PS", "PB", "PB"],
        ["ZO", "ZO", "PS", "PS", "PB"],
        ["NS", "ZO", "ZO", "PS", "PS"],
        ["NB", "NS", "NS", "ZO", "ZO"],
        ["NB", "NB", "NS", "NS", "NS"],
    ],
}


DENORMAL_POINTS = [0, 1.4e-45, 2.8e-45, 4.2e-45, 5.6e-45]
"""Five floats in a row from zero: increasing, and nothing to divide by."""


def changed(**fields: Any) -> dict[str, Any]:
    return {**CONTRACT_EXAMPLE, **fields}


def test_the_contracts_example_is_the_thesis_table_and_comes_back_as_it_was() -> None:
    table = FuzzyTable.from_json(CONTRACT_EXAMPLE)

    assert table == THESIS_TABLE
    assert table.to_json() == CONTRACT_EXAMPLE


def test_the_units_factory_table_is_the_thesis_table() -> None:
    config = default_config()

    assert FuzzyTable.from_parameters(config) == THESIS_TABLE
    assert THESIS_TABLE.to_parameters() == {
        name: config[name] for name in THESIS_TABLE.to_parameters()
    }


def test_the_second_table_has_parameters_of_its_own_and_the_points_of_the_first() -> None:
    config = default_config()

    second = FuzzyTable.from_parameters(config, "second")

    assert (second.name, second.inference) == ("thesis 4-2, smooth", "weighted_average")
    assert second.rules == THESIS_TABLE.rules
    assert second.to_parameters("second") == {
        name: config[name] for name in second.to_parameters("second")
    }
    shared = set(second.to_parameters("second")) & set(THESIS_TABLE.to_parameters())
    assert shared == {"fuzzy_speed_points_kmh", "fuzzy_torque_rate_points"}


def with_rule(row: int, column: int, label: Any) -> list[list[Any]]:
    rules = [list(row_labels) for row_labels in CONTRACT_EXAMPLE["rules"]]
    rules[row][column] = label
    return rules


@pytest.mark.parametrize(
    ("fields", "field", "code"),
    [
        ({"name": "x" * 25}, "name", "too_long"),
        ({"name": 5}, "name", "not_text"),
        ({"inference": "mom"}, "inference", "not_a_choice"),
        ({"speed_points_kmh": [5, 10, 15, 20]}, "speed_points_kmh", "wrong_shape"),
        ({"speed_points_kmh": [5, 10, 10, 20, 25]}, "speed_points_kmh[2]", "not_increasing"),
        ({"speed_points_kmh": [5, 10, 10 + 1e-9, 20, 25]}, "speed_points_kmh[2]", "not_increasing"),
        ({"torque_rate_points": [0, 0.2, float("nan"), 0.6, 0.9]}, "torque_rate_points[2]", None),
        ({"torque_rate_points": [0, 0.2, "x", 0.6, 0.9]}, "torque_rate_points[2]", "not_a_number"),
        ({"speed_points_kmh": [5, 10, 10.09, 20, 25]}, "speed_points_kmh[2]", "not_increasing"),
        ({"torque_rate_points": DENORMAL_POINTS}, "torque_rate_points[1]", "not_increasing"),
        ({"gain_points": DENORMAL_POINTS}, "gain_points[1]", "not_increasing"),
        ({"gain_points": [0.1, 0.2, 0.2009, 0.4, 0.5]}, "gain_points[2]", "not_increasing"),
        ({"gain_points": [0.1, 0.2, 0.3, 0.4, 0.51]}, "gain_points[4]", "out_of_range"),
        ({"speed_points_kmh": [5, 10, 15, 20, 1e60]}, "speed_points_kmh[4]", "out_of_range"),
        ({"gain_points": [-0.1, 0.2, 0.3, 0.4, 0.5]}, "gain_points[0]", "out_of_range"),
        ({"rules": with_rule(3, 1, "XX")}, "rules[3][1]", "not_a_choice"),
        ({"rules": with_rule(3, 1, None)}, "rules[3][1]", "not_a_choice"),
        ({"rules": CONTRACT_EXAMPLE["rules"][:4]}, "rules", "wrong_shape"),
        ({"surprise": 1}, "surprise", "unknown"),
    ],
)
def test_a_wrong_value_is_refused_by_name(
    fields: dict[str, Any], field: str, code: str | None
) -> None:
    with pytest.raises(InvalidRequest) as refused:
        FuzzyTable.from_json(changed(**fields))

    fault = refused.value.fields[0]
    assert fault.field == field
    assert fault.code == (code or "not_finite")


def test_the_ranges_are_the_registrys() -> None:
    registry = {
        field: (PARAMETER_BY_NAME[name].min, PARAMETER_BY_NAME[name].max)
        for field, name in PARAMETER_NAMES.items()
        if field in RANGES
    }

    least_steps = {
        field: PARAMETER_BY_NAME[name].least_step
        for field, name in PARAMETER_NAMES.items()
        if field in RANGES
    }

    assert registry == RANGES
    assert least_steps == LEAST_STEPS


def test_points_a_least_step_apart_are_taken_however_they_round() -> None:
    for hundredth in range(0, 4450, 7):
        speeds = [(hundredth + 10 * k) / 100 for k in range(5)]
        table = FuzzyTable.from_json(changed(speed_points_kmh=speeds))
        assert table.to_json()["speed_points_kmh"] == speeds


def test_a_stored_table_that_would_be_refused_today_is_shown_as_it_is() -> None:
    config = {**default_config(), "fuzzy_gain_points": DENORMAL_POINTS}

    shown = stored_json(config)

    assert shown == {**CONTRACT_EXAMPLE, "gain_points": DENORMAL_POINTS}
    with pytest.raises(InvalidRequest):
        FuzzyTable.from_parameters(config)


def test_all_faults_are_told_at_once() -> None:
    with pytest.raises(InvalidRequest) as refused:
        FuzzyTable.from_json(changed(inference="mom", gain_points=[0.5, 0.4, 0.3, 0.2, 0.1]))

    assert [fault.field for fault in refused.value.fields] == [
        "inference",
        "gain_points[1]",
        "gain_points[2]",
        "gain_points[3]",
        "gain_points[4]",
    ]
