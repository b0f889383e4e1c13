"""What a list shows of a ride beside its figures: a line of its speed, where it was, its bests.

Worked out from the rows once, kept beside the ride, and worked out anew by a newer CARD_METHOD.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values
from backend.core.doubts import Doubt
from backend.core.sphere import great_circle_m

CARD_METHOD = 2
LINE_POINTS = 64
# The line is in steps of half a km/h: it is 26 pixels high.
LINE_STEP_KMH = 0.5
LINE_MISSING = 255
# Lengths of the rider's best power, as bike computers tell them.
BEST_S = (5, 60, 300, 1200)
# A ride that ends this near to its start, and went further away, is a loop.
LOOP_END_M = 500.0


@dataclass(frozen=True, slots=True)
class RideCard:
    """speed_line: LINE_POINTS means over equal times, in LINE_STEP_KMH; LINE_MISSING for none.

    power_w_best: the rider's best mean over each of BEST_S. notable: faults and marks it has.
    begin_deg: latitude and longitude of its first position.
    """

    speed_line: bytes = b""
    ascent_m: float | None = None
    power_w_best: tuple[float | None, ...] = (None,) * len(BEST_S)
    notable: int = 0
    begin_deg: tuple[float, float] | None = None
    is_loop: bool | None = None
    doubts: tuple[Doubt, ...] = ()


def speed_line(start_s: Values, speed_kmh: Values | None) -> bytes:
    """Means of rows (n,) over LINE_POINTS equal times, as RideCard has them; empty without a speed.

    start_s: when each row begins, since the ride's start.
    """
    if speed_kmh is None or not np.isfinite(speed_kmh).any():
        return b""
    valid = np.isfinite(speed_kmh)
    points = (start_s * (LINE_POINTS / (start_s[-1] + 1e-6))).astype(np.intp)
    sums = np.bincount(points[valid], speed_kmh[valid], LINE_POINTS)
    counts = np.bincount(points[valid], minlength=LINE_POINTS)
    steps = np.full(LINE_POINTS, LINE_MISSING, np.uint8)
    some = counts > 0
    means = sums[some] / counts[some] / LINE_STEP_KMH
    steps[some] = np.clip(np.rint(means), 0, LINE_MISSING - 1).astype(np.uint8)
    return steps.tobytes()


def line_kmh(speed_line: bytes) -> tuple[float | None, ...]:
    """A stored line as speeds; None where there is none."""
    return tuple(
        None if step == LINE_MISSING else step * LINE_STEP_KMH for step in bytes(speed_line)
    )


def ends_of(
    latitude_deg: Values | None, longitude_deg: Values | None
) -> tuple[tuple[float, float] | None, bool | None]:
    """The first position, and whether the ride came back to it; None without positions."""
    if latitude_deg is None or longitude_deg is None:
        return None, None
    valid = np.isfinite(latitude_deg) & np.isfinite(longitude_deg)
    if not valid.any():
        return None, None
    away_m = great_circle_m(
        float(latitude_deg[valid][0]),
        float(longitude_deg[valid][0]),
        latitude_deg[valid],
        longitude_deg[valid],
    )
    begin = float(latitude_deg[valid][0]), float(longitude_deg[valid][0])
    is_loop = bool(away_m[-1] <= LOOP_END_M < np.max(away_m) / 2)
    return begin, is_loop
