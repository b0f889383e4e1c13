"""Goal: the linter tells what the unit's market leaves without effect, with place and numbers.

Expected numbers are the laws' (24 km/h and 2 - (v - 10) / 7 in Japan, 25 km/h in the EU, 15.5 mph
in the UK, 28 mph for US class 3) and fuzzy_controller item 20: with a mode's ratio of 1 the thesis
table passes Japan's envelope from 14.2 km/h on.
"""

from dataclasses import replace
from typing import Any

import pytest

from backend.core.assist_mode import AssistMode, AssistModes
from backend.core.fuzzy_table import THESIS_TABLE
from backend.law import Finding, LintReport, cutoff_of, lint
from backend.law.market import MARKET_WORDS, MARKETS
from firmware_protocol._generated import Market
from firmware_protocol.spelling import words_of

OFF = AssistMode("off", "off", 0.0)
TAPER_SPEEDS_KMH = (15.0, 24.0)


def judged(market: str | None, *modes: AssistMode, **told: Any) -> LintReport:
    limits = {"assist_cutoff_kmh": 25.0, "market": market} | told.pop("limits", {})
    slots = AssistModes((*modes, *([OFF] * (5 - len(modes)))), 0) if modes else None
    return lint(told.pop("table", THESIS_TABLE), slots, limits, **told)


def found(report: LintReport, code: str) -> list[Finding]:
    findings = (*report.errors, *report.warnings, *report.notes)
    return [finding for finding in findings if finding.code == code]


def test_every_market_of_the_registry_has_a_profile_and_words() -> None:
    assert MARKETS == words_of(Market) == tuple(MARKET_WORDS)


@pytest.mark.parametrize(
    ("market", "configured_kmh", "extra_kmh", "holds_kmh"),
    [
        ("eu_epac", 25.0, 0.0, 25.0),
        ("eu_epac", 20.0, 0.0, 20.0),
        ("eu_epac", 20.0, 10.0, 20.0),
        ("uk", 25.0, 0.0, 15.5 * 1.609344),
        ("japan", 25.0, 0.0, 24.0),
        ("us_class_1", 25.0, 0.0, 25.0),
        ("us_class_1", 25.0, 20.0, 20 * 1.609344),
        ("us_class_3", 25.0, 10.0, 35.0),
        (None, 25.0, 10.0, 25.0),
    ],
)
def test_the_lower_of_setting_and_market_ends_assist(
    market: str | None, configured_kmh: float, extra_kmh: float, holds_kmh: float
) -> None:
    cutoff = cutoff_of(
        {
            "assist_cutoff_kmh": configured_kmh,
            "assist_cutoff_extra_kmh": extra_kmh,
            "market": market,
        }
    )

    assert cutoff is not None
    assert cutoff.holds_kmh == pytest.approx(holds_kmh, abs=1e-4)


@pytest.mark.slow
def test_a_cutoff_above_the_market_s_is_told_with_the_speed_that_holds() -> None:
    warning = found(judged("japan"), "cutoff_above_market")[0]

    assert warning.where == "assist_cutoff_kmh"
    assert "25 km/h" in warning.message
    assert "24 km/h: the market, Japan, allows no more" in warning.message
    assert warning.values == {"market": "japan", "speed_kmh": 24.0}


@pytest.mark.slow
@pytest.mark.parametrize("configured_kmh", [24.0, 22.1, 22.3, 0.0])
def test_a_cutoff_the_market_allows_is_not_complained_of(configured_kmh: float) -> None:
    report = judged("japan", limits={"assist_cutoff_kmh": configured_kmh})

    assert found(report, "cutoff_above_market") == []


@pytest.mark.slow
def test_an_extra_that_the_market_does_not_give_is_told_at_its_field() -> None:
    report = judged("eu_epac", limits={"assist_cutoff_extra_kmh": 10.0})

    assert [f.where for f in found(report, "cutoff_above_market")] == ["assist_cutoff_extra_kmh"]


