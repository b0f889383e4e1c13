"""What of a table, its modes and limits the unit's market leaves without effect.

None of it is dangerous: the unit gives what its market allows, whatever is written. But a dealer
who reads 25 km/h on a bike that stops helping at 24 was misinformed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.assist_mode import AssistMode, AssistModes
from backend.core.fuzzy_table import LABELS, FuzzyTable
from backend.law.finding import Finding
from backend.law.gain import surface
from backend.law.market import Cutoff, allowed_ratios, market_words
from sim_device.firmware.python import law

SPEED_STEP_KMH = 0.125
RATE_STEPS = 36
SPEED_SHOWN_KMH = 0.001
"""Differences below it are float32's, not a setting."""
RATIO_SHOWN = 0.005
BAND_KMH_MIN = 1.0
"""With it the motor's torque no longer toggles at the limit; it costs 0.3 km/h."""

Floats = npt.NDArray[np.float64]


def cutoff_warnings(cutoff: Cutoff | None) -> Iterator[Finding]:
    """A cut-off speed that is set higher than where the bike stops helping."""
    if cutoff is None or cutoff.market is None:
        return
    if cutoff.configured_kmh - cutoff.holds_kmh > SPEED_SHOWN_KMH:
        configured, where = f"is {cutoff.configured_kmh:g} km/h", "assist_cutoff_kmh"
    elif cutoff.configured_kmh + cutoff.extra_kmh - cutoff.holds_kmh > SPEED_SHOWN_KMH:
        configured, where = f"adds {cutoff.extra_kmh:g} km/h", "assist_cutoff_extra_kmh"
    else:
        return
    message = (
        f"{where} {configured}, but assist ends at {cutoff.holds_kmh:.4g} km/h: the market,"
        f" {market_words(cutoff.market)}, allows no more"
    )
    values = _message_values(cutoff.market, cutoff.holds_kmh)
    yield Finding("cutoff_above_market", message, where, values)


def band_warnings(limits: Mapping[str, Any]) -> Iterator[Finding]:
    """A cut-off so sharp that a rider at the limit feels the motor come and go."""
    band_kmh = limits.get("assist_cutoff_band_kmh")
    if band_kmh is None or band_kmh >= BAND_KMH_MIN:
        return
    message = (
        f"assist ends within {band_kmh:g} km/h: at the limit the motor goes on and off several"
        f" times a second; below a band of {BAND_KMH_MIN:g} km/h EN 15194's progressive reduction"
        " is not felt as one"
    )
    yield Finding("cutoff_band_narrow", message, "assist_cutoff_band_kmh", {"band_kmh": band_kmh})


def reach_notes(table: FuzzyTable, cutoff: Cutoff | None) -> Iterator[Finding]:
    """Rules that ask for assist at speeds where there is none."""
    if cutoff is None:
        return
    if not cutoff.is_markets or cutoff.market is None:
        yield from _rows_not_reached(table, cutoff.holds_kmh)
        return
    market, ends = market_words(cutoff.market), f"{cutoff.holds_kmh:.4g} km/h"
    message_values = _message_values(cutoff.market, cutoff.holds_kmh)
    for row, peak_kmh in enumerate(table.speed_points_kmh):
        values = {**message_values, "label": LABELS[row]}
        if row and table.speed_points_kmh[row - 1] >= cutoff.holds_kmh:
            message = (
                f"speed row {LABELS[row]} gives assist only above {ends}, where the market,"
                f" {market}, allows none: its rules have no effect"
            )
            yield Finding("row_above_market", message, f"rules[{row}]", values)
        elif peak_kmh - cutoff.holds_kmh > SPEED_SHOWN_KMH:
            message = (
                f"speed row {LABELS[row]} is fully in force at {peak_kmh:g} km/h, but from {ends}"
                f" on the market, {market}, allows no assist: there its rules have no effect"
            )
            yield Finding("peak_above_market", message, f"rules[{row}]", values)


def ratio_warnings(
    table: FuzzyTable,
    modes: AssistModes | None,
    which: str,
    cutoff: Cutoff | None,
    taper_speeds_kmh: tuple[float, float] | None,
) -> Iterator[Finding]:
    """Modes that ask for more of the rider's torque than the market allows at some speed.

    which: the table's place in the unit. taper_speeds_kmh: where the fixed law's ratio begins to
    fall and where it is zero; without them a mode that follows them is not judged.
    """
    if modes is None or cutoff is None or cutoff.market is None:
        return
    own = [speed for speed in table.speed_points_kmh if speed < cutoff.holds_kmh]
    speeds = np.union1d(np.arange(0.0, cutoff.holds_kmh, SPEED_STEP_KMH), own)
    allowed = allowed_ratios(cutoff.market, speeds)
    if allowed is None:
        return
    points = table.torque_rate_points
    rates = np.union1d(np.linspace(points[0], points[-1], RATE_STEPS + 1), points)
    gains = surface(table, speeds, rates).max(axis=1).astype(np.float64)
    for slot, mode in enumerate(modes.modes):
        if mode.law == "fuzzy" and mode.table == which:
            ratios: Floats | None = mode.ratio * (1.0 + gains)
        else:
            ratios = _fixed_ratios(modes, slot, taper_speeds_kmh, speeds)
        if ratios is None or not (ratios - allowed > RATIO_SHOWN).any():
            continue
        yield _ratio_finding(mode, slot, cutoff.market, speeds, ratios, allowed)


def _ratio_finding(
    mode: AssistMode, slot: int, market: str, speeds: Floats, ratios: Floats, allowed: Floats
) -> Finding:
    first = int(np.argmax(ratios - allowed > RATIO_SHOWN))
    worst = int(np.argmax(ratios - allowed))
    message = (
        f"{mode.name}: from {speeds[first]:.1f} km/h on it asks for more than the market,"
        f" {market_words(market)}, allows, at {speeds[worst]:.1f} km/h {ratios[worst]:.2f} times"
        f" the rider's torque instead of {allowed[worst]:.2f}; the unit gives what is allowed"
    )
    values = {**_message_values(market, float(speeds[first])), "mode": mode.name}
    return Finding("ratio_above_market", message, f"modes[{slot}].ratio", values)


def _message_values(market: str, speed_kmh: float) -> dict[str, float | str]:
    """What a message tells of a market and a speed."""
    return {"market": market, "speed_kmh": round(speed_kmh, 2)}


def _rows_not_reached(table: FuzzyTable, cutoff_kmh: float) -> Iterator[Finding]:
    for row in range(1, len(LABELS)):
        if table.speed_points_kmh[row - 1] >= cutoff_kmh:
            message = f"speed row {LABELS[row]} acts only above the cut-off of {cutoff_kmh:g} km/h"
            yield Finding("row_not_reached", message, f"rules[{row}]")


def _fixed_ratios(
    modes: AssistModes, slot: int, taper_speeds_kmh: tuple[float, float] | None, speeds: Floats
) -> Floats | None:
    """What a fixed mode asks for at each speed; None of another one, or where it is not known."""
    mode = modes.modes[slot]
    if mode.law != "fixed" or (mode.taper == "taper_speeds" and taper_speeds_kmh is None):
        return None
    config = modes.to_parameters()
    if taper_speeds_kmh is not None:
        start_kmh, end_kmh = taper_speeds_kmh
        config |= {"fixed_taper_start_kmh": start_kmh, "fixed_taper_end_kmh": end_kmh}
    return law.steady_ratios(config, slot, speeds).astype(np.float64)
