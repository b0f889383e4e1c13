"""Is the server up, and how are its units."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from backend.api.models.device import Alive, Health
from backend.api.services import Provided
from backend.errors import StoreError
from backend.web.problem import problem_response, refusals, refusals_only

router = APIRouter(tags=["server"], responses=refusals())
# Outside the API's prefix and without its version: what watches processes asks for these.
probes = APIRouter(tags=["server"])


@router.get("/health", operation_id="get_health", response_model=Health)
async def get_health(services: Provided) -> Any:
    """Whether everything that is to be kept is kept, and how each unit is."""
    return services.health.look()


@probes.get("/healthz", operation_id="get_healthz", response_model=Alive)
async def get_healthz() -> dict[str, str]:
    """The process answers. Says nothing of disk or units; `/api/v1/health` does."""
    return {"status": "ok"}


@probes.get(
    "/readyz", operation_id="get_readyz", response_model=Alive, responses=refusals_only(503)
)
def get_readyz(services: Provided) -> Any:
    """Requests can be answered; 503 while the database does not answer."""
    try:
        services.health.ready()
    except StoreError as error:
        return problem_response(503, "not_ready", error.message)
    return {"status": "ok"}
