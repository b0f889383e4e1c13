"""Evaluate a torque sensor's error test."""

from __future__ import annotations

import numpy.typing as npt

from backend.domain.calibration.figures import CalibrationFigures, evaluate

__all__ = ["evaluate_calibration"]


def evaluate_calibration(
    full_scale_nm: float, load_nm: npt.ArrayLike, forward: npt.ArrayLike, reverse: npt.ArrayLike
) -> CalibrationFigures:
    """The contract's figures. load_nm: (k,). forward, reverse: (r, k) readings in Nm, r >= 2.

    Raises InvalidRequest naming every argument at fault.
    """
    return evaluate(full_scale_nm, load_nm, forward, reverse)
