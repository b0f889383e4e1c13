"""A `.fis` system as a table of the unit's, or a refusal that names the line.

The unit has two laws: Mamdani (min, min, max, centroid) and Sugeno with constants (product,
weighted average). Both need five sets an input, of which neighbours sum to one, and every pair of
sets ruled once. The rest is refused here and not approximated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from backend.core.fuzzy_table import LABELS, NAME_BYTES_MAX, RANGES, FuzzyTable, Label
from backend.errors import InvalidRequest
from backend.law.fis.reading import FisRule, FisSet, FisSystem, FisVariable, refuse

METHODS: Mapping[str, Mapping[str, str]] = {
    "mamdani": {
        "andmethod": "min",
        "impmethod": "min",
        "aggmethod": "max",
        "defuzzmethod": "centroid",
    },
    "sugeno": {"andmethod": "prod", "defuzzmethod": "wtaver"},
}
INFERENCE = {"mamdani": "mamdani_centroid", "sugeno": "weighted_average"}

FOOT_SHARE = 0.01
"""Of the distance to its neighbour: so far a foot may be beside the neighbour's peak. Tools round
to three decimals; what is left of it shows in the largest difference."""


def table_of(system: FisSystem) -> FuzzyTable:
    """The table that a system is. Raises InvalidRequest that names the line at fault."""
    kind = system.options.get("type", "").lower()
    if kind not in METHODS:
        line = system.lines.get("type", 0)
        refuse(line, f"Type is {kind[:40]!r}; the unit has 'mamdani' and 'sugeno'.")
    for option, expected in METHODS[kind].items():
        given = system.options.get(option, "").lower()
        if given != expected:
            line = system.lines.get(option, 0)
            sentence = f"{option} is {given[:40]!r}; with {kind} the unit has {expected!r} alone."
            refuse(line, sentence)
    if len(system.inputs) != 2 or len(system.outputs) != 1:
        refuse(0, "The unit's law has two inputs, speed and torque rate, and one output.")
    speed_first = not is_speed_second(system.inputs)
    speed, rate = system.inputs if speed_first else system.inputs[::-1]
    output = system.outputs[0]
    speed_order, speeds = input_points(speed)
    rate_order, rates = input_points(rate)
    gain_order, gains = constants(output) if kind == "sugeno" else gain_points(output)
    rules: list[list[Label | None]] = [[None for _ in LABELS] for _ in LABELS]
    for rule in system.rules:
        first, second, result = checked(rule)
        row, column = (first, second) if speed_first else (second, first)
        row, column = speed_order[row - 1], rate_order[column - 1]
        if rules[row][column]:
            refuse(rule.line, "Another rule is for the same two sets.")
        rules[row][column] = LABELS[gain_order[result - 1]]
    complete = [[cell for cell in row if cell is not None] for row in rules]
    if missing := sum(
        len(row) - len(rules_given) for row, rules_given in zip(rules, complete, strict=True)
    ):
        refuse(0, f"{missing} of the 25 pairs of sets have no rule.")
    try:
        return FuzzyTable(
            table_name(system.options.get("name", "")),
            INFERENCE[kind],
            tuple(speeds),
            tuple(rates),
            tuple(gains),
            tuple(tuple(row) for row in complete),
        )
    except InvalidRequest as error:
        message = f"The .fis file cannot be used: {error.message}."
        raise InvalidRequest(message, "bad_fis", error.fields) from None


def is_speed_second(inputs: Sequence[FisVariable]) -> bool:
    """Whether the file has the torque rate first; a file that names neither has speed first."""
    first, second = (variable.name.lower() for variable in inputs)
    return "speed" in second and "speed" not in first


def table_name(name: str) -> str:
    """A system's name, cut to what a unit holds."""
    printable = "".join(character for character in name if character.isprintable())
    return printable.encode()[:NAME_BYTES_MAX].decode(errors="ignore").strip() or "fis"


def by_peak(variable: FisVariable, peaks: Sequence[float]) -> tuple[list[int], list[float]]:
    """Which place from low to high each set of the file has, and the peaks in that order."""
    if len(peaks) != len(LABELS):
        refuse(variable.line, f"The unit has five sets here, not {len(peaks)}.")
    order = sorted(range(len(peaks)), key=lambda index: peaks[index])
    places = [order.index(index) for index in range(len(peaks))]
    return places, [peaks[index] for index in order]


