"""A unit's list of wrong values, and the host's own, as fields with sentences."""

from __future__ import annotations

import struct
from collections.abc import Mapping

from backend.core.quantities import plain
from backend.errors import FieldError
from firmware_protocol._generated import PARAMETER_BY_ID, Violation
from firmware_protocol.layout import Parameter, Value
from firmware_protocol.parameters import violations
from firmware_protocol.spelling import word_of

_ROW = struct.Struct("<HBB")

MEANING = {
    Violation.NOT_FINITE: "is not a finite number",
    Violation.BELOW_MIN: "is below its minimum",
    Violation.ABOVE_MAX: "is above its maximum",
    Violation.NOT_INCREASING: "must be greater than the value before it, by its least step",
    Violation.NOT_A_CHOICE: "is none of its choices",
    Violation.NOT_TEXT: "is no text the unit can show",
    Violation.TAPER_ORDER: "must be greater than where the taper starts",
}


def unit_violations(payload: bytes) -> list[FieldError]:
    """Read the list that follows INVALID_CONFIG: id u16, index u8, code u8 each."""
    usable = len(payload) - len(payload) % _ROW.size
    return [_named(*row) for row in _ROW.iter_unpack(payload[:usable])]


def host_violations(config: Mapping[str, Value]) -> list[FieldError]:
    """What is wrong with a whole configuration, before anything is sent."""
    return [
        FieldError(
            _field_name(violation.field, violation.index),
            word_of(violation.code),
            violation.message,
        )
        for violation in violations(config)
    ]


def _named(parameter_id: int, index: int, code: int) -> FieldError:
    row = PARAMETER_BY_ID.get(parameter_id)
    violation = Violation(code) if code in set(Violation) else None
    field = _position(row, index) if row else f"parameter {parameter_id:#06x}"
    meaning = MEANING[violation] if violation else f"is refused for reason {code}"
    word = word_of(violation.name) if violation else f"code_{code}"
    return FieldError(field, word, f"{field} {meaning}{_bounds(row)}.")


def _bounds(row: Parameter | None) -> str:
    if row is None or row.min is None or row.max is None:
        return ""
    unit = f" {row.unit}" if row.unit else ""
    return f" ({plain(row.min, 6)} to {plain(row.max, 6)}{unit})"


def _field_name(name: str, index: int) -> str:
    from_registry = {row.name: row for row in PARAMETER_BY_ID.values()}
    row = from_registry.get(name)
    return _position(row, index) if row else name


def _position(row: Parameter, index: int) -> str:
    """`fuzzy_rules[2][0]` for the element at `index` in the order of the image."""
    text = ""
    for size in reversed(row.shape):
        text = f"[{index % size}]{text}"
        index //= size
    return row.name + text
