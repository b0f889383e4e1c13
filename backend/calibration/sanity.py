"""What is refused by name before anything is fitted, with the figure as it would be."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from backend.calibration.capture import Capture
from backend.calibration.prechecks import Refusal
from backend.calibration.setup import Setup
from backend.core.statistics import Numbers, robust_deviation, robust_line

SLOPE_MIN, SLOPE_MAX = 0.8, 1.25
"""Of the gain the unit was made with: beyond, it is not the sensor but the loads or the bridge."""

LOOKS_LIKE = 0.12
"""How near, as a share, a slope must be to a confusion of units to be called by its name."""

KG_PER_LB = 0.45359237

WRONG_DEVIATIONS = 7.0
WRONG_SHARE = 0.0075
"""Of the full scale: what the prediction without a capture must be missed by, and by so many
deviations of the others, before its mass is called wrong."""


def refusals(setup: Setup, captures: Sequence[Capture]) -> tuple[Refusal, ...]:
    """All that speaks against a fit of these captures; verifications are left out."""
    used = [capture for capture in captures if capture.state.kind != "verify"]
    faults = _order(used)
    load = np.array([capture.state.load_nm(setup) for capture in used])
    counts = np.array([capture.mean_counts for capture in used])
    swapped = _swapped(setup, used, load, counts)
    right = ~np.isin([capture.number for capture in used], [n for r in swapped for n in r.captures])
    line = robust_line(load[right], counts[right])
    if line is None:
        sentence = "captures at two loads or more are needed"
        return (*faults, *swapped, Refusal("too_few_loads", sentence, float(len(used))))
    slope = _slope(setup, line[0])
    wrong = [] if slope or swapped else _wrong_masses(setup, used, load, counts)
    return (*faults, *swapped, *slope, *wrong)


def _order(captures: Sequence[Capture]) -> list[Refusal]:
    """Against the capture just before it at the same pedal: a step may be repeated later, if it is
    come to from the same side. The way down may begin above what was captured on the way up."""
    faults = []
    for before, after in pairwise(sorted(captures, key=lambda capture: capture.number)):
        was, state = before.state, after.state
        alike = (was.side, was.crank_angle_deg) == (state.side, state.crank_angle_deg)
        turns = (was.direction, state.direction) == ("loading", "unloading")
        if state.kind != "load" or not alike or turns:
            continue
        sign = 1.0 if state.direction == "loading" else -1.0
        if sign * (state.mass_kg - was.mass_kg) < 0:
            sentence = (
                f"{state.mass_kg:g} kg after {was.mass_kg:g} kg while {state.direction}: a sensor"
                " that was loaded further reads otherwise"
            )
            numbers = (before.number, after.number)
            faults.append(Refusal("order", sentence, state.mass_kg, captures=numbers))
    return faults


def _swapped(
    setup: Setup, captures: Sequence[Capture], load: Numbers, counts: Numbers
) -> list[Refusal]:
    """On the pedal at the back a mass turns the spindle the other way; if all do, the bridge is
    wired against, which the slope says."""
    zeros = counts[load == 0]
    offset = float(np.median(zeros)) if zeros.size else 0.0
    full = load / setup.gain_nm_per_count
    share = np.divide(counts - offset, full, out=np.ones_like(load), where=load > 0)
    if not (share[load > 0] > 0).any():
        return []
    faults = []
    for capture, slope in zip(captures, share, strict=True):
        if capture.state.kind == "load" and -1.5 < slope < -0.5:
            side = capture.state.side or ""
            sentence = (
                f"{capture.state.mass_kg:g} kg on the {side} pedal reads {slope:.2f} of its load:"
                " it hangs on the other pedal"
            )
            values: dict[str, float | str] = {"mass_kg": capture.state.mass_kg, "side": side}
            numbers = (capture.number,)
            faults.append(Refusal("swapped_pedal", sentence, float(slope), values, numbers))
    return faults


def _slope(setup: Setup, counts_per_nm: float) -> list[Refusal]:
    slope = counts_per_nm * setup.gain_nm_per_count
    if SLOPE_MIN <= slope <= SLOPE_MAX:
        return []
    nm_per_kg = setup.gravity.gravity_ms2 * setup.arm_m
    confused = {
        "looks_like_nm": (1 / nm_per_kg, "looks like Nm: 10 read as kg"),
        "looks_like_kg": (nm_per_kg, "looks like kg: 10 read as Nm"),
        "looks_like_lb": (KG_PER_LB, "looks like lb: 10 read as kg"),
        "against": (-1.0, "the sensor turns the other way: the bridge is wired against"),
    }
    for code, (expected, sentence) in confused.items():
        if abs(slope / expected - 1) < LOOKS_LIKE:
            return [Refusal(code, f"{sentence} (slope {slope:.3f})", slope)]
    sentence = f"slope {slope:.3f} of what the unit was made with, allowed is 0.8 to 1.25"
    return [Refusal("slope", sentence, slope, {"least": SLOPE_MIN, "most": SLOPE_MAX})]


def _wrong_masses(
    setup: Setup, captures: Sequence[Capture], load: Numbers, counts: Numbers
) -> list[Refusal]:
    """Each pedal at each crank angle by itself: a bent spindle is no wrong mass."""
    places = np.array([f"{c.state.side} {c.state.crank_angle_deg}" for c in captures])
    hung = np.array([capture.state.kind == "load" for capture in captures])
    faults = []
    for place, capture in enumerate(captures):
        alike = hung & (places == places[place])
        others = (alike | ~hung) & (np.arange(load.size) != place)
        line = robust_line(load[others], counts[others])
        if not hung[place] or line is None or alike.sum() < 4:
            continue
        slope, offset = line
        left = counts - offset - slope * load
        least = WRONG_SHARE * setup.full_scale_nm * abs(slope)
        allowed = max(least, WRONG_DEVIATIONS * robust_deviation(left[others & hung]))
        if abs(left[place]) > allowed:
            apparent_kg = capture.state.mass_kg * (counts[place] - offset) / (slope * load[place])
            sentence = f"reads like {apparent_kg:.2f} kg, {capture.state.mass_kg:g} kg are named"
            values: dict[str, float | str] = {"mass_kg": capture.state.mass_kg}
            numbers = (capture.number,)
            faults.append(Refusal("wrong_mass", sentence, float(apparent_kg), values, numbers))
    return faults
