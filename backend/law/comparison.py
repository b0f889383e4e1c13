"""Two tables side by side: which cells differ, and how far their surfaces are apart and where."""

from __future__ import annotations

import numpy as np

from backend.core.described import described
from backend.core.fuzzy_table import LABELS, POINT_FIELDS, FuzzyTable, Label, PointField
from backend.law.gain import surface

# What a page draws, and how finely the largest difference is looked for beside every point.
DRAWN, LOOKED = 41, 201


@described
class CellChange:
    """A rule with another label. row: of the speed; column: of the torque rate."""

    row: int
    """Of the speed, from 0."""
    column: int
    """Of the torque rate, from 0."""
    left: Label
    right: Label


@described
class LargestDifference:
    """Where two surfaces are furthest apart."""

    gain: float
    """Right less left."""
    speed_kmh: float
    torque_rate: float
    left: float
    right: float


@described
class TableComparison:
    """Two tables, point by point and by what the unit computes of them."""

    cells: tuple[CellChange, ...]
    points_changed: tuple[PointField, ...]
    """Which of the three rows of points differ."""
    inference_changed: bool
    speeds_kmh: list[float]
    torque_rates: list[float]
    left: list[list[float]]
    """Gain, `[speed][torque rate]`."""
    right: list[list[float]]
    """As `left`."""
    largest: LargestDifference
    """Looked for over a finer grid and at every point of both."""


def compare_tables(left: FuzzyTable, right: FuzzyTable) -> TableComparison:
    """Compares what the unit computes of two tables, from standstill to beyond their points."""
    speeds = sorted({*left.speed_points_kmh, *right.speed_points_kmh})
    rates = sorted({*left.torque_rate_points, *right.torque_rate_points})
    ends = speeds[-1], rates[-1]
    drawn = [np.linspace(0.0, end, DRAWN) for end in ends]
    looked = [
        np.union1d(np.linspace(0.0, end, LOOKED), points)
        for end, points in zip(ends, (speeds, rates), strict=True)
    ]
    one, other = (surface(table, *looked).astype(np.float64) for table in (left, right))
    place = np.unravel_index(np.argmax(np.abs(other - one)), one.shape)
    return TableComparison(
        cells=cells_changed(left, right),
        points_changed=tuple(
            field for field in POINT_FIELDS if getattr(left, field) != getattr(right, field)
        ),
        inference_changed=left.inference != right.inference,
        speeds_kmh=drawn[0].tolist(),
        torque_rates=drawn[1].tolist(),
        left=surface(left, *drawn).tolist(),
        right=surface(right, *drawn).tolist(),
        largest=LargestDifference(
            gain=float(other[place] - one[place]),
            speed_kmh=float(looked[0][place[0]]),
            torque_rate=float(looked[1][place[1]]),
            left=float(one[place]),
            right=float(other[place]),
        ),
    )


def cells_changed(left: FuzzyTable, right: FuzzyTable) -> tuple[CellChange, ...]:
    """The rules with another label, row by row."""
    return tuple(
        CellChange(row, column, left.rules[row][column], right.rules[row][column])
        for row in range(len(LABELS))
        for column in range(len(LABELS))
        if left.rules[row][column] != right.rules[row][column]
    )
