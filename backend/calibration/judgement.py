"""Judgement of a calibration against limits: pass, conditional or fail, each with its causes.

The limits are per market and model, and each tells who says so. A figure above its limit fails if
it is above it by more than its own uncertainty, else it is a condition (the rule of ILAC-G8:09/2019
without a guard band). What was not measured is a condition, never a pass; but temperature and crank
angles, which a plan may leave out, are a note.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import Field

from backend.calibration.asymmetry import Asymmetry
from backend.calibration.budget import REFERENCE, Budget
from backend.calibration.fit import Fit
from backend.calibration.plain import Plain, from_plain
from backend.calibration.prechecks import Refusal
from backend.calibration.setup import Setup
from backend.calibration.strokes import SideFigures
from backend.calibration.verification import Verification
from backend.errors import FieldError, InvalidRequest

Percent = Annotated[float, Field(gt=0, le=100)]

EXAMPLE = "example limits"

MADE_GAIN_PCT = 2.0
"""Two steps of cranks are 2.9 % of 170 mm, and sensors hold their span better than this."""


@dataclass(frozen=True, slots=True)
class Limits(Plain):
    """Percent of full scale, unless the name says otherwise.

    source: who says so. expanded_pct: of the whole budget, k = 2. reference_pct: of what arm,
    masses, gravity and level leave open, k = 2. gain_change_pct: of the unit's gain, found against
    kept. left_right_pct, bending_pct: of the load. made_gain_pct: of the gain that the unit was
    made with; None in certificates from before there was this limit.
    """

    source: str = EXAMPLE
    market: str | None = None
    model: str | None = None
    linearity_pct: Percent = 0.7
    hysteresis_pct: Percent = 0.3
    repeatability_pct: Percent = 0.6
    zero_return_pct: Percent = 0.3
    total_pct: Percent = 1.0
    expanded_pct: Percent = 1.0
    reference_pct: Percent = 0.5
    left_right_pct: Percent = 1.0
    bending_pct: Percent = 1.0
    gain_change_pct: Percent = 1.0
    made_gain_pct: Percent | None = None


DEFAULTS: tuple[Limits, ...] = (
    Limits(made_gain_pct=MADE_GAIN_PCT),
    # Up to 45 km/h and 750 W: the same share of the torque is more power than elsewhere.
    Limits(market="us_class_3", expanded_pct=0.8, total_pct=0.8, made_gain_pct=MADE_GAIN_PCT),
)


def limits_table(entries: Sequence[Any]) -> tuple[Limits, ...]:
    """The house's own limits before the examples. entries: plain tables.

    Raises InvalidRequest for one that is no limits, that does not say whose it is, or that is for
    the same bikes as another.
    """
    own: dict[tuple[str | None, str | None], Limits] = {}
    for number, table in enumerate(entries, 1):
        limits = from_plain(Limits, table)
        if "made_gain_pct" not in table:
            limits = replace(limits, made_gain_pct=MADE_GAIN_PCT)
        whose = (limits.market, limits.model)
        if limits.source == EXAMPLE or whose in own:
            message = f"calibration_limits, table {number}: " + (
                "two tables are for the same market and model."
                if whose in own
                else "`source` must say whose limits these are."
            )
            fault = FieldError("calibration_limits", "not_its_own", message)
            raise InvalidRequest(message, "invalid_limits", [fault])
        own[whose] = limits
    return (*own.values(), *DEFAULTS)


def limits_for(market: str | None, model: str | None, table: Sequence[Limits] = DEFAULTS) -> Limits:
    """The most particular entry that fits: of model and market, of the model, of the market, any.

    Raises nothing: a table without an entry for anybody falls back to the example limits.
    """
    for key in ((market, model), (None, model), (market, None), (None, None)):
        for entry in table:
            if (entry.market, entry.model) == key:
                return entry
    return DEFAULTS[0]


Verdict = Literal["pass", "conditional", "fail"]
Weight = Literal["note", "conditional", "fail"]

EN_FAIL = 1.5
"""One sound verification in twenty-two is beyond 1, one in three hundred beyond 1.5: between, it is
to be taken again."""


@dataclass(frozen=True, slots=True)
class Cause(Plain):
    """Why it is no pass, or what else to know (`note`). figure, allowed, expanded: percent, where
    there are such numbers."""

    code: str
    weight: Weight
    sentence: str
    figure: float | None = None
    allowed: float | None = None
    expanded: float | None = None


@dataclass(frozen=True, slots=True)
class Judgement(Plain):
    """verdict: by the heaviest cause. limits: those that were used."""

    verdict: Verdict
    causes: tuple[Cause, ...]
    limits: Limits


class Evidence(NamedTuple):
    """What is judged. as_found: the figures by the coefficients the unit had; empty if unknown."""

    setup: Setup
    refusals: Sequence[Refusal]
    fit: Fit | None
    figures: Sequence[SideFigures]
    as_found: Sequence[SideFigures]
    zero_return_nm: float | None
    budget: Budget | None
    asymmetry: Asymmetry | None
    verifications: Sequence[Verification]


def judge(evidence: Evidence, limits: Limits) -> Judgement:
    """The verdict with every cause, the heaviest first."""
    order = {"fail": 0, "conditional": 1, "note": 2}
    causes = sorted(_causes(evidence, limits), key=lambda cause: order[cause.weight])
    heaviest = causes[0].weight if causes else "note"
    verdict: Verdict = "pass" if heaviest == "note" else heaviest
    return Judgement(verdict, tuple(causes), limits)


def _causes(evidence: Evidence, limits: Limits) -> Iterator[Cause]:
    for refusal in evidence.refusals:
        yield Cause(refusal.code, "fail", refusal.sentence, refusal.figure)
    if evidence.fit is None or evidence.budget is None:
        if not evidence.refusals:
            yield Cause("too_few_captures", "fail", "the captures do not suffice for a fit")
        return
    yield from _figures(evidence, limits)
    yield from _uncertainty(evidence, evidence.budget, limits)
    yield from _asymmetry(evidence, limits)
    yield from _verified(evidence)
    yield from _gain(evidence, limits)
    yield from _made(evidence, evidence.fit, limits)


def _over(
    code: str, words: str, figure: float, allowed: float, expanded: float = 0.0
) -> Iterator[Cause]:
    if figure <= allowed:
        return
    weight: Literal["conditional", "fail"] = (
        "fail" if figure - expanded > allowed else "conditional"
    )
    sentence = f"{words} {figure:.2f} %, allowed is {allowed:g} %"
    yield Cause(code, weight, sentence, figure, allowed, expanded)


def _figures(evidence: Evidence, limits: Limits) -> Iterator[Cause]:
    sides = {figures.side for figures in evidence.figures}
    for side in ("right", "left"):
        if side not in sides:
            words = f"{side} pedal: two complete strokes up and down are needed for its figures"
            yield Cause(f"no_strokes_{side}", "conditional", words)
    assert evidence.fit is not None
    percent = 100 / evidence.setup.full_scale_nm
    repeatability = 2 * evidence.fit.repeatability_nm * percent
    for figures in evidence.figures:
        # A mean of strokes scatters itself: by their deviation over the root of their number.
        mean = figures.repeatability_deviation_pct / figures.strokes**0.5
        line, loop = figures.linearity_line_pct, figures.hysteresis_pct
        where = f"{figures.side} pedal:"
        yield from _over("linearity", f"{where} linearity", line, limits.linearity_pct, mean)
        yield from _over("hysteresis", f"{where} hysteresis", loop, limits.hysteresis_pct, mean)
        total = figures.total_deviation_pct
        yield from _over("total", f"{where} total error", total, limits.total_pct, mean)
    yield from _over("repeatability", "repeatability", repeatability, limits.repeatability_pct)
    if evidence.zero_return_nm is None:
        yield Cause("no_zero_return", "conditional", "no stroke ends with a zero")
    else:
        back = abs(evidence.zero_return_nm) * percent
        yield from _over(
            "zero_return", "zero return", back, limits.zero_return_pct, 2**0.5 * repeatability
        )


def _uncertainty(evidence: Evidence, budget: Budget, limits: Limits) -> Iterator[Cause]:
    percent = 100 / evidence.setup.full_scale_nm
    expanded = max(budget.expanded_nm) * percent
    yield from _over("uncertainty", "expanded uncertainty", expanded, limits.expanded_pct)
    shared = [entry.standard_nm[-1] for entry in budget.contributions if entry.cause in REFERENCE]
    loads = 2 * sum(value**2 for value in shared) ** 0.5 * percent
    yield from _over("reference", "masses and arm leave open", loads, limits.reference_pct)
    assert evidence.fit is not None
    if evidence.fit.temperature != "both":
        words = "the captures cover too few kelvin to tell the temperature coefficients"
        yield Cause("no_temperature", "note", words, evidence.fit.temperature_span_k)


def _asymmetry(evidence: Evidence, limits: Limits) -> Iterator[Cause]:
    asymmetry = evidence.asymmetry
    if asymmetry is None:
        yield Cause("no_left_right", "conditional", "loads on both pedals are needed")
        return
    if asymmetry.bending_across is None:
        words = "the captures cover too little of the crank's angle to tell a bending"
        yield Cause("no_angles", "note", words)
    for code, words, share, allowed in (
        ("left_right", "left against right", asymmetry.left_right, limits.left_right_pct),
        ("bending", "bending across the crank", asymmetry.bending_across, limits.bending_pct),
    ):
        if share is not None:
            figure, expanded = 100 * abs(share.share), 200 * share.standard
            yield from _over(code, words, figure, allowed, expanded)


def _verified(evidence: Evidence) -> Iterator[Cause]:
    unseen = [entry for entry in evidence.verifications if entry.unseen]
    if not unseen:
        words = "no verification with a mass that the fit has not seen"
        yield Cause("not_verified", "conditional", words)
    for entry in unseen:
        if entry.en > 1:
            words = (
                f"verification at {entry.load_nm:.1f} Nm reads {entry.difference_nm:+.2f} Nm off,"
                f" {entry.expanded_nm:.2f} Nm are explained"
            )
            weight: Weight = "fail" if entry.en > EN_FAIL else "conditional"
            yield Cause("verification", weight, words, entry.en, 1.0)


def _gain(evidence: Evidence, limits: Limits) -> Iterator[Cause]:
    """The old coefficients against the loads: what a wrong gain alone explains is no noise."""
    for figures in evidence.as_found:
        change = 100 * abs(figures.slope - 1)
        straight = figures.linearity_line_pct <= limits.linearity_pct
        if figures.linearity_load_pct > limits.linearity_pct and straight:
            words = (
                f"{figures.side} pedal as found: linearity {figures.linearity_load_pct:.2f} % to"
                f" the load, {figures.linearity_line_pct:.2f} % to a line: gain, not noise:"
                " recalibrate span"
            )
            yield Cause("gain_not_noise", "note", words, change, limits.gain_change_pct)


def _made(evidence: Evidence, fit: Fit, limits: Limits) -> Iterator[Cause]:
    """What is wrong by the same share in every capture, as an arm is, shows against this alone."""
    gain = fit.coefficients.gain_nm_per_count
    change = 100 * (gain / evidence.setup.gain_nm_per_count - 1)
    allowed = limits.made_gain_pct
    if allowed is None or abs(change) <= allowed:
        return
    confirmed = evidence.setup.arm_again_m is not None
    words = (
        f"the gain is {change:+.1f} % off what the unit was made with, {allowed:g} % are usual:"
        " the sensor has drifted, or a length or mass is not what was said; a climb of known height"
        " checks it on the road"
    )
    yield Cause("unlike_made", "note" if confirmed else "conditional", words, change, allowed)
