"""Goal: the rider's values follow from mechanics, and what was not measured is not made up.

Rows are those of ideal rides: distance is speed times time, power torque times angular speed,
range the battery left over the battery used per kilometre.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from backend.units.dashboard import Dashboard, DashboardAccount

PERIOD_US = 10_000
ROWS_PER_S = 100


def ridden(
    account: DashboardAccount, seconds: float, from_s: float = 0.0, **columns: object
) -> None:
    """Feeds `seconds` in blocks of three rows; a column is a number or a function of time."""
    rows = round(seconds * ROWS_PER_S)
    for start in range(0, rows, 3):
        t_s = from_s + np.arange(start, min(start + 3, rows)) / ROWS_PER_S
        block = {
            name: np.asarray(value(t_s) if callable(value) else np.full(len(t_s), value), float)
            for name, value in columns.items()
        }
        account.take(round(t_s[0] * 1e6), PERIOD_US, block)


def dashboard_after(seconds: float, **columns: object) -> Dashboard:
    account = DashboardAccount()
    ridden(account, seconds, **columns)
    return account.now()


def test_thirty_six_km_h_for_a_hundred_seconds_is_a_kilometre() -> None:
    assert dashboard_after(100.0, speed_kmh=36.0).distance_km == pytest.approx(1.0, rel=1e-9)


def test_acceleration_is_the_slope_of_speed() -> None:
    note_unit = dashboard_after(10.0, speed_kmh=lambda t_s: 3.6 * 0.5 * t_s)

    assert note_unit.acceleration_ms2 == pytest.approx(0.5, rel=1e-6)
    assert note_unit.speed_kmh == pytest.approx(3.6 * 0.5 * 9.99)


def test_rider_and_motor_power_are_torque_times_angular_speed_and_stay_apart() -> None:
    riding = {"rider_torque_nm": 20.0, "cadence_rpm": 60.0, "motor_speed_rpm": 2400.0}
    note_unit = dashboard_after(3.0, **riding, motor_torque_nm=1.0, motor_torque_demanded_nm=1.5)

    assert note_unit.rider_power_w == pytest.approx(20.0 * 2 * math.pi)
    assert note_unit.motor_power_w == pytest.approx(1.0 * 2 * math.pi * 40.0)


def test_a_unit_that_tells_only_what_it_asks_of_its_motor_has_no_motor_power() -> None:
    note_unit = dashboard_after(3.0, motor_torque_nm=1.0, motor_speed_rpm=2400.0)

    assert note_unit.motor_power_w is None


def test_strokes_are_averaged_over_a_second() -> None:
    # Two strokes a turn at 60 rpm: the ripple has a period of half a second.
    note_unit = dashboard_after(
        5.0,
        rider_torque_nm=lambda t_s: 20.0 * (1.0 - 0.8 * np.cos(4 * np.pi * t_s)),
        cadence_rpm=60.0,
    )

    assert note_unit.rider_power_w == pytest.approx(20.0 * 2 * math.pi, rel=0.03)


def test_the_range_is_the_battery_left_over_the_battery_used_per_kilometre() -> None:
    # 2 % on 1 km leave 78 %, which is 39 km.
    note_unit = dashboard_after(
        100.0, speed_kmh=36.0, battery_soc_pct=lambda t_s: 80.0 - 0.02 * t_s
    )

    assert note_unit.range_km == pytest.approx(39.0, rel=1e-3)


@pytest.mark.parametrize(
    ("speed_kmh", "soc_fall_per_s"), [(36.0, 0.0), (3.6, 0.02)], ids=["no use", "no way"]
)
def test_a_range_that_would_be_a_guess_is_missing(speed_kmh: float, soc_fall_per_s: float) -> None:
    note_unit = dashboard_after(
        100.0, speed_kmh=speed_kmh, battery_soc_pct=lambda t_s: 80.0 - soc_fall_per_s * t_s
    )

    assert note_unit.range_km is None


def test_a_charged_battery_starts_the_account_again() -> None:
    account = DashboardAccount()
    ridden(account, 100.0, speed_kmh=36.0, battery_soc_pct=40.0)
    ridden(account, 100.0, from_s=100.0, speed_kmh=36.0, battery_soc_pct=100.0)

    # The rows that showed the charge were ridden before it was noticed.
    assert account.now().distance_km == pytest.approx(1.0, abs=0.001)


def test_what_was_not_measured_is_missing_and_never_zero() -> None:
    nothing = DashboardAccount().now()
    assert {nothing.speed_kmh, nothing.rider_power_w, nothing.range_km, nothing.t_us} == {None}

    note_unit = dashboard_after(2.0, speed_kmh=math.nan, rider_torque_nm=20.0)
    assert note_unit.speed_kmh is None
    assert note_unit.acceleration_ms2 is None
    assert note_unit.rider_power_w is None
    assert note_unit.missing_s == pytest.approx(2.0)
    assert note_unit.distance_km == 0.0


def test_lost_rows_are_told_and_not_ridden() -> None:
    account = DashboardAccount()
    ridden(account, 10.0, speed_kmh=36.0)
    account.take(20_000_000, PERIOD_US, {"speed_kmh": np.array([36.0])}, lost_rows=1000)

    note_unit = account.now()
    assert note_unit.missing_s == pytest.approx(10.0)
    assert note_unit.distance_km == pytest.approx(0.1, rel=0.01)
