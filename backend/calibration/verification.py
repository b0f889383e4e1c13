"""A mass that the fit has not seen, read with the new coefficients; and a calibration beside the
earlier ones: of this bike, and of all units of its model.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field

from backend.calibration.budget import REFERENCE, budget
from backend.calibration.capture import Capture
from backend.calibration.fit import Fit
from backend.calibration.plain import Plain
from backend.calibration.setup import Setup
from backend.calibration.strokes import readings_nm
from backend.core.statistics import robust_deviation


@dataclass(frozen=True, slots=True)
class Verification(Plain):
    """One verifying capture. expanded_nm: of the difference, k = 2, without what arm, masses and
    gravity leave open: both used the same. en: the difference in those; 1 or less agrees
    (ISO/IEC 17043, B.3). unseen: no capture of the fit had this mass."""

    capture: int
    load_nm: float
    reading_nm: float
    difference_nm: float
    expanded_nm: float
    en: float
    unseen: bool


def verifications(setup: Setup, captures: Sequence[Capture], fit: Fit) -> tuple[Verification, ...]:
    """Of every capture of kind `verify`."""
    checked = [capture for capture in captures if capture.state.kind == "verify"]
    if not checked:
        return ()
    used = {capture.state.mass_kg for capture in captures if capture.state.kind == "load"}
    readings = readings_nm(checked, fit.coefficients)
    results = []
    for capture, reading in zip(checked, readings, strict=True):
        load_nm = capture.state.load_nm(setup)
        own = budget(setup, captures, fit, (load_nm,), without=REFERENCE)
        noise_nm = capture.deviation_counts * fit.coefficients.gain_nm_per_count
        expanded = math.hypot(own.expanded_nm[0], 2 * noise_nm / math.sqrt(capture.count))
        difference = float(reading) - load_nm
        results.append(
            Verification(
                capture.number,
                load_nm,
                float(reading),
                difference,
                expanded,
                en_number(difference, expanded),
                capture.state.mass_kg not in used,
            )
        )
    return tuple(results)


def en_number(difference: float, expanded: float) -> float:
    """The size of a difference in its expanded uncertainty; 0 where there is neither."""
    if difference == 0.0:
        return 0.0
    return abs(difference) / expanded if expanded > 0 else math.inf


US_PER_DAY = 86_400e6
MODEL_LEAST = 5
"""Fewer calibrations say nothing of how a model scatters."""


@dataclass(frozen=True, slots=True)
class Past(Plain):
    """An earlier calibration. *_expanded: k = 2."""

    at_utc_us: Annotated[int, Field(ge=0)]
    offset_counts: float
    offset_expanded: Annotated[float, Field(ge=0)]
    gain_nm_per_count: Annotated[float, Field(gt=0)]
    gain_expanded: Annotated[float, Field(ge=0)]


@dataclass(frozen=True, slots=True)
class Change(Plain):
    """Since the last one of this bike. *_en: the change in its expanded uncertainty; above 1 the
    sensor has changed."""

    days: float
    offset_nm: float
    offset_en: float
    gain_pct: float
    gain_en: float


@dataclass(frozen=True, slots=True)
class AmongModel(Plain):
    """Against the median of the model's units. deviations: how many of their robust standard
    deviations the gain is away; None if they are all alike."""

    units: int
    gain_pct: float
    deviations: float | None


def past_of(fit: Fit, at_utc_us: int) -> Past:
    """What is kept of a calibration to be compared with later."""
    return Past(
        at_utc_us,
        fit.coefficients.offset_counts,
        fit.expanded("offset_counts"),
        fit.coefficients.gain_nm_per_count,
        fit.expanded("gain_nm_per_count"),
    )


def change(now: Past, earlier: Sequence[Past]) -> Change | None:
    """Since the latest that is earlier; None for the first one."""
    before = [past for past in earlier if past.at_utc_us < now.at_utc_us]
    if not before:
        return None
    last = max(before, key=lambda past: past.at_utc_us)
    offset = now.offset_counts - last.offset_counts
    gain = now.gain_nm_per_count - last.gain_nm_per_count
    return Change(
        (now.at_utc_us - last.at_utc_us) / US_PER_DAY,
        offset * now.gain_nm_per_count,
        en_number(offset, float(np.hypot(now.offset_expanded, last.offset_expanded))),
        100 * gain / last.gain_nm_per_count,
        en_number(gain, float(np.hypot(now.gain_expanded, last.gain_expanded))),
    )


def among_model(now: Past, others: Sequence[Past]) -> AmongModel | None:
    """others: the latest of each other unit of the model. None with fewer than five."""
    if len(others) < MODEL_LEAST:
        return None
    gains = np.array([past.gain_nm_per_count for past in others])
    middle = float(np.median(gains))
    deviation = robust_deviation(gains)
    away = now.gain_nm_per_count - middle
    return AmongModel(len(others), 100 * away / middle, away / deviation if deviation else None)
