"""Named tables and configurations, with or without a unit."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Response

from backend.api.models.library import LibraryEntry, LibraryList
from backend.api.problem import refusals
from backend.services.tuning.library import library_entry, library_etag, library_rows

router = APIRouter(prefix="/library", tags=["library"], responses=refusals())


@router.get("", operation_id="list_library", response_model=LibraryList)
def list_library() -> dict[str, Any]:
    """Every table and configuration there is under a name, without its values."""
    return {"items": library_rows()}


@router.get(
    "/{entry_id}",
    operation_id="get_library_entry",
    response_model=LibraryEntry,
    responses=refusals(404),
)
def get_library_entry(entry_id: str, response: Response) -> Any:
    """One of them whole, as the file that `spindle device restore` takes."""
    entry = library_entry(entry_id)
    response.headers["etag"] = library_etag(entry)
    return entry
