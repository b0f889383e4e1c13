"""Coverage factors of Student's distribution."""

from __future__ import annotations

NORMAL_95_45 = 2.0
"""Of a normal distribution, for 95.45 %: what `k = 2` means (GUM table G.1)."""


def coverage_factor(degrees_of_freedom: float | None) -> float:
    """For 95.45 %, never below 2; None is infinitely many.

    The expansion of Abramowitz and Stegun 26.7.5; within 0.2 % from four degrees on. With three or
    fewer the table of GUM G.2 holds.
    """
    if degrees_of_freedom is None:
        return NORMAL_95_45
    few = {1: 13.97, 2: 4.53, 3: 3.31}
    whole = int(degrees_of_freedom)
    if whole <= 3:
        return few[max(1, whole)]
    x, v = NORMAL_95_45, degrees_of_freedom
    return (
        x
        + (x**3 + x) / (4 * v)
        + (5 * x**5 + 16 * x**3 + 3 * x) / (96 * v**2)
        + (3 * x**7 + 19 * x**5 + 17 * x**3 - 15 * x) / (384 * v**3)
        + (79 * x**9 + 776 * x**7 + 1482 * x**5 - 1920 * x**3 - 945 * x) / (92160 * v**4)
    )
