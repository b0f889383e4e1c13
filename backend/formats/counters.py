"""Counts of distance that begin anew: in each lap, in a second session, after a restart."""

from __future__ import annotations

import numpy as np

from backend.core.channels import Values

WENT_BACK_M = 10.0
"""A count by satellite positions falls by less."""
BREAK_S = 5.0
"""Between rows; over a longer one nobody knows whether the bike went on."""
START_M = 20.0
"""So far a device counts before it writes its first row."""


def continue_counter(values: Values, times_s: Values, rate_max: float) -> int:
    """Let a count (n,) go on, in place, where it begins anew; how often it did.

    Where it falls, or grows faster than `rate_max` a second, another count begins. What was ridden
    between the two is what the new one shows if it began at 0, at least what the row before went in
    a second; of a break, and of a count that did not begin at 0, it is unknown and not added.
    """
    valid = np.flatnonzero(np.isfinite(values))
    if len(valid) < 2:
        return 0
    counted = values[valid]
    steps, seconds = np.diff(counted), np.diff(times_s[valid])
    reach_m = rate_max * seconds + START_M
    anew = (steps < -WENT_BACK_M) | (steps > reach_m)
    if not anew.any():
        return 0
    began_at = np.where((steps < 0) & (counted[1:] <= reach_m), counted[1:], 0.0)
    rate = np.concatenate(([0.0], np.maximum(steps, 0.0)[:-1] / seconds[:-1]))
    goes_on = (seconds <= BREAK_S) & (rate <= rate_max)
    began_at = np.where(goes_on, np.maximum(began_at, rate * seconds), began_at)
    values[valid] = counted[0] + np.concatenate(
        ([0.0], np.cumsum(np.where(anew, began_at, np.maximum(steps, 0.0))))
    )
    return int(anew.sum())
