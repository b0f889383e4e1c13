"""Whether the last seconds of raw counts are steady enough for a capture, and why not.

What hangs on a pedal swings at 0.5 to 2 Hz, creeps and warms; the converter's own noise is white.
Means of blocks of a quarter of a second tell them apart: white noise averages out in a block, a
swing does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from backend.calibration.capture import outliers
from backend.calibration.plain import Plain
from backend.calibration.prechecks import Refusal
from backend.calibration.setup import Setup
from backend.core.statistics import Numbers

WINDOW_S = 3.0
"""Needed: two swings of a slow pendulum."""

BLOCK_S = 0.25
SPREAD_SHARE = 1e-3
"""Of the full scale, deviation of the blocks' means: a tenth of what a calibration may be off."""

DRIFT_SHARE = 5e-4
"""Of the full scale, over the window: half as much, because a mean does not average it out."""

OUTLIERS_SHARE = 0.05
"""More damaged words than this are no accident: the link to the rotor is bad."""

WARMING_K_PER_MIN = 0.5
"""The gauges follow the thermometer in minutes (thesis_checks 6): faster, and they are apart."""

SIGNIFICANT = 3.0
"""Standard uncertainties that a drift must exceed, too: noise has a slope of its own."""

END_COUNTS = 32767
"""What the sensor's word says at either end of its converter."""


class Window(NamedTuple):
    """The last samples as they came. raw_counts: (n,). degc: the sensor's, of the same time; empty
    where the unit does not tell it."""

    raw_counts: Sequence[int]
    duration_s: float
    degc: Sequence[float] = ()


@dataclass(frozen=True, slots=True)
class Steadiness(Plain):
    """In counts, after rejection. spread: deviation of the blocks' means. drift: over the window.

    reasons: why it may not be captured; empty is steady. rejected: indices of outliers.
    """

    mean_counts: float
    deviation_counts: float
    spread_counts: float
    spread_allowed_counts: float
    drift_counts: float
    drift_allowed_counts: float
    rejected: tuple[int, ...]
    reasons: tuple[Refusal, ...]

    @property
    def steady(self) -> bool:
        """Whether a capture may be taken."""
        return not self.reasons


def steadiness(window: Window, setup: Setup, window_s: float = WINDOW_S) -> Steadiness | None:
    """What the last seconds are like; None with less than two blocks of samples."""
    raw = np.asarray(window.raw_counts, np.float64)
    blocks = int(window.duration_s / BLOCK_S)
    if blocks < 2 or raw.size < 2 * blocks:
        return None
    out = outliers(raw)
    remaining, when = np.delete(raw, out), np.delete(np.arange(raw.size), out)
    means = _block_means(remaining, when * blocks // raw.size, blocks)
    slope, slope_standard = _slope(remaining, when / raw.size)
    scale = setup.full_scale_nm / setup.gain_nm_per_count
    result = Steadiness(
        mean_counts=float(remaining.mean()),
        deviation_counts=float(remaining.std(ddof=1)),
        spread_counts=float(means.std(ddof=1)),
        spread_allowed_counts=SPREAD_SHARE * scale,
        drift_counts=slope,
        drift_allowed_counts=DRIFT_SHARE * scale,
        rejected=tuple(int(index) for index in out),
        reasons=(),
    )
    reasons = [
        *_length(window, window_s),
        *_range(raw),
        *_outliers(raw.size, out.size),
        *_moving(result, slope_standard, remaining.size / blocks),
        *_warming(window),
    ]
    return _with(result, reasons)


def _with(result: Steadiness, reasons: list[Refusal]) -> Steadiness:
    names = [name for name in Steadiness.__slots__ if name != "reasons"]
    return Steadiness(**{name: getattr(result, name) for name in names}, reasons=tuple(reasons))


def _block_means(readings: Numbers, block: np.ndarray, blocks: int) -> Numbers:
    counts = np.bincount(block, minlength=blocks)
    sums = np.bincount(block, readings, minlength=blocks)
    means: Numbers = sums[counts > 0] / counts[counts > 0]
    return means


def _slope(readings: Numbers, share: Numbers) -> tuple[float, float]:
    """Change over the window, and its standard uncertainty from the scatter about the line."""
    centred = share - share.mean()
    squares = float(centred @ centred)
    slope = float(centred @ readings) / squares
    left = readings - readings.mean() - slope * centred
    return slope, float(np.sqrt(left @ left / max(1, readings.size - 2) / squares))


def _length(window: Window, window_s: float) -> list[Refusal]:
    if window.duration_s >= window_s:
        return []
    sentence = f"{window.duration_s:.1f} s so far, {window_s:g} s are needed"
    return [Refusal("too_short", sentence, window.duration_s, {"needed_s": window_s})]


def _range(raw: Numbers) -> list[Refusal]:
    at_end = float(np.mean(np.abs(raw) >= END_COUNTS))
    if at_end > OUTLIERS_SHARE:
        sentence = f"the converter is at its end in {100 * at_end:.0f} % of the readings"
        return [Refusal("end_of_range", sentence, float(np.median(raw)))]
    if np.ptp(raw) == 0.0:
        sentence = f"every reading is {raw[0]:.0f}: a sensor at work shows some noise"
        return [Refusal("stuck", sentence, float(raw[0]))]
    return []


def _outliers(number: int, rejected: int) -> list[Refusal]:
    if rejected <= OUTLIERS_SHARE * number:
        return []
    sentence = f"{rejected} of {number} readings are far from the others"
    return [Refusal("outliers", sentence, float(rejected), {"readings": float(number)})]


def _moving(result: Steadiness, slope_standard: float, per_block: float) -> list[Refusal]:
    reasons = []
    drift, allowed = abs(result.drift_counts), result.drift_allowed_counts
    drifting = drift > allowed and drift > SIGNIFICANT * slope_standard
    if drifting:
        sentence = f"drifts by {result.drift_counts:+.1f} counts, {allowed:.1f} are allowed"
        reasons.append(Refusal("drifting", sentence, result.drift_counts, {"allowed": allowed}))
    spread, allowed = result.spread_counts, result.spread_allowed_counts
    # The drift's own part of the spread is that of a ramp: its height over the root of twelve.
    if spread > allowed and not (drifting and spread < 1.5 * drift / np.sqrt(12)):
        white = result.deviation_counts / np.sqrt(per_block)
        code, word = ("swinging", "swings") if spread > 2 * white else ("noisy", "is noisy")
        sentence = f"{word} by {spread:.1f} counts, {allowed:.1f} are allowed"
        reasons.append(Refusal(code, sentence, spread, {"allowed": allowed}))
    return reasons


def _warming(window: Window) -> list[Refusal]:
    """A whole degree is the thermometer's step: one step within the window says nothing."""
    if len(window.degc) < 2:
        return []
    change_k = float(window.degc[-1] - window.degc[0])
    if abs(change_k) <= max(1.0, WARMING_K_PER_MIN * window.duration_s / 60):
        return []
    sentence = f"the sensor's temperature changed by {change_k:+.1f} K in {window.duration_s:.0f} s"
    return [Refusal("temperature_moving", sentence, change_k)]
