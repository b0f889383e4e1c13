"""Goal: torque over the crank's angle shows leg, dead spot and lag as they were made.

Method: legs whose torque is a known function of the angle, a motor that follows them by a known
time; and the simulated bike.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.rides.insight.crank import CrankTorque, crank_torque, gain_map
from tests.fakes.simulated_ride import LOOK_S, simulated_ride

RATE_HZ, CADENCE_RPM = 100.0, 72.0
AT_S = np.arange(6000) / RATE_HZ
DEG_PER_S = CADENCE_RPM * 6.0
SECONDS = np.full(len(AT_S), 1.0 / RATE_HZ)
CADENCE = np.full(len(AT_S), CADENCE_RPM)


def legs(at_s: np.ndarray, left_nm: float = 20.0, right_nm: float = 20.0) -> np.ndarray:
    """Both legs push hardest with their crank level: at 90 and 270 degrees."""
    angle = np.mod(at_s * DEG_PER_S, 360.0)
    of_leg = np.where(angle < 180.0, left_nm, right_nm)
    return of_leg * (1.0 - np.cos(np.radians(2.0 * angle)))


def told(motor_nm: np.ndarray | None = None, **strength: float) -> CrankTorque:
    angle = np.mod(AT_S * DEG_PER_S, 360.0)
    answer = crank_torque(angle, legs(AT_S, **strength), motor_nm, CADENCE, SECONDS)
    assert isinstance(answer, CrankTorque)
    return answer


def test_a_stronger_leg_has_its_share_and_the_dead_spot_is_where_none_pushes() -> None:
    uneven = told(left_nm=22.0, right_nm=18.0)

    assert uneven.left_share == pytest.approx(0.55, abs=0.005)
    assert uneven.dead_spot_share == pytest.approx(0.0, abs=0.03)
    assert min(uneven.dead_spot_deg % 180.0, 180.0 - uneven.dead_spot_deg % 180.0) <= 5.0
    assert uneven.turns == pytest.approx(72.0, rel=0.01)
    assert max(uneven.rider_nm) == pytest.approx(44.0, rel=0.02)
    assert (uneven.motor_nm, uneven.lag_deg) == (None, None)


@pytest.mark.parametrize("late_s", [0.0, 0.05, 0.1])
def test_the_lag_of_the_motor_is_the_time_that_it_is_late(late_s: float) -> None:
    answer = told(0.8 * legs(AT_S - late_s) + 5.0)

    assert answer.lag_ms == pytest.approx(1000.0 * late_s, abs=1.0)
    assert answer.lag_deg == pytest.approx(late_s * DEG_PER_S, abs=0.5)


def test_a_motor_that_does_not_swing_has_no_lag() -> None:
    assert told(np.full(len(AT_S), 20.0)).lag_deg is None


def test_what_cannot_be_told_is_refused_with_its_reason() -> None:
    angle, torque = np.mod(AT_S * DEG_PER_S, 360.0), legs(AT_S)
    few = slice(0, 1000)

    assert crank_torque(angle, torque, None, CADENCE, np.full(6000, 0.1)) == "slow_rows"
    assert crank_torque(angle[few], torque[few], None, CADENCE[few], SECONDS[few]) == "few_turns", (
        "12 turns"
    )


def test_the_simulated_bike_pushes_and_lags_as_its_law_does() -> None:
    ride = simulated_ride("commute")
    count = len(ride["speed_kmh"])
    answer = crank_torque(
        ride["crank_angle_deg"],
        ride["rider_torque_nm"],
        ride["motor_torque_nm"] * 40.34,
        ride["cadence_rpm"],
        np.full(count, LOOK_S),
    )

    assert isinstance(answer, CrankTorque)
    assert answer.left_share == pytest.approx(0.5, abs=0.05), "its legs are equal"
    assert answer.dead_spot_share is not None
    assert answer.dead_spot_share < 0.3


def test_time_lies_in_the_cell_of_speed_and_gain() -> None:
    speed = np.array([9.0, 9.5, 21.0, 21.0, np.nan, 80.0])
    gain = np.array([0.31, 0.34, 0.12, 0.0, 0.3, 9.0])
    found = gain_map(speed, gain, np.ones(6))

    assert found is not None
    cells = np.array(found.seconds)
    assert cells.sum() == 4.0
    assert (cells[4, 6], cells[10, 2], cells[24, 39]) == (2.0, 1.0, 1.0)
    assert gain_map(speed, np.zeros(6), np.ones(6)) is None
