"""A calibration beside the earlier ones: of this bike, and of all units of its model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field

from backend.domain.calibration.fit import Fit
from backend.domain.calibration.judgement.verification import en_number
from backend.domain.calibration.plain import Plain
from backend.domain.standards.statistics import robust_deviation

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
