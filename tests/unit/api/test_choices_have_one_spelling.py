"""Goal: the API's description spells every choice in lower case, but for the labels of rules and
the classes of weights.

Method: every enumeration of the whole OpenAPI document, and a request as version 0.2 sent it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from backend.calibration.setup import CLASS_SHARE
from backend.core.assist_mode import LAWS, TAPERS
from backend.core.fuzzy_table import INFERENCES, THESIS_TABLE
from backend.law import law_defaults
from backend.tuning.models.law import AssistMode, FuzzyTable, UnitLimits
from firmware_protocol._generated import Inference, Law, Market, Taper
from firmware_protocol.spelling import RULE_LABELS, words_of
from tests.fakes.api import description

LIMITS = {
    name: law_defaults()[name]
    for name, field in UnitLimits.model_fields.items()
    if field.is_required()
}


def choices(node: Any) -> Iterator[str]:
    """Every `enum` and `const` of text in a part of the document."""
    if isinstance(node, dict):
        found = node.get("enum", [])
        yield from (one for one in [*found, node.get("const")] if isinstance(one, str))
    for child in node.values() if isinstance(node, dict) else node:
        if isinstance(child, dict | list):
            yield from choices(child)


@pytest.mark.slow
def test_every_enumeration_of_the_description_is_in_lower_case() -> None:
    found = set(choices(description()))

    assert {"mamdani_centroid", "eu_epac", "factory", "latched"} <= found
    assert found >= RULE_LABELS
    names = RULE_LABELS | set(CLASS_SHARE)
    assert [one for one in sorted(found - names) if one != one.lower()] == []


@pytest.mark.parametrize(
    ("words", "table"),
    [(LAWS, Law), (TAPERS, Taper), (INFERENCES, Inference)],
    ids=["law", "taper", "inference"],
)
def test_the_typed_parts_know_the_registry_s_choices(words: tuple[str, ...], table: Any) -> None:
    assert words == words_of(table)


@pytest.mark.parametrize("market", ["JAPAN", "japan"])
def test_a_market_is_taken_in_any_case_and_told_in_lower(market: str) -> None:
    taken = UnitLimits(**LIMITS, market=market)  # type: ignore[arg-type]

    assert taken.model_dump()["market"] == "japan"
    assert set(words_of(Market)) == set(choices(UnitLimits.model_json_schema()))


def test_what_parameters_said_up_to_version_0_2_fits_the_typed_parts() -> None:
    table = THESIS_TABLE.to_json() | {"inference": "WEIGHTED_AVERAGE"}
    mode = {"name": "OFF", "law": "FIXED", "ratio": 1.0, "taper": "JAPAN_2_TO_1"}

    assert FuzzyTable.model_validate(table).inference == "weighted_average"
    taken = AssistMode.model_validate(mode)
    assert (taken.name, taken.law, taken.taper) == ("OFF", "fixed", "japan_2_to_1")
