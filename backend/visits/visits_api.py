"""Service visits of bikes: begun, written, looked at, closed, consented to; and their history."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from tempfile import SpooledTemporaryFile
from typing import IO, Annotated, Any

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import StreamingResponse

from backend.core.person import Person
from backend.errors import InvalidRequest
from backend.people.authority import require_session
from backend.visits.history import HISTORY_BYTES_MAX
from backend.visits.service import Visits
from backend.visits.types import (
    HistoryAdded,
    Visit,
    VisitChangeIn,
    VisitConsentIn,
    VisitIn,
    VisitList,
    VisitReadingsIn,
)
from backend.web.authentication import Author
from backend.web.permissions import OwnerId, caller_of
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["service"], responses=refusals(404))
TheVisits = Annotated[Visits, provided("visits")]
BikeId = Annotated[int, Path(ge=1, le=2**63 - 1)]
VisitId = Annotated[int, Path(ge=1, le=2**63 - 1)]
PhotoHash = Annotated[str, Path(pattern=r"^[0-9a-f]{64}$")]
# A phone's photograph has 5 to 15.
PHOTO_BYTES_MAX = 32 * 1024 * 1024
IN_MEMORY_BYTES = 4 * 1024 * 1024
READ_BYTES = 1 << 16


def bytes_of(*media_types: str) -> dict[str, Any]:
    """A request body that is no JSON, for the description."""
    binary = {"schema": {"type": "string", "format": "binary"}}
    return {"requestBody": {"required": True, "content": dict.fromkeys(media_types, binary)}}


@router.get("/bikes/{bike_id}/visits", operation_id="list_visits")
def list_visits(bike_id: BikeId, visits: TheVisits, owner_id: OwnerId) -> VisitList:
    """The visits of a bike, the newest first; for its owner without other people's names."""
    return VisitList(visits.list(bike_id, owner_id))


@router.post(
    "/bikes/{bike_id}/visits",
    operation_id="open_visit",
    status_code=201,
    responses=refusals(404, 409, 503, 504),
)
def open_visit(bike_id: BikeId, body: VisitIn, visits: TheVisits, author: Author) -> Visit:
    """Begins a visit, and looks at the unit if one is named. 409 `visit_open` where one is open."""
    return visits.open(bike_id, body, author)


@router.get("/visits/{visit_id}", operation_id="get_visit")
def get_visit(visit_id: VisitId, visits: TheVisits, owner_id: OwnerId) -> Visit:
    """One visit; of an open one with what is otherwise by now."""
    return visits.get(visit_id, owner_id)


@router.patch("/visits/{visit_id}", operation_id="change_visit", responses=refusals(404, 409))
def change_visit(visit_id: VisitId, body: VisitChangeIn, visits: TheVisits) -> Visit:
    """Writes in an open visit; what is absent stays."""
    return visits.change(visit_id, body)


@router.delete(
    "/visits/{visit_id}",
    operation_id="remove_visit",
    status_code=204,
    responses=refusals(404, 409),
)
def remove_visit(visit_id: VisitId, visits: TheVisits) -> None:
    """Removes an open visit that was begun by mistake; a closed one stays."""
    visits.remove(visit_id)


@router.post(
    "/visits/{visit_id}/readings",
    operation_id="look_at_unit",
    responses=refusals(404, 409, 503, 504),
)
def look_at_unit(visit_id: VisitId, body: VisitReadingsIn, visits: TheVisits) -> Visit:
    """Looks at the unit now: checks and faults. The first look is `before`, the last `after`."""
    return visits.look(visit_id, body.device_id)


@router.post("/visits/{visit_id}/close", operation_id="close_visit", responses=refusals(404, 409))
def close_visit(visit_id: VisitId, visits: TheVisits) -> Visit:
    """Ends a visit with what is otherwise by now. Nothing but the consent is changed after."""
    return visits.close(visit_id)


