"""What each mode gives for a steady push, over speed."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from backend.api.models.base import Answer, Question
from backend.api.models.config import Parameters

Speed = Annotated[float, Field(ge=0.0, le=100.0)]


class ModeCurvesRequest(Question):
    """A configuration as it is edited; what is left out has the law's defaults."""

    parameters: Parameters = Field(max_length=400)
    rider_torque_nm: float = Field(default=30.0, ge=0.0, le=300.0)
    speeds_kmh: list[Speed] = Field(
        min_length=1, max_length=60, description="Increasing; each is held for two seconds."
    )


class ModeCurve(Answer):
    """Of one mode, at the crank, after every limit."""

    torque_nm: list[float] = Field(description="At each speed.")
    torque_nm_most: float = Field(description="For a push of `hard_push_nm`, over the speeds.")
    power_w_most: float = Field(description="That torque at `cadence_rpm`.")


class ModeCurves(Answer):
    """With a battery at its nominal voltage, a cool motor, and the cranks at `cadence_rpm`."""

    cadence_rpm: float
    hard_push_nm: float
    modes: list[ModeCurve] = Field(description="By slot.")
    engine: str
