"""What a dealer may set around what the factory measured, as the unit's own C judges it.

The unit decides (`unlock_level_needed`); this names the value before it is asked, and says from
where to where it may go.
"""

from collections.abc import Mapping

import numpy as np

from firmware_protocol._generated import BANDS
from firmware_protocol.layout import Band, Value

__all__ = ["band_holds", "band_limits", "leaves_band"]


def band_holds(band: Band, config: Mapping[str, Value]) -> bool:
    """Whether the value lies in its band; in float32, bit for bit as `ebl_band_holds`."""
    with np.errstate(over="ignore", invalid="ignore"):
        around = _number(config, band.around)
        distance = _number(config, band.parameter) - around
        if band.times is not None:
            distance *= _number(config, band.times)
        within = np.float32(band.within or 0.0)
        if band.within_pct is not None:
            within = np.float32(band.within_pct / 100) * abs(around)
        return bool(abs(distance) <= within)


def leaves_band(band: Band, base: Mapping[str, Value], config: Mapping[str, Value]) -> bool:
    """Whether a change needs the maker's token: another value than before, outside of the band."""
    moved = _number(base, band.parameter) != _number(config, band.parameter)
    return moved and not band_holds(band, config)


def band_limits(band: Band, config: Mapping[str, Value]) -> tuple[float, float]:
    """The least and the largest value in the band: float32 numbers that the unit takes."""
    around = float(_number(config, band.around))
    if band.within_pct is not None:
        distance = abs(around) * band.within_pct / 100
    else:
        scale = 1.0 if band.times is None else abs(float(_number(config, band.times)))
        distance = (band.within or 0.0) / scale
    return _inward(band, config, around - distance), _inward(band, config, around + distance)


def _inward(band: Band, config: Mapping[str, Value], bound: float) -> float:
    """The float32 nearest to a bound on its inner side."""
    around = _number(config, band.around)
    value = np.float32(bound)
    while not band_holds(band, {**config, band.parameter: float(value)}) and value != around:
        value = np.nextafter(value, around)
    return float(str(value))


def _number(config: Mapping[str, Value], name: str) -> np.float32:
    value = config[name]
    assert isinstance(value, int | float)
    return np.float32(value)


def bands_left(base: Mapping[str, Value], config: Mapping[str, Value]) -> list[Band]:
    """The bands that a change leaves, in the order of the registry."""
    return [band for band in BANDS if leaves_band(band, base, config)]
