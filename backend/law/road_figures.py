"""What a ride over a road came to: the same figures of the record and of its twin, and the two
beside one another over the distance."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from backend.core.energy import KMH_PER_MS
from backend.law.recorded_ride import STANDING_MS, Bools, Floats, Recorded
from sim_device.firmware.python.law import LIMITS
from sim_device.firmware.python.twin import Totals

DURATION = "duration_s"
MOTOR_WORK = "motor_work_j"
BATTERY = "battery_j"
RIPPLE = "ripple_nm_per_s"
BINS_MAX = 400
SHORTEST_S = 1e-9
RECORDED_SHARE_MIN = 0.99
"""With less of voltage and current known the battery's energy is not."""

Figures = dict[str, float]


def figures_of(totals: Totals) -> Figures:
    """Of a twin's ride, as of a recorded one."""
    moving_s = max(totals.moving_s, SHORTEST_S)
    return {
        DURATION: totals.duration_s,
        MOTOR_WORK: totals.motor_work_j,
        "rider_work_j": totals.rider_work_j,
        BATTERY: totals.battery_j,
        "motor_power_w": totals.motor_work_j / moving_s,
        RIPPLE: math.sqrt(totals.ripple_nm2_per_s / moving_s),
    }


def figures_of_record(ride: Recorded) -> Figures:
    """The same of a recorded ride; NaN for a battery that was not measured."""
    moving = ride.speed_ms > STANDING_MS
    return {
        DURATION: ride.duration_s,
        MOTOR_WORK: ride.motor_work_j,
        "rider_work_j": float((ride.rider_nm * ride.crank_rad_s).sum() * ride.step_s),
        BATTERY: battery_j(ride),
        "motor_power_w": power_w_mean(ride.motor_work_j, moving, ride.step_s),
        RIPPLE: ripple_nm_per_s(ride.motor_nm, moving, ride.step_s),
    }


def power_w_mean(work_j: float, moving: Bools, step_s: float) -> float:
    """Over the time on the way. moving: (n,)."""
    return work_j / max(float(np.count_nonzero(moving)) * step_s, SHORTEST_S)


def ripple_nm_per_s(motor_nm: Floats, moving: Bools, step_s: float) -> float:
    """Rms of how fast the motor's torque changes on the way, by the rises that are known.

    motor_nm: at its shaft, (n,), missing as NaN. moving: (n,).
    """
    rises = np.diff(motor_nm, prepend=motor_nm[:1])[moving] / step_s
    finite = rises[np.isfinite(rises)]
    return math.sqrt(float(np.mean(finite**2))) if finite.size else 0.0


def battery_j(ride: Recorded) -> float:
    """What left the battery; NaN where too little of it was measured."""
    if ride.voltage_v is None or ride.current_a is None:
        return math.nan
    power_w = ride.voltage_v * ride.current_a
    if np.mean(np.isfinite(power_w)) < RECORDED_SHARE_MIN:
        return math.nan
    return float(np.nansum(power_w) * ride.step_s)


def limits_of_record(ride: Recorded) -> dict[str, float] | None:
    """Seconds on the way that each limit was at work; None where the ride does not tell."""
    if ride.limit_flags is None or not np.isfinite(ride.limit_flags).any():
        return None
    moving = (ride.speed_ms > STANDING_MS) & np.isfinite(ride.limit_flags)
    flags = ride.limit_flags[moving].astype(np.uint16)
    return {name: np.count_nonzero(flags & flag) * ride.step_s for name, flag in LIMITS.items()}


def places_km(ride: Recorded, turn_m: float) -> Floats:
    """Ends of the stretches that curves are drawn over, (n + 1,): none shorter than a turn of the
    crank, so that the stroke is no ripple of the picture."""
    end_m = float(ride.distance_m[-1])
    count = int(min(max(end_m / turn_m, 1.0), BINS_MAX))
    return np.asarray(np.linspace(0.0, end_m / 1000.0, count + 1), np.float64)


def curves_of_record(ride: Recorded, ends_km: Floats) -> dict[str, Floats]:
    """As `curves_of`, of a recorded ride."""
    t_s = np.asarray(np.arange(ride.speed_ms.size) * ride.step_s, np.float64)
    return over_places(
        ends_km, t_s, ride.distance_m, ride.speed_ms, ride.motor_nm, ride.speed_ms > STANDING_MS
    )


def curves_of(samples: npt.NDArray[np.void], ends_km: Floats) -> dict[str, Floats]:
    """Time at the middle of each stretch, and means over it: t_s, speed_kmh, motor_torque_nm, (n,)
    each; NaN where the ride has no sample. samples: SAMPLE_DTYPE (m,)."""
    moving = np.ones(samples.size, np.bool_)
    return over_places(
        ends_km,
        samples["t_s"],
        samples["distance_m"],
        samples["speed_ms"],
        samples["motor_nm"],
        moving,
    )


def over_places(
    ends_km: Floats,
    t_s: Floats,
    distance_m: Floats,
    speed_ms: Floats,
    motor_nm: Floats,
    moving: npt.NDArray[np.bool_],
) -> dict[str, Floats]:
    """Means over each stretch, of the samples on the way; see curves_of."""
    count = ends_km.size - 1
    stretch = np.clip(np.searchsorted(ends_km * 1000.0, distance_m, side="right") - 1, 0, count - 1)
    samples = np.bincount(stretch[moving], minlength=count)

    def mean(values: Floats) -> Floats:
        total = np.bincount(stretch[moving], values[moving], minlength=count)
        return np.asarray(np.where(samples > 0, total / np.maximum(samples, 1), np.nan))

    return {
        "t_s": mean(t_s),
        "speed_kmh": mean(speed_ms) * KMH_PER_MS,
        "motor_torque_nm": mean(motor_nm),
    }
