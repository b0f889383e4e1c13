"""The repeatability: what captures scatter by beyond what each one knows of itself."""

from __future__ import annotations

from collections.abc import Callable

HALVINGS = 60


def beyond_own(squares: Callable[[float], float], freedom: int, residual_squares: float) -> float:
    """Variance to add to each capture's own so that the weighted squares of the residuals equal
    the degrees of freedom (Paule and Mandel, 1982); 0 where they are fewer already.

    squares: the weighted squares with so much added; they fall as it grows. residual_squares:
    of the residuals without weights; what is to be added lies below four times their mean.
    """
    if freedom < 1 or squares(0.0) <= freedom:
        return 0.0
    low, high = 0.0, 4 * residual_squares / freedom + 1e-12
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if squares(middle) > freedom else (low, middle)
    return high
