"""A recorded ride as its twin reads it: in SI units, where it braked, and in which gear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.energy import KMH_PER_MS, RADIANS_PER_S_PER_RPM
from backend.errors import InvalidRequest
from sim_device.firmware.python import law

STANDING_MS = 0.3
ENGAGED_NM = 5.0
"""With less on the pedals the cranks may turn slower than the chainring."""
ENGAGED_RPM = 20.0
ONE_GEAR_SHARE = 0.06
"""Within it the reach is that of one gear: the unit's cadence and speed are no better."""
ONE_GEAR_TIME = 0.995
"""Of the pedalling; the rest is a speed that is late, as after a start with few pulses a turn. Low
gears at the starts alone were 7 % of the pedalling of a ride, and 4 % of the motor's work."""
GEAR_SAMPLES = 51
BRAKING_MS2 = -1.1
BRAKING_WINDOW_S = 0.3
FREE_RIDER_NM = 3.0
FREE_MOTOR_NM = 0.02

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
Columns = Mapping[str, Floats]


@dataclass(frozen=True, slots=True)
class Recorded:
    """The recorded ride in SI units, (n,) each, and what it came to."""

    step_s: float
    distance_m: Floats
    speed_ms: Floats
    crank_rad_s: Floats
    rider_nm: Floats
    motor_nm: Floats
    motor_rad_s: Floats
    brake: Bools
    mode: npt.NDArray[np.uint8]
    motor_degc: Floats
    controller_degc: Floats
    voltage_v: Floats | None
    current_a: Floats | None
    limit_flags: Floats | None

    @property
    def duration_s(self) -> float:
        """From the first sample to the end of the last."""
        return self.distance_m.size * self.step_s

    @property
    def motor_work_j(self) -> float:
        """At the motor's shaft."""
        return float((self.motor_nm * self.motor_rad_s).sum() * self.step_s)


def recorded(columns: Columns, config: Mapping[str, Any], step_s: float) -> Recorded:
    """The columns of a ride as the twin reads them. Lost rows are as the one before them, at the
    start as the first one: the bike did not stop for them.

    columns: speed_kmh, cadence_rpm, assist_mode, motor_torque_nm (delivered), rider_torque_raw or
    rider_torque_nm, (n,) each, missing as NaN; motor_speed_rpm, battery_voltage_v,
    battery_current_a, motor_temperature_degc, controller_temperature_degc, limit_flags and `brake`
    may be there.
    """
    there = np.isfinite(columns["speed_kmh"])
    latest = np.maximum.accumulate(np.where(there, np.arange(there.size), np.argmax(there)))
    columns = {name: values[latest] for name, values in columns.items()}
    speed_ms = np.nan_to_num(columns["speed_kmh"]) / KMH_PER_MS
    cadence_rad_s = np.nan_to_num(columns["cadence_rpm"]) * RADIANS_PER_S_PER_RPM
    if "rider_torque_raw" in columns:
        degc = columns.get("sensor_temperature_degc", np.nan)
        counts = columns["rider_torque_raw"]
        rider_nm = law.rider_torque_nm(config, counts, degc).astype(np.float64)
    else:
        rider_nm = columns["rider_torque_nm"]
    motor_rad_s = cadence_rad_s * config["gear_ratio"]
    if "motor_speed_rpm" in columns:
        motor_rad_s = np.nan_to_num(columns["motor_speed_rpm"]) * RADIANS_PER_S_PER_RPM
    unknown = np.full(speed_ms.size, np.nan)
    return Recorded(
        step_s=step_s,
        distance_m=np.concatenate(([0.0], np.cumsum(speed_ms)[:-1])) * step_s,
        speed_ms=speed_ms,
        crank_rad_s=cadence_rad_s,
        rider_nm=np.nan_to_num(rider_nm),
        motor_nm=np.nan_to_num(columns["motor_torque_nm"]),
        motor_rad_s=motor_rad_s,
        brake=columns.get("brake", np.zeros(speed_ms.size)) > 0,
        mode=np.nan_to_num(columns["assist_mode"]).astype(np.uint8),
        motor_degc=columns.get("motor_temperature_degc", unknown),
        controller_degc=columns.get("controller_temperature_degc", unknown),
        voltage_v=columns.get("battery_voltage_v"),
        current_a=columns.get("battery_current_a"),
        limit_flags=columns.get("limit_flags"),
    )


def reach_of(ride: Recorded) -> Floats:
    """Metres the bike goes for a radian of the chainring, (n,): what the pushed cranks tell, held
    where nobody pushes. Raises InvalidRequest if nobody does."""
    pushed = (ride.rider_nm > ENGAGED_NM) & (ride.crank_rad_s > ENGAGED_RPM * RADIANS_PER_S_PER_RPM)
    pushed &= ride.speed_ms > 1.0
    if not pushed.any():
        raise InvalidRequest("This ride cannot be ridden again: nobody pedals.", "no_pedalling")
    reach = ride.speed_ms[pushed] / ride.crank_rad_s[pushed]
    middle = float(np.median(reach))
    reach = smoothed(reach, GEAR_SAMPLES)
    if np.mean(np.abs(reach / middle - 1.0) < ONE_GEAR_SHARE) > ONE_GEAR_TIME:
        return np.full(ride.speed_ms.size, middle)
    return np.asarray(np.interp(np.arange(ride.speed_ms.size), np.flatnonzero(pushed), reach))


def smoothed(values: Floats, width: int) -> Floats:
    """Running median over `width` samples, (n,)."""
    half = min(width // 2, (values.size - 1) // 2)
    padded = np.pad(values, half, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    return np.asarray(np.median(windows, axis=1))


def braking_at(ride: Recorded) -> Bools:
    """Where the rider brakes, (n,): the lever says so, or the bike slows as no road makes it."""
    width = max(round(BRAKING_WINDOW_S / ride.step_s), 1)
    gain_ms = ride.speed_ms[width:] - ride.speed_ms[:-width]
    slows = np.zeros(ride.speed_ms.size, np.bool_)
    slows[width // 2 : width // 2 + gain_ms.size] = gain_ms / (width * ride.step_s) < BRAKING_MS2
    slows &= (ride.rider_nm < FREE_RIDER_NM) & (ride.motor_nm < FREE_MOTOR_NM)
    return ride.brake | slows
