"""A correction by straight pieces through what the line leaves: for the certificate only, because
the unit's law knows a line."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.domain.calibration.coefficients import Numbers
from backend.domain.calibration.fit import Fit
from backend.domain.calibration.plain import Plain
from backend.domain.calibration.strokes import Curve

KNOTS_MIN = 4
"""Fewer loads, and a line through them leaves nothing to correct."""


@dataclass(frozen=True, slots=True)
class Piecewise(Plain):
    """To be added to a reading: correction_nm at reading_nm (k,), ascending; standard_nm of each.

    significant: the largest correction is beyond twice its own standard uncertainty.
    """

    reading_nm: tuple[float, ...]
    correction_nm: tuple[float, ...]
    standard_nm: tuple[float, ...]
    significant: bool

    def corrected_nm(self, reading_nm: npt.ArrayLike) -> Numbers:
        """Readings (n,); beyond the outermost knots the last correction holds."""
        reading = np.asarray(reading_nm, np.float64)
        added: Numbers = reading + np.interp(reading, self.reading_nm, self.correction_nm)
        return added


def piecewise(curve: Curve, fit: Fit) -> Piecewise | None:
    """Through the means at each load; None with fewer than four loads."""
    if len(curve.load_nm) < KNOTS_MIN:
        return None
    left = np.array(curve.residual_nm)
    standard = fit.repeatability_nm / np.sqrt(curve.captures)
    worst = int(np.abs(left).argmax())
    return Piecewise(
        tuple(float(value) for value in np.array(curve.load_nm) + left),
        tuple(float(value) for value in -left),
        tuple(float(value) for value in standard),
        bool(math.fabs(left[worst]) > 2 * standard[worst]),
    )
