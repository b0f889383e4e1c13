"""Goal: a ride that begins in the middle of anything comes to what it was when it is ridden again.

Method: the simulated bike with a cassette in town (scenario `commute`), from where a rider goes on
uphill; and roads with one gear (tests/fakes/known_roads.py). From these rides are cut that begin
where the bike stands, rolls, brakes, is assisted or is too fast for it. What the motor did is what
an observer beside the bike saw; the twin gets the rest of the ride alone.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt
import pytest

from backend.law.recorded_ride import Recorded, recorded
from backend.law.twin import RoadTwin
from backend.rides.replay.ride_again import TIME_ERROR_MAX, WORK_ERROR_MAX
from sim_device.lockstep import LockstepUnit
from tests.fakes.known_roads import SEEN, STEP_S, Columns, Ridden, configuration, road

pytestmark = pytest.mark.slow

SPORT = 3
TOWN_S = 240.0
WORK_J_MIN = 1000.0
"""What is left of a ride has so much work of the motor, for a share of it to say something."""
BEGINNINGS = 12
"""Of each kind in each ride; up to twice as many where they do not divide evenly."""


def in_town(seconds: float, uphill_s: float = 0.0) -> Columns:
    """The scenario for so long, and then legs uphill for so long, (n,) each."""
    unit = LockstepUnit(7, scenario="commute")
    unit.select_mode(SPORT)
    rows = observed(unit, seconds)
    if uphill_s > 0.0:
        unit.brake(False)
        unit.rider("legs", 25.0, 90.0)
        unit.road(grade_deg=1.0)
        rows += observed(unit, uphill_s)
    values = np.array(rows)
    return {name: values[:, at] for at, name in enumerate((*SEEN, "brake"))}


def observed(unit: LockstepUnit, seconds: float) -> list[list[float]]:
    """A row of SEEN and the brake for each control step."""
    rows = []
    for _ in range(round(seconds / STEP_S)):
        unit.advance(STEP_S)
        seen = unit.observe()
        brake = unit.simulation_get()["brake"]
        rows.append([*(float(seen[name]) for name in SEEN.values()), float(brake)])
    return rows


@cache
def whole_rides() -> tuple[Columns, ...]:
    """Town, and three roads with one gear."""
    return in_town(TOWN_S), *(Ridden(road(seed), SPORT).columns for seed in (1301, 1302, 1303))


def twin_from(columns: Columns, row: int) -> tuple[Recorded, RoadTwin]:
    """The ride as it would have been recorded from this row on, and its twin."""
    rest = {name: values[row:] for name, values in columns.items()}
    ride = recorded(rest, configuration(), STEP_S)
    return ride, RoadTwin(ride, configuration())


def errors(ride: Recorded, twin: RoadTwin) -> tuple[float, float]:
    """Of work and of time, as shares of the recorded ones."""
    again = twin.self_replay
    return (
        again.motor_work_j / ride.motor_work_j - 1.0,
        again.duration_s / ride.duration_s - 1.0,
    )


def rows_that(begin: str, columns: Columns) -> npt.NDArray[np.intp]:
    """Rows at which a ride begins like this, evenly chosen, (k,)."""
    motor_nm, speed_kmh = columns["motor_torque_nm"], columns["speed_kmh"]
    pushes, brakes = columns["rider_torque_raw"] > 300.0, columns["brake"] > 0.0
    moves, helps = speed_kmh > 4.0, motor_nm > 0.1
    like = {
        "standing": speed_kmh < 0.1,
        "rolling": moves & ~pushes & ~brakes & ~helps & (speed_kmh < 24.0),
        "braking": moves & brakes,
        "assisted": moves & helps,
        "too fast": (speed_kmh > 25.5) & pushes,
    }[begin]
    work_j = motor_nm * columns["motor_speed_rpm"] * np.pi / 30.0 * STEP_S
    left_j = np.cumsum(work_j[::-1])[::-1]
    at = np.flatnonzero(like & (left_j > WORK_J_MIN))
    return at[:: max(at.size // BEGINNINGS, 1)]


@pytest.mark.parametrize("town_s", [0.0, 10.0, 15.0, 20.0, 30.0, 45.0])
def test_low_gears_at_the_start_are_ridden_however_long_the_ride_goes_on_in_another(
    town_s: float,
) -> None:
    ride, twin = twin_from(in_town(town_s, uphill_s=90.0), 0)

    work, time = errors(ride, twin)
    assert not twin.one_gear
    assert abs(work) <= WORK_ERROR_MAX
    assert abs(time) <= TIME_ERROR_MAX


@pytest.mark.parametrize("begin", ["standing", "rolling", "braking", "assisted", "too fast"])
def test_a_ride_that_begins_like_this_is_the_same_ride_again(begin: str) -> None:
    found = np.array(
        [
            errors(*twin_from(columns, row))
            for columns in whole_rides()
            for row in rows_that(begin, columns)
        ]
    )

    work, time = np.abs(found).T
    assert len(found) >= BEGINNINGS
    assert np.mean((work <= WORK_ERROR_MAX) & (time <= TIME_ERROR_MAX)) >= 0.9
