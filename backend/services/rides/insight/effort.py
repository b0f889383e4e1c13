"""How hard a ride was: zones, bands and best powers of its rider."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from backend.services.rides.insight.rows import WAY, RideColumns, columns_of
from backend.store import Store
from backend.views.insight import effort
from backend.views.insight.laps import MEANS, LapFigures, lap_figures
from backend.views.insight.power_curve import power_curve


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
        """The answer as the API tells it; what a ride has no channel for is None.

        threshold_power_w: what the rider can hold for an hour. heart_rate_bpm_max: his greatest.
        None: nobody told, so there are bands and no zones. Raises NotFound, ObjectDamaged.
        """
        ride = columns_of(self._store, ride_id, (*effort.NEEDED, *MEANS, *WAY))
        seconds = effort.by_seconds(ride.values, ride.start_s, ride.seconds)
        told = {
            "power": effort.power_time(seconds, threshold_power_w),
            "heart_rate": effort.heart_time(seconds, heart_rate_bpm_max),
            "torque": effort.torque_time(seconds),
            "cadence": effort.cadence_time(seconds),
        }
        power = ride.values.get(effort.POWER, np.empty(0))
        # A head unit without a meter may write nothing but zeros.
        given = bool(np.any(power > 0.0))
        curve = power_curve(power, ride.start_s, ride.seconds) if given else []
        return {
            "ride_id": ride_id,
            **{name: asdict(found) if found else None for name, found in told.items()},
            "torque_of_power": ride[effort.TORQUE] is None,
            "power_curve": [asdict(best) for best in curve],
            "laps": [asdict(lap) for lap in told_laps(ride)],
        }


def told_laps(ride: RideColumns) -> list[LapFigures]:
    """The laps that somebody marked off; a lap as long as the ride is none."""
    laps = [(lap.from_s, lap.to_s) for lap in ride.ride.noted.laps]
    if len(laps) < 2:
        return []
    step_m = ride.way.step_m if ride.way else None
    return lap_figures(ride.values, ride.start_s, ride.seconds, step_m, laps)
