"""Where a fuzzy table is ridden: seconds and motor energy of each of its cells.

A sample belongs to the at most four cells whose rules fire for it, in the shares that the law's own
sets give it: neighbouring triangles sum to one, beyond the outer points all of it is the outer
set's. So the seconds of all cells together are the seconds of the samples, and those of a column
are the time in which its rules acted, each moment weighted by how much they had to say.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.energy import MOTOR_POWER, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED, SECONDS_PER_HOUR

SETS = 5
RATE_STEP = 0.001
RATE_STEPS = 5000
"""To 5, the largest point a table can have."""
PROPOSED_AT = (0.25, 0.5, 0.75, 0.98)
"""Shares of the time in which the torque rose: each set but the last acts for as long."""
PROPOSED_STEP = 0.005
RISING_S_MIN = 60.0
"""Of less time nothing is proposed."""
NEEDED = ("speed_kmh", "torque_rate", "assist_mode", "cadence_rpm")
# What was asked of the motor: a ride has one of them, or both.
ASKED = (MOTOR_TORQUE_DEMANDED, MOTOR_TORQUE)
FUZZY_GAIN = "fuzzy_gain"

Cells = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class TableUse:
    """What the cells of one table came to, [speed][torque rate], (5, 5) each.

    seconds: the samples' time. motor_wh: of the samples whose motor power is known, None where no
    sample's is. motor_excluded_s: time of those whose motor power is not. rising_s: time at each
    torque rate, (RATE_STEPS,) of RATE_STEP; while it does not rise is not in it.
    """

    seconds: Cells
    motor_wh: Cells | None
    motor_excluded_s: float
    rising_s: Values

    @classmethod
    def none(cls) -> Self:
        """Of no samples."""
        return cls(np.zeros((SETS, SETS)), None, 0.0, np.zeros(RATE_STEPS))

    def __add__(self, other: TableUse) -> TableUse:
        """Of both their samples."""
        energies = [use.motor_wh for use in (self, other) if use.motor_wh is not None]
        return TableUse(
            self.seconds + other.seconds,
            np.sum(energies, axis=0) if energies else None,
            self.motor_excluded_s + other.motor_excluded_s,
            self.rising_s + other.rising_s,
        )

    def proposed_rates(self) -> tuple[float, ...] | None:
        """Torque-rate points that these rides use evenly; None where they rise for too little time.

        The first stays 0, where the torque holds or falls. The others divide the time in which it
        rises by PROPOSED_AT.
        """
        total_s = float(self.rising_s.sum())
        if total_s < RISING_S_MIN:
            return None
        edges = (np.arange(RATE_STEPS) + 1) * RATE_STEP
        points = [0.0]
        for share in PROPOSED_AT:
            at = edges[np.searchsorted(np.cumsum(self.rising_s), share * total_s)]
            on_step = round(float(at) / PROPOSED_STEP) * PROPOSED_STEP
            points.append(round(max(on_step, points[-1] + PROPOSED_STEP), 3))
        return tuple(points)


def acting(columns: Mapping[str, Values], slots: Collection[int], needs_gain: bool) -> Mask:
    """The samples (n,) in which the rider pedals and the table says what the motor is asked for.

    columns: NEEDED, one of ASKED and, where the ride has it, FUZZY_GAIN; (n,) each, missing as NaN.
    slots: the modes that run by the table. needs_gain: a gain of nothing was not the table's; so it
    is where the unit has none while the torque falls. Walk assist has no gain at all.
    """
    asked = next(columns[name] for name in ASKED if name in columns)
    acts = np.isin(columns["assist_mode"], list(slots))
    acts &= (columns["cadence_rpm"] > 0.0) & (asked > 0.0)
    acts &= np.isfinite(columns["speed_kmh"]) & np.isfinite(columns["torque_rate"])
    if FUZZY_GAIN in columns:
        gain = columns[FUZZY_GAIN]
        acts &= gain > 0.0 if needs_gain else np.isfinite(gain)
    return acts


def table_use(
    columns: Mapping[str, Values],
    seconds: Values,
    speed_points_kmh: Sequence[float],
    torque_rate_points: Sequence[float],
) -> TableUse:
    """Time and motor energy of samples (n,) over the cells of a table with these points.

    columns: speed_kmh and torque_rate, finite; motor_power_w where the ride has it, missing as NaN.
    seconds: how long each sample holds (n,). The points: five each, increasing.
    """
    slower, faster = memberships(speed_points_kmh, columns["speed_kmh"])
    lower, higher = memberships(torque_rate_points, columns["torque_rate"])
    places = slower * SETS + lower
    corners = [
        (places, (1.0 - faster) * (1.0 - higher)),
        (places + 1, (1.0 - faster) * higher),
        (places + SETS, faster * (1.0 - higher)),
        (places + SETS + 1, faster * higher),
    ]
    power_w = columns.get(MOTOR_POWER.name, np.full(len(seconds), np.nan))
    known = np.isfinite(power_w)
    work_wh = np.where(known, power_w, 0.0) * seconds / SECONDS_PER_HOUR
    return TableUse(
        seconds=spread(corners, seconds),
        motor_wh=spread(corners, work_wh) if known.any() else None,
        motor_excluded_s=float(np.sum(seconds[~known])),
        rising_s=rising(columns["torque_rate"], seconds),
    )


def rising(torque_rate: Values, seconds: Values) -> Values:
    """Time at each torque rate (RATE_STEPS,) of samples (n,); what does not rise is left out."""
    steps = np.clip((torque_rate / RATE_STEP).astype(np.intp), 0, RATE_STEPS - 1)
    held = np.bincount(steps, weights=seconds, minlength=RATE_STEPS).astype(np.float64)
    held[0] = 0.0
    return held


def memberships(points: Sequence[float], values: Values) -> tuple[npt.NDArray[np.intp], Values]:
    """For each value (n,) the set below it, 0 to 3, and its share of the set above, 0 to 1."""
    clamped = np.clip(values, points[0], points[-1])
    lower = np.searchsorted(points[1:-1], clamped, side="right")
    at = np.asarray(points, np.float64)
    return lower, (clamped - at[lower]) / (at[lower + 1] - at[lower])


def spread(corners: Sequence[tuple[npt.NDArray[np.intp], Values]], amounts: Values) -> Cells:
    """Amounts (n,) given to cells by places and shares (n,); (5, 5)."""
    cells = np.zeros(SETS * SETS)
    for places, shares in corners:
        cells += np.bincount(places, shares * amounts, minlength=SETS * SETS)
    return cells.reshape(SETS, SETS)
