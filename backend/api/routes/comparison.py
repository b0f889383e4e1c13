"""Two rides, or two windows of one, side by side."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query, Response

from backend.api.models.comparison import ComparedCrank, ComparedSeries, RideComparison
from backend.api.routes.rides import Channels
from backend.api.services import Provided
from backend.core.channels import channel_names
from backend.services.rides.insight.rows import Window
from backend.web.problem import DAMAGED, refusals
from backend.web.responses import whole

router = APIRouter(prefix="/rides/compare", tags=["rides"], responses={**refusals(404), **DAMAGED})

RideNumber = Annotated[int, Query(ge=1, le=2**63 - 1)]
Second = Annotated[float | None, Query(ge=0.0, le=1e7, description="Since that ride's start.")]


class Pair:
    """Which two windows; absent ends are the ride's."""

    def __init__(
        self,
        a: RideNumber,
        b: RideNumber,
        a_from_s: Second = None,
        a_to_s: Second = None,
        b_from_s: Second = None,
        b_to_s: Second = None,
    ) -> None:
        self.a = Window(a, a_from_s, a_to_s)
        self.b = Window(b, b_from_s, b_to_s)


TwoRides = Annotated[Pair, Depends()]


@router.get("", operation_id="compare_rides", response_model=RideComparison)
def compare_rides(pair: TwoRides, services: Provided) -> Any:
    """Figures of both with their differences, whether they went the same way, and by which settings
    they were ridden."""
    return services.insight.comparison(pair.a, pair.b)


@router.get("/series", operation_id="compare_ride_series", response_model=ComparedSeries)
def compare_ride_series(
    pair: TwoRides,
    services: Provided,
    by: Annotated[Literal["time", "distance"], Query(description="The common axis.")] = "time",
    channels: Channels = None,
    from_x: Annotated[float, Query(ge=0.0, le=1e9, description="Of the axis: s or m.")] = 0.0,
    to_x: Annotated[float | None, Query(ge=0.0, le=1e9)] = None,
    px: Annotated[int, Query(ge=1, le=10_000, description="Bins.")] = 1000,
) -> Response:
    """Both on one axis from the starts of their windows; without channels, those that both have."""
    comparison = services.insight.comparison
    part = (from_x, to_x)
    told = comparison.series(pair.a, pair.b, by, channel_names(channels), part, px)
    return whole(ComparedSeries, told)


@router.get("/crank", operation_id="compare_ride_crank", response_model=ComparedCrank)
def compare_ride_crank(pair: TwoRides, services: Provided) -> Any:
    """Torque over the crank's angle of both."""
    return services.insight.comparison.crank(pair.a, pair.b)
