"""Tables whose units or time zone are missing: the owner's answers are stored for their header."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Response
from fastapi.concurrency import run_in_threadpool

from backend.imports.mapping import TableMapping
from backend.imports.models import AnsweredTables, TableAnswerRequest, TableQuestion, Upload
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["uploads"], responses=refusals(400, 404, 409))
TheTableMapping = Annotated[TableMapping, provided("tables")]


@router.get(
    "/uploads/{upload_id}/mapping", operation_id="get_mapping", response_model=TableQuestion
)
def get_mapping(upload_id: str, tables: TheTableMapping) -> Any:
    """What can be said of a table, with its first rows; of one that was rejected with
    `needs_mapping`, what must be."""
    return tables.question(upload_id)


@router.put("/uploads/{upload_id}/mapping", operation_id="put_mapping", response_model=Upload)
async def put_mapping(upload_id: str, body: TableAnswerRequest, tables: TheTableMapping) -> Any:
    """Says it; the file is read, as is every other that waits for the same answer.

    Rides that are here already become what their file says now; names, notes and tags stay.
    """
    values = body.model_dump(exclude={"read_again"})
    return await run_in_threadpool(tables.say, upload_id, values, read_again=body.read_again)


@router.get("/tables", operation_id="list_tables", response_model=AnsweredTables)
def list_tables(tables: TheTableMapping) -> Any:
    """What was said of which tables, by the hash of their header."""
    return tables.answered_tables()


@router.delete("/tables/{header_sha256}", operation_id="forget_table", status_code=204)
def forget_table(header_sha256: str, tables: TheTableMapping) -> Response:
    """Forgets what was said: the next file with this header is asked about again."""
    tables.forget(header_sha256)
    return Response(status_code=204)
