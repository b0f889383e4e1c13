"""The cadence that a unit tells against the turns of its crank, counted by the crank's angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.domain.calibration.bike.wheel import cadence_error_rpm
from backend.services.rides.bike.window import refusal, rows_of
from backend.services.rides.insight.rows import Window
from backend.store import Store

CADENCE, ANGLE = "cadence_rpm", "crank_angle_deg"
TURNS_MIN = 20.0
"""Fewer, and where the crank stood at either end decides."""
SPACING_S_MAX = 0.15
"""Half a turn at 200 rpm: over longer ones nobody knows how often the crank came round."""


@dataclass(frozen=True)
class CadenceChecked:
    """Means over the window. expanded_rpm: of the counting. agrees: they differ by no more."""

    told_rpm: float
    turns: float
    duration_s: float
    error_rpm: float
    expanded_rpm: float
    agrees: bool


class CadenceCheck:
    """Counts the turns of a window. Safe from any thread."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def __call__(self, window: Window) -> CadenceChecked:
        """Raises NotFound, ObjectDamaged, and InvalidRequest where the ride cannot tell."""
        rows = rows_of(self._store, window, "ride_id", [CADENCE, ANGLE])
        if np.diff(rows.time_s).max() > SPACING_S_MAX:
            message = f"rows more than {SPACING_S_MAX:g} s apart do not tell the crank's turns"
            raise refusal("ride_id", "too_slow", message)
        angle_deg = np.unwrap(rows[ANGLE], period=360.0)
        turns = abs(float(angle_deg[-1] - angle_deg[0])) / 360.0
        if turns < TURNS_MIN:
            message = f"the crank made {turns:.1f} turns there; {TURNS_MIN:g} are needed"
            raise refusal("ride_id", "too_few_turns", message)
        duration_s = float(rows.time_s[-1] - rows.time_s[0])
        told_rpm = float(np.trapezoid(rows[CADENCE], rows.time_s)) / duration_s
        error, expanded = cadence_error_rpm(told_rpm, turns, duration_s)
        agrees = abs(error) <= expanded
        return CadenceChecked(told_rpm, turns, duration_s, error, expanded, agrees)
