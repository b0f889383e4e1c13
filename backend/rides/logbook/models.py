"""The rider's home, and what is asked of many rides at once."""

from __future__ import annotations

from datetime import date, datetime
from typing import Annotated, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody

RideIds = Annotated[
    list[Annotated[int, Field(ge=1, le=2**63 - 1)]], Field(min_length=1, max_length=500)
]


class RideTotals(Answer):
    """Sums over rides; null where none of them has it. The motor's is of `with_motor` rides only,
    the rider's of `with_rider`. They are never added up."""

    rides: int
    with_rider: int
    with_motor: int
    distance_km: float | None
    moving_s: float | None
    rider_wh: float | None
    rider_power_w_mean: float | None
    motor_wh: float | None


class PeriodTotals(RideTotals):
    """A week or a month in the rider's time zone: [from, to)."""

    first_day: date
    begin: datetime = Field(alias="from")
    end: datetime = Field(alias="to")


class BikeTotals(Answer):
    """A bike that was ridden."""

    bike_id: int
    name: str
    last_ride_at: datetime
    rides: int
    distance_km: float | None


class RideRecord(Answer):
    """The ride that has most of a figure. Powers are the rider's own."""

    kind: Literal[
        "distance_km",
        "speed_kmh_mean",
        "ascent_m",
        "power_w_best_5s",
        "power_w_best_60s",
        "power_w_best_300s",
        "power_w_best_1200s",
    ]
    value: float
    ride_id: int
    started_at: datetime


class RideFault(Answer):
    """Faults that came on a ride."""

    ride_id: int
    at: datetime
    flags: int = Field(description="Bits of `fault_flags`.")


class TagInUse(Answer):
    tag: str
    rides: int


class RiderHome(Answer):
    """Twelve weeks and twelve months up to now, the oldest first; bikes, the last ridden first."""

    weeks: list[PeriodTotals]
    months: list[PeriodTotals]
    bikes: list[BikeTotals]
    records: list[RideRecord]
    faults: list[RideFault]
    tags: list[TagInUse]


class RideTags(RequestBody):
    """Tags to add to rides and to take from them, all or none."""

    ride_ids: RideIds
    add: list[str] = Field(default=[], max_length=20)
    remove: list[str] = Field(default=[], max_length=100)


class RidesGone(RequestBody):
    ride_ids: RideIds
