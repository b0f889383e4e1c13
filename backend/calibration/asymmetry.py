"""Left against right, and what bending of the spindle adds over the crank's angle.

A diagnosis: the unit has no coefficient for it, the fit does not use it.

A mass pulls downwards with F at a pedal, the lever b outside the spindle's bearing. It bends the
spindle by F b, at every angle of the crank the same, in a plane that stays while the gauges turn.
A bridge that feels a share k of a bending, most where its own mark points down, adds to a reading

    k F b cos(spindle's angle - mark)

With a the angle of the pedal that is hung on, the spindle's is a or a + 180 degrees: the other
pedal is across. So that is s (p F cos a + q F sin a), s = +1 right, -1 left, and since the load is
F l cos a, its first part is a share of the load with the sign of the side at every angle: a
left/right difference like any other. No angle tells it apart, and no rider who pushes down feels
another. The second part shows in captures where the crank is not level. The residuals in counts
are regressed on

    s load / 2              left/right difference, bending in the plane of the crank within
    s mass g arm sin(a)     bending across the crank
    mass g arm sin(a)       a dial that is off by as much on both sides; not told
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from backend.calibration.fit import ROOT_3, Data, Fit, beyond_own
from backend.calibration.plain import Plain
from backend.calibration.setup import Setup
from backend.core.statistics import Numbers

ANGLE_SPAN_RAD = math.radians(20.0)
"""Below this span, load placement dominates: a third of the load bends across at 20 degrees."""


@dataclass(frozen=True, slots=True)
class LoadShare(Plain):
    """A share of the load of a level crank, and its standard uncertainty."""

    share: float
    standard: float


@dataclass(frozen=True, slots=True)
class Asymmetry(Plain):
    """left_right: (right - left) / mean of the slopes; bending in the plane of the crank looks the
    same and is within. bending_across: what a crank that points down would read of its load; None
    without captures over enough of the crank's angle on both sides."""

    left_right: LoadShare
    bending_across: LoadShare | None = None


def asymmetry(setup: Setup, data: Data, fit: Fit) -> Asymmetry | None:
    """None with loads on one side only. Two cranks are two arms: what either may be off by is in
    the uncertainty of their difference. Each setting of the crank may be off by its limit."""
    right, left = ((data.load_nm > 0) & (data.side == side) for side in (1.0, -1.0))
    if not right.any() or not left.any():
        return None
    counts_per_nm = 1 / fit.coefficients.gain_nm_per_count
    level_nm = data.load_nm * counts_per_nm
    down_nm = level_nm * np.tan(data.angle_rad)
    columns = [np.ones_like(level_nm), level_nm, level_nm * data.side / 2]
    if all(np.ptp(data.angle_rad[side]) >= ANGLE_SPAN_RAD for side in (right, left)):
        columns += [down_nm * data.side, down_nm]
    residual = np.array([residual.residual_nm for residual in fit.residuals]) * counts_per_nm
    own = data.own_variance + (down_nm * math.radians(setup.level_limit_deg) / ROOT_3) ** 2
    values, standard = _regressed(np.stack(columns, axis=1), residual, own)
    shares = [
        LoadShare(float(v), float(s)) for v, s in zip(values[2:4], standard[2:4], strict=True)
    ]
    arms = math.sqrt(2.0) * setup.arm_limit_m / setup.arm_m / ROOT_3
    level = LoadShare(shares[0].share, math.hypot(shares[0].standard, arms))
    return Asymmetry(level, *shares[1:])


def _regressed(columns: Numbers, torque: Numbers, own_variance: Numbers) -> tuple[Numbers, Numbers]:
    """Weighted least squares with the scatter that is left beyond the captures' own variance."""
    freedom = torque.size - columns.shape[1]

    def solved(extra: float) -> tuple[Numbers, Numbers]:
        weighted = columns / np.sqrt(own_variance + extra)[:, None]
        inverse: Numbers = np.linalg.pinv(weighted).astype(np.float64)
        return inverse @ (torque / np.sqrt(own_variance + extra)), inverse

    def squares(extra: float) -> float:
        rest = torque - columns @ solved(extra)[0]
        return float(rest @ (rest / (own_variance + extra)))

    values, inverse = solved(beyond_own(squares, freedom, float(torque @ torque)))
    standard: Numbers = np.sqrt((inverse**2).sum(axis=1))
    return values, standard
