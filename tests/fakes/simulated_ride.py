"""A ride of the simulated bike as its recorder would have kept it, in virtual time."""

from __future__ import annotations

from typing import Any

import numpy as np

from backend.core.channels import Values
from sim_device.lockstep import LockstepUnit

LOOK_S = 0.02
GAIN_NM_PER_COUNT = 0.01
SEEN = {
    "rider_torque_raw": "torque_raw_counts",
    "motor_torque_demanded_nm": "motor_demand_nm",
    **{
        name: name
        for name in (
            *("speed_kmh", "cadence_rpm", "crank_angle_deg", "assist_mode", "motor_torque_nm"),
            *("motor_speed_rpm", "battery_voltage_v", "battery_current_a", "battery_soc_pct"),
            *("motor_temperature_degc", "controller_temperature_degc", "torque_age_ms"),
            *("limit_flags", "fuzzy_gain", "torque_rate", "distance_m"),
        )
    },
}
"""Channel of a ride -> what an observer beside the bike sees."""

Step = tuple[float, dict[str, Any]]


def simulated_ride(
    steps: list[Step] | str, seed: int = 5, bike: dict[str, float] | None = None
) -> dict[str, Values]:
    """Columns (n,) every LOOK_S. steps: (seconds, what is changed before them), or a scenario."""
    scenario = steps if isinstance(steps, str) else None
    unit = LockstepUnit(seed, scenario=scenario, bike={"sensor.noise_nm": 0.06} | (bike or {}))
    if scenario is not None:
        seen = list(unit.ride_once(LOOK_S))
    else:
        seen = []
        for seconds, changes in steps:
            unit.simulation_set(changes)
            for _ in range(round(seconds / LOOK_S)):
                unit.advance(LOOK_S)
                seen.append(unit.observe())
    columns = {name: np.array([one[key] for one in seen], np.float64) for name, key in SEEN.items()}
    columns["rider_torque_nm"] = columns["rider_torque_raw"] * GAIN_NM_PER_COUNT
    return columns
