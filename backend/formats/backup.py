"""Backups of a unit's settings, and presets: files of the format of today, and those of before it,
which had the values alone."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from backend.core.unit_key import EBL, serial_key
from backend.errors import InvalidRequest
from firmware_protocol._generated import PARAMETER_BY_NAME
from firmware_protocol.configuration_file import (
    CONFIGURATION,
    TABLE,
    BadConfigurationFile,
    ConfigurationFile,
    Entry,
    is_configuration_file,
    read,
)
from firmware_protocol.parameter_values import in_one_spelling

__all__ = ["Backup", "backup_json", "backup_of", "of_the_unit", "read_backup"]


@dataclass(frozen=True)
class Backup:
    """Parameters by name, each choice in its one spelling.

    family: of the unit it is for, None where the file does not say. units: of each value, empty
    where the file has none. is_table: it is one fuzzy table and says nothing of the rest. unit_key:
    of the unit it was made of; None where the file does not say, or is of none.
    """

    parameters: dict[str, Any]
    family: str | None = None
    units: dict[str, str] = field(default_factory=dict)
    is_table: bool = False
    unit_key: str | None = None


def read_backup(saved: object, name: str) -> Backup:
    """A backup. saved: what its JSON says. name: the file's, for people.

    Raises InvalidRequest if it is none.
    """
    if is_configuration_file(saved):
        try:
            return replace(backup_of(read(saved)), unit_key=key_of(saved))
        except BadConfigurationFile as error:
            raise InvalidRequest(f"{name} cannot be used: {error}.") from None
    parameters = saved.get("parameters") if isinstance(saved, dict) else None
    if not isinstance(parameters, dict):
        raise InvalidRequest(f"{name} is not a backup: it has no `parameters`.")
    return replace(Backup(in_one_spelling(parameters)), unit_key=key_of(saved))


def of_the_unit(names: Iterable[str]) -> list[str]:
    """Those names whose values were measured or set for one unit and its bike alone."""
    parameters = PARAMETER_BY_NAME
    return [name for name in names if name in parameters and parameters[name].of_the_unit]


def key_of(saved: object) -> str | None:
    """The key of the unit that a backup was made of; None where it does not say.

    Files of before units had keys have a serial number in their `identity`, and are of our own
    protocol.
    """
    if not isinstance(saved, dict):
        return None
    if isinstance(key := saved.get("unit_key"), str):
        return key
    identity = saved.get("identity")
    serial_number = identity.get("serial_number") if isinstance(identity, dict) else None
    family = saved.get("family", EBL)
    if isinstance(serial_number, str) and isinstance(family, str):
        return serial_key(family, serial_number)
    return None


def backup_of(file: ConfigurationFile) -> Backup:
    """What a file of the format of today holds, a preset for one."""
    values = in_one_spelling(file.values) if file.family == EBL else file.values
    units = {name: entry.unit for name, entry in file.parameters.items() if name in values}
    return Backup(values, file.family, units, file.format == TABLE)


def backup_json(
    device: dict[str, Any], config: dict[str, Any], units: dict[str, str]
) -> dict[str, Any]:
    """A unit's configuration as a file.

    device, config: as in the API. units: of each parameter, by name.
    """
    serial_number = (device["identity"] or {}).get("serial_number")
    entries = {
        name: Entry(value, units.get(name, "")) for name, value in config["parameters"].items()
    }
    name = serial_number or device["id"]
    saved = ConfigurationFile(CONFIGURATION, name, "", device["family"], entries)
    header = {key: value for key, value in config.items() if key != "parameters"}
    return {**saved.to_json(), "identity": device["identity"], **header}
