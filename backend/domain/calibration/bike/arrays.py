"""Samples of a ride as the balance takes them, and its refusal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from backend.domain.calibration.coefficients import Numbers
from backend.errors import FieldError, InvalidRequest


def as_array(values: Sequence[float] | Numbers) -> Numbers:
    """As float64 (n,)."""
    return np.asarray(values, np.float64)


def summed(values: Numbers, time_s: Numbers) -> Numbers:
    """The integral from the first sample to each (n,), by trapezes."""
    steps = (values[1:] + values[:-1]) / 2 * np.diff(time_s)
    summed: Numbers = np.concatenate([[0.0], np.cumsum(steps)])
    return summed


def ordered(time_s: Numbers, values: Numbers) -> bool:
    """Ten samples or more, finite, in order of time."""
    alike = time_s.ndim == 1 and time_s.shape == values.shape and time_s.size >= 10
    return bool(
        alike
        and np.isfinite(time_s).all()
        and np.isfinite(values).all()
        and (np.diff(time_s) > 0).all()
    )


def raise_if(faults: list[FieldError]) -> None:
    """Raise InvalidRequest with all of them, if there is any."""
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"energy balance: {listed}", "invalid_balance", faults)
