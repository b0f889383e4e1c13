"""A simulated unit as a preset's runs have it: made for its market, configured over the wire.

With a table for a preset it is a unit as it leaves the factory, with this table as its first.
"""

from typing import Any

from firmware_protocol.parameters import default_config, unpack_image
from sim_device import preset
from sim_device.configure import read_image, write_config
from sim_device.lockstep import LockstepUnit

FACTORY = "factory"
"""In a preset's place: the unit as it leaves the factory."""

MARKET = "eu_epac"
# The thesis cuts hard at 25 km/h, which a unit for Europe does not. Class 1 of the United States
# ends at 32 km/h and leaves what is below to the configuration.
MARKET_OF = {"thesis": "us_class_1"}


def _values(name: str) -> dict[str, Any]:
    """What the preset sets. Raises KeyError."""
    return {} if name == FACTORY else preset.load(name).values


def parameters_of(name: str) -> dict[str, Any]:
    """The whole configuration with a preset's values in it, or the factory's. Raises KeyError."""
    return {**default_config(), **_values(name)}


def preset_unit(preset_name: str, seed: int, changes: dict[str, Any], **unit: Any) -> LockstepUnit:
    """A unit with a preset's values and those of `changes` over them.

    unit: further arguments of LockstepUnit. Raises KeyError for a preset that is none,
    ConfigureError for what the unit refuses.
    """
    wanted = _values(preset_name)
    made = LockstepUnit(seed, market=MARKET_OF.get(preset_name, MARKET), **unit)
    if "assist_cutoff_kmh" in wanted:
        # A unit for a fast market adds what its maker set above the 25 km/h of the others.
        extra_kmh: Any = unpack_image(read_image(made.unit))["assist_cutoff_extra_kmh"]
        wanted["assist_cutoff_kmh"] -= extra_kmh
    if wanted | changes:
        write_config(made.unit, wanted | changes)
    return made
