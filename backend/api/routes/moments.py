"""Moments of a connected unit's ride: around a fault, and one that is marked now."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, status

from backend.services.rides.fault_moment import FaultMoment, FaultMoments
from backend.services.rides.mark import MarkMoment, RideMark
from backend.services.rides.since_change import SinceChange
from backend.tuning.models.config import SinceChange as SinceChangeView
from backend.units.precondition import FOR_ONE_UNIT
from backend.web.problem import DAMAGED, refusals
from backend.web.services import provided

router = APIRouter(responses=refusals(404, 409, 503, 504))


@router.get(
    "/devices/{device_id}/faults/{fault_name}/moment",
    operation_id="moment_of_fault",
    tags=["devices"],
    responses=DAMAGED,
)
def moment_of_fault(
    device_id: str,
    fault_name: Annotated[str, Path(max_length=80)],
    moments: Annotated[FaultMoments, provided("fault_moments")],
) -> FaultMoment:
    """The rider's and the motor's torque around a fault, from the ride it came on, else from the
    last minutes of the stream."""
    return moments(device_id, fault_name)


@router.post(
    "/devices/{device_id}/marks",
    operation_id="mark_moment",
    tags=["devices"],
    status_code=status.HTTP_201_CREATED,
    dependencies=FOR_ONE_UNIT,
    responses=refusals(412),
)
def mark_moment(device_id: str, mark: Annotated[MarkMoment, provided("mark")]) -> RideMark:
    """Marks the newest moment of the ride that is being recorded; it is among the ride's events."""
    return mark(device_id)


@router.get(
    "/devices/{device_id}/config/revisions/{seq}/since",
    operation_id="since_revision",
    tags=["configuration"],
    response_model=SinceChangeView,
    dependencies=FOR_ONE_UNIT,
    responses=refusals(403, 412),
)
def since_revision(
    device_id: str, seq: int, since_change: Annotated[SinceChange, provided("since_change")]
) -> Any:
    """The unit's rides since this configuration beside those before it."""
    return since_change(device_id, seq)
