"""What a calibration may be off by, per market and model, and who says so."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

from pydantic import Field

from backend.domain.calibration.plain import Plain, from_plain
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


def limits_table(told: Sequence[Any]) -> tuple[Limits, ...]:
    """The house's own limits before the examples. told: plain tables.

    Raises InvalidRequest for one that is no limits, that does not say whose it is, or that is for
    the same bikes as another.
    """
    own: dict[tuple[str | None, str | None], Limits] = {}
    for number, table in enumerate(told, 1):
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
    for wanted in ((market, model), (None, model), (market, None), (None, None)):
        for entry in table:
            if (entry.market, entry.model) == wanted:
                return entry
    return DEFAULTS[0]
