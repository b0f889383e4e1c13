"""The registry's parameters as services see them; what is wrong with values, as fields with
sentences."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from typing import Any, cast

from backend.core.quantities import plain
from backend.device.configuration import Free, ParameterRow, ParameterTable
from backend.errors import FieldError
from firmware_protocol._generated import (
    BAND_BY_NAME,
    PARAMETER_BY_ID,
    PARAMETERS,
    Access,
    Violation,
)
from firmware_protocol.bands import band_limits
from firmware_protocol.layout import Parameter, Value
from firmware_protocol.parameter_values import choices_of
from firmware_protocol.parameters import default_config, pack_image, unpack_image, violations
from firmware_protocol.spelling import word_of

FACTORY = word_of(Access.FACTORY.name)


def _row(row: Parameter, default: Value) -> ParameterRow:
    return ParameterRow(
        id=row.id,
        name=row.name,
        group=row.group,
        type=row.type,
        shape=row.shape,
        unit=row.unit,
        min=row.min,
        max=row.max,
        default=default,
        access=cast(Any, word_of(Access(row.access).name)),
        choices=choices_of(row) if row.enum else None,
        length=row.length if row.type == "text" else None,
        description=row.doc,
        may_be_none=row.may_be_none,
        of_the_unit=row.of_the_unit,
    )


PARAMETER_ROWS = tuple(_row(row, default_config()[row.name]) for row in PARAMETERS)


class EblParameters(ParameterTable):
    """Checks by the registry, and by the rules that the unit's own code checks."""

    rows = PARAMETER_ROWS
    factory = frozenset(row.name for row in PARAMETER_ROWS if row.access == FACTORY)

    def free_of(self, name: str, config: Mapping[str, Value]) -> Free | None:
        """The band of a parameter in this configuration; None for one without."""
        band = BAND_BY_NAME.get(name)
        return None if band is None else Free(*band_limits(band, config), band.around)

    def faults_of(self, config: Mapping[str, Value]) -> list[FieldError]:
        """Everything that is wrong with a whole configuration, each element named."""
        return host_violations(config)

    def rounded(self, config: Mapping[str, Value]) -> dict[str, Value]:
        """A checked configuration as the unit will hold it: numbers as their float32."""
        return unpack_image(pack_image(config))

    def crc32_of(self, config: Mapping[str, Value]) -> int:
        """The checksum a unit gives for this whole configuration."""
        return zlib.crc32(pack_image(config))


TABLE = EblParameters()


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
