"""Where the gain was at which speed: time over a grid of both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values

SPEED_STEP_KMH, GAIN_STEP = 2.0, 0.05
SPEEDS_MAX, GAINS_MAX = 25, 40
"""Up to 50 km/h and a gain of 2; what lies above is in the last cell."""


@dataclass(frozen=True)
class GainMap:
    """seconds: [speed][gain], time in cells of SPEED_STEP_KMH and GAIN_STEP from zero on."""

    speed_step_kmh: float
    gain_step: float
    seconds: tuple[tuple[float, ...], ...]


def gain_map(speed_kmh: Values, gain: Values, seconds: Values) -> GainMap | None:
    """Of rows (n,), missing as NaN, in which a table gave a gain; None without any."""
    there = np.isfinite(speed_kmh) & np.isfinite(gain) & (gain > 0.0) & (speed_kmh >= 0.0)
    if not there.any():
        return None
    row = np.minimum((speed_kmh[there] // SPEED_STEP_KMH).astype(np.intp), SPEEDS_MAX - 1)
    column = np.minimum((gain[there] // GAIN_STEP).astype(np.intp), GAINS_MAX - 1)
    rows, columns = int(row.max()) + 1, int(column.max()) + 1
    cells = np.bincount(row * columns + column, seconds[there], minlength=rows * columns)
    told = tuple(tuple(line) for line in cells.reshape(rows, columns).tolist())
    return GainMap(SPEED_STEP_KMH, GAIN_STEP, told)
