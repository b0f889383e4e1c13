"""Configurations and tables that come with Spindle, by name: files in `presets`, read only."""

import json
from functools import cache
from importlib.resources import files

from firmware_protocol._generated import PARAMETER_BY_NAME
from firmware_protocol.configuration_file import BadConfigurationFile, ConfigurationFile, read
from firmware_protocol.parameters import default_config, violations

FAMILY = "ebl"


def names() -> tuple[str, ...]:
    """Every preset that comes with Spindle."""
    found = [entry.name for entry in (files("sim_device") / "presets").iterdir()]
    return tuple(sorted(name.removesuffix(".json") for name in found if name.endswith(".json")))


@cache
def load(name: str) -> ConfigurationFile:
    """The preset of this name. Raises KeyError if there is none, BadConfigurationFile for a file
    that no unit of today would take."""
    if name not in names():
        raise KeyError(f"there is no preset {name!r}; there are: {', '.join(names())}")
    source = files("sim_device") / "presets" / f"{name}.json"
    preset = read(json.loads(source.read_text(encoding="utf-8")))
    if preset.name != name:
        raise BadConfigurationFile(f"preset {name}: it calls itself {preset.name}")
    for parameter, entry in preset.parameters.items():
        if parameter not in PARAMETER_BY_NAME:
            raise BadConfigurationFile(f"preset {name}: there is no parameter {parameter}")
        unit = PARAMETER_BY_NAME[parameter].unit
        if entry.unit != unit:
            raise BadConfigurationFile(f"preset {name}: {parameter} is in {unit}, not {entry.unit}")
    wrong = violations(default_config() | preset.values)
    if wrong or preset.family != FAMILY:
        reason = wrong[0].message if wrong else f"it is for the family {preset.family}"
        raise BadConfigurationFile(f"preset {name}: {reason}")
    return preset
