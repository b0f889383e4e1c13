"""Times that name no zone, in the zone that somebody stated.

Where summer time ends, an hour of the clock comes twice. The order of the rows decides which pass
a row is of: behind a clock that went back it is the second one; a run of rows of one pass belongs
to the side on which time goes on without a gap; where neither does, it is the first.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta, tzinfo

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.formats.cells import unix_seconds

Mask = npt.NDArray[np.bool_]

EPOCH = datetime(1970, 1, 1)
QUARTER_S = 900.0
"""No clock has been put back at another minute for a hundred years."""
WENT_BACK_S = 60.0
"""Rows written out of order differ by less than this."""


def times_in_zone(moments: Sequence[datetime | None], zone: tzinfo | None) -> Values:
    """Unix times (n,) of moments in the order of the file, NaN for none; those without a zone are
    in `zone`, None for UTC."""
    seconds: Values = np.array([unix_seconds(moment) for moment in moments], np.float64)
    naive = np.array([moment is not None and moment.tzinfo is None for moment in moments], bool)
    if zone is not None and naive.any():
        seconds[naive] = in_zone(seconds[naive], zone)
    return seconds


def in_zone(wall_s: Values, zone: tzinfo) -> Values:
    """Unix times (n,) of rows in the order of the file; NaN stays NaN.

    wall_s: what the clock showed, in seconds as though it had shown UTC.
    """
    rows = np.flatnonzero(np.isfinite(wall_s))
    shown = wall_s[rows]
    quarters, of_row = np.unique(np.floor(shown / QUARTER_S), return_inverse=True)
    first, second = (
        np.array([offset_s(quarter * QUARTER_S, zone, fold) for quarter in quarters], np.float64)
        for fold in (0, 1)
    )
    earlier, later = shown - first[of_row], shown - second[of_row]
    twice = first[of_row] > second[of_row]
    seconds: Values = np.full(len(wall_s), np.nan)
    seconds[rows] = np.where(twice & second_pass(shown, earlier, later, twice), later, earlier)
    return seconds


def second_pass(shown: Values, earlier: Values, later: Values, twice: Mask) -> Mask:
    """Which rows (n,) are of the second pass. earlier, later: their Unix time in either one."""
    is_second = np.zeros(len(shown), dtype=bool)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], twice, [False])).astype(np.int8)))
    for start, stop in edges.reshape(-1, 2):
        back = np.flatnonzero(np.diff(shown[start:stop]) < -WENT_BACK_S) + 1
        if len(back):
            is_second[start + back[0] : stop] = True
            continue
        before_s = earlier[start] - earlier[start - 1] if start else np.inf
        after_s = later[stop] - later[stop - 1] if stop < len(shown) else np.inf
        is_second[start:stop] = abs(after_s) < abs(before_s)
    return is_second


def offset_s(wall_s: float, zone: tzinfo, fold: int) -> float:
    """How far a clock of the zone is ahead of UTC when it shows this; NaN beyond all calendars."""
    try:
        shown = (EPOCH + timedelta(seconds=float(wall_s))).replace(tzinfo=zone, fold=fold)
        offset = shown.utcoffset()
    except OverflowError:
        return float("nan")
    return offset.total_seconds() if offset is not None else 0.0
