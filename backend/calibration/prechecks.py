"""What must be so before the first capture: standing, nobody on the pedals, supply, temperature;
and why something is not taken: a code for programs and pages, a sentence, the figure.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from backend.calibration.plain import Plain


@dataclass(frozen=True, slots=True)
class Refusal(Plain):
    """figure: the number that decides, in the unit the code implies; None where it is no number.

    values: what the sentence tells besides, by name, for a text in another language. captures:
    the numbers of those at fault.
    """

    code: str
    sentence: str
    figure: float | None = None
    values: dict[str, float | str] = field(default_factory=dict)
    captures: tuple[int, ...] = ()


ZERO_BAND_NM = 5.0
"""As far from the kept zero as the unit lets a zero be set: beyond, a foot is on the pedal."""

WARMING_K = 1.0
"""Over the last minute: one step of the thermometer."""


@dataclass(frozen=True, slots=True)
class Measured(Plain):
    """What the unit says now; None where it does not tell. idle_nm: rider torque on the kept
    calibration. warming_k: of the sensor over the last minute."""

    wheel_kmh: float | None = None
    cadence_rpm: float | None = None
    motor_rpm: float | None = None
    idle_nm: float | None = None
    battery_v: float | None = None
    battery_min_v: float | None = None
    warming_k: float | None = None


@dataclass(frozen=True, slots=True)
class Check(Plain):
    """passed: None where nobody could tell. figure, allowed: in the unit the code implies. values:
    what the sentence tells besides, by name, for a text in another language."""

    code: str
    passed: bool | None
    sentence: str
    figure: float | None
    allowed: float | None
    values: dict[str, float | str] = field(default_factory=dict)


def prechecks(measured: Measured) -> tuple[Check, ...]:
    """All of them, in the order of the page."""
    warming_k = _size(measured.warming_k)
    return (
        _standing(measured),
        _at_most(
            "pedals_free", _size(measured.idle_nm), ZERO_BAND_NM, "Nm", "nobody on the pedals"
        ),
        _supply(measured),
        _at_most("temperature", warming_k, WARMING_K, "K in a minute", "temperature is steady"),
    )


def _size(value: float | None) -> float | None:
    return None if value is None else abs(value)


def _standing(measured: Measured) -> Check:
    """Without a figure: wheel, crank and motor turn in units of their own."""
    turning: dict[str, float | str] = {
        name: abs(value)
        for name in ("wheel_kmh", "cadence_rpm", "motor_rpm")
        if (value := getattr(measured, name)) is not None
    }
    if not turning:
        return Check("standing", None, "nothing turns: the unit does not tell", None, None)
    units = {"wheel_kmh": "wheel {:.1f} km/h", "cadence_rpm": "crank {:.0f} rpm"}
    sentence = ", ".join(
        units.get(name, "motor {:.0f} rpm").format(value) for name, value in turning.items()
    )
    standing = not any(turning.values())
    return Check("standing", standing, f"nothing turns: {sentence}", None, None, turning)


def _at_most(code: str, figure: float | None, allowed: float, unit: str, sentence: str) -> Check:
    if figure is None:
        return Check(code, None, f"{sentence}: the unit does not tell", None, allowed)
    passed = figure <= allowed
    text = f"{sentence}: {figure:.1f} {unit}, {allowed:g} is allowed"
    return Check(code, passed, text, figure, allowed)


def _supply(measured: Measured) -> Check:
    figure, least = measured.battery_v, measured.battery_min_v
    if figure is None or least is None:
        return Check("supply", None, "supply: the unit does not tell", figure, least)
    return Check("supply", figure >= least, f"supply: {figure:.1f} V of {least:g} V", figure, least)
