"""How a ride was pedalled: torque over the crank's angle, and the gain over the speed."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from backend.core.energy import DELIVERED, MOTOR_TORQUE_CRANK
from backend.services.rides.insight.rows import RideColumns, columns_of
from backend.services.rides.settings_in_force import ConfigOf, all_through
from backend.store import Store
from backend.views.insight.crank import CrankTorque, crank_torque
from backend.views.insight.gain_map import gain_map

ANGLE, TORQUE, CADENCE = "crank_angle_deg", "rider_torque_nm", "cadence_rpm"
SPEED, GAIN = "speed_kmh", "fuzzy_gain"
NEEDED = (ANGLE, TORQUE, CADENCE, MOTOR_TORQUE_CRANK.name, SPEED, GAIN)


class RidePedalling:
    """Looks at one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as the API tells it. Raises NotFound, ObjectDamaged."""
        ride = columns_of(self._store, ride_id, NEEDED)
        crank = told_crank(ride)
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


def told_crank(ride: RideColumns) -> CrankTorque | str:
    """The torque over the angle, or why it cannot be told."""
    angle, torque, cadence = ride[ANGLE], ride[TORQUE], ride[CADENCE]
    if angle is None:
        return "no_angle"
    if torque is None or cadence is None:
        return "no_torque"
    delivered = ride.ride.motor_torque_meaning == DELIVERED
    motor = ride[MOTOR_TORQUE_CRANK.name] if delivered else None
    return crank_torque(angle, torque, motor, cadence, ride.seconds)
