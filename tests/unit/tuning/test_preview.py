"""Goal: the preview answers the contract's questions about a law without a unit on the desk."""

from typing import Any

import numpy as np
import pytest

from backend.core.assist_mode import AssistModes
from backend.core.fuzzy_table import THESIS_TABLE
from backend.errors import InvalidRequest
from backend.tuning.preview import Preview
from firmware_protocol.parameters import default_config

TABLE = THESIS_TABLE.to_json()
PREVIEW = Preview()


def test_surface_and_points_are_plain_numbers_with_the_engine_named() -> None:
    surface = PREVIEW.surface(TABLE, [5.0, 20.0], [0.0, 0.9])
    points = PREVIEW.points(TABLE, [(5.0, 0.0), (20.0, 0.9)])

    assert surface["gain"][1][0] == pytest.approx(0.1, abs=1e-6)
    assert points["gain"] == [surface["gain"][0][0], surface["gain"][1][1]]
    assert surface["engine"] == points["engine"]
    assert "C99" in surface["engine"]


def test_points_that_are_no_pairs_are_refused() -> None:
    with pytest.raises(InvalidRequest):
        PREVIEW.points(TABLE, [(1.0, 2.0, 3.0)])


def test_a_table_that_cannot_exist_is_a_lint_answer_with_every_fault() -> None:
    report = PREVIEW.lint({**TABLE, "gain_points": [0.1, 0.2, 0.3, 0.4, 0.9], "inference": "mom"})

    assert [finding.where for finding in report.errors] == ["inference", "gain_points[4]"]
    assert report.warnings == report.notes == ()


@pytest.mark.parametrize("name", ["speed_points_kmh", "torque_rate_points", "gain_points"])
def test_a_table_that_the_unit_would_refuse_is_refused_by_every_question(name: str) -> None:
    table = {**TABLE, name: [0, 1.4e-45, 2.8e-45, 4.2e-45, 5.6e-45]}

    for question in (
        lambda: PREVIEW.surface(table, [5.0], [0.0]),
        lambda: PREVIEW.points(table, [(5.0, 0.0)]),
        lambda: PREVIEW.replay(default_config(), ride(), fuzzy_table=table),
    ):
        with pytest.raises(InvalidRequest, match=r"at least 0\.1|at least 0\.001"):
            question()
    assert [finding.where for finding in PREVIEW.lint(table).errors] == [
        f"{name}[{index}]" for index in (1, 2, 3, 4)
    ]


def test_a_ride_whose_own_table_is_refused_today_says_why_and_replays_with_another() -> None:
    recorded = {**default_config(), "fuzzy_gain_points": [0.1, 0.2, 0.2001, 0.3, 0.4]}

    with pytest.raises(InvalidRequest, match=r"at least 0\.001 above"):
        PREVIEW.replay(recorded, ride())

    replayed = PREVIEW.replay(recorded, ride(), fuzzy_table=TABLE)
    assert np.isfinite(replayed.motor_torque_nm).all()


def test_wrong_modes_are_lint_errors_beside_the_tables_findings() -> None:
    modes = AssistModes.from_parameters(default_config()).to_json()
    modes["modes"][2]["law"] = "turbo"

    report = PREVIEW.lint(TABLE, modes, {"assist_cutoff_kmh": 25.0})

    assert [finding.where for finding in report.errors] == ["modes[2].law"]
    assert report.notes


def ride(steps: int = 1000) -> dict[str, Any]:
    return {
        "speed_kmh": np.full(steps, 12.0),
        "cadence_rpm": np.full(steps, 60.0),
        "rider_torque_nm": np.full(steps, 25.0),
        "mode": np.full(steps, 3),
    }


def test_a_ride_is_replayed_under_another_table_and_other_modes() -> None:
    modes = AssistModes.from_parameters(default_config()).to_json()
    modes["modes"][3]["ratio"] = 0.5
    softest = {**TABLE, "rules": [["NB"] * 5] * 5}

    before = PREVIEW.replay(default_config(), ride())
    after = PREVIEW.replay(default_config(), ride(), fuzzy_table=softest, assist_modes=modes)

    assert before.assist_ratio[-1] > 1.2
    assert after.assist_ratio[-1] == pytest.approx(0.55, abs=0.001)


def test_a_ride_without_torque_cannot_be_replayed() -> None:
    arrays = ride()
    del arrays["rider_torque_nm"]

    with pytest.raises(InvalidRequest, match="torque_raw_counts"):
        PREVIEW.replay(default_config(), arrays)


def test_a_point_at_fault_is_named_as_it_was_asked() -> None:
    with pytest.raises(InvalidRequest) as of_speed:
        PREVIEW.points(TABLE, [(5.0, 0.1), (float("nan"), 0.2)])
    with pytest.raises(InvalidRequest) as of_rate:
        PREVIEW.points(TABLE, [(5.0, 1e300)])

    assert [(f.field, f.code) for f in of_speed.value.fields] == [("points[1][0]", "not_finite")]
    assert [(f.field, f.code) for f in of_rate.value.fields] == [("points[0][1]", "out_of_range")]
