"""What two stretches of riding come to, each for itself, and by how much they differ.

Rider, motor and battery stand apart and are never added. A missing figure says why, and
energies say how much time they leave out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from backend.core.channels import Values
from backend.core.described import described
from backend.core.distance import row_distances
from backend.core.energy import DEMANDED
from backend.core.ride import RideSummary, TimesUs, summarise
from backend.rides.insight.energy_split import energy_shares
from backend.rides.insight.gradient import climb_of

DISTANCE_KM_MIN = 0.01
"""Below that, work by distance is the work of a start."""
NoFigure = Literal[
    "no_speed",
    "no_way",
    "no_motion",
    "no_rider_power",
    "no_motor_power",
    "no_battery_power",
    "only_asked",
    "no_height",
    "no_rider_work",
]
SOURCES = ("rider", "motor", "battery")
NO_POWER: dict[str, NoFigure] = {
    "rider": "no_rider_power",
    "motor": "no_motor_power",
    "battery": "no_battery_power",
}
UNITS = {
    "duration_s": "s",
    "moving_s": "s",
    "distance_km": "km",
    "speed_kmh_mean": "km/h",
    "rider_wh": "Wh",
    "motor_wh": "Wh",
    "battery_wh": "Wh",
    "rider_wh_per_km": "Wh/km",
    "motor_wh_per_km": "Wh/km",
    "battery_wh_per_km": "Wh/km",
    "motor_per_rider": "",
    "ascent_m": "m",
}
"""The figures in the order of the answer."""


@described
class FigureValue:
    """A figure of one side."""

    value: float | None
    missing: NoFigure | None = None
    """Why there is no value; null with one."""
    unknown_s: float | None = None
    """Time that an energy leaves out because its samples are missing."""


@dataclass(frozen=True)
class Figure:
    """difference: B's value less A's; None where one of them is missing."""

    name: str
    unit: str
    a: FigureValue
    b: FigureValue
    difference: float | None


@dataclass(frozen=True)
class Stretch:
    """Rows (n,) of a window. values: channels by name, missing as NaN; meaning: of the ride's motor
    torque, as of core.energy."""

    values: Mapping[str, Values]
    times_us: TimesUs
    period_us: int | None
    seconds: Values
    meaning: str | None


def compared(a: Stretch, b: Stretch) -> list[Figure]:
    """Every figure of both."""
    one, other = figures_of_side(a), figures_of_side(b)
    return [
        Figure(name, unit, one[name], other[name], less(other[name].value, one[name].value))
        for name, unit in UNITS.items()
    ]


def less(value: float | None, than: float | None) -> float | None:
    """The difference; None where one of both is not known."""
    return None if value is None or than is None else value - than


def figures_of_side(rows: Stretch) -> dict[str, FigureValue]:
    """The figures of one side by name."""
    summary = summarise(rows.values, rows.times_us, rows.period_us, rows.seconds)
    figures = {
        "duration_s": FigureValue(summary.duration_s),
        "moving_s": value_or_reason(summary.moving_s, "no_speed"),
        "distance_km": value_or_reason(summary.distance_km, "no_way"),
        "speed_kmh_mean": value_or_reason(
            summary.speed_kmh_mean, "no_motion" if summary.moving_s is not None else "no_speed"
        ),
    }
    for source in SOURCES:
        energy = energy_figure(source, summary, rows.meaning)
        figures[f"{source}_wh"] = energy
        figures[f"{source}_wh_per_km"] = per_km(energy, figures["distance_km"])
    return figures | per_distance_figures(rows, figures)


def value_or_reason(value: float | None, why: NoFigure) -> FigureValue:
    """A value, or why there is none."""
    return FigureValue(value, None if value is not None else why)


def energy_figure(source: str, summary: RideSummary, meaning: str | None) -> FigureValue:
    """An energy; a motor whose torque was only asked of it has none."""
    value: float | None = getattr(summary, f"{source}_wh")
    if value is not None:
        return FigureValue(value, unknown_s=getattr(summary, f"{source}_excluded_s"))
    demanded_only = source == "motor" and meaning == DEMANDED
    return FigureValue(None, "only_asked" if demanded_only else NO_POWER[source])


def per_km(energy: FigureValue, distance: FigureValue) -> FigureValue:
    """An energy for a kilometre, or what it lacks."""
    if energy.value is None or distance.value is None:
        return FigureValue(None, energy.missing or distance.missing)
    if distance.value < DISTANCE_KM_MIN:
        return FigureValue(None, "no_motion")
    return FigureValue(energy.value / distance.value, unknown_s=energy.unknown_s)


def per_distance_figures(
    rows: Stretch, figures: Mapping[str, FigureValue]
) -> dict[str, FigureValue]:
    """Ascent, and the motor's work over the rider's of the moments in which both are known."""
    start_s = rows.times_us / 1e6
    distances = row_distances(rows.values, start_s, rows.seconds)
    altitude = rows.values.get("altitude_m")
    climb = climb_of(altitude, distances, start_s) if distances and altitude is not None else None
    everything = np.zeros(len(start_s), np.intp)
    (share,) = energy_shares(rows.values, rows.seconds, None, everything, 1)
    lacking = [figures[f"{source}_wh"].missing for source in ("motor", "rider")]
    why: NoFigure = next((reason for reason in lacking if reason), "no_rider_work")
    return {
        "ascent_m": value_or_reason(
            climb.ascent_m if climb else None, "no_height" if distances else "no_way"
        ),
        "motor_per_rider": value_or_reason(share.motor_per_rider, why),
    }
