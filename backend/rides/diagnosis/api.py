"""The drift watch of a unit's torque sensor."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query

from backend.rides.diagnosis.models import SensorDrift
from backend.rides.diagnosis.sensor_drift import SensorDriftService
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(
    prefix="/devices/{device_id}", tags=["devices"], responses=refusals(404, 503, 504)
)
TheSensorDrift = Annotated[SensorDriftService, provided("sensor_drift")]


@router.get("/sensor-drift", operation_id="sensor_drift", response_model=SensorDrift)
def sensor_drift(
    device_id: str,
    drift: TheSensorDrift,
    rides: Annotated[
        int, Query(ge=0, le=5000, description="How many are listed; the trend is of all.")
    ] = 1000,
) -> Any:
    """The zero of every ride of this unit while coasting, its trend with temperature and age, and
    when it reaches the levels. Also of a unit that is away."""
    return drift(device_id, rides)
