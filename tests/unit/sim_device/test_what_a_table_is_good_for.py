"""Goal: the tables that come with Spindle differ in the way their comments and docs/tables.md say.

Method: each is ridden through the commute in virtual time, starts on the level and holds the limit,
a factory unit for the EU under it; the same every time. Differences are asked for, not numbers.
"""

from __future__ import annotations

import numpy as np
import pytest

from tools.reproduction.table_rides import (
    Ride,
    column_shares,
    mean_gain,
    mean_kmh,
    ridden,
    ripple_pct,
    start_s,
    switched_hz,
    wh_per_km,
)
from tools.reproduction.tables import HALF_TURN, TABLES

pytestmark = pytest.mark.slow

STEP_S = 0.01


@pytest.fixture(scope="module")
def commute() -> dict[str, Ride]:
    return {table: ridden(table, "commute") for table in TABLES}


def of_a_stroke(swing_nm: float, mean_nm: float = 20.0, seconds: float = 20.0) -> Ride:
    """A motor torque that follows a stroke of two a turn at 60 r/min, at 20 km/h."""
    t_s = np.arange(STEP_S, seconds, STEP_S)
    flat = np.ones_like(t_s)
    torque_nm = mean_nm + swing_nm * np.sin(2 * np.pi * 2.0 * t_s)
    return {
        "t_s": t_s,
        "distance_m": t_s * 20.0 / 3.6,
        "cadence_rpm": 60.0 * flat,
        "battery_voltage_v": 36.0 * flat,
        "battery_current_a": 5.0 * flat,
        "motor_torque_nm": torque_nm,
        "motor_demand_nm": torque_nm,
        "motor_speed_rpm": 60.0 * flat,
        "fuzzy_gain": 0.0 * flat,
    }


def test_the_measures_are_what_a_pencil_says() -> None:
    ride = of_a_stroke(swing_nm=6.0)

    # A half turn is a whole period of the stroke: its mean is 20 Nm, a sine's rms 6 / sqrt 2.
    assert ripple_pct(ride) == pytest.approx(100 * 6.0 / np.sqrt(2) / 20.0, rel=0.01)
    assert ripple_pct(of_a_stroke(swing_nm=0.0)) == pytest.approx(0.0, abs=1e-6)
    # 180 W at 20 km/h; 20 Nm at one turn a second.
    assert wh_per_km(ride) == pytest.approx((9.0, 40 * np.pi / 20), rel=0.01)


def test_even_takes_the_least_energy_and_gives_steady_pedalling_next_to_nothing(
    commute: dict[str, Ride],
) -> None:
    battery = {table: wh_per_km(ride)[0] for table, ride in commute.items()}

    others = [battery[table] for table in TABLES if table != "even"]
    assert battery["even"] < 0.97 * min(others)
    assert mean_gain(commute["even"]) < 0.02
    assert ripple_pct(commute["even"]) < ripple_pct(commute["thesis-table"]) - 0.5
    # It is no slower on the road than can be told in town.
    assert mean_kmh(commute["even"]) > 0.98 * mean_kmh(commute["thesis-table"])


@pytest.mark.parametrize("rider", ["constant", "legs"])
def test_strong_start_is_the_quickest_away_and_even_the_slowest(rider: str) -> None:
    away_s = {table: start_s(table, rider) for table in TABLES}

    assert sorted(away_s, key=away_s.__getitem__)[0] == "strong-start"
    assert away_s["strong-start"] < min(away_s["thesis-table"], away_s["thesis-rescaled"]) - 0.4
    assert sorted(away_s, key=away_s.__getitem__)[-1] == "even"


def test_strong_start_costs_no_more_and_is_more_even_than_the_thesis_s_table(
    commute: dict[str, Ride],
) -> None:
    assert wh_per_km(commute["strong-start"])[0] < wh_per_km(commute["thesis-table"])[0]
    # A start a millisecond later changes it by half a per cent.
    assert ripple_pct(commute["strong-start"]) < ripple_pct(commute["thesis-table"]) - 0.2


def test_legs_reach_every_column_of_the_rescaled_table_and_two_of_the_thesis_s(
    commute: dict[str, Ride],
) -> None:
    thesis = column_shares(commute["thesis-table"], "thesis-table")
    rescaled = column_shares(commute["thesis-rescaled"], "thesis-rescaled")

    assert thesis[2:].sum() < 0.02
    assert rescaled.min() > 0.05
    assert ripple_pct(commute["thesis-rescaled"]) > ripple_pct(commute["thesis-table"]) + 1.0


@pytest.mark.parametrize("table", TABLES)
def test_no_table_switches_the_motor_at_the_limit_of_a_unit_for_the_road(table: str) -> None:
    assert switched_hz(table) == 0.0
    assert switched_hz(table, hard_cut=True) > 2.0


def test_a_filter_without_the_stroke_leaves_the_columns_to_changes_of_the_push(
    commute: dict[str, Ride],
) -> None:
    half_turn = ridden("thesis-rescaled", "commute", HALF_TURN)

    assert column_shares(half_turn, "thesis-rescaled")[0] > 0.8
    assert ripple_pct(half_turn) < ripple_pct(commute["thesis-rescaled"]) - 3.0
