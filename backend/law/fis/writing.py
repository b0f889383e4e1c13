"""A table as a `.fis` file that another reader evaluates to the same surface.

The universes are those of the unit's parameters and not the table's own: a shoulder then reaches
as far as an input may, also in readers that do not limit their inputs. What the format has no place
for is left out: the filter, the limits, the mode's ratio.
"""

from __future__ import annotations

from collections.abc import Sequence

from backend.core.fuzzy_table import LABELS, RANGES, FuzzyTable

SYSTEM = {
    "mamdani_centroid": ("mamdani", "min", "max", "min", "max", "centroid"),
    "weighted_average": ("sugeno", "prod", "probor", "prod", "sum", "wtaver"),
}


def write_fis(table: FuzzyTable) -> str:
    """The file's text. Numbers are the shortest that give the same double again."""
    kind, and_, or_, implication, aggregation, defuzzification = SYSTEM[table.inference]
    is_sugeno = kind == "sugeno"
    low, high = RANGES["gain_points"]
    gain = [constant(point) if is_sugeno else triangle(table.gain_points, index)
            for index, point in enumerate(table.gain_points)]  # fmt: skip
    rules = [
        f"{row} {column}, {LABELS.index(label) + 1} (1) : 1"
        for row, labels in enumerate(table.rules, start=1)
        for column, label in enumerate(labels, start=1)
    ]
    lines = [
        "[System]",
        f"Name='{plain(table.name)}'",
        f"Type='{kind}'",
        "Version=2.0",
        "NumInputs=2",
        "NumOutputs=1",
        f"NumRules={len(rules)}",
        f"AndMethod='{and_}'",
        f"OrMethod='{or_}'",
        f"ImpMethod='{implication}'",
        f"AggMethod='{aggregation}'",
        f"DefuzzMethod='{defuzzification}'",
        "",
        *input_lines(1, "speed_kmh", table.speed_points_kmh, RANGES["speed_points_kmh"]),
        *input_lines(2, "torque_rate", table.torque_rate_points, RANGES["torque_rate_points"]),
        *variable_lines("Output1", "gain", (low, high), gain),
        "[Rules]",
        *rules,
    ]
    return "\n".join(lines) + "\n"


def input_lines(
    number: int, name: str, points: Sequence[float], universe: tuple[float, float]
) -> list[str]:
    """An input's section: triangles between shoulders at the first and the last point."""
    low, high = universe
    sets = [triangle(points, index) for index in range(len(points))]
    if points[0] > low:
        sets[0] = f"'trapmf',{listed(low, low, points[0], points[1])}"
    if points[-1] < high:
        sets[-1] = f"'trapmf',{listed(points[-2], points[-1], high, high)}"
    return variable_lines(f"Input{number}", name, universe, sets)


def variable_lines(
    section: str, name: str, universe: tuple[float, float], sets: Sequence[str]
) -> list[str]:
    """A section, an empty line after it."""
    named = zip(LABELS, sets, strict=True)
    return [
        f"[{section}]",
        f"Name='{name}'",
        f"Range={listed(*universe)}",
        f"NumMFs={len(sets)}",
        *(f"MF{index}='{label}':{one}" for index, (label, one) in enumerate(named, start=1)),
        "",
    ]


def triangle(points: Sequence[float], index: int) -> str:
    """The set at a point: as wide as the way to its neighbours, the outermost as wide outside."""
    peak = points[index]
    left = points[index - 1] if index else 2.0 * peak - points[1]
    right = points[index + 1] if index + 1 < len(points) else 2.0 * peak - points[-2]
    return f"'trimf',{listed(left, peak, right)}"


def constant(value: float) -> str:
    """The set of a Sugeno output."""
    return f"'constant',{listed(value)}"


def listed(*numbers: float) -> str:
    """Numbers as MATLAB writes them: `[0 0 5 10]`."""
    return f"[{' '.join(repr(float(number)).removesuffix('.0') for number in numbers)}]"


def plain(name: str) -> str:
    """A name without what ends a text or begins a comment in such a file."""
    return "".join(" " if character in "'%[]" else character for character in name)
