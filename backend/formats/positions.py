"""Positions that a bike cannot have had: without a fix, or out of reach in the time between."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from backend.core.breaks import is_reachable
from backend.core.channels import Values
from backend.core.sphere import great_circle_m

Rows = npt.NDArray[np.intp]

ZERO_DEG = 1e-7
FEW_SHARE = 0.2
"""Of a ride's positions; more that are elsewhere are a journey by train, or another ride."""


def without_nowhere(latitude: Values, longitude: Values) -> int:
    """Take out 0, 0, where a receiver without a fix is, and half positions; how many were at 0, 0.

    Both (n,), changed in place.
    """
    nowhere = (np.abs(latitude) < ZERO_DEG) & (np.abs(longitude) < ZERO_DEG)
    half = np.isfinite(latitude) != np.isfinite(longitude)
    for values in (latitude, longitude):
        values[nowhere | half] = np.nan
    return int(nowhere.sum())


def without_unreachable(latitude: Values, longitude: Values, times_s: Values) -> int:
    """Take out positions that nobody could reach from those around; how many that were.

    Both (n,), changed in place. A track is cut where the time between two positions forbids what
    lies between them. From its longest piece on, in both directions, a piece that cannot be reached
    from the last one that was is left out, one position or many in a row.
    """
    valid = np.flatnonzero(np.isfinite(latitude) & np.isfinite(longitude))
    if len(valid) < 3:
        return 0
    pieces = np.split(valid, np.flatnonzero(~follows(valid[:-1], valid[1:], latitude, longitude,
                                                     times_s)) + 1)  # fmt: skip
    if len(pieces) == 1:
        return 0
    longest = max(range(len(pieces)), key=lambda number: len(pieces[number]))
    unreachable: list[Rows] = []
    last = pieces[longest]
    for piece in pieces[longest + 1 :]:
        if follows(last[-1:], piece[:1], latitude, longitude, times_s)[0]:
            last = piece
        else:
            unreachable.append(piece)
    first = pieces[longest]
    for piece in reversed(pieces[:longest]):
        if follows(piece[-1:], first[:1], latitude, longitude, times_s)[0]:
            first = piece
        else:
            unreachable.append(piece)
    count = sum(map(len, unreachable))
    if count > FEW_SHARE * len(valid):
        return 0
    for piece in unreachable:
        latitude[piece] = longitude[piece] = np.nan
    return count


def follows(
    before: Rows, after: Rows, latitude: Values, longitude: Values, times_s: Values
) -> npt.NDArray[np.bool_]:
    """Whether rows `after` can be reached from rows `before`, (n,) each, in the time between."""
    away_m = great_circle_m(latitude[before], longitude[before], latitude[after], longitude[after])
    return is_reachable(away_m, times_s[after] - times_s[before])
