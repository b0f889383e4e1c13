"""What is wrong, doubtful or notable about a table, before a rider finds out.

The rules and their thresholds are those of fuzzy_controller 5. They look at the surface the unit
will compute, not only at the labels: a monotone table does not give a monotone surface under
min, max and centroid.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.control.finding import Finding, LintReport
from backend.control.gain import surface
from backend.control.market import cutoff_of
from backend.control.market_rules import cutoff_warnings, ratio_warnings, reach_notes
from backend.domain.assist_mode import AssistModes
from backend.domain.fuzzy_table import LABELS, FuzzyTable

SPEED_STEP_KMH = 0.125
RATE_STEPS = 144
RIPPLE_MAX = 0.01
"""What the thesis table itself shows between its points is 0.0091; beyond this is a warning."""
RIPPLE_SHOWN = 0.001
SLOPE_MAX_PER_KMH = 0.06
CUTOFF_KMH_MAX = 25.0
"""EN 15194: no assist above it. Protects the rider's licence and insurance."""
MOTOR_TORQUE_NM_MAX = 2.0
"""Table 2-2 of the thesis: what the motor bears."""
STRONG_RIDER_NM = 70.0
"""Rider torque at which demands are looked at: a heavy rider standing on the pedal."""
GEAR_RATIO = 40.34
"""Thesis 4.10; within 10 % of what the teeth give (thesis_checks I-1)."""


@dataclass(frozen=True, slots=True)
class _Swing:
    """The largest change against the wanted direction along one axis, and where it ends."""

    size: float
    speed_kmh: float
    torque_rate: float

    @property
    def where(self) -> str:
        return f"{self.speed_kmh:.1f} km/h, torque rate {self.torque_rate:.2f}"


def lint(
    table: FuzzyTable,
    modes: AssistModes | None = None,
    limits: Mapping[str, Any] | None = None,
    which: str = "first",
    taper_speeds_kmh: tuple[float, float] | None = None,
) -> LintReport:
    """Findings about a table, and about the modes and limits it would run with if given.

    limits: the unit's parameters of the groups `limits` and `market` by name; missing ones are not
    judged. which: of the unit's two tables, `first` or `second`: the fuzzy modes that use the other
    one are not judged. taper_speeds_kmh: where the fixed law's ratio begins to fall, and where it
    is zero.
    """
    speeds = np.arange(0.0, table.speed_points_kmh[-1] + SPEED_STEP_KMH / 2, SPEED_STEP_KMH)
    rates = np.linspace(table.torque_rate_points[0], table.torque_rate_points[-1], RATE_STEPS + 1)
    gains = surface(table, speeds, rates).astype(np.float64)
    rise = _rise_with_speed(gains, speeds, rates)
    fall = _fall_with_rate(gains, speeds, rates)
    limits = limits or {}
    cutoff = cutoff_of(limits)
    return LintReport(
        errors=tuple(_limit_errors(limits)),
        warnings=(
            *_monotony_warnings(rise, fall),
            *_label_warnings(table),
            *_slope_warnings(gains),
            *_steady_warnings(gains),
            *_demand_warnings(gains, modes, limits, which),
            *cutoff_warnings(cutoff),
            *ratio_warnings(table, modes, which, cutoff, taper_speeds_kmh),
        ),
        notes=(
            *_ripple_notes(rise, fall),
            *_neighbour_notes(table),
            *reach_notes(table, cutoff),
            *_mode_notes(modes, which, limits.get("market")),
        ),
    )


def _rise_with_speed(
    gains: npt.NDArray[np.float64], speeds: npt.NDArray[np.float64], rates: npt.NDArray[np.float64]
) -> _Swing:
    rises = gains - np.minimum.accumulate(gains, axis=0)
    row, column = np.unravel_index(rises.argmax(), rises.shape)
    return _Swing(float(rises[row, column]), float(speeds[row]), float(rates[column]))


def _fall_with_rate(
    gains: npt.NDArray[np.float64], speeds: npt.NDArray[np.float64], rates: npt.NDArray[np.float64]
) -> _Swing:
    falls = np.maximum.accumulate(gains, axis=1) - gains
    row, column = np.unravel_index(falls.argmax(), falls.shape)
    return _Swing(float(falls[row, column]), float(speeds[row]), float(rates[column]))


