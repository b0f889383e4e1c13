"""The registry's parameters as services see them, and checks of whole configurations."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass

from backend.device.violations import host_violations
from backend.errors import FieldError
from firmware_protocol._generated import ENUM_BY_NAME, PARAMETERS, Access
from firmware_protocol.layout import Parameter, Value
from firmware_protocol.parameters import default_config, pack_image, unpack_image

__all__ = [
    "PARAMETER_ROWS",
    "ParameterRow",
    "Value",
    "faults_of",
    "group",
    "rounded",
    "unknown_names",
]


@dataclass(frozen=True)
class ParameterRow:
    """What a parameter is. choices: names of an enumeration, None for numbers and texts.

    length: bytes a text may have, None for numbers.
    """

    id: int
    name: str
    group: str
    type: str
    shape: tuple[int, ...]
    unit: str
    min: float | None
    max: float | None
    default: Value
    access: str
    choices: tuple[str, ...] | None
    length: int | None
    description: str


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
        access=Access(row.access).name,
        choices=tuple(ENUM_BY_NAME[row.enum].__members__) if row.enum else None,
        length=row.length if row.type == "text" else None,
        description=row.doc,
    )


PARAMETER_ROWS = tuple(_row(row, default_config()[row.name]) for row in PARAMETERS)
_BY_NAME = {row.name: row for row in PARAMETER_ROWS}


def group(name: str) -> tuple[str, ...]:
    """Names of the parameters of one group, in the order of their ids."""
    return tuple(row.name for row in PARAMETER_ROWS if row.group == name)


def unknown_names(changes: Mapping[str, Value]) -> list[FieldError]:
    """Names that are no parameter."""
    return [
        FieldError(name, "unknown_parameter", f"{name} is not a parameter of this unit.")
        for name in changes
        if name not in _BY_NAME
    ]


def faults_of(config: Mapping[str, Value]) -> list[FieldError]:
    """Everything that is wrong with a whole configuration, each element named."""
    return host_violations(config)


def rounded(config: Mapping[str, Value]) -> dict[str, Value]:
    """A checked configuration as the unit will hold it: numbers as their float32."""
    return unpack_image(pack_image(config))


def image_crc32(config: Mapping[str, Value]) -> int:
    """The checksum a unit gives for this whole configuration."""
    return zlib.crc32(pack_image(config))
