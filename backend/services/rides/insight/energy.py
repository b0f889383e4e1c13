"""Where a ride's energy went: rider, motor and battery apart, by mode and by gradient."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import pairwise
from typing import Any

import numpy as np

from backend.core.energy import BATTERY_POWER, MOTOR_POWER, RIDER_POWER
from backend.services.rides.insight.rows import WAY, RideColumns, columns_of
from backend.services.rides.settings_in_force import ConfigOf, Stretch, source_of, stretches
from backend.store import Store
from backend.views.insight.charge import Charge, charge_of
from backend.views.insight.energy_split import GRADIENT_EDGES_PCT, by_gradient, energy_shares
from backend.views.insight.way import climb_of, gradient_pct

MODE, ALTITUDE, SOC = "assist_mode", "altitude_m", "battery_soc_pct"
POWERS = (RIDER_POWER.name, MOTOR_POWER.name, BATTERY_POWER.name)
NEEDED = (*POWERS, *WAY, MODE, ALTITUDE, SOC)


class RideEnergy:
    """Adds up one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as the API tells it. Raises NotFound, ObjectDamaged."""
        ride = columns_of(self._store, ride_id, NEEDED)
        step_m = ride.way.step_m if ride.way else None
        everything = np.zeros(len(ride.seconds), np.intp)
        (whole,) = energy_shares(ride.values, ride.seconds, step_m, everything, 1)
        km = whole.distance_km or 0.0
        gradients, unknown_s = told_gradients(ride)
        altitude = ride[ALTITUDE]
        climb = ride.way and altitude is not None and climb_of(altitude, ride.way, ride.start_s)
        soc = ride[SOC]
        charge = None
        if soc is not None:
            charge = charge_of(soc, ride[BATTERY_POWER.name], ride.seconds, step_m)
        return {
            "ride_id": ride_id,
            "whole": asdict(whole),
            "lost_km": ride.way.lost_m / 1000.0 if ride.way else None,
            "battery_wh_per_km": whole.battery_wh / km if whole.battery_wh and km else None,
            "modes": told_modes(ride, stretches(self._config_of, ride.ride)),
            "gradients": gradients,
            "gradient_unknown_s": unknown_s,
            "climb": asdict(climb) if climb else None,
            "charge": asdict(charge) if charge else None,
            "range_refused": refused(charge),
        }


def told_modes(ride: RideColumns, parts: Sequence[Stretch]) -> list[dict[str, Any]]:
    """The modes that were selected; names only where they are known, as they were at the end."""
    mode = ride[MODE]
    if mode is None or not np.isfinite(mode).any():
        return []
    there = np.isfinite(mode)
    slots, places = np.unique(mode[there].astype(np.intp), return_inverse=True)
    groups = np.full(len(mode), -1, np.intp)
    groups[there] = places
    step_m = ride.way.step_m if ride.way else None
    shares = energy_shares(ride.values, ride.seconds, step_m, groups, len(slots))
    names = parts[-1].config["mode_names"] if source_of(parts) == "ride" else ()
    return [
        {"mode": int(slot), "name": names[slot] if slot < len(names) else None, **asdict(share)}
        for slot, share in zip(slots, shares, strict=True)
    ]


def told_gradients(ride: RideColumns) -> tuple[list[dict[str, Any]] | None, float | None]:
    """Bands of gradient that were ridden, and how long it was not known; None without heights."""
    altitude = ride[ALTITUDE]
    if altitude is None or ride.way is None:
        return None, None
    groups = by_gradient(gradient_pct(altitude, ride.way, ride.start_s))
    edges = (None, *GRADIENT_EDGES_PCT, None)
    count = len(edges) - 1
    shares = energy_shares(ride.values, ride.seconds, ride.way.step_m, groups, count)
    bands = [
        {"from_pct": low, "to_pct": high, **asdict(share)}
        for (low, high), share in zip(pairwise(edges), shares, strict=True)
        if share.seconds > 0.0
    ]
    return bands, float(ride.seconds[groups < 0].sum())


def refused(charge: Charge | None) -> str | None:
    """Why there is no range, a code; None where there is one."""
    return "no_charge" if charge is None else charge.refused
