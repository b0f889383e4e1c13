"""The checks of a unit."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter

from backend.visits.unit_checks import CheckUnit, UnitChecks
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["service"], responses=refusals(404, 503, 504))


@router.get("/devices/{device_id}/checks", operation_id="check_unit")
def check_unit(device_id: str, check: Annotated[CheckUnit, provided("check_unit")]) -> UnitChecks:
    """What can be checked of a unit without touching it, done now: what was found, what is allowed,
    and whether it passed."""
    return check(device_id)
