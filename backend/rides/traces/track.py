"""Where a ride went: a few of its rows, enough to draw its track and to lay every axis over time.

Half of the points stand evenly in time, so that a place between two of them can be derived from its
moment; the others are where the track bends most (Douglas and Peucker 1973, the farthest point
first). In a break of the ride, and between positions that are missing for longer than the shortest
of these, stands one point without a position: no line is drawn there.
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.breaks import LATITUDE, LONGITUDE, apart
from backend.core.channels import Values
from backend.core.distance import DISTANCE_CHANNELS
from backend.rides.traces.axes import Axis, Rows, places

EVEN_POINTS = 1000
BENDS = 1000
# Of the track's extent: what is nearer to the line is less than a pixel on any screen.
FLAT_SHARE = 1 / 4000

RowNumbers = npt.NDArray[np.intp]


@dataclass(frozen=True)
class Track:
    """Points in order of time, each array (n,); None for what the ride did not record, NaN for a
    point without it. Metres and seconds in motion since the ride's start: `axis_positions`."""

    t_s: Values
    moving_s: Values | None
    distance_m: Values | None
    latitude_deg: Values | None
    longitude_deg: Values | None

    def to_json(self) -> dict[str, object]:
        """As the API tells it: missing as null, degrees to a centimetre."""
        return {
            "t_s": numbers(self.t_s, 3),
            "moving_s": numbers(self.moving_s, 3),
            "distance_m": numbers(self.distance_m, 2),
            "latitude_deg": numbers(self.latitude_deg, 7),
            "longitude_deg": numbers(self.longitude_deg, 7),
        }


def track(ride: Rows) -> Track:
    """The points of a whole ride: at most EVEN_POINTS + BENDS and two for each gap."""
    times_s = ride.times_us(0, ride.row_count) / 1e6
    columns = ride.values(DISTANCE_CHANNELS)
    positioned_rows = positioned(columns)
    rows = evenly(times_s)
    breaks = np.empty(0, np.int64)
    if len(positioned_rows):
        bends = positioned_rows[
            bending(columns[LATITUDE][positioned_rows], columns[LONGITUDE][positioned_rows])
        ]
        breaks = np.flatnonzero(apart(positioned_rows, times_s, ride.breaks()))
        ends = np.concatenate(
            (
                positioned_rows[breaks],
                positioned_rows[np.minimum(breaks + 1, len(positioned_rows) - 1)],
            )
        )
        rows = np.unique(np.concatenate((rows, bends, ends)))
    # The point without a position stands right after the last one before the gap.
    opened = np.searchsorted(rows, positioned_rows[breaks]) + 1 if len(breaks) else breaks

    def at(values: Values) -> Values:
        chosen = values[rows]
        between = (chosen[opened - 1] + chosen[np.minimum(opened, len(chosen) - 1)]) / 2
        return np.insert(chosen, opened, between)

    def place(name: str) -> Values | None:
        return np.insert(columns[name][rows], opened, np.nan) if len(positioned_rows) else None

    seconds = ride.row_seconds()

    def points_on(axis: Axis) -> Values | None:
        values = places(columns, times_s, seconds, axis)
        return None if values is None else at(values)

    return Track(
        at(times_s), points_on("moving"), points_on("distance"), place(LATITUDE), place(LONGITUDE)
    )


def positioned(columns: Mapping[str, Values]) -> RowNumbers:
    """Rows with a position."""
    if not {LATITUDE, LONGITUDE} <= columns.keys():
        return np.empty(0, np.intp)
    valid = np.isfinite(columns[LATITUDE]) & np.isfinite(columns[LONGITUDE])
    return np.flatnonzero(valid)


def evenly(times_s: Values) -> RowNumbers:
    """Rows that stand evenly in time, first and last among them."""
    if len(times_s) <= EVEN_POINTS:
        return np.arange(len(times_s))
    even_s = np.linspace(times_s[0], times_s[-1], EVEN_POINTS)
    return np.unique(np.searchsorted(times_s, even_s))


def bending(latitude_deg: Values, longitude_deg: Values) -> RowNumbers:
    """The points (m,) where the track bends most: ends first, then the farthest from the line."""
    around = np.unwrap(longitude_deg, period=360.0)
    narrow = np.cos(np.radians(latitude_deg.mean()))
    flat = np.column_stack((around * narrow, latitude_deg))
    least = FLAT_SHARE * float(np.ptp(flat, axis=0).max())
    chosen = {0, len(flat) - 1}
    waiting: list[tuple[float, int, int, int]] = []

    def split(first: int, last: int) -> None:
        if last - first < 2:
            return
        away = distances(flat[first + 1 : last], flat[first], flat[last])
        far = int(np.argmax(away))
        if away[far] > least:
            heapq.heappush(waiting, (-float(away[far]), first, first + 1 + far, last))

    split(0, len(flat) - 1)
    while waiting and len(chosen) < BENDS:
        _, first, bend, last = heapq.heappop(waiting)
        chosen.add(bend)
        split(first, bend)
        split(bend, last)
    return np.array(sorted(chosen))


def distances(points: Values, begin: Values, end: Values) -> Values:
    """How far points (k, 2) are from the stretch between two others."""
    line = end - begin
    length = float(line @ line)
    share = np.clip((points - begin) @ line / length, 0.0, 1.0) if length else np.zeros(len(points))
    off: Values = points - begin - share[:, None] * line
    return np.hypot(off[:, 0], off[:, 1])


def numbers(values: Values | None, digits: int) -> list[float | None] | None:
    """Rounded, missing as None."""
    if values is None:
        return None
    return [None if np.isnan(value) else round(value, digits) for value in values.tolist()]
