"""What a table's gain does between its points: proven bounds, never less than the truth.

Weighted average: bilinear in a cell, so that extremes lie at the points; exact.

Min, max and centroid: boxes of places are bisected until what the law does somewhere in them (at
least) and what interval arithmetic proves of all of them (at most) agree. For a change along an
axis a place is a pair on one line. Its order and distance are constraints, met by a Lagrange
multiplier, so that a slope in the wanted direction is told from one against it without ever
smaller boxes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from backend.core.fuzzy_table import FuzzyTable
from backend.law.gain_pieces import QUARTERS, Floats, Interval, Ints, Pieces, Places
from sim_device.firmware.python import law

ROUNDING = 1e-5
"""Bounds include it: five times what float32 adds in the law to a gain at worst."""
AGREED, AGREED_SHARE = 1e-4, 0.005
"""At least and at most agree when they differ by less than this, or by this share."""
ROUNDS_MAX = 100
BOXES_MAX = 200_000
"""After so many a search ends with the bound it has: half a second of a core."""
RETAINED = 512
"""Answers: a page asks again for the same table, an undo for the one before."""
SAME = 1e-6
"""A distance this much too long, as a share, is so by rounding only."""


@dataclass(frozen=True, slots=True)
class Change:
    """The largest change of the gain that was sought.

    at_most: proven. at_least: what the law itself does between two places. speed_kmh, torque_rate:
    where that change ends.
    """

    at_most: float
    at_least: float
    speed_kmh: float
    torque_rate: float

    @property
    def where(self) -> str:
        """The place as findings name it."""
        return f"{self.speed_kmh:.1f} km/h, torque rate {self.torque_rate:.2f}"


@lru_cache(RETAINED)
def largest_rise(
    table: FuzzyTable,
    axis: str,
    sign: int = 1,
    distance: float = math.inf,
    least: float = 0.0,
) -> Change:
    """The largest rise of the gain along an axis, between any two places of one line.

    axis: `speed` or `rate`. sign: -1 for the largest fall. distance: how far apart the two may be,
    in km/h or torque rate. least: a change below it need not be told from none; `at_most` is then
    at most this.
    """
    if table.inference == "weighted_average":
        return _rise_at_points(table, axis, sign, distance)
    search = _RiseSearch(table, axis, sign, distance)
    at_most = search.run(least)
    return Change(at_most, search.largest, *search.largest_at)


@lru_cache(RETAINED)
def gain_range(table: FuzzyTable, first_rate_only: bool = False) -> tuple[float, float]:
    """The least and the greatest gain over the table, or at its first torque rate.

    Never narrower than the truth, and wider by AGREED and ROUNDING at most.
    """
    if table.inference == "weighted_average":
        speeds, rates = table.speed_points_kmh, table.torque_rate_points
        rates = rates[:1] if first_rate_only else rates
        gains = law.gain_surface(table.to_parameters(), speeds, rates)
        low, high = float(gains.min()) - ROUNDING, float(gains.max()) + ROUNDING
    else:
        low = -_GainSearch(table, -1, first_rate_only).run(-math.inf)
        high = _GainSearch(table, 1, first_rate_only).run(-math.inf)
    return max(low, 0.0), high


class _Boxes(NamedTuple):
    """Boxes a search looks at. which: (k, n), the pieces they lie in. low, high: (d, n), sides."""

    which: Ints
    low: Floats
    high: Floats

    def only(self, chosen: npt.NDArray[np.bool_]) -> _Boxes:
        return _Boxes(self.which[:, chosen], self.low[:, chosen], self.high[:, chosen])

    def halves(self, side: Ints) -> _Boxes:
        """Each cut in two at the middle of a side of its own."""
        rows = np.arange(side.size)
        middle = 0.5 * (self.low[side, rows] + self.high[side, rows])
        lower, upper = self.high.copy(), self.low.copy()
        lower[side, rows] = upper[side, rows] = middle
        return _Boxes(
            np.concatenate((self.which, self.which), axis=1),
            np.concatenate((self.low, upper), axis=1),
            np.concatenate((lower, self.high), axis=1),
        )

    def places(self, rows: tuple[int, int, int], share: int) -> Places:
        """The places with these rows of `which`; `share` is one side, the last is across."""
        quarter, outer, line = (self.which[row] for row in rows)
        return Places(
            quarter,
            outer,
            line,
            Interval(self.low[share], self.high[share]),
            Interval(self.low[-1], self.high[-1]),
        )


class _Bounded(NamedTuple):
    """Boxes that can be, their upper bounds (n,), how much each side blurs the bound (d, n)."""

    boxes: _Boxes
    upper: Floats
    blur: Floats


class _Search:
    """Finds the largest value of something the law does; a subclass says of what."""

    def __init__(self, table: FuzzyTable, axis: str, sign: int) -> None:
        self.gain = law.FuzzyGain(table.to_parameters())
        self.axis = axis
        self.sign = sign
        self.pieces = Pieces(table, axis)
        self.agreed_share = AGREED_SHARE
        self.largest = -math.inf
        self.largest_at = (table.speed_points_kmh[0], table.torque_rate_points[0])

    def run(self, least: float) -> float:
        """The upper bound of all. Boxes that cannot matter are dropped, the others bisected."""
        boxes, proven, looked_at = self.first(), -math.inf, 0
        for _ in range(ROUNDS_MAX):
            bounded = self.bounded(boxes)
            enough = max(least - ROUNDING, self.largest + self._agreed())
            open_ones = bounded.upper > enough
            proven = max(proven, float(bounded.upper[~open_ones].max(initial=-math.inf)))
            still = bounded.upper[open_ones]
            looked_at += bounded.upper.size
            if not still.size or looked_at + 2 * still.size > BOXES_MAX:
                break
            boxes = bounded.boxes.only(open_ones).halves(bounded.blur[:, open_ones].argmax(axis=0))
        return max(self.largest, proven, float(still.max(initial=-math.inf))) + ROUNDING

    def _agreed(self) -> float:
        share = 0.0 if math.isinf(self.largest) else abs(self.largest) * self.agreed_share
        return max(AGREED, share)

    def first(self) -> _Boxes:
        """All there is."""
        raise NotImplementedError

    def bounded(self, boxes: _Boxes) -> _Bounded:
        """Bounds of boxes; what the law does in them is noted on the way."""
        raise NotImplementedError

    def law(self, places: Floats, lines: Floats) -> Floats:
        """The unit's gain at places on lines, (n,) each."""
        speeds, rates = (places, lines) if self.axis == "speed" else (lines, places)
        gains = self.gain.points(speeds.astype(np.float32), rates.astype(np.float32))
        return gains.astype(np.float64)

    def note(self, values: Floats, places: Floats, lines: Floats) -> None:
        """Keeps the largest of what the law did."""
        best = int(values.argmax()) if values.size else -1
        if best >= 0 and values[best] > self.largest:
            self.largest = float(values[best])
            at = float(places[best]), float(lines[best])
            self.largest_at = at if self.axis == "speed" else at[::-1]


