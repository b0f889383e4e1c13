"""Goal: the two ways to even out the strokes do what they promise, at every cadence.

Method: legs of 40 Nm whose push swings by 90 % twice a turn, T = 40 (1 - 0.9 cos 2 angle) Nm, and
legs that begin or cease, through the law. A low-pass of first order leaves 1 / sqrt(1 + (w t)^2) of
a swing of w rad/s and delays it by atan(w t); a mean over half a turn leaves nothing of it.
"""

import math

import numpy as np
import pytest

from firmware_protocol.parameters import default_config
from tests.fakes.filtered_torque import Numbers, filtered_nm

STEP_S = 0.01
MEAN_NM = 40.0
SWING = 0.9
HALF_TURN = {**default_config(), "torque_filter": "half_turn"}
TIME_CONSTANT = {**default_config(), "torque_filter": "time_constant", "torque_filter_s": 0.5}
CADENCES_RPM = [30.0, 47.0, 60.0, 75.0, 90.0, 115.0]


def strokes_nm(cadence_rpm: float, seconds: float) -> Numbers:
    times_s = np.arange(round(seconds / STEP_S)) * STEP_S
    angle_rad = times_s * cadence_rpm / 60.0 * 2.0 * math.pi
    return MEAN_NM * (1.0 - SWING * np.cos(2.0 * angle_rad))


def swing_of(settled_nm: Numbers) -> float:
    """Half of what a series swings by, as a share of the legs' mean."""
    return float(np.ptp(settled_nm)) / 2.0 / MEAN_NM


@pytest.mark.parametrize("cadence_rpm", CADENCES_RPM)
def test_half_a_turn_leaves_no_ripple_and_the_legs_mean(cadence_rpm: float) -> None:
    settled = filtered_nm(strokes_nm(cadence_rpm, 20.0), cadence_rpm, HALF_TURN)[1000:]

    # A part of the half turn ends within a step of its angle: a step is 2 to 8 % of half a turn.
    assert swing_of(settled) < 0.04
    assert np.mean(settled) == pytest.approx(MEAN_NM, rel=0.01)


@pytest.mark.parametrize("cadence_rpm", CADENCES_RPM)
def test_a_time_constant_leaves_the_ripple_of_a_low_pass(cadence_rpm: float) -> None:
    settled = filtered_nm(strokes_nm(cadence_rpm, 20.0), cadence_rpm, TIME_CONSTANT)[1000:]

    swing_rad_per_s = 2.0 * cadence_rpm / 60.0 * 2.0 * math.pi
    left = 1.0 / math.hypot(1.0, swing_rad_per_s * 0.5)
    assert swing_of(settled) == pytest.approx(SWING * left, rel=0.03)


@pytest.mark.parametrize("cadence_rpm", CADENCES_RPM)
def test_legs_that_cease_are_forgotten_in_half_a_turn(cadence_rpm: float) -> None:
    half_turn_steps = math.ceil(30.0 / cadence_rpm / STEP_S)
    torque_nm = np.concatenate([np.full(1000, MEAN_NM), np.zeros(300)])

    after = filtered_nm(torque_nm, cadence_rpm, HALF_TURN)[1000:]

    part_steps = math.ceil(half_turn_steps / 16)
    assert after[half_turn_steps + part_steps] == pytest.approx(0.0, abs=1e-3)
    assert after[half_turn_steps // 2] == pytest.approx(MEAN_NM / 2.0, rel=0.15)


def test_a_start_counts_from_its_first_push() -> None:
    """Nothing is known of a crank that stood: what it pushes now is the mean."""
    cadence_rpm = np.concatenate([np.zeros(100), np.full(200, 60.0)])
    torque_nm = np.concatenate([np.zeros(50), np.full(250, MEAN_NM)])

    out = filtered_nm(torque_nm, cadence_rpm, HALF_TURN)

    assert np.all(out[:50] == 0.0)
    assert out[50:] == pytest.approx(MEAN_NM, rel=1e-6)


def test_a_crank_that_stands_or_turns_back_holds_no_old_push() -> None:
    cadence_rpm = np.concatenate([np.full(300, 60.0), np.zeros(1), np.full(1, -20.0)])
    torque_nm = np.concatenate([np.full(300, MEAN_NM), np.full(2, 3.0)])

    out = filtered_nm(torque_nm, cadence_rpm, HALF_TURN)

    assert out[-2:] == pytest.approx(3.0, rel=1e-6)


def test_a_unit_of_before_averages_with_its_time_constant() -> None:
    older = {name: value for name, value in default_config().items() if name != "torque_filter"}
    torque_nm = strokes_nm(60.0, 3.0)

    out = filtered_nm(torque_nm, 60.0, older)

    assert np.array_equal(out, filtered_nm(torque_nm, 60.0, TIME_CONSTANT))
