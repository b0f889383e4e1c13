"""Tables whose units or zone nobody knows but their owner: asked, answered, remembered."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Response
from fastapi.concurrency import run_in_threadpool

from backend.api.models.table import KnownTables, SaidOfTable, TableQuestion
from backend.api.models.upload import Upload
from backend.api.services import Provided
from backend.web.problem import refusals

router = APIRouter(tags=["uploads"], responses=refusals(400, 404, 409))


@router.get(
    "/uploads/{upload_id}/mapping", operation_id="get_mapping", response_model=TableQuestion
)
def get_mapping(upload_id: str, services: Provided) -> Any:
    """What must be said of a file that was rejected with `needs_mapping`, with its first rows."""
    return services.tables.question(upload_id)


@router.put("/uploads/{upload_id}/mapping", operation_id="put_mapping", response_model=Upload)
async def put_mapping(upload_id: str, body: SaidOfTable, services: Provided) -> Any:
    """Says it; the file is read, as is every other that waits for the same answer."""
    return await run_in_threadpool(services.tables.say, upload_id, body.model_dump())


@router.get("/tables", operation_id="list_tables", response_model=KnownTables)
def list_tables(services: Provided) -> Any:
    """What was said of which tables, by the hash of their header."""
    return services.tables.known()


@router.delete("/tables/{header_sha256}", operation_id="forget_table", status_code=204)
def forget_table(header_sha256: str, services: Provided) -> Response:
    """Forgets what was said: the next file with this header is asked about again."""
    services.tables.forget(header_sha256)
    return Response(status_code=204)
