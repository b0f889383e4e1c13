"""Goal: a certificate is worked out again from its raw counts, by anybody, and a change shows.

Method: certificates of the workshop, judged, sealed, read back, tampered with; and the command.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.calibration.certificate import About, certificate, evaluate, unit_mark
from backend.calibration.coefficients import Coefficients
from backend.calibration.fit import fit
from backend.calibration.judgement import Limits, limits_for, limits_table
from backend.calibration.setup import Setup
from backend.calibration.strokes import curve, piecewise
from backend.calibration.verification import Past, among_model, change, past_of
from backend.calibration.worked import work_out
from backend.cli import main
from backend.core.canonical_json import sha256_of
from backend.errors import InvalidRequest
from tests.fakes.calibration_bench import DISOBEYS, LOADS_KG, OBEYS, SETUP, Specimen, Workshop

CAPTURES = tuple(Workshop(OBEYS["table5_1"], 3).captures())
FOUND = Coefficients(0.0, 0.01)
ABOUT = About(3, 1_795_000_000_000_000, "ebl:29f015f2", "spindle 0.5.0", market="eu_epac")


def file() -> dict[str, Any]:
    """As it is read from a disk."""
    body = certificate(ABOUT, SETUP, CAPTURES, FOUND, Limits())
    read: dict[str, Any] = json.loads(json.dumps(body))
    return read


def causes(specimen: Specimen, found: Coefficients | None = FOUND) -> dict[str, str]:
    worked = work_out(SETUP, Workshop(specimen, 2).captures(), found, Limits())
    return {cause.code: cause.weight for cause in worked.judgement.causes}


def test_a_certificate_follows_from_its_raw_captures() -> None:
    evaluated = evaluate(file())

    assert evaluated.reproduced
    assert evaluated.worked.judgement.verdict == "pass"
    assert evaluated.sha256 == sha256_of(file()["document"])
    assert unit_mark(evaluated.sha256).to_bytes(8, "big").hex() == evaluated.sha256[:16]


def test_a_gain_that_was_made_up_is_found_although_the_hash_was_made_to_fit() -> None:
    body = file()
    body["document"]["worked"]["fit"]["coefficients"]["gain_nm_per_count"] *= 1.0001
    body["sha256"] = sha256_of(body["document"])

    (difference,) = evaluate(body).differences

    assert difference.path == "worked.fit.coefficients.gain_nm_per_count"
    assert difference.stated == pytest.approx(difference.computed * 1.0001)


def test_a_raw_count_that_was_changed_shows_in_hash_and_figures() -> None:
    body = file()
    body["document"]["captures"][4]["raw_counts"][0] += 3

    evaluated = evaluate(body)

    assert evaluated.sha256 != evaluated.stated_sha256
    assert "captures[4].mean_counts" in {difference.path for difference in evaluated.differences}
    assert not evaluated.reproduced


def test_a_figure_that_this_version_no_longer_knows_differs_and_a_new_one_does_not() -> None:
    body = file()
    body["document"]["worked"]["old_figure"] = 1.0
    del body["document"]["worked"]["zero_return_nm"]

    assert [difference.path for difference in evaluate(body).differences] == ["worked.old_figure"]


def test_what_cannot_be_read_names_every_field() -> None:
    body = file()
    body["document"]["setup"]["arm_m"] = 17.0
    del body["document"]["captures"][2]["raw_counts"]

    with pytest.raises(InvalidRequest) as refused:
        evaluate(body)

    assert [fault.field for fault in refused.value.fields] == [
        "setup.arm_m",
        "captures[2].raw_counts",
    ]


def test_the_command_needs_no_server_and_is_one_where_something_differs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, body = tmp_path / "certificate.json", file()
    path.write_text(json.dumps(body), encoding="utf-8")
    assert main(["calibrate", "evaluate", str(path)]) == 0
    assert "follows from the raw captures" in capsys.readouterr().out

    body["document"]["captures"][4]["raw_counts"][0] += 3
    path.write_text(json.dumps(body), encoding="utf-8")
    assert main(["calibrate", "evaluate", str(path), "--json"]) == 1
    assert not json.loads(capsys.readouterr().out)["reproduced"]


def test_a_wrong_arm_common_to_all_captures_is_no_pass_until_it_was_read_twice() -> None:
    """172.5 mm said of a crank of 165 mm: 4.5 % too much in every capture, so in no residual."""
    said = replace(SETUP, arm_m=SETUP.arm_m * 172.5 / 165.0)
    limits = limits_for(None, None)

    def judged(setup: Setup, by: Limits = limits) -> tuple[str, dict[str, str]]:
        judgement = work_out(setup, CAPTURES, FOUND, by).judgement
        return judgement.verdict, {cause.code: cause.weight for cause in judgement.causes}

    verdict, weights = judged(said)
    assert (verdict, weights["unlike_made"]) == ("conditional", "conditional")
    verdict, weights = judged(replace(said, arm_again_m=said.arm_m))
    assert (verdict, weights["unlike_made"]) == ("pass", "note")
    assert "unlike_made" not in judged(SETUP)[1]
    # A certificate of before keeps the judgement that it was given.
    assert judged(said, Limits())[0] == "pass"


def test_a_gain_error_is_told_from_noise() -> None:
    """Found three percent off the loads, straight to its line: not the sensor but its span."""
    assert causes(Specimen({"gain": 1.03, "noise_nm": 0.06}))["gain_not_noise"] == "note"
    assert "gain_not_noise" not in causes(OBEYS["table5_1"])


@pytest.mark.parametrize(
    ("state", "code"),
    [("sticky", "hysteresis"), ("bent", "left_right"), ("asymmetric", "left_right")],
)
def test_a_fault_fails_by_its_name(state: str, code: str) -> None:
    assert causes(DISOBEYS[state])[code] == "fail"


def test_a_load_at_another_crank_angle_is_no_knot_of_the_correction() -> None:
    worked = work_out(SETUP, Workshop(DISOBEYS["bent"], 2).captures(), None, Limits())

    assert worked.curve is not None
    assert worked.piecewise is not None
    assert len(worked.curve.load_nm) == len(LOADS_KG) + 1
    assert len(worked.piecewise.reading_nm) == len(LOADS_KG) + 1


def test_what_was_not_measured_is_a_condition_and_never_a_pass() -> None:
    right = [c for c in CAPTURES if c.state.side == "right" and c.state.kind != "verify"]

    judged = work_out(SETUP, right, None, Limits()).judgement

    assert judged.verdict == "conditional"
    assert {c.code for c in judged.causes if c.weight == "conditional"} == {
        "no_left_right",
        "no_strokes_left",
        "not_verified",
    }


def test_temperature_coefficients_come_only_from_captures_that_tell_them() -> None:
    """Loads at 12 and 32 degrees tell both; zeros there but loads at one only that of the zero."""
    captures = Workshop(OBEYS["drifted"], 4).captures()
    cold_loads = [c for c in captures if c.state.kind != "load" or c.state.sensor_degc == 12.0]
    untold = [replace(c, state=replace(c.state, sensor_degc=None)) for c in captures]

    assert fit(SETUP, captures).temperature == "both"
    offset = fit(SETUP, cold_loads)
    assert (offset.temperature, offset.temperature_span_k) == ("offset", 20.0)
    assert offset.coefficients.gain_share_per_k is None
    assert offset.coefficients.offset_counts_per_k == pytest.approx(
        2.0, abs=offset.expanded("offset_counts_per_k")
    )
    none = fit(SETUP, untold)
    assert (none.temperature, none.temperature_span_k) == ("none", None)
    assert none.coefficients.reference_degc is None


def test_limits_are_the_most_particular_and_say_whose_they_are() -> None:
    table = (Limits(), Limits("maker", "japan", None), Limits("maker", None, "City 7"))

    assert limits_for("japan", "City 7", table).model == "City 7"
    assert limits_for("japan", None, table).market == "japan"
    assert limits_for("uk", "other").source == "example limits"


def test_the_house_s_own_limits_come_before_the_examples() -> None:
    table = limits_table([{"source": "maker, sheet 7", "model": "City 7", "linearity_pct": 0.5}])

    assert limits_for("eu", "City 7", table).linearity_pct == 0.5
    assert limits_for("eu", "City 8", table).source == "example limits"
    whole_house = limits_table([{"source": "our workshop", "total_pct": 0.9}])
    assert limits_for("eu", "City 8", whole_house).total_pct == 0.9


@pytest.mark.parametrize(
    ("tables", "named"),
    [
        ([{"linearity_pct": 0.5}], "source"),
        ([{"source": "a"}, {"source": "b"}], "two tables"),
        ([{"source": "a", "linearity": 0.5}], "linearity"),
        ([{"source": "a", "total_pct": 0}], "total_pct"),
        (["a"], "dictionary|object"),
    ],
)
def test_limits_that_are_none_are_refused_by_name(tables: list[object], named: str) -> None:
    with pytest.raises(InvalidRequest, match=named):
        limits_table(tables)


def test_a_sensor_that_moved_is_told_from_one_that_did_not() -> None:
    first = past_of(fit(SETUP, CAPTURES), 0)
    again = past_of(fit(SETUP, Workshop(OBEYS["table5_1"], 9).captures()), 86_400_000_000)
    moved = past_of(fit(SETUP, Workshop(OBEYS["drifted"], 9).captures()), 172_800_000_000)

    same, after = change(again, [first]), change(moved, [again, first])

    assert same is not None
    assert after is not None
    assert (same.days, after.days) == (1.0, 1.0)
    assert same.gain_en < 1 < after.gain_en
    # The gain fell by 3.8 %, so that a count is worth more.
    assert after.gain_pct == pytest.approx(100 * (1 / 0.962 - 1), abs=0.3)
    assert change(first, []) is None


def test_a_gain_apart_from_its_model_is_told() -> None:
    others = [
        Past(0, 0.0, 1.0, 0.01 * (1 + share), 1e-5) for share in (-2e-3, -1e-3, 0, 1e-3, 2e-3)
    ]

    apart = among_model(replace(others[2], gain_nm_per_count=0.0105), others)

    assert apart is not None
    assert apart.gain_pct == pytest.approx(5.0)
    assert apart.deviations == pytest.approx(0.05 / (1.4826 * 1e-3))
    assert among_model(others[0], others[:4]) is None


def test_pieces_undo_the_sensors_own_curve() -> None:
    """A bow of half a percent that a line cannot follow, planted in the counts."""
    bow = [
        replace(one, mean_counts=one.mean_counts + 200 * (load - load**2))
        for one in CAPTURES
        for load in [one.state.load_nm(SETUP) / 100]
    ]
    fitted = fit(SETUP, bow)
    shape = curve(SETUP, bow, fitted.coefficients)

    pieces = piecewise(shape, fitted)

    assert pieces is not None
    assert pieces.significant
    load = np.array(shape.load_nm)
    assert np.abs(shape.residual_nm).max() > 0.2
    assert pieces.corrected_nm(load + shape.residual_nm) == pytest.approx(load, abs=1e-9)
