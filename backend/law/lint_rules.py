"""What is wrong, doubtful or notable about a table, before a rider finds out.

The rules and their thresholds are those of fuzzy_controller 5. They look at the surface the unit
will compute, not only at the labels: a monotone table does not give a monotone surface under
min, max and centroid. What is told of the surface is a proven bound (gain_bounds): never less than
what the unit does, wherever on the surface it does it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from backend.core.assist_mode import AssistModes
from backend.core.fuzzy_table import LABELS, FuzzyTable
from backend.law.finding import Finding, LintReport
from backend.law.gain_bounds import ROUNDING, Change, gain_range, largest_rise
from backend.law.market import cutoff_of
from backend.law.market_rules import band_warnings, cutoff_warnings, ratio_warnings, reach_notes
from sim_device.firmware.python.law import law_defaults

RIPPLE_MAX = 0.01
"""What the thesis table itself shows between its points is 0.0091; beyond this is a warning."""
RIPPLE_SHOWN = 0.001
JERK_DISTANCE_KMH = 1.0
JERK_MAX = 0.06
"""Change of the gain within that distance, wherever it begins."""
CUTOFF_KMH_MAX = 25.0
"""EN 15194: no assist above it. Protects the rider's licence and insurance."""
MOTOR_TORQUE_NM_MAX = 2.0
"""Table 2-2 of the thesis: what the motor bears."""
STRONG_RIDER_NM = 70.0
"""Rider torque at which demands are looked at: a heavy rider standing on the pedal."""
GEAR_RATIO = law_defaults()["gear_ratio"]
"""Where no unit told its own."""


def lint(
    table: FuzzyTable,
    modes: AssistModes | None = None,
    limits: Mapping[str, Any] | None = None,
    which: str = "first",
    taper_speeds_kmh: tuple[float, float] | None = None,
    gear_ratio: float | None = None,
) -> LintReport:
    """Findings about a table, and about the modes and limits it would run with if given.

    limits: the unit's parameters of the groups `limits` and `market` by name; missing ones are not
    judged. which: of the unit's two tables, `first` or `second`: the fuzzy modes that use the other
    one are not judged. taper_speeds_kmh: where the fixed law's ratio begins to fall, and where it
    is zero. gear_ratio: motor turns per crank turn; None counts as the registry's default.
    """
    rise = largest_rise(table, "speed", least=RIPPLE_SHOWN)
    fall = largest_rise(table, "rate", sign=-1, least=RIPPLE_SHOWN)
    limits = limits or {}
    cutoff = cutoff_of(limits)
    return LintReport(
        errors=tuple(_limit_errors(limits)),
        warnings=(
            *_monotony_warnings(rise, fall),
            *_label_warnings(table),
            *_jerk_warnings(table),
            *_steady_warnings(table),
            *_demand_warnings(table, modes, limits, which, gear_ratio or GEAR_RATIO),
            *cutoff_warnings(cutoff),
            *band_warnings(limits),
            *ratio_warnings(table, modes, which, cutoff, taper_speeds_kmh),
        ),
        notes=(
            *_ripple_notes(rise, fall),
            *_neighbour_notes(table),
            *reach_notes(table, cutoff),
            *_mode_notes(modes, which, limits.get("market")),
        ),
    )


def _limit_errors(limits: Mapping[str, Any]) -> Iterator[Finding]:
    cutoff_kmh = limits.get("assist_cutoff_kmh", 0.0)
    if not cutoff_kmh <= CUTOFF_KMH_MAX:
        message = f"assist until {cutoff_kmh:g} km/h; above {CUTOFF_KMH_MAX:g} it must be zero"
        yield Finding("assist_above_cutoff", message, "assist_cutoff_kmh")
    torque_nm = limits.get("motor_torque_nm_max", 0.0)
    if not torque_nm <= MOTOR_TORQUE_NM_MAX:
        message = f"motor torque up to {torque_nm:g} Nm; it bears {MOTOR_TORQUE_NM_MAX:g} Nm"
        yield Finding("no_torque_limit", message, "motor_torque_nm_max")


def _monotony_warnings(rise: Change, fall: Change) -> Iterator[Finding]:
    if rise.at_most > RIPPLE_MAX:
        message = f"the gain rises by up to {_up(rise.at_most, 3)} while the bike gets faster"
        yield Finding("gain_rises_with_speed", message, rise.where, _message_values(rise))
    if fall.at_most > RIPPLE_MAX:
        message = f"the gain falls by up to {_up(fall.at_most, 3)} while the rider pushes harder"
        yield Finding("gain_falls_with_torque_rate", message, fall.where, _message_values(fall))


