"""Goal: what the cranks tell of a ride's gears is neither a gear too few nor one too many.

Method: speed and cadence of gears that are known, at 100 samples a second.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.law import law_defaults
from backend.law.recorded_ride import Recorded, reach_of, recorded

STEP_S = 0.01
HIGH_M, LOW_M = 0.97, 0.33
"""Metres for a radian of the chainring."""
START_S, RIDE_S = 8, 100


def pedalled(reach_m: np.ndarray, speed_ms: np.ndarray) -> Recorded:
    """A ride in these gears at these speeds, (n,) each, pushed all the time."""
    columns = {
        "speed_kmh": 3.6 * speed_ms,
        "cadence_rpm": speed_ms / reach_m * 30.0 / np.pi,
        "rider_torque_nm": np.full(speed_ms.size, 20.0),
        "motor_torque_nm": np.zeros(speed_ms.size),
        "assist_mode": np.full(speed_ms.size, 3.0),
    }
    return recorded(columns, law_defaults(), STEP_S)


def test_low_gears_of_a_start_are_gears_of_a_ride_that_goes_on_in_another() -> None:
    samples = np.arange(round(RIDE_S / STEP_S))
    starting = samples < round(START_S / STEP_S)
    reach_m = np.where(starting, LOW_M, HIGH_M)

    found_m = reach_of(pedalled(reach_m, np.where(starting, 2.0, 6.7)))

    away_from_the_shift = np.abs(samples - starting.sum()) > round(0.3 / STEP_S)
    assert found_m[away_from_the_shift] == pytest.approx(reach_m[away_from_the_shift])


def test_a_speed_that_is_late_at_the_start_is_no_gear() -> None:
    speed_ms = np.full(round(RIDE_S / STEP_S), 6.7)
    ride = pedalled(np.full(speed_ms.size, HIGH_M), speed_ms)
    ride.speed_ms[: round(0.3 / STEP_S)] *= 0.8

    assert reach_of(ride) == pytest.approx(HIGH_M)
