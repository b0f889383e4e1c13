"""Units as files write them, and what their numbers are in another unit of the same quantity."""

from __future__ import annotations

from backend.core.energy import KMH_PER_MS

# Unit as files write it, without case and spaces -> its quantity, our word, factor to the
# channel's unit, and what is added after that.
UNITS: dict[str, tuple[str, str, float, float]] = {
    **dict.fromkeys(("km/h", "kmh", "kph", "kmph", "km/hr"), ("speed", "km/h", 1.0, 0.0)),
    **dict.fromkeys(("mph", "mi/h", "mp/h"), ("speed", "mph", 1.609344, 0.0)),
    **dict.fromkeys(("m/s", "mps", "ms"), ("speed", "m/s", KMH_PER_MS, 0.0)),
    **dict.fromkeys(("m", "meter", "meters", "metres", "metre"), ("length", "m", 1.0, 0.0)),
    **dict.fromkeys(("km", "kilometers", "kilometres"), ("length", "km", 1000.0, 0.0)),
    **dict.fromkeys(("mi", "miles", "mile"), ("length", "mi", 1609.344, 0.0)),
    **dict.fromkeys(("ft", "feet"), ("length", "ft", 0.3048, 0.0)),
    **dict.fromkeys(("degc", "c", "°c", "celsius", "ºc"), ("temperature", "degC", 1.0, 0.0)),
    **dict.fromkeys(("degf", "f", "°f", "fahrenheit"), ("temperature", "degF", 5 / 9, -160 / 9)),
    **dict.fromkeys(("nm", "n-m", "n·m", "n*m"), ("torque", "Nm", 1.0, 0.0)),
    **dict.fromkeys(("ft-lb", "lb-ft", "ftlb", "lbft"), ("torque", "ft-lb", 1.3558179, 0.0)),
    **dict.fromkeys(("w", "watt", "watts"), ("power", "W", 1.0, 0.0)),
    "kw": ("power", "kW", 1000.0, 0.0),
    **dict.fromkeys(("rpm", "1/min"), ("cadence", "rpm", 1.0, 0.0)),
    "bpm": ("heart_rate", "bpm", 1.0, 0.0),
    **dict.fromkeys(("deg", "°", "degrees"), ("angle", "deg", 1.0, 0.0)),
    **dict.fromkeys(("%", "pct", "percent"), ("share", "%", 1.0, 0.0)),
    "1": ("share", "1", 100.0, 0.0),
    "v": ("voltage", "V", 1.0, 0.0),
    "a": ("current", "A", 1.0, 0.0),
}


def plain_unit(unit: str) -> str:
    """A unit without case and spaces, as `UNITS` has it."""
    return unit.strip().lower().replace(" ", "")


def factor_between(stated: str, meant: str) -> float | None:
    """What a number in one unit is to be multiplied by for another; None where that is not all."""
    if plain_unit(stated) == plain_unit(meant):
        return 1.0
    one, other = UNITS.get(plain_unit(stated)), UNITS.get(plain_unit(meant))
    if one is None or other is None or (one[0], one[3]) != (other[0], other[3]):
        return None
    return one[2] / other[2]
