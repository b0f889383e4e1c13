"""Rider power, motor power and battery power: three quantities, never mixed, never guessed.

    rider power      = rider torque x crank speed              (P = M w, w = 2 pi n / 60)
    motor power      = motor shaft torque x motor shaft speed  (mechanical, before the gears)
    battery power    = battery voltage x battery current       (electrical, more than mechanical)

A motor's power is of the torque it delivers. A unit of earlier firmware, and most files, tell only
what was asked of the motor: such a ride has no motor power, only the battery's.

A head unit that reports power itself reports the rider's (`rider_power_w`) or the motor's
(`motor_power_w`); such a recorded channel wins over the derived one. A sample with any factor
missing has no power and is left out of the energy; how much time was left out is part of the
answer, so a total never pretends to be whole.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from backend.core.channels import ChannelSpec, Values

RADIANS_PER_S_PER_RPM = 2.0 * math.pi / 60.0
SECONDS_PER_HOUR = 3600.0
KMH_PER_MS = 3.6

# Wide where the product of two 16 bit factors may not fit: no extreme is ever clipped.
RIDER_POWER = ChannelSpec("rider_power_w", "W", 0.1, wide=True)
MOTOR_POWER = ChannelSpec("motor_power_w", "W", 0.1)
BATTERY_POWER = ChannelSpec("battery_power_w", "W", 0.1)
MOTOR_TORQUE_CRANK = ChannelSpec("motor_torque_crank_nm", "Nm", 0.01)
MOTOR_TORQUE_DEMANDED_CRANK = ChannelSpec("motor_torque_demanded_crank_nm", "Nm", 0.01)
AT_CRANK = (MOTOR_TORQUE_CRANK, MOTOR_TORQUE_DEMANDED_CRANK)

# What a ride's `motor_torque_nm` is. A unit that measures what it delivers tells what it asks, too.
MotorTorqueMeaning = Literal["delivered", "demanded"]
DEMANDED: Final = "demanded"
DELIVERED: Final = "delivered"
MOTOR_TORQUE = "motor_torque_nm"
MOTOR_TORQUE_DEMANDED = "motor_torque_demanded_nm"

# Derived channel -> the recorded channels it is made of.
FACTORS: Mapping[str, tuple[str, ...]] = {
    RIDER_POWER.name: ("rider_torque_nm", "cadence_rpm"),
    MOTOR_POWER.name: (MOTOR_TORQUE, "motor_speed_rpm"),
    BATTERY_POWER.name: ("battery_voltage_v", "battery_current_a"),
    MOTOR_TORQUE_CRANK.name: (MOTOR_TORQUE,),
    MOTOR_TORQUE_DEMANDED_CRANK.name: (MOTOR_TORQUE_DEMANDED,),
}
DERIVED: tuple[ChannelSpec, ...] = (RIDER_POWER, MOTOR_POWER, BATTERY_POWER, *AT_CRANK)


@dataclass(frozen=True, slots=True)
class Energy:
    """Energy of one power channel over a ride.

    wh: sum over the samples that are there. excluded_s: time whose samples were missing.
    """

    wh: float
    excluded_s: float


def motor_torque_meaning(recorded: Collection[str]) -> MotorTorqueMeaning | None:
    """Whether the motor torque of these channels was asked for or given; None without one."""
    if MOTOR_TORQUE in recorded and MOTOR_TORQUE_DEMANDED in recorded:
        return DELIVERED
    return DEMANDED if MOTOR_TORQUE in recorded or MOTOR_TORQUE_DEMANDED in recorded else None


def derivable(recorded: Collection[str], gear_ratio: float | None) -> tuple[ChannelSpec, ...]:
    """The derived channels a ride with these recorded channels can offer.

    gear_ratio: motor turns per crank turn; without it there is no motor torque at the crank.
    """
    return tuple(
        channel
        for channel in DERIVED
        if channel.name not in recorded
        and all(factor in recorded for factor in FACTORS[channel.name])
        and (channel not in AT_CRANK or gear_ratio is not None)
        and (channel is not MOTOR_POWER or motor_torque_meaning(recorded) == DELIVERED)
    )


def derive(name: str, columns: Mapping[str, Values], gear_ratio: float | None) -> Values:
    """Values (n,) of a derived channel from the physical values (n,) of its factors.

    columns: every channel of `FACTORS[name]`, missing as NaN. Raises KeyError for other names.
    """
    if name == RIDER_POWER.name:
        return columns["rider_torque_nm"] * columns["cadence_rpm"] * RADIANS_PER_S_PER_RPM
    if name == MOTOR_POWER.name:
        return columns[MOTOR_TORQUE] * columns["motor_speed_rpm"] * RADIANS_PER_S_PER_RPM
    if name == BATTERY_POWER.name:
        return columns["battery_voltage_v"] * columns["battery_current_a"]
    if any(name == channel.name for channel in AT_CRANK) and gear_ratio is not None:
        return columns[FACTORS[name][0]] * gear_ratio
    raise KeyError(name)


def energy(power_w: Values, seconds: Values) -> Energy:
    """Energy of power (n,) where sample i holds for seconds[i] (n,); NaN samples are left out."""
    missing = ~np.isfinite(power_w)
    joules = weighted_sum(power_w, seconds)
    return Energy(wh=joules / SECONDS_PER_HOUR, excluded_s=float(np.sum(seconds[missing])))


def weighted_sum(values: Values, seconds: Values) -> float:
    """Sum of the samples (n,) times how long each holds; missing ones count nothing."""
    present = np.where(np.isfinite(values), values, 0.0)
    present *= seconds
    return float(np.sum(present))


def sample_seconds(
    times_us: np.ndarray[tuple[int], np.dtype[np.int64]],
    breaks: np.ndarray[tuple[int], np.dtype[np.bool_]],
) -> Values:
    """How long each sample (n,) holds: until the next one, but never across a break.

    breaks: of the steps from row to row (n - 1,). The last sample, and one before a break, holds
    for the usual spacing.
    """
    if len(times_us) < 2:
        return np.zeros(len(times_us))
    spacing = np.diff(times_us)
    running = spacing[(spacing > 0) & ~breaks]
    usual = float(np.median(running)) if len(running) else 0.0
    return np.append(np.where(breaks, usual, np.maximum(spacing, 0)), usual) / 1e6


def rate_hz(seconds: Values) -> float | None:
    """How often samples (n,) come that hold for `seconds`, by the middle one; None without any."""
    running = seconds[seconds > 0.0]
    return 1.0 / float(np.median(running)) if len(running) else None
