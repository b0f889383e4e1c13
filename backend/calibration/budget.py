"""How sure a torque reading is: the uncertainty budget by GUM (JCGM 100:2008), in Nm over torque.

A limit `a` with no further information counts as a rectangle, a / root 3 (4.3.7). Contributions are
independent of each other and add as squares (5.1.2); what the loads share is its own contribution.
Effective degrees of freedom by Welch and Satterthwaite (G.4.1); limits have infinitely many.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.calibration.capture import Capture
from backend.calibration.fit import ROOT_3, Fit
from backend.calibration.plain import Plain
from backend.calibration.setup import Setup
from backend.calibration.strokes import curve, zero_return_nm
from backend.core.statistics import Numbers, coverage_factor

POINTS = 11
REFERENCE = ("masses", "arm", "gravity", "level")
"""Causes outside the sensor, in the loads; a comparison with the same instruments has them not."""


@dataclass(frozen=True, slots=True)
class Contribution(Plain):
    """standard_nm: at each torque of the budget. degrees_of_freedom: None is infinitely many."""

    cause: str
    standard_nm: tuple[float, ...]
    degrees_of_freedom: float | None


@dataclass(frozen=True, slots=True)
class Budget(Plain):
    """Over torque_nm (k,). coverage: the factor at each, 2 or more; expanded = coverage x combined,
    for 95.45 %."""

    torque_nm: tuple[float, ...]
    contributions: tuple[Contribution, ...]
    combined_nm: tuple[float, ...]
    degrees_of_freedom: tuple[float | None, ...]
    coverage: tuple[float, ...]
    expanded_nm: tuple[float, ...]

    def expanded_at(self, torque_nm: float) -> float:
        """Between the budget's torques, by a straight line."""
        return float(np.interp(abs(torque_nm), self.torque_nm, self.expanded_nm))


def budget(
    setup: Setup,
    captures: Sequence[Capture],
    fit: Fit,
    torque_nm: Sequence[float] | None = None,
    without: Sequence[str] = (),
) -> Budget:
    """Of one steady reading at each torque, on the fit's coefficients and near its temperature.

    torque_nm: zero to full scale in ten steps if absent. without: causes to be left out.
    """
    torque = (
        np.linspace(0.0, setup.full_scale_nm, POINTS)
        if torque_nm is None
        else np.asarray(torque_nm, np.float64)
    )
    flat = np.ones_like(torque)
    contributions = [
        Contribution("fit", _as_floats(_scatter(fit, torque)), float(fit.degrees_of_freedom)),
        *(Contribution(cause, _as_floats(nm), None) for cause, nm in _shared(fit, torque)),
        *(
            Contribution(cause, _as_floats(flat * standard), freedom)
            for cause, standard, freedom in _of_the_sensor(setup, captures, fit)
        ),
    ]
    return summed(torque, [entry for entry in contributions if entry.cause not in without])


def summed(torque: Numbers, contributions: Sequence[Contribution]) -> Budget:
    """Independent contributions as one budget."""
    parts = np.array([entry.standard_nm for entry in contributions])
    combined = np.sqrt((parts**2).sum(axis=0))
    freedom = [
        effective_degrees_of_freedom(column, [entry.degrees_of_freedom for entry in contributions])
        for column in parts.T
    ]
    coverage = [coverage_factor(value) for value in freedom]
    return Budget(
        _as_floats(torque),
        tuple(contributions),
        _as_floats(combined),
        tuple(freedom),
        tuple(coverage),
        _as_floats(combined * coverage),
    )


def effective_degrees_of_freedom(
    standard: Sequence[float] | Numbers, freedom: Sequence[float | None]
) -> float | None:
    """Welch and Satterthwaite, GUM eq. G.2b; None is infinitely many."""
    total = math.fsum(value**2 for value in standard) ** 2
    rest = math.fsum(
        value**4 / number
        for value, number in zip(standard, freedom, strict=True)
        if number is not None
    )
    return total / rest if rest > 1e-12 * total else None


def _scatter(fit: Fit, torque: Numbers) -> Numbers:
    """Offset and gain together, with their covariance: d torque = -gain d offset + torque d gain
    / gain."""
    by = _by_coefficient(fit, torque)
    covariance = np.array(fit.covariance)[:2, :2]
    scatter: Numbers = np.sqrt(np.einsum("ki,ij,kj->k", by, covariance, by))
    return scatter


def _shared(fit: Fit, torque: Numbers) -> list[tuple[str, Numbers]]:
    by = _by_coefficient(fit, torque)
    values: dict[str, Numbers] = {}
    for common in fit.common:
        cause = common.cause.partition("_")[0]
        shift = by @ np.array(common.shift[:2])
        values[cause] = np.hypot(values.get(cause, np.zeros_like(torque)), shift)
    return list(values.items())


def _by_coefficient(fit: Fit, torque: Numbers) -> Numbers:
    gain = fit.coefficients.gain_nm_per_count
    by: Numbers = np.stack([np.full_like(torque, -gain), torque / gain], axis=1)
    return by


def _of_the_sensor(
    setup: Setup, captures: Sequence[Capture], fit: Fit
) -> list[tuple[str, float, float | None]]:
    shape = curve(setup, captures, fit.coefficients)
    loops = [abs(loop) for loop in shape.loop_nm if loop is not None]
    zero_nm = zero_return_nm(captures, fit.coefficients)
    step_nm = setup.resolution_counts * fit.coefficients.gain_nm_per_count
    freedom = float(fit.degrees_of_freedom)
    return [
        ("linearity", max(abs(left) for left in shape.residual_nm) / ROOT_3, None),
        ("hysteresis", max(loops, default=0.0) / 2 / ROOT_3, None),
        ("repeatability", fit.repeatability_nm, freedom),
        ("zero_return", abs(zero_nm or 0.0) / 2 / ROOT_3, None),
        ("resolution", step_nm / 2 / ROOT_3, None),
    ]


def _as_floats(values: Numbers) -> tuple[float, ...]:
    return tuple(float(value) for value in values)
