"""What a ride used of its battery's charge, in percent of a full one.

The reading is not that of a meter: it is 0 until the battery answers, it jumps when the battery
connects anew, and it recovers by a step or two when the load ends. So it is taken as the median of
some ten seconds at a time and of the minute around; a zero that it jumps from or to is no reading.
What was used is the sum of its falls. A rise of more than RISE_PCT is a charge on the way or
another battery, a fall that no motor makes is another battery: what was used is counted on from
there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described

Mask = npt.NDArray[np.bool_]

BIN_S = 10.0
WINDOW = 7
RISE_PCT = 5.0
JUMP_PCT = 10.0
FALL_PCT_S_MAX = 0.1
"""Six in a minute: 1.8 kW from 500 Wh."""
END_PCT = 2.0


@described
class ChargeJump:
    """A charge on the way, or another battery."""

    at_s: float
    from_pct: float
    to_pct: float


@dataclass(frozen=True)
class ChargeUse:
    """first_pct, last_pct: at the ends. used_pct: the sum of what it fell by.

    at_s, used_so_far_pct: how that grew, (n,) each.
    """

    first_pct: float
    last_pct: float
    used_pct: float
    jumps: tuple[ChargeJump, ...]
    at_s: Values
    used_so_far_pct: Values


def charge_use(soc_pct: Values, at_s: Values) -> ChargeUse | None:
    """Of readings (n,), missing as NaN, at seconds since the ride's start; None without one."""
    valid = np.isfinite(soc_pct)
    readings, seconds = soc_pct[valid], at_s[valid]
    real = without_false_zeros(readings)
    readings, seconds = readings[real], seconds[real]
    if not len(readings):
        return None
    pieces = unbroken_pieces(*smoothed(readings, seconds))
    used, jumps = 0.0, []
    so_far: list[float] = []
    cuts = np.searchsorted(seconds, [piece_s[0] for _, piece_s in pieces[1:]])
    parts = zip(np.split(readings, cuts), np.split(seconds, cuts), strict=True)
    levels = [smoothed(*part) for part in parts]
    for number, (level, level_s) in enumerate(levels):
        if number:
            before = levels[number - 1][0]
            jumps.append(ChargeJump(float(level_s[0]), float(before[-1]), float(level[0])))
        lows = np.minimum.accumulate(level)
        so_far += (used + lows[0] - lows).tolist()
        used = so_far[-1]
    first, last = float(levels[0][0][0]), float(levels[-1][0][-1])
    level_s = np.concatenate([piece_s for _, piece_s in levels])
    return ChargeUse(first, last, used, tuple(jumps), level_s, np.array(so_far))


def unbroken_pieces(level: Values, level_s: Values) -> list[tuple[Values, Values]]:
    """A smoothed charge cut where it rises, or falls faster than any motor takes it."""
    cuts = []
    low, low_s = float(level[0]), float(level_s[0])
    for at, (one, second) in enumerate(zip(level.tolist(), level_s.tolist(), strict=True)):
        fallen = low - one
        if one > low + RISE_PCT or fallen > max(JUMP_PCT, FALL_PCT_S_MAX * (second - low_s)):
            cuts.append(at)
        if cuts[-1:] == [at] or one <= low:
            low, low_s = one, second
    return list(zip(np.split(level, cuts), np.split(level_s, cuts), strict=True))


def without_false_zeros(readings: Values) -> Mask:
    """Which readings (n,) are some: not the zeros that the charge jumps to, or from."""
    real: Mask = readings != 0.0
    edges = np.flatnonzero(np.diff(np.concatenate(([False], ~real, [False])).astype(np.int8)))
    for start, stop in edges.reshape(-1, 2):
        beside = [readings[start - 1]] if start else []
        beside += [readings[stop]] if stop < len(readings) else []
        if not beside or min(beside) <= JUMP_PCT:
            real[start:stop] = True
    return real


def smoothed(readings: Values, seconds: Values) -> tuple[Values, Values]:
    """The median of every BIN_S, and of WINDOW of these around each, with when it was."""
    bins = np.floor((seconds - seconds[0]) / BIN_S).astype(np.int64)
    starts = np.flatnonzero(np.concatenate(([True], np.diff(bins) > 0)))
    medians = np.array([np.median(part) for part in np.split(readings, starts[1:])])
    half = min(WINDOW // 2, len(medians) - 1)
    around = np.lib.stride_tricks.sliding_window_view(
        np.pad(medians, half, mode="reflect"), 2 * half + 1
    )
    level: Values = np.median(around, axis=1)
    # The window is cut at the ends, where it lags: what fits there is taken as it was read.
    ends = np.r_[:half, len(level) - half : len(level)]
    fits = ends[np.abs(medians[ends] - level[ends]) <= END_PCT]
    level[fits] = medians[fits]
    return level, seconds[starts]
