"""Configurations and tables that come with Spindle, by name: files in `presets`, read only."""

import json
from functools import cache
from importlib.resources import files

from firmware_protocol.configuration_check import faults_of
from firmware_protocol.configuration_file import BadConfigurationFile, ConfigurationFile, read
from firmware_protocol.parameters import default_config, violations


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
    wrong = [fault.message for fault in faults_of(preset)]
    wrong += [fault.message for fault in violations(default_config() | preset.values)]
    if wrong:
        raise BadConfigurationFile(f"preset {name}: {wrong[0]}")
    return preset
