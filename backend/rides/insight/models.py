"""What a ride tells: energy, effort, pedalling, diagnosis."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from backend.core.api_models import Answer
from backend.rides.diagnosis.finding import DiagnosisCheck, Severity
from backend.rides.insight.charge import Charge, NoRange
from backend.rides.insight.effort import Distribution, LapFigures
from backend.rides.insight.gradient import Climb
from backend.rides.insight.power_curve import BestMean


class EnergyShare(Answer):
    """Rider, motor and battery side by side; null where it was not measured. Never added up."""

    seconds: float
    distance_km: float | None
    rider_wh: float | None
    motor_wh: float | None
    battery_wh: float | None
    motor_per_rider: float | None = Field(
        description="The motor's work over the rider's, of the moments in which both are known."
    )


class ModeEnergy(EnergyShare):
    mode: int = Field(description="Its slot.")
    name: str | None = Field(description="Null where nobody kept the ride's configuration.")


class GradientEnergy(EnergyShare):
    """Of the rows whose gradient lies from `from_pct` up to `to_pct`; null for no end."""

    from_pct: float | None
    to_pct: float | None


class RideEnergy(Answer):
    ride_id: int
    total: EnergyShare
    lost_km: float | None = Field(description="Way in gaps, that is in no row.")
    battery_wh_per_km: float | None
    modes: list[ModeEnergy]
    gradients: list[GradientEnergy] | None = Field(
        description="Gradient of height over way, a straight line over 100 m; null without heights."
    )
    gradient_unknown_s: float | None
    climb: Climb | None
    charge: Charge | None
    range_refused: Literal["no_charge"] | NoRange | None = Field(
        description="Why there is no range; null with one."
    )


class RideEffort(Answer):
    """What the rider gave; null without the channel."""

    ride_id: int
    power: Distribution | None = Field(
        description="While pedalling. Zones after Allen and Coggan, of the threshold power."
    )
    heart_rate: Distribution | None = Field(description="Zones by tenths of the greatest.")
    torque: Distribution | None
    torque_of_power: bool = Field(description="Torque is power over cadence, not measured.")
    cadence: Distribution | None
    power_curve: list[BestMean] = Field(
        description="A stretch with a gap in it does not count; the last is the longest without."
    )
    laps: list[LapFigures]


class RideDiagnosis(Answer):
    ride_id: int
    method: int = Field(description="Counted up whenever a threshold or a method changes.")
    worst: Severity | None
    checks: list[DiagnosisCheck]


class CrankTorque(Answer):
    """Means over turning cranks, in 36 bins from the left crank up on."""

    turns: float
    cadence_rpm: float
    rider_nm: list[float]
    motor_nm: list[float] | None = Field(description="What the motor gave, at the crank.")
    left_share: float | None = Field(
        description="Of the rider's work, in the half of the turn in which the left leg pushes."
    )
    dead_spot_deg: float
    dead_spot_share: float | None = Field(description="Its torque over the mean.")
    lag_deg: float | None = Field(
        description="Of the motor behind the rider, by the fundamental of the stroke; null where "
        "the motor's torque is not known or does not swing with it."
    )
    lag_ms: float | None


class GainMap(Answer):
    """Time over speed and gain: seconds[speed][gain], cells of these steps from zero on."""

    speed_step_kmh: float
    gain_step: float
    seconds: list[list[float]]


class RidePedalling(Answer):
    ride_id: int
    crank: CrankTorque | None
    crank_refused: Literal["no_angle", "no_torque", "slow_rows", "few_turns"] | None
    gain: GainMap | None
    speed_points_kmh: list[float] | None = Field(
        description="Of the ride's own table; null where nobody kept it."
    )
    gain_points: list[float] | None
