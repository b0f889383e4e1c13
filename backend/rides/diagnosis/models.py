"""How the zero of a unit's torque sensor moves over its rides."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer
from backend.rides.diagnosis.zero_trend import Share

NoZero = Literal[
    "no_torque",
    "no_cadence",
    "no_speed",
    "no_coasting",
    "not_still",
    "foot",
    "disagree",
    "unreadable",
]
NoTrend = Literal["few_rides", "short_time", "none_since_calibration"]


class RideZero(Answer):
    """A ride, and what its torque sensor read while the rider coasted."""

    ride_id: int
    started_at: datetime
    zero_nm: float | None = Field(description="By the unit's scale on that ride.")
    uncertainty_nm: float | None = Field(description="Standard uncertainty.")
    zero_counts: float | None
    temperature_degc: float | None = Field(description="Of the sensor, then.")
    pieces: int = Field(description="Stretches of coasting of 5 s that it is the median of.")
    reason: NoZero | None = Field(description="Why there is no zero.")
    left_out: Literal["apart", "no_temperature", "other_compensation"] | None = Field(
        description="Why a zero is not in the trend: far from all others; no temperature where the "
        "others have one; ridden under another temperature compensation."
    )


class ScaleChange(Answer):
    name: str
    old: Any
    new: Any


class CalibrationMark(Answer):
    """A configuration that changed how counts become torque."""

    seq: int
    created_at: datetime
    author: str
    reason: str
    changed: list[ScaleChange]


class BandPoint(Answer):
    """The zero at the typical temperature, with its interval of 90 %."""

    at: datetime
    zero_nm: float
    low_nm: float
    high_nm: float


class Crossing(Answer):
    """When the zero reaches a level of either sign; the interval is of 90 %."""

    level_nm: float
    state: Literal["over", "expected", "not_in_sight"]
    at: datetime | None
    earliest_at: datetime | None
    latest_at: datetime | None = Field(description="Null for beyond five years.")


class Crossings(Answer):
    watch: Crossing
    act: Crossing


class DriftTrend(Answer):
    """Zero = a step for each calibration + temperature + age + scatter, by least squares."""

    rides: int = Field(description="How many it is made of.")
    per_month_nm: Share
    per_kelvin_nm: Share | None
    no_per_kelvin: Literal["no_thermometer", "same_weather"] | None = Field(
        description="Why temperature is not told apart: too few rides have one; all within 5 K."
    )
    typical_degc: float | None = Field(description="Mean sensor temperature of these rides.")
    scatter_nm: float = Field(description="Of rides, beyond what each knows of itself.")
    today: BandPoint
    crossings: Crossings
    bands: list[list[BandPoint]] = Field(description="To draw; one for each calibration.")


class SensorDrift(Answer):
    """The zero of a unit's torque sensor over its rides, and when it will be too far."""

    unit_key: str
    method: int
    watch_nm: float = Field(description="More than the weather's share over 50 K.")
    act_nm: float = Field(description="At rest the unit then reports TORQUE_DRIFT: no assist.")
    level: Literal["ok", "watch", "act"] | None = Field(
        description="Of the latest zero since the last calibration; null without one."
    )
    latest: RideZero | None
    rides: list[RideZero] = Field(description="Newest first; also those without a zero.")
    calibrations: list[CalibrationMark] = Field(description="Oldest first.")
    no_trend: NoTrend | None
    trend: DriftTrend | None