class _RiseSearch(_Search):
    """Pairs of places on one line; sides are share of the start, share of the end, across."""

    def __init__(self, table: FuzzyTable, axis: str, sign: int, distance: float) -> None:
        super().__init__(table, axis, sign)
        self.distance = distance

    def first(self) -> _Boxes:
        shape = (QUARTERS, 2, QUARTERS, 2, QUARTERS)
        which = np.indices(shape).reshape(len(shape), -1)
        which = which[:, which[0] <= which[2]]
        sides = np.tile([[1.0], [1.0], [0.5]], which.shape[1])
        return _Boxes(which, np.zeros_like(sides), sides)

    def bounded(self, boxes: _Boxes) -> _Bounded:
        boxes = self._possible(boxes)
        pieces, sign = self.pieces, self.sign
        start, end = _ends(boxes)
        start_enclosure, end_enclosure = pieces.enclose(start), pieces.enclose(end)
        span, span_end = pieces.span(start.quarter), pieces.span(end.quarter)
        slope, slope_end = (
            start_enclosure.along.scaled(sign / span),
            end_enclosure.along.scaled(sign / span_end),
        )
        price = 0.5 * (slope.middle + slope_end.middle)
        if math.isinf(self.distance):
            price = np.minimum(price, 0.0)
        net = slope.shifted(-price).scaled(span)
        net_end = slope_end.shifted(-price).scaled(span_end)
        by_line = (end_enclosure.across - start_enclosure.across).scaled(sign)
        sides = (
            net * start_enclosure.share_to_along,
            net_end * end_enclosure.share_to_along,
            by_line
            + net_end * end_enclosure.across_to_along
            - net * start_enclosure.across_to_along,
        )
        half = 0.5 * (boxes.high - boxes.low)
        place, place_end = (pieces.middle(places) for places in (start, end))
        rise = sign * (end_enclosure.centre - start_enclosure.centre)
        paid = np.where(price > 0.0, price * min(self.distance, pieces.length), 0.0)
        upper = rise - price * (place_end - place) + paid
        upper += (np.stack([side.size for side in sides]) * half).sum(axis=0)
        plain = (end_enclosure.gain - start_enclosure.gain).scaled(sign).high
        toward = np.stack((-slope.middle * span, slope_end.middle * span_end, sides[2].middle))
        self._evaluate(boxes, toward)
        return _Bounded(
            boxes, np.minimum(upper, plain), np.stack([side.width for side in sides]) * half
        )

    def _possible(self, boxes: _Boxes) -> _Boxes:
        """Those with a pair in the wanted order, near enough."""
        start, end = (self.pieces.ranges(places) for places in _ends(boxes))
        distance = end - start
        return boxes.only((distance.high >= 0.0) & (distance.low <= self.distance))

    def _evaluate(self, boxes: _Boxes, toward: Floats) -> None:
        """What the law does from the middle of each box to its middle, and at the corner to which
        the slopes lead."""
        corner = np.where(toward > 0.0, boxes.high, boxes.low)
        lows, highs, lines = [], [], []
        for sides in (0.5 * (boxes.low + boxes.high), corner):
            start, end = _ends(_Boxes(boxes.which, sides, sides))
            low, high = self.pieces.middle(start), self.pieces.middle(end)
            lows.append(low)
            highs.append(np.clip(high, low, low + self.distance))
            lines.append(self.pieces.line_place(start.line, sides[-1]))
        both = np.concatenate((*lows, *highs))
        gains = self.law(both, np.concatenate((*lines, *lines)))
        half = both.size // 2
        rises = self.sign * (gains[half:] - gains[:half])
        self.note(rises, both[half:], np.concatenate(lines))


