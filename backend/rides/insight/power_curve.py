"""Mean maximal power: the greatest mean over every stretch of a length, for lengths up to the ride.

Power holds from a sample until the next, so work over time is a line with corners, and the best
stretch of a length begins or ends at one of them: looking there finds it exactly, at any sampling.
A stretch with a missing sample or a pause in it does not count.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from backend.core.channels import Values
from backend.core.described import described

MINUTE_S, HOUR_S = 60, 3600
DURATIONS_S = (
    *(1, 2, 5, 10, 15, 20, 30),
    *(minutes * MINUTE_S for minutes in (1, 2, 3, 5, 8, 10, 15, 20, 30, 45)),
    *(hours * HOUR_S for hours in (1, 1.5, 2, 3, 4, 6, 8, 12, 24)),
)
MISSING_S = 1e-6
"""Less than a clock's microsecond is no gap."""


@described
class BestMean:
    """The greatest mean over this long, in the stretch that begins at `from_s`."""

    duration_s: float
    power_w: float
    from_s: float


def power_curve(
    power_w: Values,
    start_s: Values,
    seconds: Values,
    durations_s: Sequence[float] = DURATIONS_S,
) -> list[BestMean]:
    """Best means of power (n,), missing as NaN, that begins at start_s and holds for `seconds`.

    The last is of the longest stretch without a gap: the whole ride if it has none.
    """
    if not len(power_w):
        return []
    valid = np.isfinite(power_w)
    begins, ends = start_s, start_s + seconds
    # Corners of two lines over time: work, and time without a sample; a pause is one more piece.
    corner_s = np.column_stack((begins, ends)).reshape(-1).round(6)
    work_j = np.where(valid, power_w, 0.0) * seconds
    holes = np.where(valid, 0.0, seconds)
    pauses = np.append(0.0, begins[1:] - ends[:-1])
    work = np.cumsum(np.column_stack((np.zeros(len(work_j)), work_j)).reshape(-1))
    missing = np.cumsum(np.column_stack((np.maximum(pauses, 0.0), holes)).reshape(-1))
    corner_s, first = np.unique(corner_s, return_index=True)
    work, missing = work[first], missing[first]
    longest_s = longest_run(corner_s, missing)
    lengths = [float(length) for length in durations_s if length < longest_s - MISSING_S]
    means = [best_mean(corner_s, work, missing, length) for length in (*lengths, longest_s)]
    return [best for best in means if best is not None]


def longest_run(corner_s: Values, missing_s: Values) -> float:
    """The longest stretch between corners in which nothing is missing."""
    unbroken = np.diff(missing_s) <= MISSING_S
    edges = np.flatnonzero(np.diff(np.concatenate(([False], unbroken, [False])).astype(np.int8)))
    runs = edges.reshape(-1, 2)
    longest = max((corner_s[stop] - corner_s[start] for start, stop in runs), default=0.0)
    return round(float(longest), 6)


def best_mean(
    corner_s: Values, work_j: Values, missing_s: Values, length: float
) -> BestMean | None:
    """The best stretch of this length, among those that begin or end at a corner."""
    if length <= 0.0:
        return None
    rows = round(length / float(corner_s[1] - corner_s[0]))
    if 0 < rows < len(corner_s) and is_even(corner_s, rows, length):
        # Even rows: a stretch that begins at a corner ends at one, and nothing is between them.
        gained, gone = work_j[rows:] - work_j[:-rows], missing_s[rows:] - missing_s[:-rows]
        return best_of(corner_s[:-rows], gained, gone, length)
    candidates = [best_from(corner_s, work_j, missing_s, length, at) for at in (0.0, length)]
    return max((best for best in candidates if best), key=lambda best: best.power_w, default=None)


def best_from(
    corner_s: Values, work_j: Values, missing_s: Values, length: float, before_s: float
) -> BestMean | None:
    """The best stretch among those that begin before_s before a corner."""
    begins = corner_s - before_s
    inside = (begins >= corner_s[0] - MISSING_S) & (begins + length <= corner_s[-1] + MISSING_S)
    begins = begins[inside]

    def over(line: Values) -> Values:
        ends = np.interp(begins + length, corner_s, line)
        gained: Values = ends - np.interp(begins, corner_s, line)
        return gained

    return best_of(begins, over(work_j), over(missing_s), length)


def is_even(corner_s: Values, rows: int, length: float) -> bool:
    """Whether so many corners on it is always this length."""
    off_s = corner_s[rows:] - corner_s[:-rows] - length
    return bool(np.max(np.abs(off_s)) <= MISSING_S)


def best_of(begins: Values, work_j: Values, missing_s: Values, length: float) -> BestMean | None:
    """The best of stretches (m,) by when they begin, their work and their time without samples."""
    unbroken = missing_s <= MISSING_S
    if not unbroken.any():
        return None
    best = int(np.argmax(np.where(unbroken, work_j, -np.inf)))
    return BestMean(length, float(work_j[best]) / length, float(begins[best]))
