"""Goal: every choice has one spelling, and what older versions wrote is read as the same value.

Method: the registry's enumerations beside the rule, and a configuration as version 0.2 spelled it:
by the registry's own names. Equal means the same bytes for the unit.
"""

from typing import Any

import pytest

from firmware_protocol._generated import (
    ENUM_BY_NAME,
    PARAMETER_BY_NAME,
    PARAMETERS,
    FaultFlags,
    Label,
    LimitFlags,
    Market,
)
from firmware_protocol.parameter_values import choices_of, in_one_spelling
from firmware_protocol.parameters import (
    default_config,
    pack_image,
    set_items,
    unpack_image,
    violations,
)
from firmware_protocol.spelling import RULE_LABELS, member_of, word_of, words_of

OLD = {
    "fuzzy_inference": "MAMDANI_CENTROID",
    "mode_laws": ["OFF", "FIXED", "FIXED", "FUZZY", "FUZZY"],
    "mode_tapers": ["NONE", "JAPAN_1_TO_1", "JAPAN_2_TO_1", "TAPER_SPEEDS", "NONE"],
    "market": "US_CLASS_3",
}
NEW = {
    "fuzzy_inference": "mamdani_centroid",
    "mode_laws": ["off", "fixed", "fixed", "fuzzy", "fuzzy"],
    "mode_tapers": ["none", "japan_1_to_1", "japan_2_to_1", "taper_speeds", "none"],
    "market": "us_class_3",
}


def configured(changes: dict[str, Any]) -> dict[str, Any]:
    return default_config() | changes


def test_all_words_are_lower_case_but_the_labels_of_rules() -> None:
    for name, table in [*ENUM_BY_NAME.items(), ("faults", FaultFlags), ("limits", LimitFlags)]:
        words = words_of(table)

        assert len(set(words)) == len(table.__members__), name
        if table is Label:
            assert set(words) == RULE_LABELS
        else:
            assert all(word == word.lower() for word in words), name


@pytest.mark.parametrize("written", ["JAPAN", "japan", "Japan"])
def test_a_word_is_read_in_any_case(written: str) -> None:
    assert member_of(Market, written) is Market.JAPAN
    assert word_of(Market.JAPAN.name) == "japan"


def test_what_a_unit_holds_and_what_it_was_built_with_is_spelled_as_today() -> None:
    for config in (default_config(), unpack_image(pack_image(default_config()))):
        for row in PARAMETERS:
            value = config[row.name]
            if row.enum is not None and isinstance(value, str):
                assert value in choices_of(row)
    assert unpack_image(pack_image(configured(OLD))) == configured(NEW)


def test_the_old_spelling_is_the_same_value_for_the_unit() -> None:
    assert violations(configured(OLD)) == []
    assert pack_image(configured(OLD)) == pack_image(configured(NEW))
    assert set_items(OLD) == set_items(NEW)


def test_an_old_backup_becomes_today_s_and_nothing_is_said_of_it() -> None:
    assert in_one_spelling(configured(OLD)) == configured(NEW)


def test_a_text_is_left_as_it_was_typed() -> None:
    typed = configured({"mode_names": ["OFF", "Eco", "FUZZY", "", "NB"]})

    assert in_one_spelling(typed)["mode_names"] == ["OFF", "Eco", "FUZZY", "", "NB"]
    assert unpack_image(pack_image(typed))["mode_names"] == ["OFF", "Eco", "FUZZY", "", "NB"]


@pytest.mark.parametrize("wrong", ["MAGIC", 7, None, ["MAMDANI_CENTROID"], "mamdani centroid"])
def test_what_is_no_choice_stays_as_it_is_and_is_refused_with_the_words_of_today(
    wrong: Any,
) -> None:
    kept = in_one_spelling({"fuzzy_inference": wrong})
    (violation,) = violations(configured({"fuzzy_inference": wrong}))

    assert kept["fuzzy_inference"] in (wrong, ["mamdani_centroid"])
    assert violation.field == "fuzzy_inference"
    if not isinstance(wrong, list):
        assert "one of mamdani_centroid, weighted_average" in violation.message


def test_every_parameter_of_an_enumeration_names_its_choices() -> None:
    assert choices_of(PARAMETER_BY_NAME["fuzzy_rules"]) == ("NB", "NS", "ZO", "PS", "PB")
    assert choices_of(PARAMETER_BY_NAME["fuzzy_table_name"]) == ()
