"""Backups of a unit's settings, and presets: files of the format of today, and those of before it,
which had the values alone."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from backend.errors import InvalidRequest
from firmware_protocol.configuration_file import (
    CONFIGURATION,
    TABLE,
    BadConfigurationFile,
    ConfigurationFile,
    Entry,
    is_configuration_file,
    read,
)
from firmware_protocol.retired import brought_forward

__all__ = ["Backup", "backup_json", "backup_of", "read_backup"]

# The family whose parameters changed their names and spelling over the versions.
EBL = "ebl"


@dataclass(frozen=True)
class Backup:
    """Parameters by their names and spelling of today.

    notes: what was made of those of an older unit, in words. family: of the unit it is for, None
    where an old file does not say. units: of each value, empty for an old file. is_table: it is one
    fuzzy table and says nothing of the rest.
    """

    parameters: dict[str, Any]
    notes: list[str] = field(default_factory=list)
    family: str | None = None
    units: dict[str, str] = field(default_factory=dict)
    is_table: bool = False


def read_backup(saved: object, name: str) -> Backup:
    """A backup. saved: what its JSON says. name: the file's, for people.

    Raises InvalidRequest if it is none.
    """
    if is_configuration_file(saved):
        try:
            return backup_of(read(saved))
        except BadConfigurationFile as error:
            raise InvalidRequest(f"{name} cannot be used: {error}.") from None
    parameters = saved.get("parameters") if isinstance(saved, dict) else None
    if not isinstance(parameters, dict):
        raise InvalidRequest(f"{name} is not a backup: it has no `parameters`.")
    return Backup(*brought_forward(parameters))


def backup_of(file: ConfigurationFile) -> Backup:
    """What a file of the format of today holds, a preset for one."""
    values, notes = brought_forward(file.values) if file.family == EBL else (file.values, [])
    units = {name: entry.unit for name, entry in file.parameters.items() if name in values}
    return Backup(values, notes, file.family, units, file.format == TABLE)


def backup_json(
    device: dict[str, Any], config: dict[str, Any], units: dict[str, str]
) -> dict[str, Any]:
    """A unit's configuration as a file.

    device, config: as the API tells them. units: of each parameter, by name.
    """
    serial_number = (device["identity"] or {}).get("serial_number")
    entries = {
        name: Entry(value, units.get(name, "")) for name, value in config["parameters"].items()
    }
    name = serial_number or device["id"]
    saved = ConfigurationFile(CONFIGURATION, name, "", device["family"], entries)
    told = {key: value for key, value in config.items() if key != "parameters"}
    return {**saved.to_json(), "identity": device["identity"], **told}
