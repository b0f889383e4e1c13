"""All that follows from setup and captures, in one go: the wizard and `evaluate` ask the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from backend.calibration.asymmetry import Asymmetry, asymmetry
from backend.calibration.budget import Budget, budget
from backend.calibration.capture import Capture
from backend.calibration.coefficients import Coefficients
from backend.calibration.fit import Fit, data_of, fit
from backend.calibration.judgement import Evidence, Judgement, Limits, judge
from backend.calibration.plain import Plain
from backend.calibration.prechecks import Refusal
from backend.calibration.sanity import refusals
from backend.calibration.setup import Setup
from backend.calibration.strokes import (
    Curve,
    Piecewise,
    SideFigures,
    curve,
    piecewise,
    side_figures,
    zero_return_nm,
)
from backend.calibration.verification import Verification, verifications
from backend.errors import InvalidRequest


@dataclass(frozen=True, slots=True)
class Worked(Plain):
    """What comes out. With refusals, or too few captures, nothing is fitted: None and empty."""

    refusals: tuple[Refusal, ...]
    fit: Fit | None
    curve: Curve | None
    piecewise: Piecewise | None
    asymmetry: Asymmetry | None
    figures: tuple[SideFigures, ...]
    as_found: tuple[SideFigures, ...]
    zero_return_nm: float | None
    budget: Budget | None
    verifications: tuple[Verification, ...]
    judgement: Judgement


def work_out(
    setup: Setup,
    captures: Sequence[Capture],
    unit_coefficients: Coefficients | None,
    limits: Limits,
) -> Worked:
    """unit_coefficients: the coefficients the unit had; None where nobody read them."""
    refused = refusals(setup, captures)
    fitted = None if refused else _fit(setup, captures)
    if fitted is None:
        evidence = Evidence(setup, refused, None, (), (), None, None, None, ())
        judged = judge(evidence, limits)
        return Worked(refused, None, None, None, None, (), (), None, None, (), judged)
    shape = curve(setup, captures, fitted.coefficients)
    evidence = Evidence(
        setup,
        refused,
        fitted,
        side_figures(setup, captures, fitted.coefficients),
        side_figures(setup, captures, unit_coefficients) if unit_coefficients else (),
        zero_return_nm(captures, fitted.coefficients),
        budget(setup, captures, fitted),
        asymmetry(setup, data_of(setup, captures), fitted),
        verifications(setup, captures, fitted),
    )
    return Worked(
        refusals=refused,
        fit=fitted,
        curve=shape,
        piecewise=piecewise(shape, fitted),
        asymmetry=evidence.asymmetry,
        figures=tuple(evidence.figures),
        as_found=tuple(evidence.as_found),
        zero_return_nm=evidence.zero_return_nm,
        budget=evidence.budget,
        verifications=tuple(evidence.verifications),
        judgement=judge(evidence, limits),
    )


def _fit(setup: Setup, captures: Sequence[Capture]) -> Fit | None:
    try:
        return fit(setup, captures)
    except InvalidRequest:
        return None
