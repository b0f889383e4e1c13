"""All rides at once: the rider's home, tags and deletion of many."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, status
from fastapi.responses import StreamingResponse

from backend.rides.logbook.home import RiderHomeService
from backend.rides.logbook.models import RiderHome, RidesGone, RideTags
from backend.rides.query import Blur, ExportFormat, RideKind
from backend.rides.service import Rides
from backend.web.permissions import OwnerId
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(prefix="/rides", tags=["rides"], responses=refusals(404, 409, 415))
TheRiderHome = Annotated[RiderHomeService, provided("home")]
TheRides = Annotated[Rides, provided("rides")]


@router.get("/home", operation_id="rider_home", response_model=RiderHome)
def rider_home(
    home: TheRiderHome,
    owner_id: OwnerId,
    zone: Annotated[
        str, Query(max_length=64, description="The rider's time zone, of the IANA database.")
    ] = "UTC",
    week_begins: Annotated[int, Query(ge=1, le=7, description="1 Monday to 7 Sunday.")] = 1,
    bike: Annotated[int | None, Query(ge=1, le=2**63 - 1)] = None,
) -> Any:
    """Weeks, months, records and faults of all rides or a bike's; days begin at the zone's
    midnight, whatever its clocks do. 422 `unknown_zone` for a zone that is none."""
    return home(zone, week_begins, bike, owner_id)


@router.get(
    "/archive",
    operation_id="export_rides",
    response_class=StreamingResponse,
    responses={200: {"content": {"application/zip": {}}}},
)
def export_rides(
    rides: TheRides,
    kind: Annotated[RideKind, Depends()],
    formats: Annotated[
        list[ExportFormat], Query(min_length=1, max_length=5, default_factory=lambda: ["fit"])
    ],
    ids: Annotated[
        str | None,
        Query(
            pattern=r"^[0-9]{1,18}(,[0-9]{1,18}){0,499}$",
            description="Numbers of rides separated by commas; absent means all of this kind.",
        ),
    ] = None,
    blur_m: Blur = None,
) -> StreamingResponse:
    """Rides as a ZIP with an `index.csv` that lists them and what could not be made of them."""
    ride_ids = [int(number) for number in ids.split(",")] if ids else []
    chunks = rides.archive(formats, blur_m, ride_ids, **kind.filters())
    headers = {"content-disposition": 'attachment; filename="spindle-rides.zip"'}
    return StreamingResponse(chunks, media_type="application/zip", headers=headers)


@router.post("/tags", operation_id="tag_rides", status_code=status.HTTP_204_NO_CONTENT)
def tag_rides(body: RideTags, home: TheRiderHome, owner_id: OwnerId) -> None:
    """Adds tags to rides and takes others from them, all or none."""
    home.tag(body.ride_ids, body.add, body.remove, owner_id)


@router.post("/delete", operation_id="delete_rides", status_code=status.HTTP_204_NO_CONTENT)
def delete_rides(body: RidesGone, rides: TheRides, owner_id: OwnerId) -> None:
    """Deletes rides as `delete_ride` does each, in order. One that is gone already is passed over;
    409 at one that is being recorded, behind which nothing was deleted."""
    rides.delete_all(body.ride_ids, owner_id)
