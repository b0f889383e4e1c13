"""The bike's numbers as they are requested and described."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field

from backend.calibration.bike.balance import Balance
from backend.calibration.bike.coast_down import Resistance
from backend.calibration.bike.wheel import Circumference, CutOff, Pulses
from backend.calibration.types import GravityAt, GravityInput
from backend.core.api_models import RequestBody
from backend.core.described import described

RideNumber = Annotated[int, Field(ge=1, le=2**63 - 1)]
Second = Annotated[float | None, Field(ge=0, le=1e7)]
DEVICE = "A connected unit to compare with; null: none."


class RollOut(RequestBody):
    """Rolled straight ahead from one mark on the ground to the next, rider on the saddle."""

    distances_m: list[Annotated[float, Field(gt=0, le=1000)]] = Field(min_length=2, max_length=50)
    turns: float = Field(gt=0, le=400, description="Of the wheel, in each of the rolls.")
    tape_limit_m: float = Field(ge=0, le=1, description="Half width of what a roll may be off.")
    device_id: str | None = Field(default=None, max_length=400, description=DEVICE)


class WheelByTrack(RequestBody):
    """A ride whose speed is counted by the wheel, and positions of the same way."""

    ride_id: RideNumber
    from_s: Second = None
    to_s: Second = None
    track_ride_id: RideNumber | None = Field(
        default=None,
        description="Another device's ride at the same time, which has the positions; the bike "
        "stands at both ends of the window then. Null: the ride itself has them.",
    )
    device_circumference_m: float | None = Field(
        default=None,
        ge=0.5,
        le=3.0,
        description="What the ride's device counts with; null: as its stored configuration says.",
    )
    device_id: str | None = Field(default=None, max_length=400, description=DEVICE)


@described
class UnitComparison:
    device_id: str
    stored_m: float
    """What the unit counts with."""
    free_min_m: float | None
    """What may be set without the maker's token."""
    free_max_m: float | None
    in_band: bool | None
    """The measured value lies there; null: no band."""
    difference_pct: float
    """Of the measured value from the stored one."""
    agrees: bool
    """They differ by no more than the expanded uncertainty."""
    cut_off: CutOff | None
    """At what true speed the unit's assist cut-off lies; null: it has none."""


@described
class Wheel:
    measured: Circumference
    distance_m: float
    """On the ground; of rolls, their mean."""
    turns: float
    """Of the wheel, on that distance."""
    noise_m: float | None
    """Of a position, in each direction; null: rolled."""
    unit_comparison: UnitComparison | None


class PulsesRequest(RequestBody):
    """A ride, or a part of it, in which nothing but a hand turned the wheel, from a mark to it."""

    ride_id: RideNumber
    from_s: Second = None
    to_s: Second = None
    turns: float = Field(gt=0, le=1000, description="Of the wheel, counted by whoever turned it.")


@described
class PulseComparison:
    """The speed sensor's pulses in a turn of its wheel, compared with the unit's setting."""

    unit_key: str | None
    """Whose they are."""
    reported_turns: float
    """Of the wheel, by the unit."""
    turns: float
    pulses: Pulses


class CadenceRequest(RequestBody):
    """A part of a ride; at best from a standing crank to a standing one."""

    ride_id: RideNumber
    from_s: Second = None
    to_s: Second = None


@described
class Cadence:
    """The mean cadence that the unit reported, against the turns of its crank's angle."""

    reported_rpm: float
    turns: float
    duration_s: float
    error_rpm: float
    """Reported less counted."""
    expanded_rpm: float
    """Expanded uncertainty of the counting, k = 2."""
    agrees: bool


class SlopeRidden(RequestBody):
    """A part of a ride, and how much higher its end lies than its begin."""

    ride_id: RideNumber
    from_s: Second = None
    to_s: Second = None
    rise_m: float | None = Field(
        default=None, ge=-2000, le=2000, description="Null: by the heights of the ride."
    )


class ClimbRequest(RequestBody):
    """A steady climb on the legs alone, and coast-downs with the same rider and tyres; each
    `_limit` is a half width."""

    climb: SlopeRidden
    coast_downs: list[SlopeRidden] = Field(
        default=[], max_length=10, description="None: rolling and air are typical, within limits."
    )
    mass_kg: float = Field(ge=20, le=400, description="Bike, rider and all they carry.")
    mass_limit_kg: float = Field(gt=0, le=50)
    gravity: GravityAt | GravityInput | None = Field(
        default=None, description="Null: anything between the equator's and the poles'."
    )
    rise_limit_m: float = Field(gt=0, le=100)
    efficiency: float = Field(default=0.97, ge=0.5, le=1, description="From crank to road.")
    efficiency_limit: float = Field(default=0.015, ge=0, le=0.2)
    wheels_kg: float = Field(default=2.2, ge=0, le=20, description="What their inertia adds.")
    wheels_limit_kg: float = Field(default=0.5, ge=0, le=10)
    speed_share_limit: float = Field(default=0.005, ge=0, le=0.1)
    wind_limit_ms: float = Field(default=0.5, ge=0, le=10)
    calibrated_expanded_pct: float | None = Field(
        default=None,
        ge=0,
        le=50,
        description="Of the torque by its calibration, k = 2; null: by the certificate of the last "
        "one that was in the unit before the ride.",
    )
    motor_off: bool = Field(
        default=False,
        description="The rider's word, needed where the ride does not tell what the motor gave.",
    )


@described
class CertificateOfTorque:
    calibration_id: int
    """Of the job that has it."""
    sha256: str
    """Of the certificate that the unit keeps."""
    written_at: datetime
    """When the unit got it."""
    torque_nm: float
    """The mean of the climb."""
    expanded_share: float
    """Of that torque, k = 2."""


@described
class CalibratedTorque:
    """How well the calibration knows the torque, and who says so.

    `unknown`: only the climb's uncertainty counts.
    """

    source: Literal["given", "certificate", "unknown"]
    expanded_share: float
    certificate: CertificateOfTorque | None = None


@described
class ClimbResult:
    """The torque gain by an energy balance, and whether it agrees with the calibration."""

    unit_key: str | None
    rise_m: float
    """Of the climb, as it was counted."""
    duration_s: float
    resistance: Resistance
    balance: Balance
    calibrated: CalibratedTorque
