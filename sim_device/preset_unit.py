"""A simulated unit as a preset's runs have it: made for its market, configured over the wire.

With a table for a preset it is a unit as it leaves the factory, with this table as its first.
"""

from typing import Any

from firmware_protocol._generated import PARAMETER_BY_NAME, PARAMETERS, Access
from firmware_protocol.parameters import default_config, unpack_image
from sim_device import preset
from sim_device.configure import read_image, write_config
from sim_device.lockstep import LockstepUnit

FACTORY = "factory"
"""In a preset's place: the unit as it leaves the factory."""

OF_THE_BIKE = {row.name for row in PARAMETERS if row.record == "CALIBRATION"}
"""Of the dealer's settings those that are measured on one bike."""

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
    market = MARKET_OF.get(preset_name, MARKET)
    return unit_with(_values(preset_name), market, seed, changes, **unit)


def without_the_bike(values: dict[str, Any]) -> dict[str, Any]:
    """Of a unit's whole configuration what another bike may have, too: a dealer's settings without
    calibration and wheel. The cut-off is the one that holds."""
    kept = {
        name: value
        for name, value in values.items()
        if PARAMETER_BY_NAME[name].access != Access.FACTORY and name not in OF_THE_BIKE
    }
    if "assist_cutoff_kmh" in kept:
        kept["assist_cutoff_kmh"] += values.get("assist_cutoff_extra_kmh", 0.0)
    return kept


def unit_with(
    values: dict[str, Any], market: str, seed: int, changes: dict[str, Any], **unit: Any
) -> LockstepUnit:
    """A unit made for a market, with these values over the factory's and `changes` over them.

    values: as a preset has them. The rest is as of `preset_unit`.
    """
    wanted = dict(values)
    made = LockstepUnit(seed, market=market, **unit)
    if "assist_cutoff_kmh" in wanted:
        # A unit for a fast market adds what its maker set above the 25 km/h of the others.
        extra_kmh: Any = unpack_image(read_image(made.unit))["assist_cutoff_extra_kmh"]
        wanted["assist_cutoff_kmh"] -= extra_kmh
    if wanted | changes:
        write_config(made.unit, wanted | changes)
    return made
