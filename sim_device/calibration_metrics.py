"""Figures of an error test as the simulator tells them: thesis eq. 3.18 to 3.21, plain Python.

The server has its own (backend.calibration.figures), for readings of any sensor; a test
holds both against each other and against the thesis' tables.
"""

from collections.abc import Callable, Sequence
from math import hypot
from statistics import fmean
from typing import Any

Readings = Sequence[Sequence[float]]


def metrics(
    full_scale_nm: float, load_nm: Sequence[float], forward: Readings, reverse: Readings
) -> dict[str, Any]:
    """linearity, hysteresis, repeatability and total in percent of full scale.

    load_nm: (k,). forward, reverse: (r, k) readings in Nm. Repeatability by the largest deviation
    from the mean and by the range of the readings (thesis_checks I-7).
    """
    percent = 100.0 / full_scale_nm
    up, down = _means(forward), _means(reverse)
    linearity = percent * max(
        abs((u + d) / 2 - load) for u, d, load in zip(up, down, load_nm, strict=True)
    )
    hysteresis = percent * max(abs(u - d) for u, d in zip(up, down, strict=True)) / 2
    deviation = percent * _largest(forward, reverse, _deviation)
    spread = percent * _largest(forward, reverse, _range)
    return {
        "linearity_pct": linearity,
        "hysteresis_pct": hysteresis,
        "repeatability_pct": {"deviation": deviation, "range": spread},
        "total_pct": {
            "deviation": hypot(linearity, hysteresis, deviation),
            "range": hypot(linearity, hysteresis, spread),
        },
    }


def _means(strokes: Readings) -> list[float]:
    return [fmean(column) for column in zip(*strokes, strict=True)]


def _deviation(column: Sequence[float]) -> float:
    mean = fmean(column)
    return max(abs(reading - mean) for reading in column)


def _range(column: Sequence[float]) -> float:
    return max(column) - min(column)


def _largest(
    forward: Readings, reverse: Readings, spread: Callable[[Sequence[float]], float]
) -> float:
    columns = [*zip(*forward, strict=True), *zip(*reverse, strict=True)]
    return max(spread(column) for column in columns)
