"""The closed list of unit suffixes: the same spelling in C, Python, TypeScript, SQL and TOML.

A physical name ends in one of these, or in two around `_per_` (`assist_ramp_up_nm_per_s`). A bound
follows the unit (`motor_torque_nm_max`). A name without a suffix has no dimension (`assist_ratio`).
"""

from __future__ import annotations

from math import floor, isfinite, log10

UNITS: dict[str, str] = {
    "nm": "Nm",
    "rpm": "rpm",
    "kmh": "km/h",
    "v": "V",
    "mv": "mV",
    "a": "A",
    "ma": "mA",
    "w": "W",
    "wh": "Wh",
    "s": "s",
    "ms": "ms",
    "us": "µs",
    "hz": "Hz",
    "degc": "°C",
    "k": "K",
    "deg": "deg",
    "m": "m",
    "kg": "kg",
    "ohm": "Ω",
    "pct": "%",
    "counts": "counts",
    "count": "count",
}
"""Suffix -> the unit as people read it."""

BOUNDS = ("min", "max")
"""What may follow the unit in a name."""


def plain(value: float, digits: int) -> str:
    """A number with so many significant digits, never with an exponent.

    Digits before the point are never rounded away: `plain(1053.2, 3)` is `1053`.
    """
    if not value or not isfinite(value):
        return f"{value:g}"
    places = max(0, digits - 1 - floor(log10(abs(value))))
    text = f"{value:.{places}f}"
    return text.rstrip("0").rstrip(".") if places else text


def unit_of(name: str) -> str:
    """The unit of a physical name as people read it; empty if the name has no dimension.

    `unit_of("motor_torque_nm_max")` is `Nm`, `unit_of("assist_ramp_up_nm_per_s")` is `Nm/s`, and of
    a share (`gain_share_per_k`) `1/K`.
    """
    words = name.split("_")
    if words[-1] in BOUNDS:
        words = words[:-1]
    if len(words) < 2 or words[-1] not in UNITS:
        return ""
    if len(words) >= 4 and words[-2] == "per":
        return f"{UNITS.get(words[-3], '1')}/{UNITS[words[-1]]}"
    return UNITS[words[-1]]
