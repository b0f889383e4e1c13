"""The most a table's gain can be between two speed points, from the rules at its corners alone.

Weighted average: the gain is a mean of at most four peaks, so it is at most the highest of them.

Min, max and centroid: let b be the highest label of the corners. What the joined sets have beyond
the clipped set of b lies at its peak P or below, since a lower set ends at the peak above its own.
So the centroid is at most P, or the centroid of that set alone where this is higher. A clipped
triangle reaches `left` and `right` of P, and over both the height only falls away from P, so its
centroid is at most (right - left) / 2 above it: the mean distance from P on a side is at most half
of that side. A first set that the universe cuts has the less of a left side.
"""

from __future__ import annotations

import numpy as np

from backend.core.fuzzy_table import FuzzyTable
from backend.law.gain_bounds import ROUNDING


def gain_most(table: FuzzyTable) -> tuple[float, ...]:
    """The most gain in each of the four rows of cells, from the slowest; float32 included.

    The slowest holds for every speed below it too, the fastest for every one above.
    """
    peaks = np.asarray(table.gain_points, np.float32).astype(np.float64)
    most = peaks.copy()
    if table.inference != "weighted_average":
        widths = np.diff(peaks)
        left = np.minimum(np.concatenate((widths[:1], widths)), peaks)
        right = np.concatenate((widths, [0.0]))
        most += 0.5 * np.maximum(right - left, 0.0)
    labels = table.label_indices()
    highest = np.maximum(labels[:-1], labels[1:]).max(axis=1)
    return tuple(float(gain) for gain in most[highest] + ROUNDING)
