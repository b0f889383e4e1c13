"""Goal: setup and captures say what they mean, travel as JSON unchanged, and refuse by name.

Method: gravity against values published elsewhere, loads against thesis eq. 3.22, JSON there and
back, and one wrong thing at a time.
"""

import json
import math
from typing import Any

import numpy as np
import pytest

from backend.calibration.capture import State, capture_of, captured_of, state_of
from backend.calibration.coefficients import Coefficients
from backend.calibration.plain import to_plain
from backend.calibration.setup import Mass, Setup, gravity_at, normal_gravity_ms2, setup_of
from backend.errors import InvalidRequest

SETUP = Setup(
    arm_m=0.170,
    arm_limit_m=0.0005,
    gravity=gravity_at(47.4, 408.0),
    masses=(Mass("disc 1", 6.0, "M1"), Mass("jug", 12.0, None, 0.02)),
    loads_kg=(6.0, 12.0, 18.0),
    full_scale_nm=100.0,
    gain_nm_per_count=0.01,
)


def faults(body: dict[str, Any]) -> set[tuple[str, str]]:
    with pytest.raises(InvalidRequest) as refused:
        setup_of(body)
    return {(fault.field, fault.code) for fault in refused.value.fields}


@pytest.mark.parametrize(
    ("latitude_deg", "height_m", "gravity_ms2"),
    [
        (0.0, 0.0, 9.7803253359),  # WGS 84, table 3.4
        (90.0, 0.0, 9.8321849378),  # the same
        (45.0, 0.0, 9.80619777),  # GRS 80, which differs by less than 1e-8 there
    ],
)
def test_normal_gravity_is_the_published_one(
    latitude_deg: float, height_m: float, gravity_ms2: float
) -> None:
    assert normal_gravity_ms2(latitude_deg, height_m) == pytest.approx(gravity_ms2, abs=3e-8)


def test_a_kilometre_up_weighs_three_parts_in_ten_thousand_less() -> None:
    lost = normal_gravity_ms2(45.0) - normal_gravity_ms2(45.0, 1000.0)

    assert lost == pytest.approx(3.086e-3, rel=0.001)


def test_gravity_at_sevres_is_the_measured_one_within_its_uncertainty() -> None:
    # IGSN 71, point A at the BIPM.
    place = gravity_at(48.83, 66.0)

    assert abs(place.gravity_ms2 - 9.80926) < 2 * place.standard_ms2


def test_the_load_is_mass_times_gravity_times_the_level_part_of_the_arm() -> None:
    level = State("load", "right", 35.99, direction="loading")
    steep = State("load", "right", 35.99, crank_angle_deg=60.0, direction="loading")

    assert level.load_nm(SETUP) == pytest.approx(60.0, abs=0.01)
    assert steep.load_nm(SETUP) == pytest.approx(level.load_nm(SETUP) / 2, rel=1e-12)


def test_setup_and_capture_travel_as_json_unchanged() -> None:
    state = State("load", "left", 6.0, direction="unloading", sensor_degc=24.0)
    capture = capture_of(3, state, [600, 601, 599, 32767, 600], 3.0, 1_795_000_000_000_000)

    assert setup_of(json.loads(json.dumps(to_plain(SETUP)))) == SETUP
    assert captured_of(json.loads(json.dumps(to_plain(capture)))) == capture


def test_a_damaged_word_is_left_out_and_named() -> None:
    capture = capture_of(1, State("zero"), [-3, -2, -3, -4, 32767, -3], 3.0, 0)

    assert capture.rejected == (4,)
    assert (capture.count, capture.mean_counts) == (5, -3.0)
    assert capture.deviation_counts == pytest.approx(math.sqrt(0.5))


def test_a_converter_that_toggles_one_step_has_no_outlier() -> None:
    assert capture_of(1, State("zero"), [5] * 99 + [6], 1.0, 0).rejected == ()


def test_every_wrong_field_of_a_setup_is_named() -> None:
    body = to_plain(SETUP) | {"arm_m": "long", "strokes": True, "nobody": 1}
    body["masses"][1]["mass_kg"] = math.nan
    del body["full_scale_nm"]

    assert {field for field, _ in faults(body)} == {
        "arm_m",
        "strokes",
        "nobody",
        "masses[1].mass_kg",
        "full_scale_nm",
    }


def test_a_mass_has_a_class_or_a_limit_and_a_plan_stays_within_the_scale() -> None:
    body = to_plain(SETUP) | {"loads_kg": [6.0, 6.0, 120.0]}
    body["masses"][0]["limit_kg"] = 0.1

    assert faults(body) == {
        ("masses[0].limit_kg", "class_or_limit"),
        ("loads_kg", "named_twice"),
        ("loads_kg", "beyond_full_scale"),
    }


def test_a_crank_that_was_read_as_two_lengths_is_measured() -> None:
    body = to_plain(SETUP)

    assert faults({**body, "arm_again_m": 0.1725}) == {("arm_again_m", "arm_differs")}
    assert setup_of({**body, "arm_again_m": 0.1701}).arm_again_m == 0.1701


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"kind": "zero", "mass_kg": 1.0}, "mass_kg"),
        ({"kind": "load", "mass_kg": 6.0, "direction": "loading"}, "side"),
        ({"kind": "load", "side": "left", "direction": "loading"}, "mass_kg"),
        ({"kind": "load", "side": "left", "mass_kg": 6.0}, "direction"),
        ({"kind": "load", "side": "both", "mass_kg": 6.0, "direction": "loading"}, "side"),
    ],
)
def test_a_state_that_cannot_be_is_refused(body: dict[str, Any], field: str) -> None:
    with pytest.raises(InvalidRequest) as refused:
        state_of(body)

    assert [fault.field for fault in refused.value.fields] == [field]


def test_a_missing_coefficient_or_temperature_corrects_nothing() -> None:
    plain = Coefficients(-3.0, 0.01)
    warm = Coefficients(-3.0, 0.01, 2.0, 2e-4, 20.0)

    assert plain.torque_nm([997.0], [70.0]) == pytest.approx([10.0])
    assert warm.torque_nm([997.0], [np.nan]) == pytest.approx([10.0])
    assert warm.torque_nm([1097.0], [70.0]) == pytest.approx([10.0 * 1.01])
