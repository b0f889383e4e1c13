"""Goal: between the acceptance figures (tests/acceptance) the curves have the thesis' shape.

Method: scenarios in virtual time with the factory configuration, against two engines that are not
ours (thesis_checks 4).
"""

from typing import Any

import pytest

from sim_device.scenario import run, trace
from sim_device.scenario_file import ScenarioError


def figures(name: str, **settings: object) -> dict[str, Any]:
    return run(name, settings)


def test_the_start_has_the_shape_of_the_tapered_reading() -> None:
    fixed = figures("start", law="fixed")["speed_kmh"]

    # thesis_checks 4.5; the stroke average of 0.5 s costs up to half a km/h on the way.
    for second, kmh in {"5": 6.2, "10": 12.1, "15": 17.4, "20": 20.7, "30": 23.7}.items():
        assert fixed[second] == pytest.approx(kmh, abs=0.5)


def test_the_slope_has_the_shape_of_the_tapered_reading() -> None:
    fixed = figures("slope", law="fixed")["speed_kmh"]

    for second, kmh in {"1": 23.2, "2": 21.7, "5": 18.6, "10": 16.1, "15": 15.2}.items():
        assert fixed[second] == pytest.approx(kmh, abs=0.3)


def test_a_heavier_bike_needs_longer() -> None:
    light_s = figures("start", mass_kg=95)["time_to_limit_s"]
    heavy_s = figures("start", mass_kg=105)["time_to_limit_s"]

    # thesis_checks 4.4: 18.8 and 21.2 s, on the average of 0.34 s later with the stroke average.
    assert light_s == pytest.approx(18.8 + 0.34, abs=0.3)
    assert heavy_s == pytest.approx(21.2 + 0.34, abs=0.3)


def test_1_2_kw_of_legs_hold_19_kmh_on_a_true_15_degrees() -> None:
    # thesis_checks 4.3: both laws sit on the bus limit, and no gap of 7 km/h is possible.
    laws = {law: figures("slope", law=law, grade_deg=15.0, rider_torque_nm=220.0)
            for law in ("fixed", "fuzzy")}  # fmt: skip

    assert laws["fixed"]["final_speed_kmh"] == pytest.approx(19.1, abs=0.3)
    assert laws["fuzzy"]["final_speed_kmh"] == pytest.approx(19.3, abs=0.3)


def test_a_trace_ends_where_the_scenario_does() -> None:
    points = trace("slope", {"law": "fixed"})

    assert points[0] == (0.0, pytest.approx(25.0, abs=0.01))
    assert points[-1][1] == figures("slope", law="fixed")["final_speed_kmh"]
    with pytest.raises(ScenarioError, match="kinematics has no trace"):
        trace("kinematics")