def _label_warnings(table: FuzzyTable) -> Iterator[Finding]:
    labels = table.label_indices()
    for axis, direction in ((0, "speed"), (1, "torque rate")):
        for row, column in np.argwhere(np.abs(np.diff(labels, axis=axis)) > 1):
            here = LABELS[labels[row, column]]
            beyond = LABELS[labels[row + 1, column] if axis == 0 else labels[row, column + 1]]
            message = f"{here} next to {beyond} along {direction}: more than one label apart"
            yield Finding("label_step", message, f"rules[{row}][{column}]")


def _jerk_warnings(table: FuzzyTable) -> Iterator[Finding]:
    rise, fall = (
        largest_rise(table, "speed", sign, JERK_DISTANCE_KMH, JERK_MAX) for sign in (1, -1)
    )
    worst = max(rise, fall, key=lambda change: change.at_most)
    if worst.at_most > JERK_MAX:
        message = (
            f"the gain changes by up to {_up(worst.at_most, 3)} within {JERK_DISTANCE_KMH:g} km/h;"
            " the rider feels it as a jerk"
        )
        yield Finding("steep_gain", message, worst.where, _message_values(worst))


def _steady_warnings(table: FuzzyTable) -> Iterator[Finding]:
    lowest, highest = gain_range(table, first_rate_only=True)
    if highest > RIPPLE_SHOWN:
        message = (
            f"steady pedalling already gains {lowest:.2f} to {highest:.2f}, by the speed:"
            " that much more than the mode's ratio"
        )
        yield Finding("gain_at_steady_torque", message, "torque rate 0")


def _demand_warnings(
    table: FuzzyTable,
    modes: AssistModes | None,
    limits: Mapping[str, Any],
    which: str,
    gear_ratio: float,
) -> Iterator[Finding]:
    if modes is None:
        return
    highest = gain_range(table)[1]
    unit_nm = limits.get("motor_torque_nm_max", MOTOR_TORQUE_NM_MAX)
    for slot, mode in enumerate(modes.modes):
        if mode.law == "off" or (mode.law == "fuzzy" and mode.table != which):
            continue
        limit_nm = unit_nm * mode.torque_pct / 100
        gain = highest if mode.law == "fuzzy" else 0.0
        ratio = mode.ratio * (1.0 + gain)
        demand_nm = ratio * STRONG_RIDER_NM / gear_ratio
        if demand_nm > limit_nm > 0.0:
            message = (
                f"{mode.name}: {STRONG_RIDER_NM:g} Nm of rider torque ask {demand_nm:.2f} Nm of the"
                f" motor; above {limit_nm * gear_ratio / ratio:.0f} Nm its {limit_nm:g} Nm limit"
                " decides and the mode has no effect"
            )
            yield Finding("demand_beyond_motor", message, f"modes[{slot}]")


def _ripple_notes(rise: Change, fall: Change) -> Iterator[Finding]:
    worst = max(rise, fall, key=lambda change: change.at_most)
    if RIPPLE_SHOWN < worst.at_most <= RIPPLE_MAX:
        message = (
            f"between the points the surface ripples by up to {_up(worst.at_most, 4)}, as min, max"
            " and centroid do; weighted_average does not"
        )
        yield Finding("centroid_ripple", message, worst.where, _message_values(worst))


def _up(gain: float, digits: int) -> str:
    """A bound in digits that do not understate it; what rounding adds to every bound aside."""
    scale = 10**digits
    return f"{math.ceil((gain - ROUNDING) * scale) / scale:.{digits}f}"


def _message_values(change: Change) -> dict[str, float | str]:
    """What a translated message tells of a change."""
    return {"at_most": float(_up(change.at_most, 4))}


def _neighbour_notes(table: FuzzyTable) -> Iterator[Finding]:
    labels = table.label_indices()
    for row in np.flatnonzero((np.diff(labels, axis=0) == 0).all(axis=1)):
        message = f"speed rows {LABELS[row]} and {LABELS[row + 1]} are equal"
        yield Finding("equal_neighbours", message, f"rules[{row}]")
    for column in np.flatnonzero((np.diff(labels, axis=1) == 0).all(axis=0)):
        message = f"torque-rate columns {LABELS[column]} and {LABELS[column + 1]} are equal"
        yield Finding("equal_neighbours", message, f"rules[][{column}]")


def _mode_notes(modes: AssistModes | None, which: str, market: str | None) -> Iterator[Finding]:
    for slot, mode in enumerate(modes.modes if modes else ()):
        if market is None and mode.law == "fixed" and mode.taper == "none" and mode.ratio > 0.0:
            message = f"{mode.name}: the ratio does not fall with speed, as Japan wants it to"
            yield Finding("ratio_does_not_fall", message, f"modes[{slot}]")
    if modes and not any(
        mode.law == "fuzzy" and mode.table == which and mode.ratio > 0.0 for mode in modes.modes
    ):
        message = "no mode with a ratio runs the fuzzy law with this table: it changes nothing"
        yield Finding("table_not_used", message, "modes")
