"""The fuzzy table: three rows of five points, 25 rules and how they are combined.

Thesis 4.6 and table 4-2. A FuzzyTable that exists is one the unit can compute; whatever cannot be
is refused when it is built, with every field at fault named.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from backend.errors import FieldError, InvalidRequest

Label = Literal["NB", "NS", "ZO", "PS", "PB"]
LABELS: tuple[Label, ...] = ("NB", "NS", "ZO", "PS", "PB")
"""The five sets of every variable, from least to most; `NB` is the least gain, not a negative."""

INFERENCES = ("mamdani_centroid", "weighted_average")

RANGES = {
    "speed_points_kmh": (0.0, 45.0),
    "torque_rate_points": (0.0, 5.0),
    "gain_points": (0.0, 0.5),
}
"""What the unit takes, as in the registry. The gain's is the thesis' universe: it protects the
rider from a table that triples the torque."""

LEAST_STEPS = {
    "speed_points_kmh": 0.1,
    "torque_rate_points": 0.001,
    "gain_points": 0.001,
}
"""Least distance of neighbouring points, as in the registry: nearer than that the law would divide
by next to nothing, and neither sensor nor rider could tell the points apart."""

STEP_SHARE = np.float32(0.99)
"""Of that distance, compared in float32 as in the unit: decimals a step apart may be nearer."""

NAME_BYTES_MAX = 24

PointField = Literal["speed_points_kmh", "torque_rate_points", "gain_points"]
POINT_FIELDS: tuple[PointField, ...] = ("speed_points_kmh", "torque_rate_points", "gain_points")
PARAMETER_NAMES = {
    "name": "fuzzy_table_name",
    "inference": "fuzzy_inference",
    "speed_points_kmh": "fuzzy_speed_points_kmh",
    "torque_rate_points": "fuzzy_torque_rate_points",
    "gain_points": "fuzzy_gain_points",
    "rules": "fuzzy_rules",
}
"""Field here -> parameter of the unit, for the first table."""

PARAMETERS_OF = {
    "first": PARAMETER_NAMES,
    "second": PARAMETER_NAMES
    | {
        "name": "second_table_name",
        "inference": "second_inference",
        "gain_points": "second_gain_points",
        "rules": "second_rules",
    },
}
"""The same for each of the unit's two tables, by the word a mode chooses its table with."""

SHARED_FIELDS = ("speed_points_kmh", "torque_rate_points")
"""What both tables have in common, because one block of a ride log must hold them (ADR 8)."""


