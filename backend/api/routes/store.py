"""Where everything is kept, and a backup of it."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from fastapi.responses import StreamingResponse

from backend.api.models.store import StorePlace
from backend.api.services import Provided
from backend.web.problem import refusals

router = APIRouter(prefix="/store", tags=["server"], responses=refusals(503))


@router.get("", operation_id="get_store", response_model=StorePlace)
def get_store(services: Provided) -> Any:
    """Where rides, units and settings are kept, how large that is, and how much room is left."""
    return services.keeping.place()


@router.get(
    "/backup",
    operation_id="get_backup",
    response_class=StreamingResponse,
    responses={200: {"content": {"application/zip": {}}}},
)
def get_backup(services: Provided) -> StreamingResponse:
    """Everything that is kept, at this moment, as a zip; unpacked into an empty folder it is a data
    folder. The database is checked before the first byte; its `backup.json` names what lacks."""
    backup = services.keeping.backup()
    headers = {"content-disposition": f'attachment; filename="{backup.file_name}"'}
    return StreamingResponse(backup.chunks, media_type="application/zip", headers=headers)
