"""What a ride tells: energy, effort, pedalling, diagnosis; and its report."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from fastapi.responses import StreamingResponse

from backend.rides.insight.models import RideDiagnosis, RideEffort, RideEnergy, RidePedalling
from backend.rides.query import RideId, as_file
from backend.rides.questions import Insight
from backend.web.problem import DAMAGED, refusals
from backend.web.services import provided

router = APIRouter(prefix="/rides", tags=["rides"], responses=refusals(404))
TheInsight = Annotated[Insight, provided("insight")]

ThresholdPower = Annotated[
    float | None, Query(ge=20.0, le=1000.0, description="What the rider can hold for an hour.")
]
HeartRateMax = Annotated[float | None, Query(ge=80.0, le=250.0, description="The rider's.")]


@router.get(
    "/{ride_id}/energy",
    operation_id="energy_of_ride",
    response_model=RideEnergy,
    responses=DAMAGED,
)
def energy_of_ride(ride_id: RideId, insight: TheInsight) -> Any:
    """Rider, motor and battery apart: of the whole ride, by mode and by gradient; charge and
    range."""
    return insight.energy(ride_id)


@router.get(
    "/{ride_id}/effort",
    operation_id="effort_of_ride",
    response_model=RideEffort,
    responses=DAMAGED,
)
def effort_of_ride(
    ride_id: RideId,
    insight: TheInsight,
    threshold_power_w: ThresholdPower = None,
    heart_rate_bpm_max: HeartRateMax = None,
) -> Any:
    """Time in zones and bands, and best mean powers. Without a threshold there are no zones."""
    return insight.effort(ride_id, threshold_power_w, heart_rate_bpm_max)


@router.get(
    "/{ride_id}/pedalling",
    operation_id="pedalling_of_ride",
    response_model=RidePedalling,
    responses=DAMAGED,
)
def pedalling_of_ride(ride_id: RideId, insight: TheInsight) -> Any:
    """Torque over the crank's angle with leg, dead spot and lag; time over speed and gain."""
    return insight.pedalling(ride_id)


@router.get(
    "/{ride_id}/diagnosis",
    operation_id="diagnosis_of_ride",
    response_model=RideDiagnosis,
    responses=DAMAGED,
)
def diagnosis_of_ride(ride_id: RideId, insight: TheInsight) -> Any:
    """What the ride shows of the bike's health, with the evidence; and what it cannot show."""
    return insight.diagnosis(ride_id)


@router.get(
    "/{ride_id}/report",
    operation_id="report_of_ride",
    response_class=StreamingResponse,
    responses={**DAMAGED, 200: {"content": {"text/html": {}}}},
)
def report_of_ride(
    ride_id: RideId,
    insight: TheInsight,
    language: Literal["en", "zh"] = "en",
    threshold_power_w: ThresholdPower = None,
    heart_rate_bpm_max: HeartRateMax = None,
) -> StreamingResponse:
    """The ride as one HTML file that needs nothing else: figures, track, traces, energy, zones,
    torque round the crank, health. It tells where the ride went, to its ends."""
    return as_file(insight.report(ride_id, language, threshold_power_w, heart_rate_bpm_max))
