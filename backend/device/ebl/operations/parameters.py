"""The registry's parameters as services see them, and checks of whole configurations."""

from __future__ import annotations

import zlib
from collections.abc import Mapping

from backend.device.configuration import Free, ParameterRow, ParameterTable, Value
from backend.device.ebl.operations.violations import host_violations
from backend.errors import FieldError
from firmware_protocol._generated import BAND_BY_NAME, PARAMETERS, Access
from firmware_protocol.bands import band_limits
from firmware_protocol.layout import Parameter
from firmware_protocol.parameter_values import choices_of
from firmware_protocol.parameters import default_config, pack_image, unpack_image
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
        access=word_of(Access(row.access).name),
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
