"""What modes give for a steady push: over speed, and over the grid of a table."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import Parameters

Speed = Annotated[float, Field(ge=0.0, le=100.0)]


class ModeCurvesRequest(RequestBody):
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


class TorqueSurfaceRequest(RequestBody):
    """A configuration as it is edited; what is left out has the law's defaults."""

    parameters: Parameters = Field(max_length=400)
    mode: int = Field(ge=0, le=4, description="The slot whose table and ratio are asked.")
    rider_torque_nm: float = Field(default=30.0, ge=1.0, le=300.0)
    speeds_kmh: list[Speed] = Field(min_length=1, max_length=64, description="Increasing.")
    torque_rates: list[Annotated[float, Field(ge=0.0, le=100.0)]] = Field(
        min_length=1, max_length=64, description="Increasing."
    )


class TorqueSurface(Answer):
    """At the crank, rows = speeds. What is given for long: ramps are over, the mean of a minute
    that a continuous rating is held against has come to rest, the battery has its nominal voltage
    and the motor is cool."""

    speeds_kmh: list[float]
    torque_rates: list[float]
    demanded_nm: list[list[float]] = Field(description="By the mode's law.")
    delivered_nm: list[list[float]] = Field(description="What is left of it after every limit.")
    limit_flags: list[list[int]] = Field(description="Bits of the registry: what held it back.")
    cadence_rpm: float
    crank_rad_per_s: float = Field(description="Torque times this is the power.")
    engine: str
