"""Who changed what, when, and why."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request
from fastapi.responses import StreamingResponse

from backend.audit.service import Audit, ExportFormat
from backend.audit.types import AuditFilter, AuditPage
from backend.core.api_models import Moment
from backend.core.audit import Action, ObjectKind
from backend.core.moments import microseconds
from backend.core.person import Permission
from backend.web.permissions import caller_of
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(prefix="/audit", tags=["audit"], responses=refusals())
TheAudit = Annotated[Audit, provided("audit")]
MEDIA_TYPES: dict[ExportFormat, str] = {
    "csv": "text/csv; charset=utf-8",
    "jsonl": "application/jsonl",
}
FILES: Any = {200: {"content": {kind.split(";")[0]: {} for kind in MEDIA_TYPES.values()}}}


def sought_in(
    request: Request,
    who: Annotated[
        str | None, Query(max_length=128, description="Part of a name, of a person or a key.")
    ] = None,
    action: Action | None = None,
    object_kind: ObjectKind | None = None,
    unit_key: Annotated[str | None, Query(max_length=500)] = None,
    bike_id: Annotated[int | None, Query(ge=1, le=2**63 - 1)] = None,
    begin: Annotated[Moment | None, Query(alias="from")] = None,
    end: Annotated[Moment | None, Query(alias="to")] = None,
) -> AuditFilter:
    """Which events; what was done to accounts and keys only for who manages people."""
    caller = caller_of(request)
    return AuditFilter(
        who=who,
        action=action,
        object_kind=object_kind,
        unit_key=unit_key,
        bike_id=bike_id,
        from_us=microseconds(begin),
        to_us=microseconds(end),
        with_people=caller is None or Permission.MANAGE_PEOPLE in caller.permissions,
    )


Sought = Annotated[AuditFilter, Depends(sought_in)]


@router.get("", operation_id="list_audit")
def list_audit(
    audit: TheAudit,
    sought: Sought,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    cursor: Annotated[str | None, Query(max_length=200)] = None,
) -> AuditPage:
    """Newest first; `next` is the cursor of the following page, or null.

    What was done to accounts and keys is shown to who manages people alone.
    """
    return audit.page(sought, limit, cursor)


@router.get(
    "/export", operation_id="export_audit", response_class=StreamingResponse, responses=FILES
)
def export_audit(
    audit: TheAudit,
    sought: Sought,
    file_format: Annotated[ExportFormat, Query(alias="format")] = "csv",
) -> StreamingResponse:
    """All of them as a file, oldest first.

    In `jsonl` each line is an event as it was hashed: its `sha256` is that of the line's object
    without `sha256`, names sorted, no blanks, ASCII.
    """
    chunks: Iterator[bytes] = audit.export(sought, file_format)
    made = datetime.now(UTC).strftime("%Y-%m-%dT%H%MZ")
    name = f"spindle-audit-{made}.{file_format}"
    headers = {"content-disposition": f'attachment; filename="{name}"'}
    return StreamingResponse(chunks, media_type=MEDIA_TYPES[file_format], headers=headers)