@pytest.mark.slow
def test_rules_whose_speeds_the_market_takes_away_are_named_by_row() -> None:
    fast = replace(THESIS_TABLE, speed_points_kmh=(5.0, 10.0, 20.0, 25.0, 30.0))

    japan, eu = judged("japan", table=fast), judged("eu_epac", table=fast)

    assert [f.where for f in found(japan, "peak_above_market")] == ["rules[3]"]
    assert [f.where for f in found(japan, "row_above_market")] == ["rules[4]"]
    assert "above 24 km/h" in found(japan, "row_above_market")[0].message
    assert [f.where for f in found(eu, "row_above_market")] == ["rules[4]"]
    assert found(eu, "peak_above_market") == []


def test_a_setting_below_the_market_s_speed_is_the_reason_that_is_told() -> None:
    report = judged("japan", limits={"assist_cutoff_kmh": 18.0})

    assert [f.where for f in found(report, "row_not_reached")] == ["rules[4]"]
    assert found(report, "row_above_market") == []


@pytest.mark.slow
def test_the_thesis_table_in_the_eu_has_nothing_to_explain_to_its_market() -> None:
    report = judged("eu_epac", AssistMode("sport", "fuzzy", 1.0))

    codes = {finding.code for finding in (*report.warnings, *report.notes)}
    assert not {code for code in codes if code.endswith("_market")}


def test_a_fuzzy_mode_of_ratio_one_passes_japans_envelope_from_14_2_km_h_on() -> None:
    warning = found(judged("japan", AssistMode("sport", "fuzzy", 1.0)), "ratio_above_market")[0]

    assert warning.where == "modes[0].ratio"
    assert warning.message.startswith("sport: from 14.2 km/h on")
    assert warning.values["speed_kmh"] == pytest.approx(14.2, abs=0.13)


@pytest.mark.slow
def test_a_fuzzy_mode_is_judged_with_the_table_it_uses() -> None:
    second = AssistMode("sport", "fuzzy", 1.0, table="second")

    assert found(judged("japan", second), "ratio_above_market") == []
    assert len(found(judged("japan", second), "table_not_used")) == 1
    assert len(found(judged("japan", second, which="second"), "ratio_above_market")) == 1
    assert found(judged("japan", second, which="second"), "table_not_used") == []


@pytest.mark.slow
def test_a_demand_beyond_the_motor_is_told_of_modes_with_this_table_only() -> None:
    modes = (AssistMode("first", "fuzzy", 1.0), AssistMode("second", "fuzzy", 1.0, table="second"))
    limits = {"motor_torque_nm_max": 2.0}

    first = found(judged("eu_epac", *modes, limits=limits), "demand_beyond_motor")
    second = found(judged("eu_epac", *modes, limits=limits, which="second"), "demand_beyond_motor")

    assert [finding.where for finding in first] == ["modes[0]"]
    assert [finding.where for finding in second] == ["modes[1]"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("taper", "ratio", "passes"),
    [
        ("none", 0.5, True),  # 0.5 is Japan's own ratio at 20.5 km/h
        ("japan_2_to_1", 2.0, False),
        ("japan_1_to_1", 2.0, False),
        # (24 - v) / 9 times the ratio against (24 - v) / 7: 9/7 is where they meet.
        ("taper_speeds", 1.25, False),
        ("taper_speeds", 1.5, True),
    ],
)
def test_the_fixed_law_is_judged_with_its_taper(taper: str, ratio: float, passes: bool) -> None:
    report = judged(
        "japan", AssistMode("tour", "fixed", ratio, taper), taper_speeds_kmh=TAPER_SPEEDS_KMH
    )

    assert bool(found(report, "ratio_above_market")) is passes


@pytest.mark.slow
def test_a_taper_nobody_told_is_not_judged() -> None:
    report = judged("japan", AssistMode("tour", "fixed", 3.0))

    assert found(report, "ratio_above_market") == []


@pytest.mark.slow
def test_only_a_market_that_names_a_ratio_has_one_to_keep() -> None:
    report = judged("us_class_1", AssistMode("tour", "fixed", 3.0, "none"))

    assert found(report, "ratio_above_market") == found(report, "ratio_does_not_fall") == []
