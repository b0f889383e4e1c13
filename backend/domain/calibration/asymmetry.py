"""Left against right, and what bending of the spindle adds over the crank's angle.

A diagnosis: the unit has no coefficient for it, the fit is told none of it. The residuals in counts
are regressed on side (+1 right, -1 left) times

    load                         left/right difference with the crank level, as a share of the load
    load (1 - cos angle)         bending in the plane of the crank
    mass g arm sin(angle)        bending across it
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from backend.domain.calibration.coefficients import Numbers
from backend.domain.calibration.fit import ROOT_3, Data, Fit
from backend.domain.calibration.plain import Plain
from backend.domain.calibration.setup import Setup

ANGLE_SPAN_RAD = math.radians(30.0)
"""Less, and a bending in the crank's plane changes by less than its own uncertainty."""


@dataclass(frozen=True, slots=True)
class Share(Plain):
    """A share of the load and its standard uncertainty."""

    share: float
    standard: float


@dataclass(frozen=True, slots=True)
class Asymmetry(Plain):
    """left_right: (right - left) / mean of the slopes, crank level. bending_level, bending_across:
    None without captures over enough of the crank's angle. Two angles cannot tell the two apart:
    then all of it is called level."""

    left_right: Share
    bending_level: Share | None = None
    bending_across: Share | None = None


def asymmetry(setup: Setup, data: Data, fit: Fit) -> Asymmetry | None:
    """None with loads on one side only. Two cranks are two arms: what either may be off by is in
    the uncertainty of their difference."""
    loaded = data.load_nm > 0
    if not (data.side[loaded] > 0).any() or not (data.side[loaded] < 0).any():
        return None
    counts_per_nm = 1 / fit.coefficients.gain_nm_per_count
    pull_nm = data.load_nm * data.side * counts_per_nm
    columns = [np.ones_like(data.load_nm), data.load_nm, pull_nm / 2]
    if float(np.ptp(data.angle_rad[loaded])) >= ANGLE_SPAN_RAD:
        columns.append(pull_nm * (1 - np.cos(data.angle_rad)))
        if np.unique(data.angle_rad[loaded]).size > 2:
            columns.append(pull_nm * np.tan(data.angle_rad))
    left = np.array([residual.residual_nm for residual in fit.residuals]) * counts_per_nm
    values, standard = _regressed(np.stack(columns, axis=1), left, data.own_variance)
    shares = [Share(float(v), float(s)) for v, s in zip(values[2:], standard[2:], strict=True)]
    arms = math.sqrt(2.0) * setup.arm_limit_m / setup.arm_m / ROOT_3
    level = Share(shares[0].share, math.hypot(shares[0].standard, arms))
    return Asymmetry(level, *shares[1:])


def _regressed(columns: Numbers, left: Numbers, own_variance: Numbers) -> tuple[Numbers, Numbers]:
    """Least squares with the scatter that is left, not less than the captures' own."""
    values: Numbers = np.linalg.lstsq(columns, left, rcond=None)[0].astype(np.float64)
    rest = left - columns @ values
    variance = max(float(rest @ rest) / max(1, left.size - values.size), float(own_variance.mean()))
    standard: Numbers = np.sqrt(np.diag(np.linalg.pinv(columns.T @ columns)) * variance)
    return values, standard
