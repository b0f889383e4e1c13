"""Whether two rides went the same way: how much of each track lies near the other one.

Both tracks are laid on one plane around their middle and walked in steps of STEP_M; nothing is
walked over a gap between positions. A position of a bicycle computer is off by 5 to 10 m, two of
them and a road with two sides by 25: NEAR_M is one road, and less than the next one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.breaks import Mask, apart
from backend.core.channels import Values
from backend.core.described import described
from backend.core.sphere import EARTH_M

NEAR_M = 30.0
STEP_M = 10.0
CELL_M = 4.0
"""Of points that lie closer together one stands for all: laps of a track stay few points."""


@dataclass(frozen=True)
class Positions:
    """Of rows (n,), missing as NaN. breaks: of the steps from row to row (n - 1,). at_m: distance
    since the window's start, None where not known."""

    latitude_deg: Values
    longitude_deg: Values
    start_s: Values
    breaks: Mask
    at_m: Values | None


@described
class RouteOverlap:
    """Shares, 0 to 1, of tracks walked in steps of 10 m."""

    near_m: float
    a_near_b: float
    """Of A's track, so near to B's, whenever B was there."""
    b_near_a: float
    """As `a_near_b`."""
    in_step: float | None
    """Of the way that both have, where they are so near at the same distance from their starts: how
    well they line up by distance. Null without a way."""


@dataclass(frozen=True)
class Walked:
    """Points (k, 2) in metres on the plane, a step apart; at_m (k,): the way at each."""

    points_m: Values
    at_m: Values


def route_overlap(a: Positions, b: Positions) -> RouteOverlap | None:
    """None unless both have two positions that follow each other."""
    latitudes_deg = np.concatenate([side.latitude_deg for side in (a, b)])
    if not np.isfinite(latitudes_deg).any():
        return None
    middle_deg = float(np.nanmean(latitudes_deg))
    first_deg = next(
        (float(side.longitude_deg[np.isfinite(side.longitude_deg)][0]))
        for side in (a, b)
        if np.isfinite(side.longitude_deg).any()
    )
    one, other = (walked(side, middle_deg, first_deg) for side in (a, b))
    if one is None or other is None:
        return None
    in_step = None
    if a.at_m is not None and b.at_m is not None:
        in_step = share_in_step(one, other)
    return RouteOverlap(
        NEAR_M,
        share_near(one.points_m, other.points_m),
        share_near(other.points_m, one.points_m),
        in_step,
    )


def walked(side: Positions, middle_deg: float, first_deg: float) -> Walked | None:
    """A track in steps of STEP_M; None where no two positions follow each other."""
    valid = np.flatnonzero(np.isfinite(side.latitude_deg) & np.isfinite(side.longitude_deg))
    if len(valid) < 2:
        return None
    around = np.mod(side.longitude_deg[valid] - first_deg + 180.0, 360.0) - 180.0
    narrow = np.cos(np.radians(middle_deg))
    plane = np.radians(np.column_stack((around * narrow, side.latitude_deg[valid] - middle_deg)))
    points = plane * EARTH_M
    at_m = np.zeros(len(valid)) if side.at_m is None else side.at_m[valid]
    step = np.where(
        ~apart(valid, side.start_s, side.breaks), np.hypot(*np.diff(points, axis=0).T), 0.0
    )
    distance_m = np.append(0.0, np.cumsum(step))
    if distance_m[-1] <= 0.0:
        return None
    # In a break `distance_m` is constant: the search finds the later of its two ends.
    steps_m = np.arange(0.0, distance_m[-1], STEP_M)
    begin = np.searchsorted(distance_m, steps_m, "right") - 1
    share = ((steps_m - distance_m[begin]) / step[begin])[:, None]
    laid = points[begin] + share * (points[begin + 1] - points[begin])
    return Walked(laid, at_m[begin] + share[:, 0] * (at_m[begin + 1] - at_m[begin]))


def share_near(points_m: Values, others_m: Values) -> float:
    """Share of points (k, 2) that have one of others (n, 2) within NEAR_M.

    The others are kept in cells as wide as that, so that only nine are looked at for each point.
    """
    thin = others_m[np.unique(np.floor(others_m / CELL_M), axis=0, return_index=True)[1]]
    low = np.minimum(points_m.min(axis=0), thin.min(axis=0)) - 2.0 * NEAR_M
    columns = int((max(points_m[:, 0].max(), thin[:, 0].max()) - low[0]) / NEAR_M) + 3

    def cell(of_m: Values) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        place = ((of_m - low) // NEAR_M).astype(np.int64)
        number: np.ndarray[tuple[int], np.dtype[np.int64]] = place[:, 1] * columns + place[:, 0]
        return number

    order = np.argsort(cell(thin), kind="stable")
    thin = thin[order]
    numbers, mine = cell(thin), cell(points_m)
    near = np.zeros(len(points_m), np.bool_)
    for up in (-columns, 0, columns):
        # Three cells of a line of cells stand behind each other.
        first = np.searchsorted(numbers, mine + up - 1, "left")
        stop = np.searchsorted(numbers, mine + up + 1, "right")
        count = stop - first
        owner = np.repeat(np.arange(len(points_m)), count)
        behind = np.arange(int(count.sum())) - np.repeat(np.cumsum(count) - count, count)
        away = points_m[owner] - thin[np.repeat(first, count) + behind]
        near[owner[np.hypot(away[:, 0], away[:, 1]) <= NEAR_M]] = True
    return float(near.mean())


def share_in_step(one: Walked, other: Walked) -> float | None:
    """Share of the way that both have on which they are near each other; None if there is none.

    Of points of the first only those with a point of the other within a step of way are asked.
    """
    after = np.minimum(np.searchsorted(other.at_m, one.at_m), len(other.at_m) - 1)
    before = np.maximum(after - 1, 0)
    nearer = np.abs(other.at_m[before] - one.at_m) < np.abs(other.at_m[after] - one.at_m)
    match = np.where(nearer, before, after)
    both = np.abs(other.at_m[match] - one.at_m) <= STEP_M
    if not both.any():
        return None
    away = one.points_m[both] - other.points_m[match[both]]
    return float((np.hypot(away[:, 0], away[:, 1]) <= NEAR_M).mean())
