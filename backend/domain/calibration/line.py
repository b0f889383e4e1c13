"""Straight lines that a few wrong points do not move."""

from __future__ import annotations

import numpy as np

from backend.domain.calibration.coefficients import Numbers


def robust_line(x: Numbers, y: Numbers) -> tuple[float, float] | None:
    """Slope and offset by Theil and Sen: the median of all pairs' slopes, then of what is left.

    x, y: (n,). Up to 29 % of wrong points do not move it. None with less than two places in x.
    """
    first, second = np.triu_indices(x.size, 1)
    apart = np.abs(x[first] - x[second]) > 1e-9
    if not apart.any():
        return None
    first, second = first[apart], second[apart]
    slope = float(np.median((y[second] - y[first]) / (x[second] - x[first])))
    return slope, float(np.median(y - slope * x))