def _limit_errors(limits: Mapping[str, Any]) -> Iterator[Finding]:
    cutoff_kmh = limits.get("assist_cutoff_kmh", 0.0)
    if not cutoff_kmh <= CUTOFF_KMH_MAX:
        message = f"assist until {cutoff_kmh:g} km/h; above {CUTOFF_KMH_MAX:g} it must be zero"
        yield Finding("assist_above_cutoff", message, "assist_cutoff_kmh")
    torque_nm = limits.get("motor_torque_nm_max", 0.0)
    if not torque_nm <= MOTOR_TORQUE_NM_MAX:
        message = f"motor torque up to {torque_nm:g} Nm; it bears {MOTOR_TORQUE_NM_MAX:g} Nm"
        yield Finding("no_torque_limit", message, "motor_torque_nm_max")


def _monotony_warnings(rise: _Swing, fall: _Swing) -> Iterator[Finding]:
    if rise.size > RIPPLE_MAX:
        message = f"the gain rises by {rise.size:.3f} while the bike gets faster"
        yield Finding("gain_rises_with_speed", message, rise.where)
    if fall.size > RIPPLE_MAX:
        message = f"the gain falls by {fall.size:.3f} while the rider pushes harder"
        yield Finding("gain_falls_with_torque_rate", message, fall.where)


def _label_warnings(table: FuzzyTable) -> Iterator[Finding]:
    labels = table.label_indices()
    for axis, direction in ((0, "speed"), (1, "torque rate")):
        for row, column in np.argwhere(np.abs(np.diff(labels, axis=axis)) > 1):
            here = LABELS[labels[row, column]]
            beyond = LABELS[labels[row + 1, column] if axis == 0 else labels[row, column + 1]]
            message = f"{here} next to {beyond} along {direction}: more than one label apart"
            yield Finding("label_step", message, f"rules[{row}][{column}]")


def _slope_warnings(gains: npt.NDArray[np.float64]) -> Iterator[Finding]:
    steps = round(1.0 / SPEED_STEP_KMH)
    if len(gains) <= steps:
        return
    slope = float(np.abs(gains[steps:] - gains[:-steps]).max())
    if slope > SLOPE_MAX_PER_KMH:
        message = f"the gain changes by {slope:.3f} within 1 km/h; the rider feels it as a jerk"
        yield Finding("steep_gain", message, None)


def _steady_warnings(gains: npt.NDArray[np.float64]) -> Iterator[Finding]:
    steady = gains[:, 0]
    if steady.max() > 0.0:
        message = (
            f"steady pedalling already gains {steady.min():.2f} to {steady.max():.2f}:"
            " the mode's ratio is never reached alone"
        )
        yield Finding("gain_at_steady_torque", message, "torque rate 0")


def _demand_warnings(
    gains: npt.NDArray[np.float64],
    modes: AssistModes | None,
    limits: Mapping[str, Any],
    which: str,
) -> Iterator[Finding]:
    unit_nm = limits.get("motor_torque_nm_max", MOTOR_TORQUE_NM_MAX)
    for slot, mode in enumerate(modes.modes if modes else ()):
        if mode.law == "off" or (mode.law == "fuzzy" and mode.table != which):
            continue
        limit_nm = unit_nm * mode.torque_pct / 100
        gain = float(gains.max()) if mode.law == "fuzzy" else 0.0
        ratio = mode.ratio * (1.0 + gain)
        demand_nm = ratio * STRONG_RIDER_NM / GEAR_RATIO
        if demand_nm > limit_nm > 0.0:
            message = (
                f"{mode.name}: {STRONG_RIDER_NM:g} Nm of rider torque ask {demand_nm:.2f} Nm of the"
                f" motor; above {limit_nm * GEAR_RATIO / ratio:.0f} Nm its {limit_nm:g} Nm limit"
                " decides and the mode has no effect"
            )
            yield Finding("demand_beyond_motor", message, f"modes[{slot}]")


def _ripple_notes(rise: _Swing, fall: _Swing) -> Iterator[Finding]:
    if max(rise.size, fall.size) > RIPPLE_SHOWN and max(rise.size, fall.size) <= RIPPLE_MAX:
        worst = max(rise, fall, key=lambda swing: swing.size)
        message = (
            f"between the points the surface ripples by up to {worst.size:.4f}, as min, max and"
            " centroid do; weighted_average does not"
        )
        yield Finding("centroid_ripple", message, worst.where)


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
