"""How far the unit is from a `.fis` system, each computed in its own way.

A system is evaluated as MATLAB's `evalfis` does by default, with 101 samples of the output, ends
included. Of the thesis's table that alone is 0.002 from the unit's exact centroid.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from backend.core.described import described
from backend.core.fuzzy_table import FuzzyTable
from backend.law.fis.mapping import is_speed_second
from backend.law.fis.reading import FisSet, FisSystem, FisVariable
from backend.law.gain import surface

SAMPLES = 101
GRID = 81

Numbers = npt.NDArray[np.float64]


@described
class Deviation:
    """The largest difference between the file and the unit over a grid, and where it is."""

    gain: float
    speed_kmh: float
    torque_rate: float
    gain_of_file: float
    gain_of_unit: float
    samples: int | None
    """Of the output, ends included, with which the file was evaluated, as MATLAB does; the unit's
    centroid is exact. Null for a Sugeno system, which has none."""
    points: int
    """So many were compared."""


def deviation(system: FisSystem, table: FuzzyTable) -> Deviation:
    """Compares a system with the table that was made of it."""
    swapped = is_speed_second(system.inputs)
    first, second = system.inputs
    speed, rate = (second, first) if swapped else (first, second)
    speeds = grid(speed, table.speed_points_kmh)
    rates = grid(rate, table.torque_rate_points)
    own = evaluated(system, rates, speeds).T if swapped else evaluated(system, speeds, rates)
    units = np.asarray(surface(table, speeds, rates), np.float64)
    row, column = np.unravel_index(np.argmax(np.abs(own - units)), own.shape)
    return Deviation(
        gain=float(abs(own[row, column] - units[row, column])),
        speed_kmh=float(speeds[row]),
        torque_rate=float(rates[column]),
        gain_of_file=float(own[row, column]),
        gain_of_unit=float(units[row, column]),
        samples=None if is_sugeno(system) else SAMPLES,
        points=own.size,
    )


def grid(variable: FisVariable, points: Sequence[float]) -> Numbers:
    """Where both are looked at: evenly, a little beyond the outer points too, and at each point."""
    beyond = 0.2 * (points[-1] - points[0])
    low, high = max(variable.low, points[0] - beyond), min(variable.high, points[-1] + beyond)
    return np.union1d(np.linspace(low, high, GRID), np.asarray(points))


def is_sugeno(system: FisSystem) -> bool:
    """Whether the output is constants and not sets."""
    return system.options["type"].lower() == "sugeno"


def evaluated(system: FisSystem, first: Numbers, second: Numbers) -> Numbers:
    """The system's output over a grid, float64 (n, m). first: (n,) and second: (m,) inputs."""
    one = [membership(each, first) for each in system.inputs[0].sets]
    other = [membership(each, second) for each in system.inputs[1].sets]
    output = system.outputs[0]
    if is_sugeno(system):
        total: Numbers = np.zeros((first.size, second.size))
        weight: Numbers = np.zeros((first.size, second.size))
        for rule in system.rules:
            fired = one[rule.inputs[0] - 1][:, None] * other[rule.inputs[1] - 1][None, :]
            total += fired * output.sets[rule.outputs[0] - 1].numbers[0]
            weight += fired
        quotient: Numbers = total / weight
        return quotient
    levels = np.zeros((len(output.sets), first.size, second.size))
    for rule in system.rules:
        fired = np.minimum(one[rule.inputs[0] - 1][:, None], other[rule.inputs[1] - 1][None, :])
        levels[rule.outputs[0] - 1] = np.maximum(levels[rule.outputs[0] - 1], fired)
    samples = np.linspace(output.low, output.high, SAMPLES)
    area: Numbers = np.zeros(levels.shape[1:])
    moment: Numbers = np.zeros(levels.shape[1:])
    shapes = [membership(each, samples) for each in output.sets]
    for index, sample in enumerate(samples):
        height = np.zeros(levels.shape[1:])
        for shape, level in zip(shapes, levels, strict=True):
            height = np.maximum(height, np.minimum(level, shape[index]))
        area += height
        moment += sample * height
    centroid: Numbers = moment / area
    return centroid


def membership(one: FisSet, values: Numbers) -> Numbers:
    """How far each value is in a triangle or a trapezoid, (n,)."""
    left, right = one.numbers[0], one.numbers[-1]
    full_from, full_to = one.numbers[1], one.numbers[-2]
    grades: Numbers = np.ones_like(values)
    if full_from > left:
        grades = np.minimum(grades, (values - left) / (full_from - left))
    if right > full_to:
        grades = np.minimum(grades, (right - values) / (right - full_to))
    grades[(values < left) | (values > right)] = 0.0
    return grades
