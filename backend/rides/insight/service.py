"""Where a ride's energy went, how hard it was, and how it was pedalled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import pairwise
from typing import Any

import numpy as np

from backend.core.distance import DISTANCE_CHANNELS
from backend.core.energy import (
    BATTERY_POWER,
    DELIVERED,
    MOTOR_POWER,
    MOTOR_TORQUE_CRANK,
    RIDER_POWER,
)
from backend.rides.insight import effort
from backend.rides.insight.charge import Charge, charge_of
from backend.rides.insight.crank import CrankTorque, crank_torque, gain_map
from backend.rides.insight.effort import MEANS, LapFigures, lap_figures
from backend.rides.insight.energy_split import GRADIENT_EDGES_PCT, by_gradient, energy_shares
from backend.rides.insight.gradient import climb_of, gradient_pct
from backend.rides.insight.power_curve import power_curve
from backend.rides.rows import RideColumns, columns_of
from backend.rides.settings_in_force import ConfigOf, Stretch, all_through, source_of, stretches
from backend.store import Store

MODE, ALTITUDE, SOC = "assist_mode", "altitude_m", "battery_soc_pct"
POWERS = (RIDER_POWER.name, MOTOR_POWER.name, BATTERY_POWER.name)
ENERGY_CHANNELS = (*POWERS, *DISTANCE_CHANNELS, MODE, ALTITUDE, SOC)


class RideEnergy:
    """Adds up one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as in the API. Raises NotFound, ObjectDamaged."""
        ride = columns_of(self._store, ride_id, ENERGY_CHANNELS)
        step_m = ride.distances.step_m if ride.distances else None
        everything = np.zeros(len(ride.seconds), np.intp)
        (total,) = energy_shares(ride.values, ride.seconds, step_m, everything, 1)
        km = total.distance_km or 0.0
        gradients, unknown_s = gradient_shares(ride)
        altitude = ride[ALTITUDE]
        climb = (
            ride.distances
            and altitude is not None
            and climb_of(altitude, ride.distances, ride.start_s)
        )
        soc = ride[SOC]
        charge = None
        if soc is not None:
            charge = charge_of(soc, ride[BATTERY_POWER.name], ride.start_s, ride.seconds, step_m)
        return {
            "ride_id": ride_id,
            "total": asdict(total),
            "lost_km": ride.distances.lost_m / 1000.0 if ride.distances else None,
            "battery_wh_per_km": total.battery_wh / km if total.battery_wh and km else None,
            "modes": mode_shares(ride, stretches(self._config_of, ride.ride)),
            "gradients": gradients,
            "gradient_unknown_s": unknown_s,
            "climb": asdict(climb) if climb else None,
            "charge": charge,
            "range_refused": refused(charge),
        }


def mode_shares(ride: RideColumns, parts: Sequence[Stretch]) -> list[dict[str, Any]]:
    """The modes that were selected; names only where they are known, as they were at the end."""
    mode = ride[MODE]
    if mode is None or not np.isfinite(mode).any():
        return []
    valid = np.isfinite(mode)
    slots, places = np.unique(mode[valid].astype(np.intp), return_inverse=True)
    groups = np.full(len(mode), -1, np.intp)
    groups[valid] = places
    step_m = ride.distances.step_m if ride.distances else None
    shares = energy_shares(ride.values, ride.seconds, step_m, groups, len(slots))
    names = parts[-1].config["mode_names"] if source_of(parts) == "ride" else ()
    return [
        {"mode": int(slot), "name": names[slot] if slot < len(names) else None, **asdict(share)}
        for slot, share in zip(slots, shares, strict=True)
    ]


def gradient_shares(ride: RideColumns) -> tuple[list[dict[str, Any]] | None, float | None]:
    """Bands of gradient that were ridden, and how long it was not known; None without heights."""
    altitude = ride[ALTITUDE]
    if altitude is None or ride.distances is None:
        return None, None
    groups = by_gradient(gradient_pct(altitude, ride.distances, ride.start_s))
    edges = (None, *GRADIENT_EDGES_PCT, None)
    count = len(edges) - 1
    shares = energy_shares(ride.values, ride.seconds, ride.distances.step_m, groups, count)
    bands = [
        {"from_pct": low, "to_pct": high, **asdict(share)}
        for (low, high), share in zip(pairwise(edges), shares, strict=True)
        if share.seconds > 0.0
    ]
    return bands, float(ride.seconds[groups < 0].sum())


def refused(charge: Charge | None) -> str | None:
    """Why there is no range, a code; None where there is one."""
    return "no_charge" if charge is None else charge.refused


class RideEffort:
    """Looks at one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def __call__(
        self,
        ride_id: int,
        threshold_power_w: float | None = None,
        heart_rate_bpm_max: float | None = None,
    ) -> dict[str, Any]:
        """The answer as in the API; what a ride has no channel for is None.

        threshold_power_w: what the rider can hold for an hour. heart_rate_bpm_max: his greatest.
        None: not given, so there are bands and no zones. Raises NotFound, ObjectDamaged.
        """
        ride = columns_of(self._store, ride_id, (*effort.NEEDED, *MEANS, *DISTANCE_CHANNELS))
        seconds = effort.by_seconds(ride.values, ride.start_s, ride.seconds)
        distributions = {
            "power": effort.power_time(seconds, threshold_power_w),
            "heart_rate": effort.heart_time(seconds, heart_rate_bpm_max),
            "torque": effort.torque_time(seconds),
            "cadence": effort.cadence_time(seconds),
        }
        power = ride.values.get(effort.POWER, np.empty(0))
        # A head unit without a meter may write nothing but zeros.
        has_power = bool(np.any(power > 0.0))
        curve = power_curve(power, ride.start_s, ride.seconds) if has_power else []
        return {
            "ride_id": ride_id,
            **{name: asdict(found) if found else None for name, found in distributions.items()},
            "torque_of_power": ride[effort.TORQUE] is None,
            "power_curve": [asdict(best) for best in curve],
            "laps": [asdict(lap) for lap in laps_of_ride(ride)],
        }


