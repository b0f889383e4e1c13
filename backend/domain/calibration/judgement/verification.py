"""Verification: a mass that the fit has not seen, read with the new coefficients."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from backend.domain.calibration.budget import REFERENCE, budget
from backend.domain.calibration.capture import Capture
from backend.domain.calibration.fit import Fit
from backend.domain.calibration.plain import Plain
from backend.domain.calibration.setup import Setup
from backend.domain.calibration.strokes import readings_nm


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
    found = []
    for capture, reading in zip(checked, readings, strict=True):
        load_nm = capture.state.load_nm(setup)
        own = budget(setup, captures, fit, (load_nm,), without=REFERENCE)
        noise_nm = capture.deviation_counts * fit.coefficients.gain_nm_per_count
        expanded = math.hypot(own.expanded_nm[0], 2 * noise_nm / math.sqrt(capture.count))
        difference = float(reading) - load_nm
        found.append(
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
    return tuple(found)


def en_number(difference: float, expanded: float) -> float:
    """The size of a difference in its expanded uncertainty; 0 where there is neither."""
    if difference == 0.0:
        return 0.0
    return abs(difference) / expanded if expanded > 0 else math.inf