@router.post(
    "/visits/{visit_id}/consent",
    operation_id="consent_to_visit",
    responses=refusals(403, 404, 409),
)
def consent_to_visit(
    visit_id: VisitId, body: VisitConsentIn, visits: TheVisits, request: Request
) -> Visit:
    """The owner agrees with what was done: by their account, or by a signature in the workshop."""
    caller = caller_of(request)
    person: Person | None = None
    if caller is not None:
        person = caller.person
        if caller.owner_id is not None:
            require_session(caller)
    return visits.consent(visit_id, body, person)


@router.post(
    "/visits/{visit_id}/photos",
    operation_id="add_visit_photo",
    status_code=201,
    responses=refusals(404, 409),
    openapi_extra=bytes_of("image/jpeg", "image/png", "image/webp"),
)
async def add_visit_photo(
    visit_id: VisitId,
    name: Annotated[str, Query(min_length=1, max_length=120, description="Of the file.")],
    request: Request,
    visits: TheVisits,
) -> Visit:
    """Keeps a photograph of up to 32 MiB: upright, 1600 px at most, without what the camera wrote
    into the file."""
    with SpooledTemporaryFile(IN_MEMORY_BYTES) as file:
        await collected(request.stream(), file, PHOTO_BYTES_MAX)
        return await run_in_threadpool(visits.add_photo, visit_id, name, file.read())


@router.get(
    "/visits/{visit_id}/photos/{sha256}",
    operation_id="get_visit_photo",
    response_class=Response,
    responses={**refusals(404), 200: {"content": {"image/jpeg": {}}}},
)
def get_visit_photo(visit_id: VisitId, sha256: PhotoHash, visits: TheVisits) -> Response:
    """A photograph as JPEG."""
    headers = {"cache-control": "private, max-age=86400, immutable"}
    data = visits.photo(visit_id, sha256)
    return Response(data, media_type="image/jpeg", headers=headers)


@router.delete(
    "/visits/{visit_id}/photos/{sha256}",
    operation_id="remove_visit_photo",
    responses=refusals(404, 409),
)
def remove_visit_photo(visit_id: VisitId, sha256: PhotoHash, visits: TheVisits) -> Visit:
    """Takes a photograph out of an open visit, for good."""
    return visits.remove_photo(visit_id, sha256)


@router.get(
    "/bikes/{bike_id}/history",
    operation_id="get_bike_history",
    response_class=StreamingResponse,
    responses={**refusals(404), 200: {"content": {"application/zip": {}}}},
)
def get_bike_history(bike_id: BikeId, visits: TheVisits) -> StreamingResponse:
    """The closed visits of a bike as one file that goes on with it, without the names of who
    brought it or signed."""
    file = SpooledTemporaryFile(IN_MEMORY_BYTES)  # noqa: SIM115  # closed once it is sent
    try:
        visits.write_history(bike_id, file)
    except BaseException:
        file.close()
        raise
    headers = {"content-disposition": f'attachment; filename="spindle-bike-{bike_id}.zip"'}
    return StreamingResponse(pieces(file), media_type="application/zip", headers=headers)


@router.post(
    "/bikes/{bike_id}/history",
    operation_id="add_bike_history",
    responses=refusals(404, 409),
    openapi_extra=bytes_of("application/zip"),
)
async def add_bike_history(bike_id: BikeId, request: Request, visits: TheVisits) -> HistoryAdded:
    """Adds the visits of such a file that are not here yet, all or none. Up to 512 MiB."""
    with SpooledTemporaryFile(IN_MEMORY_BYTES) as file:
        await collected(request.stream(), file, HISTORY_BYTES_MAX)
        return await run_in_threadpool(visits.read_history, bike_id, file)


async def collected(chunks: AsyncIterator[bytes], file: IO[bytes], bytes_max: int) -> None:
    """Write what arrives into a file, and go back to its beginning. Raises InvalidRequest."""
    count = 0
    async for chunk in chunks:
        count += len(chunk)
        if count > bytes_max:
            raise InvalidRequest(f"The file is larger than {bytes_max} bytes.", "too_large")
        await run_in_threadpool(file.write, chunk)
    file.seek(0)


def pieces(file: IO[bytes]) -> Iterator[bytes]:
    """A file from its beginning, closed at its end."""
    with file:
        file.seek(0)
        while piece := file.read(READ_BYTES):
            yield piece