def input_points(variable: FisVariable) -> tuple[list[int], list[float]]:
    """Places and peaks of an input's sets. Raises InvalidRequest unless neighbours sum to one."""
    plateaus = [plateau(one) for one in variable.sets]
    low, high = variable.low, variable.high
    # A shoulder holds beyond the universe's end; its peak is where it ends to hold.
    peaks = [right if left <= low < right else left for left, right in plateaus]
    places, points = by_peak(variable, peaks)
    in_order = sorted(variable.sets, key=lambda one: places[variable.sets.index(one)])
    for place, one in enumerate(in_order):
        left, right = plateau(one)
        is_first, is_last = place == 0, place == len(LABELS) - 1
        if left != right and not ((is_first and left <= low) or (is_last and right >= high)):
            refuse(one.line, f"{one.label} is flat between {left:g} and {right:g}.")
        if is_first and points[0] > low and left > low:
            advice = f"below {points[0]:g} no rule acts fully: draw a shoulder"
            refuse(one.line, f"{one.label}: {advice}, trapmf [{low:g} {low:g} ...].")
        if is_last and points[-1] < high and right < high:
            advice = f"above {points[-1]:g} no rule acts fully: draw a shoulder"
            refuse(one.line, f"{one.label}: {advice}, trapmf [... {high:g} {high:g}].")
    require_chain(in_order, points)
    return places, points


def gain_points(variable: FisVariable) -> tuple[list[int], list[float]]:
    """Places and peaks of the output's triangles. Raises InvalidRequest for what is no chain."""
    low, high = RANGES["gain_points"]
    if (variable.low, variable.high) != (low, high):
        refuse(variable.line, f"The unit's gain has the Range [{low:g} {high:g}].")
    for one in variable.sets:
        if one.kind != "trimf":
            refuse(one.line, f"{one.label} is a {one.kind}; the unit's gain has trimf alone.")
    places, points = by_peak(variable, [plateau(one)[0] for one in variable.sets])
    in_order = sorted(variable.sets, key=lambda one: places[variable.sets.index(one)])
    require_chain(in_order, points)
    # The outermost sets are as wide outside as inside, cut where the universe ends.
    for one, foot, peak, inner, end in (
        (in_order[0], in_order[0].numbers[0], points[0], points[1], low),
        (in_order[-1], in_order[-1].numbers[2], points[-1], points[-2], high),
    ):
        mirrored = 2.0 * peak - inner
        cut = (foot - end) * (peak - end) <= 0.0 and (mirrored - end) * (peak - end) <= 0.0
        if peak != end and not cut and not near(foot, mirrored, peak - inner):
            refuse(one.line, f"{one.label} ends at {foot:g}; the unit has it end at {mirrored:g}.")
    return places, points


def constants(variable: FisVariable) -> tuple[list[int], list[float]]:
    """Places and values of a Sugeno output. Raises InvalidRequest for what is not constant."""
    for one in variable.sets:
        if one.kind != "constant" or len(one.numbers) != 1:
            refuse(one.line, f"{one.label} is {one.kind}; the unit has one constant for a label.")
    return by_peak(variable, [one.numbers[0] for one in variable.sets])


def plateau(one: FisSet) -> tuple[float, float]:
    """From where to where a set is fully true. Raises InvalidRequest for an unknown kind."""
    count = {"trimf": 3, "trapmf": 4}.get(one.kind)
    if count is None:
        refuse(one.line, f"{one.label} is a {one.kind[:40]}; the unit has trimf and trapmf.")
    if len(one.numbers) != count or list(one.numbers) != sorted(one.numbers):
        refuse(one.line, f"{one.label}: {one.kind} has {count} numbers that do not fall.")
    return one.numbers[1], one.numbers[-2]


def require_chain(sets: Sequence[FisSet], points: Sequence[float]) -> None:
    """Raises InvalidRequest unless each set ends where its neighbour is full: sums of one."""
    for (one, other), (point, following) in zip(pairwise(sets), pairwise(points), strict=True):
        for foot, peak, owner in (
            (one.numbers[-1], following, one),
            (other.numbers[0], point, other),
        ):
            if not near(foot, peak, following - point):
                fault = f"ends at {foot:g} and not where its neighbour is full, at {peak:g}"
                refuse(owner.line, f"{owner.label} {fault}: the sets do not sum to one.")


def near(value: float, expected: float, gap: float) -> bool:
    """Whether a foot is where it belongs, up to a tool's rounding."""
    return abs(value - expected) <= FOOT_SHARE * abs(gap)


def checked(rule: FisRule) -> tuple[int, int, int]:
    """Both sets and the result of a rule. Raises InvalidRequest for what the unit cannot do."""
    if len(rule.inputs) != 2 or len(rule.outputs) != 1:
        refuse(rule.line, "A rule has two sets of inputs and one of the output.")
    if not rule.is_and:
        refuse(rule.line, "The inputs are joined by OR; the unit has AND alone.")
    if rule.weight != 1.0:
        refuse(rule.line, f"The weight is {rule.weight:g}; the unit's rules all have 1.")
    for number in (*rule.inputs, *rule.outputs):
        if number < 0:
            refuse(rule.line, "The unit has no NOT.")
        if not 1 <= number <= len(LABELS):
            refuse(rule.line, f"There is no set {number}: each rule names one of five.")
    return rule.inputs[0], rule.inputs[1], rule.outputs[0]
