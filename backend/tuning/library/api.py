"""Named tables and configurations, with or without a unit."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Header, Path, Query, Response

from backend.law.feel import Feel
from backend.tuning.library.compare import Compare, Side
from backend.tuning.library.models import (
    CompareRequest,
    Comparison,
    FisText,
    LibraryDocument,
    LibraryEntry,
    LibraryList,
    ReadFis,
)
from backend.tuning.library.service import Library, LibraryRow, library_file, read_fis_file
from backend.tuning.models.law import Table
from backend.web.authentication import Author
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(prefix="/library", tags=["library"], responses=refusals())
TheCompare = Annotated[Compare, provided("compare")]
TheLibrary = Annotated[Library, provided("library")]
EntryId = Annotated[str, Path(max_length=80)]
Version = Annotated[
    int | None, Query(ge=1, le=2**31 - 1, description="Of an own item: as it was in this version.")
]
IfMatch = Annotated[
    str | None,
    Header(description="The ETag of what the change was made for, or `*`.", max_length=400),
]


@router.get("", operation_id="list_library", response_model=LibraryList)
def list_library(
    library: TheLibrary,
    deleted: Annotated[bool, Query(description="Deleted own items, too.")] = False,
) -> dict[str, Any]:
    """Every table and configuration there is under a name, without its values."""
    return {"items": library.rows(deleted)}


@router.post(
    "",
    operation_id="add_library_item",
    response_model=LibraryRow,
    status_code=201,
    responses=refusals(409),
)
def add_library_item(
    body: LibraryDocument, library: TheLibrary, response: Response, author: Author
) -> Any:
    """Keeps a document under its name. It is checked as a unit would; nothing goes to a unit."""
    row = library.add(body.model_dump(exclude_unset=True), author)
    response.headers["location"] = f"/api/v1/library/{row.id}"
    return _stamped(row, response)


@router.post(
    "/compare",
    operation_id="compare",
    response_model=Comparison,
    responses=refusals(404, 409, 503, 504),
)
def compare(body: CompareRequest, comparer: TheCompare) -> Any:
    """Any two side by side: presets, own items, what a unit has or had, a draft. Changes nothing.

    The cells and parameters that differ, the surfaces with their largest difference and its place,
    and how both feel.
    """
    left, right = (Side(**side.model_dump()) for side in (body.left, body.right))
    return comparer.compare(left, right, body.feel)


@router.post("/fis", operation_id="read_fis", response_model=ReadFis)
def read_fis(body: FisText) -> Any:
    """The table in a `.fis` file, with the largest difference between the file and the unit. What
    the unit cannot do is refused with its line. Nothing is kept."""
    return read_fis_file(body.text, body.name)


@router.get(
    "/{entry_id}",
    operation_id="get_library_entry",
    response_model=LibraryEntry,
    responses=refusals(404),
)
def get_library_entry(
    entry_id: EntryId, library: TheLibrary, response: Response, version: Version = None
) -> Any:
    """One of them whole, as the file that `spindle device restore` takes."""
    entry = library.entry(entry_id, version)
    response.headers["etag"] = entry.etag
    return entry.document


@router.put(
    "/{entry_id}",
    operation_id="change_library_item",
    response_model=LibraryRow,
    responses=refusals(403, 404, 409, 412),
)
def change_library_item(
    entry_id: EntryId,
    body: LibraryDocument,
    library: TheLibrary,
    response: Response,
    author: Author,
    if_match: IfMatch = None,
) -> Any:
    """Gives an own item another content or name; brings a deleted one back. What it was stays among
    its versions."""
    document = body.model_dump(exclude_unset=True)
    return _stamped(library.change(entry_id, document, if_match, author), response)


@router.delete(
    "/{entry_id}",
    operation_id="remove_library_item",
    response_model=LibraryRow,
    responses=refusals(403, 404, 409, 412),
)
def remove_library_item(
    entry_id: EntryId,
    library: TheLibrary,
    response: Response,
    author: Author,
    if_match: IfMatch = None,
) -> Any:
    """Takes an own item out of the library. Its versions stay, and a PUT brings it back."""
    return _stamped(library.remove(entry_id, if_match, author), response)


@router.get(
    "/{entry_id}/export",
    operation_id="export_library_entry",
    response_class=Response,
    responses={**refusals(404, 409), 200: {"content": {"application/octet-stream": {}}}},
)
def export_library_entry(
    entry_id: EntryId,
    library: TheLibrary,
    file_format: Annotated[Literal["json", "fis", "csv"], Query(alias="format")] = "json",
    table: Annotated[
        Table, Query(description="Of a configuration, for `fis` and `csv`.")
    ] = "first",
    version: Version = None,
) -> Response:
    """A file: the document as JSON, or one table for MATLAB and others, or for a spreadsheet."""
    document = library.entry(entry_id, version).document
    file = library_file(entry_id, document, file_format, table)
    headers = {"content-disposition": f'attachment; filename="{file.file_name}"'}
    return Response(file.text, media_type=file.media_type, headers=headers)


@router.get(
    "/{entry_id}/feel",
    operation_id="get_library_feel",
    response_model=Feel,
    responses=refusals(404, 409),
)
def get_library_feel(entry_id: EntryId, comparer: TheCompare) -> Any:
    """How an entry feels on the simulated bike: an eighth of a second, once for what it holds."""
    return comparer.feel(entry_id)


@router.get(
    "/{entry_id}/versions",
    operation_id="list_library_versions",
    response_model=LibraryList,
    responses=refusals(404),
)
def list_library_versions(entry_id: EntryId, library: TheLibrary) -> dict[str, Any]:
    """Every state an own item was in, newest first: who made it, and when."""
    return {"items": library.versions(entry_id)}


def _stamped(row: Any, response: Response) -> Any:
    response.headers["etag"] = row.etag
    return row
