"""Goal: who takes a table that comes with Spindle knows what the linter would say of it.

Method: every table preset under the limits of a unit for the EU as it leaves the factory. A warning
stands in the table's comment by its code; a table without one has none.
"""

from __future__ import annotations

import pytest

from backend.core.fuzzy_table import FuzzyTable
from backend.law import lint, presets, surface
from firmware_protocol._generated import PARAMETERS
from firmware_protocol.configuration_file import TABLE
from firmware_protocol.parameters import default_config

LIMITS = {
    row.name: default_config()[row.name] for row in PARAMETERS if row.group in ("limits", "market")
}
TABLES = [name for name in presets.names() if presets.load(name).format == TABLE]


def table_of(name: str) -> FuzzyTable:
    return FuzzyTable.from_parameters(presets.load(name).values)


def test_there_are_the_thesis_s_the_same_rescaled_and_two_recommended_ones() -> None:
    assert set(TABLES) == {"thesis-table", "thesis-rescaled", "even", "strong-start"}


@pytest.mark.parametrize("name", TABLES)
def test_what_the_linter_warns_of_is_in_the_comment(name: str) -> None:
    comment = presets.load(name).comment

    report = lint(table_of(name), limits=LIMITS)

    assert report.errors == ()
    assert {warning.code for warning in report.warnings if warning.code not in comment} == set()
    assert ("Lint warns" in comment) == bool(report.warnings)


@pytest.mark.parametrize("name", ["even", "strong-start"])
def test_a_recommended_table_never_gives_more_to_a_faster_bike_or_to_a_weaker_push(
    name: str,
) -> None:
    speeds_kmh = [index / 8 for index in range(8 * 30)]
    rates = [index / 200 for index in range(121)]

    gain = surface(table_of(name), speeds_kmh, rates)

    assert (gain[1:] <= gain[:-1] + 1e-6).all()
    assert (gain[:, 1:] >= gain[:, :-1] - 1e-6).all()
    assert gain[-1].max() < 0.13
    assert gain.max() == pytest.approx(0.5)
