"""A unit on the workbench: its checks, and the file for who helps from afar."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter

from backend.visits.types import SupportFile, UnitChecks
from backend.visits.workbench import Workbench
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["service"], responses=refusals(404, 503, 504))
TheWorkbench = Annotated[Workbench, provided("workbench")]


@router.get("/devices/{device_id}/checks", operation_id="check_unit")
def check_unit(device_id: str, workbench: TheWorkbench) -> UnitChecks:
    """What can be checked of a unit without touching it, done now: what was found, what is allowed,
    and whether it passed."""
    return workbench.check(device_id)


@router.get("/devices/{device_id}/support", operation_id="get_support_file")
def get_support_file(device_id: str, workbench: TheWorkbench) -> SupportFile:
    """What a unit says of itself, for who helps from afar; also of one that is away. No names, no
    addresses, no rides."""
    return workbench.support_file(device_id)
