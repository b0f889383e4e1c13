"""Two rides, or two windows of one, side by side."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query, Response

from backend.core.channels import channel_names
from backend.rides.comparison.models import ComparedCrank, ComparedSeries, RideComparison
from backend.rides.comparison.since_change import RidesSinceChange, SinceChange
from backend.rides.query import Channels
from backend.rides.questions import Insight
from backend.rides.rows import Window
from backend.rides.service import Rides
from backend.units.precondition import FOR_ONE_UNIT
from backend.web.permissions import OwnerId
from backend.web.problem import DAMAGED, refusals
from backend.web.responses import json_response
from backend.web.services import provided

router = APIRouter(prefix="/rides/compare", tags=["rides"], responses={**refusals(404), **DAMAGED})
TheInsight = Annotated[Insight, provided("insight")]
TheRides = Annotated[Rides, provided("rides")]

RideNumber = Annotated[int, Query(ge=1, le=2**63 - 1)]
Second = Annotated[float | None, Query(ge=0.0, le=1e7, description="Since that ride's start.")]


class Pair:
    """Which two windows of rides that the caller may see; absent ends are the ride's."""

    def __init__(
        self,
        rides: TheRides,
        owner_id: OwnerId,
        a: RideNumber,
        b: RideNumber,
        a_from_s: Second = None,
        a_to_s: Second = None,
        b_from_s: Second = None,
        b_to_s: Second = None,
    ) -> None:
        rides.require_own((a, b), owner_id)
        self.a = Window(a, a_from_s, a_to_s)
        self.b = Window(b, b_from_s, b_to_s)


of_units = APIRouter(tags=["configuration"], responses=refusals(404, 409, 503, 504))

TwoRides = Annotated[Pair, Depends()]


@router.get("", operation_id="compare_rides", response_model=RideComparison)
def compare_rides(pair: TwoRides, insight: TheInsight) -> Any:
    """Figures of both with their differences, whether they went the same way, and by which settings
    they were ridden."""
    return insight.comparison(pair.a, pair.b)


@router.get("/series", operation_id="compare_ride_series", response_model=ComparedSeries)
def compare_ride_series(
    pair: TwoRides,
    insight: TheInsight,
    by: Annotated[Literal["time", "distance"], Query(description="The common axis.")] = "time",
    channels: Channels = None,
    from_x: Annotated[float, Query(ge=0.0, le=1e9, description="Of the axis: s or m.")] = 0.0,
    to_x: Annotated[float | None, Query(ge=0.0, le=1e9)] = None,
    px: Annotated[int, Query(ge=1, le=10_000, description="Bins.")] = 1000,
) -> Response:
    """Both on one axis from the starts of their windows; without channels, those that both have."""
    comparison = insight.comparison
    part = (from_x, to_x)
    told = comparison.series(pair.a, pair.b, by, channel_names(channels), part, px)
    return json_response(ComparedSeries, told)


@router.get("/crank", operation_id="compare_ride_crank", response_model=ComparedCrank)
def compare_ride_crank(pair: TwoRides, insight: TheInsight) -> Any:
    """Torque over the crank's angle of both."""
    return insight.comparison.crank(pair.a, pair.b)


@of_units.get(
    "/devices/{device_id}/config/revisions/{seq}/since",
    operation_id="since_revision",
    response_model=SinceChange,
    dependencies=FOR_ONE_UNIT,
    responses=refusals(403, 412),
)
def since_revision(
    device_id: str, seq: int, since_change: Annotated[RidesSinceChange, provided("since_change")]
) -> Any:
    """The unit's rides since this configuration beside those before it."""
    return since_change(device_id, seq)
