"""Rows of two rides on one axis: bins of equal length, counted from the start of each one's window.

A bin has the least, the greatest and the mean value of the rows that begin in it. Where none does
and the row before still holds, it has that row's value; how long a row holds is told by
core.energy. In a gap, before the first row and behind the last one it has nothing. The mean is
over the time that was spent in the bin, so a bin of way tells what was there for how long.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values

ROUNDING = 1e-6
"""Of a bin."""


@dataclass(frozen=True)
class Laid:
    """Rows (n,) on an axis. at: seconds or metres since the window's start, never falling; until:
    where each stops holding; seconds: how long it holds."""

    at: Values
    until: Values
    seconds: Values

    def part(self, low: float, high: float) -> slice:
        """The rows that begin from `low` to `high`, and the one that may still hold at `low`."""
        first = int(np.searchsorted(self.at, low, "left"))
        before = np.flatnonzero(self.seconds[:first] > 0.0)
        begin = int(before[-1]) if len(before) else first
        return slice(begin, int(np.searchsorted(self.at, high, "right")))

    def of(self, rows: slice) -> Laid:
        """Some of the rows."""
        return Laid(self.at[rows], self.until[rows], self.seconds[rows])


@dataclass(frozen=True)
class Bins:
    """minimum, maximum, mean: (bins,), missing as NaN."""

    minimum: Values
    maximum: Values
    mean: Values


def binned(laid: Laid, values: Values, edges: Values) -> Bins:
    """Values of rows (n,), missing as NaN, in the bins between edges (bins + 1,)."""
    # A row on an edge begins there, whatever the last bit of both says.
    edges = edges - ROUNDING * (edges[1] - edges[0])
    first = np.searchsorted(laid.at, edges[:-1], "left")
    stop = np.append(first[1:], np.searchsorted(laid.at, edges[-1], "right"))
    answer = [np.full(len(first), np.nan) for _ in range(3)]
    begun = stop > first
    before = np.maximum(first - 1, 0)
    if len(laid.at):
        continues = (
            ~begun
            & (first > 0)
            & (laid.until[before] > edges[:-1] + 2.0 * ROUNDING * (edges[1] - edges[0]))
        )
        for column in answer:
            column[continues] = values[before[continues]]
    if begun.any():
        starts, rows = first[begun] - first[0], slice(first[0], stop[-1])
        inside, seconds = values[rows], laid.seconds[rows]
        present = np.isfinite(inside)
        weight = np.add.reduceat(np.where(present, seconds, 0.0), starts)
        total = np.add.reduceat(np.where(present, inside * seconds, 0.0), starts)
        answer[0][begun] = np.fmin.reduceat(inside, starts)
        answer[1][begun] = np.fmax.reduceat(inside, starts)
        mean = np.full(len(starts), np.nan)
        answer[2][begun] = np.divide(total, weight, out=mean, where=weight > 0.0)
    return Bins(*answer)