class _GainSearch(_Search):
    """Single places; sides are share and across. The largest gain, or the least one's negative."""

    def __init__(self, table: FuzzyTable, sign: int, first_rate_only: bool) -> None:
        super().__init__(table, "speed", sign)
        self.agreed_share = 0.0
        self.first_rate_only = first_rate_only

    def first(self) -> _Boxes:
        shape = (QUARTERS, 2, 1 if self.first_rate_only else QUARTERS)
        which = np.indices(shape).reshape(len(shape), -1)
        sides = np.tile([[1.0], [0.0 if self.first_rate_only else 0.5]], which.shape[1])
        return _Boxes(which, np.zeros_like(sides), sides)

    def bounded(self, boxes: _Boxes) -> _Bounded:
        sign = self.sign
        places = boxes.places((0, 1, 2), 0)
        start_enclosure = self.pieces.enclose(places)
        sides = (
            start_enclosure.along * start_enclosure.share_to_along,
            start_enclosure.across + start_enclosure.along * start_enclosure.across_to_along,
        )
        half = 0.5 * (boxes.high - boxes.low)
        upper = sign * start_enclosure.centre
        upper += (np.stack([side.size for side in sides]) * half).sum(axis=0)
        upper = np.minimum(upper, start_enclosure.gain.scaled(sign).high)
        toward = np.stack([side.middle for side in sides]) * sign
        for at in (0.5 * (boxes.low + boxes.high), np.where(toward > 0.0, boxes.high, boxes.low)):
            points = _Boxes(boxes.which, at, at).places((0, 1, 2), 0)
            speeds, rates = self.pieces.middle(points), self.pieces.line_place(points.line, at[-1])
            self.note(sign * self.law(speeds, rates), speeds, rates)
        return _Bounded(boxes, upper, np.stack([side.width for side in sides]) * half)


def _ends(boxes: _Boxes) -> tuple[Places, Places]:
    """Starts and ends of pairs."""
    return boxes.places((0, 1, 4), 0), boxes.places((2, 3, 4), 1)


def _rise_at_points(table: FuzzyTable, axis: str, sign: int, distance: float) -> Change:
    """Of a bilinear gain: from a point of the table to another, or as far as is asked."""
    points, lines = table.speed_points_kmh, table.torque_rate_points
    if axis == "rate":
        points, lines = lines, points
    places = np.asarray(points, np.float64)
    if math.isfinite(distance):
        neighbours = np.concatenate((places - distance, places, places + distance))
        places = np.unique(np.clip(neighbours, places[0], places[-1]))
    speeds, rates = (places, lines) if axis == "speed" else (lines, places)
    gains = law.gain_surface(table.to_parameters(), speeds, rates).astype(np.float64)
    gains = gains if axis == "speed" else gains.T
    distances = places[None, :] - places[:, None]
    within = (distances >= 0.0) & (distances <= distance * (1.0 + SAME))
    rises = np.where(within[..., None], sign * (gains[None] - gains[:, None]), -math.inf)
    _, end, line = np.unravel_index(rises.argmax(), rises.shape)
    at = float(places[end]), float(lines[line])
    speed_kmh, rate = at if axis == "speed" else at[::-1]
    largest = float(rises.max())
    return Change(largest + ROUNDING, largest, speed_kmh, rate)
