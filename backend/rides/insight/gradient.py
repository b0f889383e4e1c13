"""Height and gradient of a ride's rows.

The gradient is height over distance, never told from speed: heights are averaged over cells of
CELL_M of distance, and a straight line is fitted to them over WINDOW_M around each cell. With a
barometer's 0.3 m of noise a cell that comes to 0.2 %. Neither reaches over a gap: a run of heights
ends there, and with less than half a window around it a cell has no gradient.

Ascent counts a climb only once it is CLIMB_M above the lowest point since the last one, as
GoldenCheetah does (3 m unless set): a barometer's drift at a red light is no hill. A climb goes on
behind a gap; what the height changed by in it is not climbed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described
from backend.core.distance import RowDistances

CELL_M = 5.0
WINDOW_M = 100.0
GAP_S = 10.0
GAP_M = 50.0
"""Between heights that do not stand in rows that follow each other."""
GRADIENT_PCT_MAX = 40.0
"""Steeper than any road (Baldwin Street: 34.8 %): the height jumped, and there is no gradient."""
CLIMB_M = 3.0

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Heights:
    """A run of heights on cells of CELL_M from start_m on, (cells,); rows: those that lie in it."""

    start_m: float
    height_m: Values
    rows: npt.NDArray[np.intp]
    cell_of_row: npt.NDArray[np.intp]


@described
class Climb:
    """By heights averaged over 5 m of distance; a climb counts once it is 3 m high."""

    ascent_m: float
    descent_m: float
    lowest_m: float
    """Of the averaged heights."""
    highest_m: float
    """Of the averaged heights."""


def runs_of_heights(
    altitude_m: Values, distances: RowDistances, start_s: Values
) -> Iterator[Heights]:
    """Heights without a gap in them, from altitudes (n,), missing as NaN."""
    valid = np.flatnonzero(np.isfinite(altitude_m))
    if not len(valid):
        return
    follows = (np.diff(valid) == 1) & ~distances.gap[valid[:-1]]
    far = (np.diff(start_s[valid]) > GAP_S) | (np.diff(distances.at_m[valid]) > GAP_M)
    broken = far & ~follows
    for rows in np.split(valid, np.flatnonzero(broken) + 1):
        start_m = float(distances.at_m[rows[0]])
        cells = ((distances.at_m[rows] - start_m) // CELL_M).astype(np.intp)
        count = np.bincount(cells)
        total = np.bincount(cells, altitude_m[rows])
        filled = np.flatnonzero(count)
        means = np.interp(np.arange(len(count)), filled, total[filled] / count[filled])
        yield Heights(start_m, means, rows, cells)


def gradient_pct(altitude_m: Values, distances: RowDistances, start_s: Values) -> Values:
    """The gradient at each row (n,) in percent, NaN where it is unknown."""
    gradient: Values = np.full(len(altitude_m), np.nan)
    for run in runs_of_heights(altitude_m, distances, start_s):
        gradient[run.rows] = slope_pct(run.height_m)[run.cell_of_row]
    return gradient


def slope_pct(height_m: Values) -> Values:
    """Least squares over WINDOW_M around each cell (n,); NaN with less than half a window."""
    n = len(height_m)
    at_m: Values = np.arange(n, dtype=np.float64) * CELL_M
    half = round(WINDOW_M / CELL_M / 2)
    first = np.maximum(np.arange(n) - half, 0)
    last = np.minimum(np.arange(n) + half + 1, n)

    def summed(values: Values) -> Values:
        total = np.append(0.0, np.cumsum(values))
        sums: Values = total[last] - total[first]
        return sums

    count = (last - first).astype(np.float64)
    lean: Values = height_m - height_m.mean()
    x, y = summed(at_m), summed(lean)
    spread = count * summed(at_m**2) - x**2
    slope: Values = np.full(n, np.nan)
    enough = (count - 1) * CELL_M >= WINDOW_M / 2
    np.divide(count * summed(at_m * lean) - x * y, spread, out=slope, where=enough & (spread > 0))
    slope[np.abs(slope) * 100.0 > GRADIENT_PCT_MAX] = np.nan
    return slope * 100.0


def climb_of(altitude_m: Values, distances: RowDistances, start_s: Values) -> Climb | None:
    """Ascent and descent of altitudes (n,); None where there is no height."""
    runs = [run.height_m for run in runs_of_heights(altitude_m, distances, start_s)]
    if not runs:
        return None
    heights = np.concatenate(runs)
    steps = np.concatenate([np.diff(run, prepend=run[0]) for run in runs])
    joined = np.cumsum(steps)
    return Climb(climbed(joined), climbed(-joined), float(heights.min()), float(heights.max()))


def climbed(height_m: Values) -> float:
    """Climbs of at least CLIMB_M of heights (n,): each from its foot to its top."""
    total = 0.0
    foot = top = float(height_m[0])
    for height in height_m.tolist():
        if height > top:
            top = height
        elif top - height >= CLIMB_M or height < foot:
            total += top - foot if top - foot >= CLIMB_M else 0.0
            foot = top = height
    return total + (top - foot if top - foot >= CLIMB_M else 0.0)
