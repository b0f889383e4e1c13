"""Is the server up, how are its units, where is it found, where is everything kept, and a backup of
it."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Request
from fastapi.responses import StreamingResponse

from backend.core.described import described
from backend.errors import StoreError
from backend.server.addresses import Addresses, ServerAddresses
from backend.server.backup import StoreService
from backend.server.health import Health, HealthCheck
from backend.store import StorePlace
from backend.web.problem import problem_response, refusals, refusals_only
from backend.web.services import provided

router = APIRouter(tags=["server"], responses=refusals())
# Outside the API's prefix and without its version: what watches processes asks for these.
probes = APIRouter(tags=["server"])
TheStore = Annotated[StoreService, provided("store")]
TheAddresses = Annotated[ServerAddresses, provided("addresses")]
Check = Annotated[HealthCheck, provided("health")]


@described
class Alive:
    status: Literal["ok"] = "ok"


@router.get("/health", operation_id="get_health")
async def get_health(health: Check) -> Health:
    """Whether everything that is to be kept is kept, and how each unit is."""
    return health.current()


@probes.get("/healthz", operation_id="get_healthz")
async def get_healthz() -> Alive:
    """The process answers. Says nothing of disk or units; `/api/v1/health` does."""
    return Alive()


@probes.get(
    "/readyz", operation_id="get_readyz", response_model=Alive, responses=refusals_only(503)
)
def get_readyz(health: Check) -> Any:
    """Requests can be answered; 503 while the database does not answer."""
    try:
        health.ready()
    except StoreError as error:
        return problem_response(503, "not_ready", error.message)
    return Alive()


@router.get("/server/addresses", operation_id="get_addresses")
def get_addresses(addresses: TheAddresses, request: Request) -> Addresses:
    """By which addresses a phone reaches this server, and how it knows the certificate."""
    _, port = request.scope["server"]
    return addresses.now(str(request.base_url), port)


@router.get("/store", operation_id="get_store", responses=refusals(503))
def get_store(store: TheStore) -> StorePlace:
    """Where rides, units and settings are kept, how large that is, and how much room is left."""
    return store.place()


@router.get(
    "/store/backup",
    operation_id="get_backup",
    response_class=StreamingResponse,
    responses=refusals(503) | {200: {"content": {"application/zip": {}}}},
)
def get_backup(store: TheStore) -> StreamingResponse:
    """Everything that is kept, at this moment, as a zip; unpacked into an empty folder it is a data
    folder. The database is checked before the first byte; its `backup.json` names what lacks."""
    backup = store.backup()
    headers = {"content-disposition": f'attachment; filename="{backup.file_name}"'}
    return StreamingResponse(backup.chunks, media_type="application/zip", headers=headers)