@dataclass(frozen=True, slots=True)
class FuzzyTable:
    """One table, checked. Raises InvalidRequest naming every field at fault.

    name: at most 24 bytes. inference: one of INFERENCES. The points: five each, finite, within
    RANGES, LEAST_STEPS apart as float32. rules: rules[speed][torque rate], labels of LABELS.
    """

    name: str
    inference: str
    speed_points_kmh: tuple[float, ...]
    torque_rate_points: tuple[float, ...]
    gain_points: tuple[float, ...]
    rules: tuple[tuple[Label, ...], ...]

    def __post_init__(self) -> None:
        faults = [
            *_name_faults(self.name),
            *_inference_faults(self.inference),
            *(fault for name in POINT_FIELDS for fault in point_faults(name, getattr(self, name))),
            *_rule_faults(self.rules),
        ]
        if faults:
            listed = "; ".join(fault.message for fault in faults)
            raise InvalidRequest(f"fuzzy table: {listed}", "invalid_fuzzy_table", faults)

    @classmethod
    def from_json(cls, value: Mapping[str, Any]) -> FuzzyTable:
        """From the contract's `fuzzy_table` object. Raises InvalidRequest."""
        missing = [name for name in PARAMETER_NAMES if name not in value]
        unknown = [name for name in value if name not in PARAMETER_NAMES]
        if missing or unknown:
            faults = [
                *(FieldError(name, "missing", f"{name} is missing") for name in missing),
                *(FieldError(name, "unknown", f"{name} is not part of it") for name in unknown),
            ]
            listed = "; ".join(fault.message for fault in faults)
            raise InvalidRequest(f"fuzzy table: {listed}", "invalid_fuzzy_table", faults)
        return cls(
            name=value["name"],
            inference=value["inference"],
            speed_points_kmh=_frozen(value["speed_points_kmh"]),
            torque_rate_points=_frozen(value["torque_rate_points"]),
            gain_points=_frozen(value["gain_points"]),
            rules=tuple(_frozen(row) for row in _frozen(value["rules"])),
        )

    def to_json(self) -> dict[str, Any]:
        """The contract's `fuzzy_table` object."""
        return {
            "name": self.name,
            "inference": self.inference,
            **{name: list(getattr(self, name)) for name in POINT_FIELDS},
            "rules": [list(row) for row in self.rules],
        }

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any], which: str = "first") -> FuzzyTable:
        """From a unit's configuration, by registry names. Raises InvalidRequest.

        which: `first` or `second` of the unit's tables.
        """
        return cls.from_json(stored_json(parameters, which))

    def to_parameters(self, which: str = "first") -> dict[str, Any]:
        """The six parameters this table is in a unit's configuration, as its first or second."""
        value = self.to_json()
        return {name: value[field] for field, name in PARAMETERS_OF[which].items()}

    def label_indices(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        """The rules as int64 (5, 5), 0 for NB to 4 for PB."""
        return np.array([[LABELS.index(label) for label in row] for row in self.rules])


def stored_json(parameters: Mapping[str, Any], which: str = "first") -> dict[str, Any]:
    """The contract's `fuzzy_table` object of a configuration, whatever it holds.

    What an older unit took stays readable where this one would refuse it.
    """
    return {field: parameters[name] for field, name in PARAMETERS_OF[which].items()}


def point_faults(field: str, points: Sequence[Any]) -> Iterable[FieldError]:
    """Whatever is wrong with five points. field: which of POINT_FIELDS they are."""
    if len(points) != len(LABELS):
        yield FieldError(field, "wrong_shape", f"{field} needs five numbers, not {len(points)}")
        return
    previous: float = -np.inf
    for index, point in enumerate(points):
        where = f"{field}[{index}]"
        if isinstance(point, bool) or not isinstance(point, int | float):
            yield FieldError(where, "not_a_number", f"{where} is not a number")
            continue
        if not np.isfinite(point):
            yield FieldError(where, "not_finite", f"{where} is not a finite number")
            continue
        if _narrow(point) - _narrow(previous) < STEP_SHARE * np.float32(LEAST_STEPS[field]):
            message = (
                f"{where} is {point:g} and not at least {LEAST_STEPS[field]:g} above {previous:g}"
            )
            yield FieldError(where, "not_increasing", message)
        low, high = RANGES[field]
        if not low <= point <= high:
            yield FieldError(
                where, "out_of_range", f"{where} is {point:g}, not within {low:g} to {high:g}"
            )
        previous = point


def _frozen(value: Any) -> tuple[Any, ...]:
    """Lists become tuples; anything else stays one wrong element for the checks to name."""
    return tuple(value) if isinstance(value, Sequence) and not isinstance(value, str) else (value,)


def _name_faults(name: Any) -> Iterable[FieldError]:
    if not isinstance(name, str):
        yield FieldError("name", "not_text", "name must be text")
    elif len(name.encode()) > NAME_BYTES_MAX:
        yield FieldError("name", "too_long", f"name is longer than {NAME_BYTES_MAX} bytes")


def _inference_faults(inference: Any) -> Iterable[FieldError]:
    if inference not in INFERENCES:
        choices = " or ".join(INFERENCES)
        yield FieldError("inference", "not_a_choice", f"inference must be {choices}")


def _narrow(point: float) -> np.float32:
    """As the unit holds it; a number beyond float32 is infinite and out of range anyway."""
    with np.errstate(over="ignore"):
        return np.float32(point)


def _rule_faults(rules: Sequence[Sequence[Any]]) -> Iterable[FieldError]:
    if len(rules) != len(LABELS) or any(len(row) != len(LABELS) for row in rules):
        yield FieldError("rules", "wrong_shape", "rules needs five rows of five labels")
        return
    for row_index, row in enumerate(rules):
        for column_index, label in enumerate(row):
            if label not in LABELS:
                where = f"rules[{row_index}][{column_index}]"
                yield FieldError(
                    where, "not_a_choice", f"{where} is {label!r}, not one of {' '.join(LABELS)}"
                )


THESIS_TABLE = FuzzyTable(
    name="thesis 4-2",
    inference="mamdani_centroid",
    speed_points_kmh=(5.0, 10.0, 15.0, 20.0, 25.0),
    torque_rate_points=(0.0, 0.225, 0.45, 0.675, 0.9),
    gain_points=(0.1, 0.2, 0.3, 0.4, 0.5),
    rules=(
        ("ZO", "ZO", "PS", "PB", "PB"),
        ("ZO", "ZO", "PS", "PS", "PB"),
        ("NS", "ZO", "ZO", "PS", "PS"),
        ("NB", "NS", "NS", "ZO", "ZO"),
        ("NB", "NB", "NS", "NS", "NS"),
    ),
)
"""Table 4-2 with its lost cell restored (fuzzy_controller 0, thesis_checks I-12)."""
