"""Goal: the whole unit, sensor to motor, reaches the acceptance figures of thesis_checks 5.

Method: scenarios in virtual time with the factory configuration. The figures come from two engines
that are not ours; a true 15 degrees, which the thesis claims, must not be reached.
"""

from typing import Any

import pytest

from sim_device.scenario import run


def figures(name: str, **settings: object) -> dict[str, Any]:
    return run(name, settings)


def test_kinematics_at_25_kmh() -> None:
    turning = figures("kinematics")

    assert turning["wheel_rpm"] == pytest.approx(200.953, rel=1e-4)
    assert turning["crank_rpm"] == pytest.approx(63.940, rel=1e-4)
    assert turning["motor_rpm"] == pytest.approx(2579.3, rel=1e-4)


def test_the_start_takes_40_s_with_the_fixed_law_and_20_s_with_the_fuzzy_one() -> None:
    fixed_s = figures("start", law="fixed")["time_to_limit_s"]
    fuzzy_s = figures("start", law="fuzzy")["time_to_limit_s"]

    assert fixed_s == pytest.approx(40.0, abs=1.0)
    assert fuzzy_s == pytest.approx(20.0, abs=0.5)
    assert fixed_s / fuzzy_s == pytest.approx(2.00, abs=0.08)


def test_the_start_has_the_shape_of_the_tapered_reading() -> None:
    fixed = figures("start", law="fixed")["speed_kmh"]

    # thesis_checks 4.5; the stroke average of 0.5 s costs up to half a km/h on the way.
    for second, kmh in {"5": 6.2, "10": 12.1, "15": 17.4, "20": 20.7, "30": 23.7}.items():
        assert fixed[second] == pytest.approx(kmh, abs=0.5)


@pytest.mark.parametrize(
    ("law", "final_kmh", "after_5_s_kmh"), [("fixed", 14.7, 18.6), ("fuzzy", 22.0, 24.1)]
)
def test_the_equivalent_slope_ends_at_the_thesis_speeds(
    law: str, final_kmh: float, after_5_s_kmh: float
) -> None:
    slope = figures("slope", law=law)

    assert slope["final_speed_kmh"] == pytest.approx(final_kmh, abs=0.3)
    assert slope["speed_kmh"]["5"] == pytest.approx(after_5_s_kmh, abs=0.3)


@pytest.mark.parametrize(
    ("law", "start_s", "start_tolerance_s", "slope_kmh", "slope_tolerance_kmh"),
    [("fixed", 41.0, 2.0, 14.7, 0.5), ("fuzzy", 21.0, 1.5, 22.0, 0.7)],
)
def test_legs_do_what_the_servo_does(
    law: str,
    start_s: float,
    start_tolerance_s: float,
    slope_kmh: float,
    slope_tolerance_kmh: float,
) -> None:
    start = figures("start", law=law, rider="legs")
    slope = figures("slope", law=law, rider="legs")

    assert start["time_to_limit_s"] == pytest.approx(start_s, abs=start_tolerance_s)
    assert slope["final_speed_kmh"] == pytest.approx(slope_kmh, abs=slope_tolerance_kmh)


@pytest.mark.parametrize("law", ["fixed", "fuzzy"])
@pytest.mark.parametrize("rider_torque_nm", [45.0, 60.0])
def test_a_true_15_degrees_stops_the_bike(law: str, rider_torque_nm: float) -> None:
    slope = figures("slope", law=law, grade_deg=15.0, rider_torque_nm=rider_torque_nm)

    assert slope["below_14_7_kmh_at_s"] <= 2.5
    assert slope["stopped_at_s"] <= 6.0
    assert slope["final_speed_kmh"] == 0.0


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("start", {"law": "fixed"}),
        ("start", {"law": "fuzzy", "rider": "legs"}),
        ("slope", {"law": "fuzzy"}),
        ("slope", {"law": "fuzzy", "grade_deg": 15.0}),
        ("commute", {}),
    ],
)
def test_the_energy_books_close_to_one_percent(name: str, settings: dict[str, object]) -> None:
    assert figures(name, **settings)["energy_balance_error_pct"] <= 1.0


def test_the_dynamometer_breaks_away_where_energy_says_and_where_the_thesis_says() -> None:
    physical = figures("resistance")["breakaway_torque_nm"]
    printed = figures("resistance", convention="thesis")["breakaway_torque_nm"]

    # A16: 20 Nm times 44/14 over the chain's efficiency; eq. 5.1 as printed divides instead.
    assert physical == pytest.approx(62.86 / 0.97, abs=0.5)
    assert printed == pytest.approx(6.36, abs=0.05)


def test_a_heavier_bike_needs_longer() -> None:
    light_s = figures("start", mass_kg=95)["time_to_limit_s"]
    heavy_s = figures("start", mass_kg=105)["time_to_limit_s"]

    # thesis_checks 4.4: 18.8 and 21.2 s, on the average of 0.34 s later with the stroke average.
    assert light_s == pytest.approx(18.8 + 0.34, abs=0.3)
    assert heavy_s == pytest.approx(21.2 + 0.34, abs=0.3)
