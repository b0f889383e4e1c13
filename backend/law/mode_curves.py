"""What each of the five modes gives for a steady push, over speed, by the unit's own law."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.errors import InvalidRequest
from backend.law.ride_replay import raw_counts_of, replay
from sim_device.firmware.python import law

CADENCE_RPM = 60.0
HARD_PUSH_NM = 120.0
"""What a strong rider stamps with: it shows where the limits end the assist."""
MODES = 5
SPEEDS_MAX = 60
FIRST_S, NEXT_S = 20.0, 2.0
"""How long each speed is held: the first until the slowest ramp of 5 Nm/s has come to its end."""

Config = Mapping[str, Any]
Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class ModeCurve:
    """Of one mode, at the crank, after every limit. torque_nm: at each speed, (n,).

    torque_nm_most: for HARD_PUSH_NM of the rider's, at the speed where it is most.
    """

    torque_nm: Floats
    torque_nm_most: float


def mode_curves(
    config: Config, rider_torque_nm: float, speeds_kmh: npt.ArrayLike
) -> list[ModeCurve]:
    """The five modes in the order of their slots, at CADENCE_RPM, the torque held steady.

    config: the unit's parameters by registry name. speeds_kmh: (n,), increasing. Raises
    InvalidRequest for what the law refuses.
    """
    speeds = np.asarray(speeds_kmh, np.float32)
    if not 1 <= speeds.size <= SPEEDS_MAX:
        raise InvalidRequest(f"give 1 to {SPEEDS_MAX} speeds", "too_many_points")
    curves = []
    for mode in range(MODES):
        pushed = _steady_torque(config, mode, rider_torque_nm, speeds)
        most = _steady_torque(config, mode, HARD_PUSH_NM, speeds)
        curves.append(ModeCurve(pushed, float(most.max())))
    return curves


def _steady_torque(config: Config, mode: int, rider_torque_nm: float, speeds: Floats) -> Floats:
    """Motor torque at the crank at the end of each speed's time, (n,)."""
    steps = np.full(speeds.size, round(NEXT_S / law.STEP_S))
    steps[0] = round(FIRST_S / law.STEP_S)
    repeated = np.repeat(speeds, steps)
    every = np.ones_like(repeated)
    answer = replay(
        config,
        speed_kmh=repeated,
        cadence_rpm=every * np.float32(CADENCE_RPM),
        torque_raw_counts=every * raw_counts_of(config, rider_torque_nm),
        mode=np.full(repeated.size, mode, np.uint8),
    )
    at_shaft = answer.motor_torque_nm[np.cumsum(steps) - 1]
    return np.asarray(at_shaft * np.float32(config["gear_ratio"]), np.float32)
