"""What a ride that is being recorded comes to so far, counted up row by row."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from backend.core._generated import MOVING_KMH
from backend.core.channels import ChannelSpec, Values
from backend.core.energy import (
    FACTORS,
    MOTOR_POWER,
    RIDER_POWER,
    SECONDS_PER_HOUR,
    derivable,
    derive,
)
from backend.core.ride import RideSummary, present

POWERS = (RIDER_POWER, MOTOR_POWER)


class RunningTotals:
    """Sums over rows of one period. Fed from one thread; what it tells may be read from any.

    As in a finished ride's figures a missing sample adds nothing, and what never had one is None.
    An odometer is not looked at, so that the distance may differ from the finished ride's by what
    the speed does not tell.
    """

    def __init__(self, channels: Sequence[ChannelSpec], period_us: int) -> None:
        self._channels = {channel.name: (at, channel) for at, channel in enumerate(channels)}
        offered = {channel.name for channel in derivable(self._channels.keys(), None)}
        self._powers = [p for p in POWERS if p.name in self._channels or p.name in offered]
        self._period_s = period_us / 1e6
        self._rows = 0
        self._sums: dict[str, float] = {}

    def add(self, rows: npt.NDArray[np.int16]) -> None:
        """Count rows (n, channels) that follow those of before."""
        self._rows += len(rows)
        found: dict[str, float] = {}
        if "speed_kmh" in self._channels:
            speed = present(self._values("speed_kmh", rows))
            if len(speed):
                moving = speed[speed > MOVING_KMH]
                found["distance_km"] = float(np.sum(speed))
                found["moving_km"] = float(np.sum(moving))
                found["moving_s"] = float(len(moving))
        for power in self._powers:
            valid = present(self._values(power.name, rows))
            if len(valid):
                found[power.name] = float(np.sum(valid))
        sums = {name: self._sums.get(name, 0.0) + value for name, value in found.items()}
        self._sums = {**self._sums, **sums}

    def skip(self, rows: int) -> None:
        """Count rows that never came: only time went on."""
        self._rows += rows

    def summary(self) -> RideSummary:
        """The figures so far; those that only a whole ride has are None."""
        sums = {name: value * self._period_s for name, value in self._sums.items()}
        moving_s = sums.get("moving_s")
        return RideSummary(
            duration_s=self._rows * self._period_s,
            moving_s=moving_s,
            distance_km=hours(sums.get("distance_km")),
            speed_kmh_mean=sums["moving_km"] / moving_s if moving_s else None,
            rider_wh=hours(sums.get(RIDER_POWER.name)),
            motor_wh=hours(sums.get(MOTOR_POWER.name)),
        )

    def _values(self, name: str, rows: npt.NDArray[np.int16]) -> Values:
        """Values (n,) of a recorded channel, or of a power that is derived."""
        if name in self._channels:
            at, channel = self._channels[name]
            return channel.to_values(rows[:, at])
        factors = {factor: self._values(factor, rows) for factor in FACTORS[name]}
        return derive(name, factors, None)


def hours(seconds: float | None) -> float | None:
    """A sum over seconds as one over hours."""
    return None if seconds is None else seconds / SECONDS_PER_HOUR
