"""Moments of a connected unit's ride: around a fault, and one that is marked now."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, status

from backend.rides.recording.fault_moment import FaultMoment, FaultMoments
from backend.rides.recording.marks import MarkMoment, RideMark
from backend.units.precondition import FOR_ONE_UNIT
from backend.web.problem import DAMAGED, refusals
from backend.web.services import provided

router = APIRouter(tags=["devices"], responses=refusals(404, 409, 503, 504))


@router.get(
    "/devices/{device_id}/faults/{fault_name}/moment",
    operation_id="moment_of_fault",
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
    status_code=status.HTTP_201_CREATED,
    dependencies=FOR_ONE_UNIT,
    responses=refusals(412),
)
def mark_moment(device_id: str, mark: Annotated[MarkMoment, provided("mark")]) -> RideMark:
    """Marks the newest moment of the ride that is being recorded; it is among the ride's events."""
    return mark(device_id)
