"""The centroid's gain in pieces in which it is smooth, and what interval arithmetic says of one.

A cell of the table is quartered: a place in a quarter lies `along` and `across`, 0 to 1/2 of the
cell, away from its nearest point. Where the two are equal min and max change hands; so a quarter is
two pieces, in each of which the level of every output set is 0, a, 1 - a, b or 1 - b. A piece's
coordinates are `across` and `share`, 0 to 1: along = share * across in the piece nearer to the
points, across + share * (1/2 - across) in the other.

With a level's plateau from P - l to P + r around its peak P, and the area A of the joined sets,
    dgain / dlevel = integral of (x - gain) over the plateau / A.
That law, areas and plateaus are those of sim_device/firmware/control/fuzzy_table.c, in float64.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from backend.core.fuzzy_table import FuzzyTable

GAIN_MIN, GAIN_MAX = 0.0, 0.5
QUARTERS = 8
"""Along one axis: two in each of the four cells."""
NEAREST = (0, 1, 1, 2, 2, 3, 3, 4)
FARTHER = (1, 0, 2, 1, 3, 2, 4, 3)

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]


class Interval(NamedTuple):
    """From `low` to `high`, arrays of one shape."""

    low: Floats
    high: Floats

    def __add__(self, other: Interval) -> Interval:  # type: ignore[override]
        return Interval(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Interval) -> Interval:
        return Interval(self.low - other.high, self.high - other.low)

    def __mul__(self, other: Interval) -> Interval:  # type: ignore[override]
        ends = (
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        )
        return Interval(np.minimum.reduce(ends), np.maximum.reduce(ends))

    def shifted(self, by: Floats) -> Interval:
        return Interval(self.low + by, self.high + by)

    def scaled(self, by: Floats | float) -> Interval:
        ends = self.low * by, self.high * by
        return Interval(np.minimum(*ends), np.maximum(*ends))

    def over(self, divisor: Interval) -> Interval:
        """Divided by what is positive."""
        return Interval(
            self.low / np.where(self.low < 0.0, divisor.low, divisor.high),
            self.high / np.where(self.high < 0.0, divisor.high, divisor.low),
        )

    @property
    def middle(self) -> Floats:
        return 0.5 * (self.low + self.high)

    @property
    def width(self) -> Floats:
        return self.high - self.low

    @property
    def size(self) -> Floats:
        """The largest absolute value in it."""
        return np.maximum(np.abs(self.low), np.abs(self.high))


class Places(NamedTuple):
    """Boxes of places of pieces, (n,) each: which quarter along, 1 for the outer of its two pieces,
    which quarter across; and the ranges of share and across."""

    quarter: Ints
    outer: Ints
    line: Ints
    share: Interval
    across: Interval

    def along(self) -> Interval:
        """Distance from the nearest point."""
        low, high = (
            along_of(self.outer, share, across)
            for share, across in zip(self.share, self.across, strict=True)
        )
        return Interval(low, high)


@dataclass(frozen=True, slots=True)
class Enclosure:
    """What is known of the gain in boxes, (n,) each.

    centre: the gain there. gain: all of the box. along, across: its derivatives by the places'
    distances from their nearest points. share_to_along, across_to_along: d along / d share and
    d along / d across.
    """

    centre: Floats
    gain: Interval
    along: Interval
    across: Interval
    share_to_along: Interval
    across_to_along: Interval


class Pieces:
    """One table's pieces along one axis: lines along it, the other axis across."""

    def __init__(self, table: FuzzyTable, axis: str) -> None:
        labels = table.label_indices()
        speeds, rates = _as_in_the_unit(table.speed_points_kmh, table.torque_rate_points)
        if axis == "speed":
            self.labels, self.points, self.lines = labels, speeds, rates
        else:
            self.labels, self.points, self.lines = labels.T, rates, speeds
        (self.peaks,) = _as_in_the_unit(table.gain_points)
        self.widths = np.diff(self.peaks)
        self.first_reach = min((self.peaks[0] - GAIN_MIN) / self.widths[0], 1.0)
        self.last_reach = min((GAIN_MAX - self.peaks[-1]) / self.widths[-1], 1.0)
        self._number_levels()

    def _number_levels(self) -> None:
        """The level of each set in each piece as constant + a * along + b * across, and whether
        it is above its neighbours'."""
        shape = (QUARTERS, 2, QUARTERS, 5)
        self.levels = np.zeros((*shape, 3))
        self.above_left = np.zeros(shape, bool)
        self.above_right = np.zeros(shape, bool)
        for quarter, outer, line in np.ndindex(shape[:3]):
            along, across = (0.375, 0.25) if outer else (0.125, 0.25)
            near, far = NEAREST[quarter], FARTHER[quarter]
            near_line, far_line = NEAREST[line], FARTHER[line]
            heights = np.zeros(5)
            for point, first in ((near, (1.0, -1.0, 0.0)), (far, (0.0, 1.0, 0.0))):
                for other, second in ((near_line, (1.0, 0.0, -1.0)), (far_line, (0.0, 0.0, 1.0))):
                    level = min(first, second, key=lambda f: f[0] + f[1] * along + f[2] * across)
                    height = level[0] + level[1] * along + level[2] * across
                    label = self.labels[point, other]
                    if height > heights[label]:
                        heights[label] = height
                        self.levels[quarter, outer, line, label] = level
            # Equal ones are neighbours of one height: either may count as the upper one.
            self.above_right[quarter, outer, line, :-1] = heights[:-1] >= heights[1:]
            self.above_left[quarter, outer, line, 1:] = heights[1:] > heights[:-1]

    @property
    def length(self) -> float:
        """From the first point along to the last."""
        return float(self.points[-1] - self.points[0])

    def middle(self, places: Places) -> Floats:
        """Coordinate along of the middle of each box."""
        along = along_of(places.outer, places.share.middle, places.across.middle)
        near = self.points[np.take(NEAREST, places.quarter)]
        return np.asarray(near + self.span(places.quarter) * along)

    def ranges(self, places: Places) -> Interval:
        """Coordinates along of each box."""
        near = self.points[np.take(NEAREST, places.quarter)]
        return places.along().scaled(self.span(places.quarter)).shifted(near)

    def line_place(self, line: Ints, across: Floats) -> Floats:
        """Coordinate across of lines."""
        near, far = np.take(NEAREST, line), np.take(FARTHER, line)
        return np.asarray(self.lines[near] + (self.lines[far] - self.lines[near]) * across)

    def span(self, quarter: Ints) -> Floats:
        """Signed width of the quarter's cell, from the nearest point on."""
        near, far = np.take(NEAREST, quarter), np.take(FARTHER, quarter)
        return np.asarray(self.points[far] - self.points[near])

    def enclose(self, places: Places) -> Enclosure:
        """Gain and derivatives over boxes of places."""
        along = places.along()
        which = (places.quarter, places.outer, places.line)
        constant, a, b = np.moveaxis(self.levels[which], -1, 0)
        levels = Interval(constant, constant)
        levels += Interval(along.low[:, None], along.high[:, None]).scaled(a)
        levels += Interval(places.across.low[:, None], places.across.high[:, None]).scaled(b)
        across_centre = places.across.middle
        along_centre = along_of(places.outer, places.share.middle, across_centre)
        at_centre = constant + a * along_centre[:, None] + b * across_centre[:, None]
        area = Interval(self._area(levels.low), self._area(levels.high))
        centre = self._moment(at_centre) / self._area(at_centre)
        left, right = self._plateaus(which, levels)
        # Moment about the centre's gain: zero there, and so the gain's distance from it.
        slope = self._pull(left, right, Interval(centre, centre))
        distance = np.maximum(levels.high - at_centre, at_centre - levels.low)
        reach = (slope.size * distance).sum(axis=1) / area.low
        gain = Interval(np.maximum(centre - reach, GAIN_MIN), np.minimum(centre + reach, GAIN_MAX))
        slope = self._pull(left, right, gain)
        return Enclosure(
            centre,
            gain,
            _sum(slope.scaled(a)).over(area),
            _sum(slope.scaled(b)).over(area),
            _share_to_along(places),
            _across_to_along(places),
        )

    def _plateaus(
        self, which: tuple[Ints, Ints, Ints], levels: Interval
    ) -> tuple[Interval, Interval]:
        """Plateau left and right of each peak. The higher of two neighbours has 1 - level of the
        gap between them, the lower one its level."""
        upper = Interval(1.0 - levels.high, 1.0 - levels.low)
        above = self.above_left[which]
        left = Interval(*(np.where(above, *ends) for ends in zip(upper, levels, strict=True)))
        above = self.above_right[which]
        right = Interval(*(np.where(above, *ends) for ends in zip(upper, levels, strict=True)))
        for side, edge, reach in ((left, 0, self.first_reach), (right, 4, self.last_reach)):
            for end, flat in zip(side, upper, strict=True):
                end[:, edge] = np.minimum(reach, flat[:, edge])
        left_widths = np.concatenate((self.widths[:1], self.widths))
        right_widths = np.concatenate((self.widths, self.widths[-1:]))
        return (
            Interval(left.low * left_widths, left.high * left_widths),
            Interval(right.low * right_widths, right.high * right_widths),
        )

    def _pull(self, left: Interval, right: Interval, gain: Interval) -> Interval:
        """Integral of (x - gain) over each plateau."""
        arm = Interval(self.peaks - gain.high[:, None], self.peaks - gain.low[:, None])
        own = Interval(0.5 * (right.low**2 - left.high**2), 0.5 * (right.high**2 - left.low**2))
        return (left + right) * arm + own

    def _area(self, levels: Floats) -> Floats:
        first, last = levels[..., 0], levels[..., 4]
        low, high = levels[..., :-1], levels[..., 1:]
        gaps = 0.5 * (low + high + np.abs(low - high) * (1.0 - low - high))
        return np.asarray(
            gaps @ self.widths
            + self.widths[0] * _outer_area(first, self.first_reach)
            + self.widths[-1] * _outer_area(last, self.last_reach)
        )

    def _moment(self, levels: Floats) -> Floats:
        first, last = levels[..., 0], levels[..., 4]
        low, high = levels[..., :-1], levels[..., 1:]
        gaps = 0.5 * (low + high + np.abs(low - high) * (1.0 - low - high))
        clip = levels**2 * (0.25 - levels / 6.0)
        middles = 0.5 * (self.peaks[:-1] + self.peaks[1:])
        first_width, last_width = self.widths[0], self.widths[-1]
        outer = (
            self.peaks[0] * first_width * _outer_area(first, self.first_reach)
            + self.peaks[-1] * last_width * _outer_area(last, self.last_reach)
            - first_width**2 * _outer_moment(first, self.first_reach)
            + last_width**2 * _outer_moment(last, self.last_reach)
        )
        return np.asarray(
            gaps @ (self.widths * middles) + np.diff(clip, axis=-1) @ self.widths**2 + outer
        )


