"""Rides: list, look, annotate, trace, export, replay, delete."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query, Request, Response, status
from fastapi.responses import JSONResponse, StreamingResponse

from backend.core.api_models import Moment
from backend.core.channels import channel_names
from backend.rides.files import MEDIA_TYPES
from backend.rides.insight.ledger import EnergyLedger
from backend.rides.insight.table_use import UseOfTable
from backend.rides.models import Figure, Ride, RideList, RidePatch, Series, Track
from backend.rides.query import Blur, Channels, ExportFormat, RideId, RideKind, as_file
from backend.rides.replay.models import (
    AgainRequest,
    ClosedLoop,
    Replay,
    ReplayRequest,
    TableUse,
    TableUseRequest,
)
from backend.rides.replay.ride_again import RideAgain
from backend.rides.replay.why_ride import WhyRide
from backend.rides.service import Rides
from backend.tuning.models.why import Cuts, Ledger, Why
from backend.web.problem import DAMAGED, refusals
from backend.web.responses import json_response, streamed_json, while_connected
from backend.web.services import provided

EXPORTED: dict[str, Any] = {media_type.split(";")[0]: {} for media_type in MEDIA_TYPES.values()}
router = APIRouter(prefix="/rides", tags=["rides"], responses=refusals(404, 409, 415))
TheEnergyLedger = Annotated[EnergyLedger, provided("ledger")]
TheRideAgain = Annotated[RideAgain, provided("ride_again")]
TheRides = Annotated[Rides, provided("rides")]
TheUseOfTable = Annotated[UseOfTable, provided("use_of_table")]
TheWhyRide = Annotated[WhyRide, provided("why_ride")]

# The block described on top of backend/rides/traces/trace.py.
BINARY_MEDIA_TYPE = "application/octet-stream"
Axis = Literal["time", "moving", "distance"]


@router.get("", operation_id="list_rides", response_model=RideList)
def list_rides(
    rides: TheRides,
    kind: Annotated[RideKind, Depends()],
    begin: Annotated[Moment | None, Query(alias="from")] = None,
    end: Annotated[Moment | None, Query(alias="to")] = None,
    device: Annotated[
        str | None,
        Query(max_length=500, description="A unit's key or serial number, or a device's id."),
    ] = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    cursor: Annotated[str | None, Query(max_length=200)] = None,
) -> Any:
    """Newest first; `next` is the cursor of the following page, or null."""
    page = rides.list(begin, end, limit, cursor, device=device, **kind.filters())
    return json_response(RideList, page)


@router.get("/{ride_id}", operation_id="get_ride", response_model=Ride)
def get_ride(ride_id: RideId, rides: TheRides) -> Any:
    """One ride with its summary, its gaps and its channels."""
    return json_response(Ride, rides.get(ride_id))


@router.patch("/{ride_id}", operation_id="patch_ride", response_model=Ride)
def patch_ride(ride_id: RideId, body: RidePatch, rides: TheRides) -> Any:
    """Changes name, notes, tags and what is accepted; nothing that was measured."""
    return rides.patch(ride_id, **body.model_dump(exclude_unset=True))


@router.delete("/{ride_id}", operation_id="delete_ride", status_code=status.HTTP_204_NO_CONTENT)
def delete_ride(ride_id: RideId, rides: TheRides) -> None:
    """Deletes a ride and its samples; with the last ride that came from a file, the file too."""
    rides.delete(ride_id)


@router.get(
    "/{ride_id}/series",
    operation_id="get_ride_series",
    response_model=Series,
    responses={**DAMAGED, 200: {"content": {BINARY_MEDIA_TYPE: {}}}},
)
def get_ride_series(
    ride_id: RideId,
    request: Request,
    rides: TheRides,
    channels: Channels = None,
    from_s: Annotated[float | None, Query(ge=0.0)] = None,
    to_s: Annotated[float | None, Query(ge=0.0)] = None,
    px: Annotated[int, Query(ge=1, le=10_000, description="Width of the plot.")] = 1200,
    axis: Annotated[Axis, Query(description="What the plot's pixels are equal parts of.")] = "time",
) -> Any:
    """The exact least and greatest value per pixel; every sample once they fit."""
    trace = rides.series(ride_id, channel_names(channels), from_s, to_s, px, axis)
    if BINARY_MEDIA_TYPE in request.headers.get("accept", ""):
        return Response(trace.to_bytes(), media_type=BINARY_MEDIA_TYPE)
    # Thousands of numbers that the view has just made: checking each again costs more than them.
    return streamed_json(JSONResponse(trace.to_json()).body)


@router.get(
    "/{ride_id}/track",
    operation_id="get_ride_track",
    response_model=Track,
    responses=DAMAGED,
)
def get_ride_track(ride_id: RideId, rides: TheRides) -> Any:
    """Where the ride went: some 2000 of its rows, enough to draw its track."""
    return json_response(Track, rides.track(ride_id).to_json())


@router.get(
    "/{ride_id}/figure",
    operation_id="get_ride_figure",
    response_model=Figure,
    responses=DAMAGED,
)
def get_ride_figure(
    ride_id: RideId,
    rides: TheRides,
    channels: Channels = None,
    px: Annotated[int, Query(ge=1, le=10_000)] = 1200,
    language: Literal["en", "zh"] = "en",
) -> Any:
    """The traces of a ride as a Plotly figure, its titles in a language."""
    return json_response(Figure, rides.figure(ride_id, channel_names(channels), px, language))


@router.get(
    "/{ride_id}/export",
    operation_id="export_ride",
    response_class=StreamingResponse,
    responses={**DAMAGED, 200: {"content": EXPORTED}},
)
def export_ride(
    ride_id: RideId,
    rides: TheRides,
    file_format: Annotated[ExportFormat, Query(alias="format")] = "csv",
    blur_m: Blur = None,
) -> StreamingResponse:
    """The ride as a file, verified before its first byte; `original` is what was uploaded."""
    return as_file(rides.export(ride_id, file_format, blur_m))


@router.post(
    "/{ride_id}/replay",
    operation_id="replay_ride",
    response_model=Replay,
    responses=DAMAGED,
)
def replay_ride(ride_id: RideId, body: ReplayRequest, rides: TheRides) -> Any:
    """Runs the ride's inputs through the unit's own law with other settings; speed and legs are as
    recorded, the bike does not answer."""
    return json_response(Replay, rides.replay(ride_id, **body.changes()))


@router.post(
    "/{ride_id}/again",
    operation_id="ride_again",
    response_model=ClosedLoop,
    responses=DAMAGED,
)
async def ride_again(
    ride_id: RideId, body: AgainRequest, request: Request, ride_again_with: TheRideAgain
) -> Any:
    """The same road again with other settings, by a twin of the bike; 422 says why where that
    cannot be trusted. Takes a second for some minutes of road, and ends when nobody waits."""

    def work(check_connected: Callable[[], None]) -> Any:
        estimate = ride_again_with(
            ride_id, body.rider_and_bike(), check_connected, **body.changes()
        )
        return json_response(ClosedLoop, estimate)

    return await while_connected(request, work)


@router.get("/{ride_id}/why", operation_id="why_of_ride", response_model=Why, responses=DAMAGED)
def why_of_ride(
    ride_id: RideId, why: TheWhyRide, t_s: Annotated[float, Query(ge=0.0, le=1e7)]
) -> Any:
    """Why the motor gave what it gave then; 409 `no_table` without the ride's configuration."""
    return why(ride_id, t_s)


@router.get("/{ride_id}/cuts", operation_id="cuts_of_ride", response_model=Cuts, responses=DAMAGED)
def cuts_of_ride(ride_id: RideId, why: TheWhyRide) -> Any:
    """Where a limit held the motor back, in order of time, as the unit told it."""
    return {"items": why.cuts(ride_id)}


@router.get(
    "/{ride_id}/ledger", operation_id="ledger_of_ride", response_model=Ledger, responses=DAMAGED
)
def ledger_of_ride(ride_id: RideId, ledger: TheEnergyLedger) -> Any:
    """Which mode and which rule carried which share of the ride's motor energy."""
    return ledger(ride_id)


@router.post("/table-use", operation_id="table_use", response_model=TableUse)
def table_use(body: TableUseRequest, use: TheUseOfTable) -> Any:
    """Where in a fuzzy table rides were: seconds and motor energy of each cell."""
    return json_response(TableUse, use(**body.model_dump()))