def laps_of_ride(ride: RideColumns) -> list[LapFigures]:
    """The laps that somebody marked off; a lap as long as the ride is none."""
    laps = [(lap.from_s, lap.to_s) for lap in ride.ride.metadata.laps]
    if len(laps) < 2:
        return []
    step_m = ride.distances.step_m if ride.distances else None
    return lap_figures(ride.values, ride.start_s, ride.seconds, step_m, laps)


ANGLE, TORQUE, CADENCE = "crank_angle_deg", "rider_torque_nm", "cadence_rpm"
SPEED, GAIN = "speed_kmh", "fuzzy_gain"
PEDALLING_CHANNELS = (ANGLE, TORQUE, CADENCE, MOTOR_TORQUE_CRANK.name, SPEED, GAIN)


class RidePedalling:
    """Looks at one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as in the API. Raises NotFound, ObjectDamaged."""
        ride = columns_of(self._store, ride_id, PEDALLING_CHANNELS)
        crank = crank_of_ride(ride)
        speed, gain = ride[SPEED], ride[GAIN]
        of_gain = None
        if speed is not None and gain is not None:
            of_gain = gain_map(speed, gain, ride.seconds)
        points, _ = all_through(self._config_of, ride.ride)
        return {
            "ride_id": ride_id,
            "crank": asdict(crank) if isinstance(crank, CrankTorque) else None,
            "crank_refused": crank if isinstance(crank, str) else None,
            "gain": asdict(of_gain) if of_gain else None,
            "speed_points_kmh": points.get("fuzzy_speed_points_kmh"),
            "gain_points": points.get("fuzzy_gain_points"),
        }


def crank_of_ride(ride: RideColumns) -> CrankTorque | str:
    """The torque over the angle, or a code of why there is none."""
    angle, torque, cadence = ride[ANGLE], ride[TORQUE], ride[CADENCE]
    if angle is None:
        return "no_angle"
    if torque is None or cadence is None:
        return "no_torque"
    delivered = ride.ride.motor_torque_meaning == DELIVERED
    motor = ride[MOTOR_TORQUE_CRANK.name] if delivered else None
    return crank_torque(angle, torque, motor, cadence, ride.seconds)
