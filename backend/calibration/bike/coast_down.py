"""What road and air take, from coast-downs: the part of an energy balance that legs do not tell.

    m dv/dt = -(f0 + f2 v^2) - m g slope

with f0 and f2 rolling and air (thesis eq. 4.1 to 4.3). The motor is off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from backend.calibration.bike.wheel import ROOT_3, as_array, ordered, raise_if, summed
from backend.calibration.plain import Plain
from backend.errors import FieldError

TYPICAL_ROLLING, TYPICAL_ROLLING_LIMIT = 0.0075, 0.0035
"""Of the weight: a hard narrow tyre on smooth asphalt to a soft wide one on a rough road."""

TYPICAL_AIR_NS2_M2, TYPICAL_AIR_LIMIT_NS2_M2 = 0.32, 0.12
"""Half of 1.2 kg/m3 times 0.33 m2 (hands low) to 0.73 m2 (upright, wide coat)."""


class Run(NamedTuple):
    """A coast-down. time_s, speed_ms: (n,), n >= 10. rise_m: from its begin to its end."""

    time_s: Sequence[float]
    speed_ms: Sequence[float]
    rise_m: float = 0.0


@dataclass(frozen=True, slots=True)
class ClimbInputs(Plain):
    """What is known besides, and how well: each `_limit` is a half width. wheels_kg: what the
    wheels' inertia adds to the mass. efficiency: from crank to road. speed_share: of the wheel's
    circumference. wind_limit_ms: along the climb, beyond that of the coast-downs."""

    mass_kg: float
    mass_limit_kg: float
    gravity_ms2: float
    rise_limit_m: float
    gravity_limit_ms2: float = 0.0
    efficiency: float = 0.97
    efficiency_limit: float = 0.015
    wheels_kg: float = 2.2
    wheels_limit_kg: float = 0.5
    speed_share_limit: float = 0.005
    wind_limit_ms: float = 0.5


@dataclass(frozen=True, slots=True)
class Resistance(Plain):
    """rolling_n: at any speed. air_ns2_m2: times the square of the speed. covariance: of the two,
    from the scatter of the runs about the model. source: `typical` of no runs."""

    rolling_n: float
    air_ns2_m2: float
    covariance: tuple[tuple[float, float], tuple[float, float]]
    source: Literal["coast_down", "typical"] = "coast_down"


def resistance(runs: Sequence[Run], climb_inputs: ClimbInputs) -> Resistance:
    """Rolling and air from coast-downs, at best the same stretch both ways; typical ones with wide
    limits without any.

    The momentum lost since each run's begin is f0 t + f2 integral(v^2 dt), less the slope's part:
    a line in two knowns, with each run's first speed free. Raises InvalidRequest.
    """
    if not runs:
        return typical(climb_inputs)
    _checked_runs(runs)
    heavy_kg = climb_inputs.mass_kg + climb_inputs.wheels_kg
    rows, lost = [], []
    for place, run in enumerate(runs):
        time_s, speed = as_array(run.time_s), as_array(run.speed_ms)
        time_s = time_s - time_s[0]
        squares = summed(speed**2, time_s)
        own = np.zeros((time_s.size, len(runs)))
        own[:, place] = 1.0
        rows.append(np.column_stack([time_s, squares, own]))
        distance_m = float(summed(speed, time_s)[-1])
        slope_n = climb_inputs.mass_kg * climb_inputs.gravity_ms2 * run.rise_m / distance_m
        lost.append(-heavy_kg * speed - slope_n * time_s)
    matrix, right_side = np.concatenate(rows), np.concatenate(lost)
    values = np.linalg.lstsq(matrix, right_side, rcond=None)[0]
    left = right_side - matrix @ values
    variance = float(left @ left) / (right_side.size - values.size)
    covariance = variance * np.linalg.pinv(matrix.T @ matrix)[:2, :2]
    (a, b), (c, d) = covariance.tolist()
    return Resistance(float(values[0]), float(values[1]), ((a, b), (c, d)))


def typical(climb_inputs: ClimbInputs) -> Resistance:
    """Of an unknown bike: rectangles wide enough for all bikes."""
    weight_n = climb_inputs.mass_kg * climb_inputs.gravity_ms2
    rolling = TYPICAL_ROLLING_LIMIT * weight_n / ROOT_3
    air = TYPICAL_AIR_LIMIT_NS2_M2 / ROOT_3
    covariance = ((rolling**2, 0.0), (0.0, air**2))
    return Resistance(TYPICAL_ROLLING * weight_n, TYPICAL_AIR_NS2_M2, covariance, "typical")


def _checked_runs(runs: Sequence[Run]) -> None:
    faults = []
    for place, run in enumerate(runs):
        time_s, speed = as_array(run.time_s), as_array(run.speed_ms)
        if not ordered(time_s, speed):
            field = f"runs[{place}]"
            message = f"{field}: ten samples or more, in order of time, finite"
            faults.append(FieldError(field, "wrong_shape", message))
        elif not speed.max() - speed.min() > 0.3 * speed.max():
            field = f"runs[{place}].speed_ms"
            message = f"{field}: the speed must fall by a third to tell rolling from air"
            faults.append(FieldError(field, "too_short", message))
    raise_if(faults)
