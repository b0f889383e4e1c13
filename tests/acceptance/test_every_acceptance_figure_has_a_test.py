"""Goal: nobody can take away the test of an acceptance figure of thesis_checks 5 unnoticed.

Method: the table below says where each of A1 to A18 is held; the tests it names must exist.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ACCEPTANCE = "tests/acceptance/test_thesis_acceptance.py"
CUT_OFFS = "tests/acceptance/test_cut_offs_through_the_physics.py"
LAW = "tests/unit/sim_device/test_assist_law.py"
LIMITS = "tests/unit/sim_device/test_assist_limits.py"
GAIN = "tests/unit/sim_device/test_fuzzy_gain.py"
UNIT = "tests/unit/sim_device/test_lockstep_unit.py"
LINK = "tests/unit/physics/test_rotor_link.py"

HELD_BY = {
    "A1": [
        (ACCEPTANCE, "test_a1_the_simulators_metrics_of_table_3_1_are_exact"),
        (
            "tests/unit/calibration/test_calibration_figures.py",
            "test_table_3_1_gives_the_recomputed_figures",
        ),
        ("tests/unit/calibration/test_calibration_figures.py", "test_table_5_1_has_one_percent"),
    ],
    "A2": [(ACCEPTANCE, "test_a2_")],
    "A3": [(ACCEPTANCE, "test_a3_")],
    "A4": [(ACCEPTANCE, "test_a4_")],
    "A5": [(LAW, "test_the_fixed_law_tapers_from_15_to_24_kmh")],
    "A6": [
        (GAIN, "test_the_thesis_table_gives_the_thesis_surface_at_its_points"),
        (GAIN, "test_standstill_counts_as_the_first_speed"),
        (GAIN, "test_the_centroid_ripples_no_more_than_the_reference_measured"),
    ],
    "A7": [(ACCEPTANCE, "test_a7_")],
    "A8": [(ACCEPTANCE, "test_a8_")],
    "A9": [(ACCEPTANCE, "test_a9_")],
    "A10": [(ACCEPTANCE, "test_a10_")],
    "A11": [(ACCEPTANCE, "test_a11_")],
    "A12": [
        (ACCEPTANCE, "test_a12_"),
        ("tests/unit/sim_device/test_books_close_on_any_ride.py", "test_a12_the_books_close"),
    ],
    "A13": [
        (ACCEPTANCE, "test_a13_"),
        (LIMITS, "test_at_25_kmh_the_battery_leaves_at_most_1_45_nm"),
        ("tests/unit/sim_device/test_physics_clutches_and_limits.py", "test_no_torque_comes_from"),
    ],
    "A14": [
        (LIMITS, "test_there_is_no_assist_at_and_above_25_kmh"),
        (LIMITS, "test_standing_cranks_end_the_assist_after_150_ms"),
        (LIMITS, "test_back_pedalling_takes_the_torque_away_in_the_same_step"),
        (LIMITS, "test_a_low_battery_ends_the_assist"),
        (CUT_OFFS, "test_a14_the_brake_lever_within_50_ms"),
        (CUT_OFFS, "test_a14_pedal_stop_within_150_ms"),
        (CUT_OFFS, "test_a14_back_pedalling"),
        (CUT_OFFS, "test_a14_none_at_25_kmh"),
        (CUT_OFFS, "test_a14_a_hazard_latches"),
        (CUT_OFFS, "test_a_speed_sensor_that_sticks"),
        (CUT_OFFS, "test_a_motor_that_lost_its_position"),
        (UNIT, "test_the_brake_lever_ends_assist_within_a_twentieth_of_a_second"),
    ],
    "A15": [(LAW, "test_the_gain_never_compounds")],
    "A16": [(ACCEPTANCE, "test_a16_")],
    "A17": [
        (ACCEPTANCE, "test_a17_two_hours"),
        (ACCEPTANCE, "test_a17_a_bit"),
        (LINK, "test_a17_"),
    ],
    "A18": [(ACCEPTANCE, "test_a18_")],
}


@pytest.mark.parametrize("number", [f"A{number}" for number in range(1, 19)])
def test_the_tests_of_this_figure_exist(number: str) -> None:
    for path, name in HELD_BY[number]:
        text = (ROOT / path).read_text(encoding="utf-8")
        assert re.search(rf"^def {name}", text, flags=re.MULTILINE), f"{path} has no {name}"
