"""Rider, motor and battery apart: energy, way and time of groups of a ride's rows.

Three energies stand side by side and are never added. The ratio of the motor's work to the rider's
is of the moments in which both are known.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.energy import BATTERY_POWER, MOTOR_POWER, RIDER_POWER, SECONDS_PER_HOUR

GRADIENT_EDGES_PCT = (-6.0, -2.0, 2.0, 6.0, 10.0)

Groups = npt.NDArray[np.intp]


@dataclass(frozen=True)
class EnergyShare:
    """One group: None where the ride has no such channel, or the group no sample of it."""

    seconds: float
    distance_km: float | None
    rider_wh: float | None
    motor_wh: float | None
    battery_wh: float | None
    motor_per_rider: float | None


def energy_shares(
    columns: Mapping[str, Values],
    seconds: Values,
    step_m: Values | None,
    groups: Groups,
    count: int,
) -> list[EnergyShare]:
    """The share of each of `count` groups.

    columns: powers (n,) as far as there are any, missing as NaN. seconds, step_m: (n,), how long
    each row holds and the way ridden in it. groups: (n,), 0 to count - 1, negative for none.
    """
    inside = groups >= 0
    of = groups[inside]

    def summed(amounts: Values) -> Values:
        total: Values = np.bincount(of, amounts[inside], minlength=count).astype(np.float64)
        return total

    def energy_wh(power_w: Values, present: npt.NDArray[np.bool_]) -> list[float | None]:
        present_count = np.bincount(of[present[inside]], minlength=count)
        energy = summed(np.where(present, power_w, 0.0) * seconds) / SECONDS_PER_HOUR
        return [float(wh) if rows else None for wh, rows in zip(energy, present_count, strict=True)]

    none: list[float | None] = [None] * count
    powers = {name: columns.get(name) for name in (RIDER_POWER.name, MOTOR_POWER.name)}
    rider, motor = powers.values()
    both_rider, both_motor = none, none
    if rider is not None and motor is not None:
        both = np.isfinite(rider) & np.isfinite(motor)
        both_rider, both_motor = energy_wh(rider, both), energy_wh(motor, both)
    spent = [
        none if power is None else energy_wh(power, np.isfinite(power))
        for power in (rider, motor, columns.get(BATTERY_POWER.name))
    ]
    seconds_in = summed(seconds)
    km = none if step_m is None else [float(metres) / 1000.0 for metres in summed(step_m)]
    return [
        EnergyShare(
            float(seconds_in[group]),
            km[group],
            spent[0][group],
            spent[1][group],
            spent[2][group],
            ratio(both_motor[group], both_rider[group]),
        )
        for group in range(count)
    ]


def ratio(motor_wh: float | None, rider_wh: float | None) -> float | None:
    """Motor over rider; None where the rider gave nothing or one of them is not known."""
    if motor_wh is None or not rider_wh or rider_wh <= 0.0:
        return None
    return motor_wh / rider_wh


def by_gradient(gradient_pct: Values) -> Groups:
    """The band of each row (n,) among GRADIENT_EDGES_PCT; -1 where the gradient is not known."""
    bands = np.digitize(gradient_pct, GRADIENT_EDGES_PCT)
    return np.where(np.isfinite(gradient_pct), bands, -1).astype(np.intp)
