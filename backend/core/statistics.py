"""Student's quantiles; deviations and straight lines that a few wrong values do not move."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]

NORMAL_90, NORMAL_95 = 1.6448536, 1.9599640
"""Of a normal distribution, for a two-sided interval of 90 % and of 95 %."""
NORMAL_95_45 = 2.0
"""For 95.45 %: what `k = 2` means (GUM table G.1)."""

MAD_TO_DEVIATION = 1.4826
"""Median absolute deviation to standard deviation, of a normal distribution."""
MEDIAN_TO_MEAN = math.sqrt(math.pi / 2.0)
"""Of a normal distribution, how much more a median is uncertain by than a mean."""


def robust_deviation(values: npt.NDArray[np.float64]) -> float:
    """A standard deviation from the median of the distances from the median. values: (n,)."""
    return MAD_TO_DEVIATION * float(np.median(np.abs(values - np.median(values))))


def student(normal: float, degrees_of_freedom: float) -> float:
    """Student's quantile from that of a normal distribution: Abramowitz and Stegun 26.7.5.

    Within 0.2 % from four degrees of freedom on, within 1 % at three.
    """
    x, v = normal, degrees_of_freedom
    return (
        x
        + (x**3 + x) / (4 * v)
        + (5 * x**5 + 16 * x**3 + 3 * x) / (96 * v**2)
        + (3 * x**7 + 19 * x**5 + 17 * x**3 - 15 * x) / (384 * v**3)
        + (79 * x**9 + 776 * x**7 + 1482 * x**5 - 1920 * x**3 - 945 * x) / (92160 * v**4)
    )


def coverage_factor(degrees_of_freedom: float | None) -> float:
    """For 95.45 %, never below 2; None is infinitely many.

    With three degrees of freedom or fewer the table of GUM G.2 holds.
    """
    if degrees_of_freedom is None:
        return NORMAL_95_45
    few = {1: 13.97, 2: 4.53, 3: 3.31}
    degrees = int(degrees_of_freedom)
    if degrees <= 3:
        return few[max(1, degrees)]
    return student(NORMAL_95_45, degrees_of_freedom)


def robust_line(x: Numbers, y: Numbers) -> tuple[float, float] | None:
    """Slope and offset by Theil and Sen: the median of all pairs' slopes, then of what is left.

    x, y: (n,). Up to 29 % of wrong points do not move it. None with less than two places in x.
    """
    first, second = np.triu_indices(x.size, 1)
    distinct = np.abs(x[first] - x[second]) > 1e-9
    if not distinct.any():
        return None
    first, second = first[distinct], second[distinct]
    slope = float(np.median((y[second] - y[first]) / (x[second] - x[first])))
    return slope, float(np.median(y - slope * x))
