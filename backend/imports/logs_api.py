"""Rides in a unit's own flash: list them, fetch one, see how far it is."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response, status

from backend.imports.models import LogDownload, UnitLogs
from backend.imports.unit_logs import Collect, ErasedLog
from backend.units.precondition import FOR_ONE_UNIT
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(
    tags=["devices"], dependencies=FOR_ONE_UNIT, responses=refusals(404, 409, 412, 503, 504)
)
TheCollect = Annotated[Collect, provided("collect")]

LogId = Annotated[int, Path(ge=1, lt=2**32)]
DOWNLOAD = "/devices/{device_id}/logs/{log_id}/download"


@router.get("/devices/{device_id}/logs", operation_id="list_logs", response_model=UnitLogs)
def list_logs(device_id: str, collect: TheCollect) -> Any:
    """Rides the unit has recorded by itself; 409 for a unit that keeps none."""
    return collect.logs(device_id)


@router.delete(
    "/devices/{device_id}/logs/{log_id}", operation_id="erase_log", response_model=ErasedLog
)
def erase_log(device_id: str, log_id: LogId, collect: TheCollect) -> Any:
    """Frees a log in the unit's flash; 409 unless it was fetched and the unit knows that."""
    return collect.erase(device_id, log_id)


@router.post(
    DOWNLOAD,
    operation_id="start_log_download",
    response_model=LogDownload,
    status_code=status.HTTP_202_ACCEPTED,
)
def start_log_download(
    device_id: str, log_id: LogId, collect: TheCollect, response: Response
) -> Any:
    """Fetches a log in the background and makes it a ride; goes on where an earlier try ended."""
    download = collect.start(device_id, log_id)
    response.headers["location"] = f"/api/v1/devices/{device_id}/logs/{log_id}/download"
    return download


@router.get(DOWNLOAD, operation_id="get_log_download", response_model=LogDownload)
def get_log_download(device_id: str, log_id: LogId, collect: TheCollect) -> Any:
    """How far a download is, and what became of it."""
    return collect.get(device_id, log_id)
