"""What each lap of a ride came to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values
from backend.core.energy import MOTOR_POWER, RIDER_POWER

HEART = "heart_rate_bpm"
MEANS = (RIDER_POWER.name, MOTOR_POWER.name, HEART)


@dataclass(frozen=True)
class LapFigures:
    """Means over the time with a sample; None without any. seconds: of the rows in the lap."""

    from_s: float
    to_s: float
    seconds: float
    distance_km: float | None
    rider_power_w_mean: float | None
    motor_power_w_mean: float | None
    heart_rate_bpm_mean: float | None


def lap_figures(
    columns: Mapping[str, Values],
    start_s: Values,
    seconds: Values,
    step_m: Values | None,
    laps: Iterable[tuple[float, float]],
) -> list[LapFigures]:
    """Of laps from when to when, over rows (n,) that begin at start_s."""
    found = []
    for from_s, to_s in laps:
        first, last = np.searchsorted(start_s, (from_s - 1e-6, to_s - 1e-6))
        rows = slice(int(first), int(last))
        means = (mean(columns.get(name), seconds, rows) for name in MEANS)
        km = None if step_m is None else float(step_m[rows].sum()) / 1000.0
        found.append(LapFigures(from_s, to_s, float(seconds[rows].sum()), km, *means))
    return found


def mean(values: Values | None, seconds: Values, rows: slice) -> float | None:
    """Mean of rows by how long they hold."""
    if values is None:
        return None
    there = np.isfinite(values[rows])
    held_s = float(seconds[rows][there].sum())
    if held_s <= 0.0:
        return None
    return float((values[rows][there] * seconds[rows][there]).sum()) / held_s