def _as_in_the_unit(*rows: Sequence[float]) -> list[Floats]:
    return [np.asarray(row, np.float32).astype(np.float64) for row in rows]


def along_of(outer: Ints, share: Floats, across: Floats) -> Floats:
    """Distance from the nearest point, of the place with these coordinates of its piece."""
    return np.where(outer, across + share * (0.5 - across), share * across)


def _share_to_along(places: Places) -> Interval:
    low, high = places.across
    return Interval(
        np.where(places.outer, 0.5 - high, low), np.where(places.outer, 0.5 - low, high)
    )


def _across_to_along(places: Places) -> Interval:
    low, high = places.share
    return Interval(
        np.where(places.outer, 1.0 - high, low), np.where(places.outer, 1.0 - low, high)
    )


def _sum(terms: Interval) -> Interval:
    return Interval(terms.low.sum(axis=-1), terms.high.sum(axis=-1))


def _outer_area(level: Floats, reach: float) -> Floats:
    flat = np.minimum(reach, 1.0 - level)
    end_level = np.minimum(level, 1.0 - reach)
    return level * flat + 0.5 * (reach - flat) * (level + end_level)


def _outer_moment(level: Floats, reach: float) -> Floats:
    flat = np.minimum(reach, 1.0 - level)
    slope = reach - flat
    end_level = np.minimum(level, 1.0 - reach)
    return (
        flat * (0.5 * level * flat + 0.5 * slope * (level + end_level))
        + slope**2 * (level + 2.0 * end_level) / 6.0
    )
