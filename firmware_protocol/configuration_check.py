"""Whether a unit would take what a configuration file holds: names, units, families and values."""

from dataclasses import dataclass

from firmware_protocol._generated import PARAMETER_BY_NAME
from firmware_protocol.configuration_file import ConfigurationFile
from firmware_protocol.parameters import violations
from firmware_protocol.spelling import word_of

FAMILY = "ebl"


@dataclass(frozen=True)
class FileFault:
    """Something of a file that no unit takes. field: where. code: a word for programs."""

    field: str
    code: str
    message: str


def faults_of(file: ConfigurationFile) -> list[FileFault]:
    """Everything that is wrong with a file; empty when a unit of today would take it.

    What a file does not name is the bike's own and is not missed.
    """
    if file.family != FAMILY:
        message = f"It is for units of the family {file.family!r}, and only {FAMILY} is known here."
        return [FileFault("family", "foreign_family", message)]
    if not file.parameters:
        return [FileFault("parameters", "empty", "It holds no parameter.")]
    found = []
    for name, entry in file.parameters.items():
        row = PARAMETER_BY_NAME.get(name)
        if row is not None and entry.unit != row.unit:
            message = f"{name} is in {row.unit!r}, not in {entry.unit!r}."
            found.append(FileFault(f"parameters.{name}.unit", "other_unit", message))
    for wrong in violations(file.values, complete=False):
        field = f"parameters.{wrong.field}.value"
        found.append(FileFault(field, word_of(wrong.code), wrong.message))
    return found
