"""Torque over the crank's angle, and where the gain was at which speed.

Which leg, where the dead spot is, and how far the assist lags. The angle is 0 with the left crank
up, so the left leg pushes from 0 to 180 degrees and the right one from there on. A sensor on the
spindle feels both legs at once: what a half of the turn shows is the leg that pushes less what the
other one drags. Two strokes make a turn, so torque swings with twice its speed; the lag of the
motor is the phase between both swings of that fundamental, counted in degrees of the crank.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values
from backend.core.energy import rate_hz

BINS = 36
ANGLE_DEG = 360.0 / BINS
STROKES = 2
TURNS_MIN = 20.0
"""Fewer turns are one start or one bump."""
CADENCE_RPM_MIN = 20.0
RATE_HZ_MIN = 20.0
"""At 90 rpm so many rows still tell a turn in 13 places."""
RIPPLE_MIN = 0.05
"""Of its mean: a motor whose torque swings less does not follow the stroke, and has no lag."""
DEGREES_PER_S_PER_RPM = 6.0


@dataclass(frozen=True)
class CrankTorque:
    """Means over turning cranks, bin by bin (BINS,) from 0 degrees on.

    left_share: of the rider's work, by the halves of the turn. dead_spot_deg: the middle of the
    weakest bin; dead_spot_share: its torque over the mean. lag_deg, lag_ms: of the motor behind the
    rider, at the mean cadence; None where the motor's torque is not known or does not swing.
    """

    turns: float
    cadence_rpm: float
    rider_nm: tuple[float, ...]
    motor_nm: tuple[float, ...] | None
    left_share: float | None
    dead_spot_deg: float
    dead_spot_share: float | None
    lag_deg: float | None
    lag_ms: float | None


def crank_torque(
    angle_deg: Values,
    rider_nm: Values,
    motor_nm: Values | None,
    cadence_rpm: Values,
    seconds: Values,
) -> CrankTorque | str:
    """Of rows (n,), missing as NaN; or a code of why there is none: `slow_rows`, `few_turns`.

    motor_nm: what the motor gave, at the crank; None where that is not known.
    """
    if (rate_hz(seconds) or 0.0) < RATE_HZ_MIN:
        return "slow_rows"
    turning = np.isfinite(angle_deg) & np.isfinite(rider_nm) & (cadence_rpm >= CADENCE_RPM_MIN)
    if motor_nm is not None:
        turning &= np.isfinite(motor_nm)
    turning_s = seconds[turning]
    turns = float((cadence_rpm[turning] * turning_s).sum()) / 60.0
    places = (np.mod(angle_deg[turning], 360.0) // ANGLE_DEG).astype(np.intp) % BINS
    spent_s = np.bincount(places, turning_s, minlength=BINS)
    if turns < TURNS_MIN or not spent_s.all():
        return "few_turns"
    rider = np.bincount(places, rider_nm[turning] * turning_s, minlength=BINS) / spent_s
    motor = None
    if motor_nm is not None:
        motor = np.bincount(places, motor_nm[turning] * turning_s, minlength=BINS) / spent_s
    mean_nm = float(rider.mean())
    weakest = int(np.argmin(rider))
    cadence = turns * 60.0 / float(turning_s.sum())
    lag_deg = None if motor is None else lag(rider, motor)
    return CrankTorque(
        turns=turns,
        cadence_rpm=cadence,
        rider_nm=tuple(rider.tolist()),
        motor_nm=None if motor is None else tuple(motor.tolist()),
        left_share=float(rider[: BINS // 2].mean()) / (2.0 * mean_nm) if mean_nm > 0.0 else None,
        dead_spot_deg=(weakest + 0.5) * ANGLE_DEG,
        dead_spot_share=float(rider[weakest]) / mean_nm if mean_nm > 0.0 else None,
        lag_deg=lag_deg,
        lag_ms=None if lag_deg is None else 1000.0 * lag_deg / (cadence * DEGREES_PER_S_PER_RPM),
    )


def lag(rider_nm: Values, motor_nm: Values) -> float | None:
    """Degrees of the crank by which the motor's swing follows the rider's, -90 to 90."""
    swings = [np.fft.rfft(values)[STROKES] / BINS * 2.0 for values in (rider_nm, motor_nm)]
    for swing, values in zip(swings, (rider_nm, motor_nm), strict=True):
        if abs(swing) < RIPPLE_MIN * abs(float(values.mean())) or abs(swing) == 0.0:
            return None
    return float(np.degrees(np.angle(swings[0] * np.conj(swings[1])))) / STROKES


SPEED_STEP_KMH, GAIN_STEP = 2.0, 0.05
SPEEDS_MAX, GAINS_MAX = 25, 40
"""Up to 50 km/h and a gain of 2; what lies above is in the last cell."""


@dataclass(frozen=True)
class GainMap:
    """seconds: [speed][gain], time in cells of SPEED_STEP_KMH and GAIN_STEP from zero on."""

    speed_step_kmh: float
    gain_step: float
    seconds: tuple[tuple[float, ...], ...]


def gain_map(speed_kmh: Values, gain: Values, seconds: Values) -> GainMap | None:
    """Of rows (n,), missing as NaN, in which a table gave a gain; None without any."""
    valid = np.isfinite(speed_kmh) & np.isfinite(gain) & (gain > 0.0) & (speed_kmh >= 0.0)
    if not valid.any():
        return None
    row = np.minimum((speed_kmh[valid] // SPEED_STEP_KMH).astype(np.intp), SPEEDS_MAX - 1)
    column = np.minimum((gain[valid] // GAIN_STEP).astype(np.intp), GAINS_MAX - 1)
    rows, columns = int(row.max()) + 1, int(column.max()) + 1
    cells = np.bincount(row * columns + column, seconds[valid], minlength=rows * columns)
    gains = tuple(tuple(line) for line in cells.reshape(rows, columns).tolist())
    return GainMap(SPEED_STEP_KMH, GAIN_STEP, gains)
