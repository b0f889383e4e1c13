"""Configurations and tables as files: one JSON object that says of every value what unit it is in.

    {"format": "spindle-configuration", "version": 1, "name": "thesis", "comment": "...",
     "family": "ebl", "parameters": {"assist_cutoff_kmh": {"value": 25.0, "unit": "km/h"}}}

`spindle-table` is the same with the parameters of one fuzzy table, all of them and no other, under
the names of a unit's first. A backup adds `identity`, `unit_key`, `generation` and `crc32` of the
unit it was made of. Only the form is looked at here: whether a unit takes the values, the unit's
own rows say.
"""

from dataclasses import dataclass
from typing import Any

CONFIGURATION = "spindle-configuration"
TABLE = "spindle-table"
VERSION = 1

TABLE_PARAMETERS = (
    "fuzzy_table_name",
    "fuzzy_inference",
    "fuzzy_speed_points_kmh",
    "fuzzy_torque_rate_points",
    "fuzzy_gain_points",
    "fuzzy_rules",
)
"""What a table is made of."""

_WORDS = ("name", "comment", "family")
_ENTRY_KEYS = {"value", "unit", "comment"}


class BadConfigurationFile(ValueError):
    """What was read is no such file; the message says where it is not."""


@dataclass(frozen=True)
class Entry:
    """One parameter's value, lists nested as its shape is. unit: empty for a number without."""

    value: Any
    unit: str
    comment: str = ""

    def to_json(self) -> dict[str, Any]:
        """As it stands in a file."""
        comment = {"comment": self.comment} if self.comment else {}
        return {"value": self.value, "unit": self.unit, **comment}


@dataclass(frozen=True)
class ConfigurationFile:
    """A file that was read. format: `CONFIGURATION` or `TABLE`. family: of the unit it is for."""

    format: str
    name: str
    comment: str
    family: str
    parameters: dict[str, Entry]

    @property
    def kind(self) -> str:
        """`configuration` or `table`, as people and the API say it."""
        return self.format.removeprefix("spindle-")

    @property
    def values(self) -> dict[str, Any]:
        """The values alone, by their parameters' names."""
        return {name: entry.value for name, entry in self.parameters.items()}

    def to_json(self) -> dict[str, Any]:
        """The file's JSON, which `read` takes; an entry without a comment has none."""
        return {
            "format": self.format,
            "version": VERSION,
            "name": self.name,
            "comment": self.comment,
            "family": self.family,
            "parameters": {name: entry.to_json() for name, entry in self.parameters.items()},
        }


def is_configuration_file(saved: object) -> bool:
    """Whether JSON says of itself that it is such a file, of whatever version."""
    return isinstance(saved, dict) and saved.get("format") in (CONFIGURATION, TABLE)


def read(saved: object) -> ConfigurationFile:
    """The file in what its JSON says. Raises BadConfigurationFile."""
    if not isinstance(saved, dict) or not is_configuration_file(saved):
        raise BadConfigurationFile(f"it has no `format`, {CONFIGURATION} or {TABLE}")
    version = saved.get("version")
    if version != VERSION:
        raise BadConfigurationFile(
            f"it has version {version!r}, and this Spindle reads version {VERSION}: use a newer one"
        )
    for key in _WORDS:
        if not isinstance(saved.get(key), str):
            raise BadConfigurationFile(f"its `{key}` is no text")
    parameters = saved.get("parameters")
    if not isinstance(parameters, dict):
        raise BadConfigurationFile("it has no `parameters`")
    if saved["format"] == TABLE:
        _require_one_table(set(parameters))
    return ConfigurationFile(
        format=saved["format"],
        name=saved["name"],
        comment=saved["comment"],
        family=saved["family"],
        parameters={name: _entry(name, entry) for name, entry in parameters.items()},
    )


def _require_one_table(names: set[str]) -> None:
    if missing := sorted(set(TABLE_PARAMETERS) - names):
        raise BadConfigurationFile(f"it is a table without {', '.join(missing)}")
    if other := sorted(names - set(TABLE_PARAMETERS)):
        raise BadConfigurationFile(f"it is a table, and {', '.join(other)} is no part of one")


def _entry(name: str, entry: object) -> Entry:
    if not isinstance(entry, dict) or "value" not in entry:
        raise BadConfigurationFile(f"its parameter {name} has no `value`")
    if unknown := sorted(set(entry) - _ENTRY_KEYS):
        raise BadConfigurationFile(f"its parameter {name} has an unknown {unknown[0]!r}")
    unit, comment = entry.get("unit"), entry.get("comment", "")
    if not isinstance(unit, str) or not isinstance(comment, str):
        raise BadConfigurationFile(f"the unit or comment of its parameter {name} is no text")
    return Entry(entry["value"], unit, comment)
