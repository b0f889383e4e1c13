"""Is the server up, and how are its units."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from backend.api.models.device import Health
from backend.api.problem import refusals
from backend.api.services import Provided

router = APIRouter(tags=["server"], responses=refusals())


@router.get("/health", operation_id="get_health", response_model=Health)
async def get_health(services: Provided) -> Any:
    """Whether everything that is to be kept is kept, and how each unit is."""
    return services.health.look()
