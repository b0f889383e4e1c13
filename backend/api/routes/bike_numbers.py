"""The bike's other numbers, measured in the hour of a calibration: computed, never kept."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from backend.api.models.bike_numbers import (
    Cadence,
    CadenceRequest,
    ClimbRequest,
    ClimbTold,
    PulsesRequest,
    PulsesTold,
    RollOut,
    SlopeRidden,
    Wheel,
    WheelByTrack,
)
from backend.api.models.calibration import GravityAt, GravityGiven
from backend.api.services import Provided
from backend.domain.calibration.bike.coast_down import Known
from backend.domain.calibration.bike.wheel import ROOT_3
from backend.domain.calibration.gravity import ANYWHERE_LIMIT_MS2, ANYWHERE_MS2, gravity_at
from backend.services.rides.bike.climb import Question, Slope
from backend.services.rides.bike.wheel import TrackQuestion
from backend.services.rides.insight.rows import Window
from backend.web.problem import DAMAGED, refusals

router = APIRouter(prefix="/calibration", tags=["calibration"])
UNIT = refusals(404, 503, 504)


@router.post("/wheel/roll-out", operation_id="roll_out_wheel", response_model=Wheel, responses=UNIT)
def roll_out_wheel(body: RollOut, services: Provided) -> Any:
    """The circumference from rolls on the ground, with its uncertainty, beside the unit's."""
    told = body.distances_m, body.turns, body.tape_limit_m
    return services.bike_numbers.wheel.rolled(*told, body.device_id)


@router.post(
    "/wheel/track",
    operation_id="track_wheel",
    response_model=Wheel,
    responses={**UNIT, **DAMAGED},
)
def track_wheel(body: WheelByTrack, services: Provided) -> Any:
    """The circumference from the positions of a ride against the turns of its wheel; refused by
    name where the rides cannot tell."""
    window = Window(body.ride_id, body.from_s, body.to_s)
    question = TrackQuestion(window, body.track_ride_id, body.told_circumference_m)
    return services.bike_numbers.wheel.tracked(question, body.device_id)


@router.post(
    "/wheel/pulses",
    operation_id="count_wheel_pulses",
    response_model=PulsesTold,
    responses={**refusals(404), **DAMAGED},
)
def count_wheel_pulses(body: PulsesRequest, services: Provided) -> Any:
    """The speed sensor's pulses in a turn of its wheel, from a ride of a wheel turned by hand."""
    window = Window(body.ride_id, body.from_s, body.to_s)
    return services.bike_numbers.pulses(window, body.turns)


@router.post(
    "/cadence",
    operation_id="check_cadence",
    response_model=Cadence,
    responses={**refusals(404), **DAMAGED},
)
def check_cadence(body: CadenceRequest, services: Provided) -> Any:
    """The cadence of a ride against the turns of its crank, counted by the crank's angle."""
    return services.bike_numbers.cadence(Window(body.ride_id, body.from_s, body.to_s))


@router.post(
    "/climb",
    operation_id="check_by_climb",
    response_model=ClimbTold,
    responses={**refusals(404), **DAMAGED},
)
def check_by_climb(body: ClimbRequest, services: Provided) -> Any:
    """The torque gain from the energy of a climb, which shares nothing with masses on a pedal;
    refused by name where the rides cannot tell."""
    told_pct = body.calibrated_expanded_pct
    return services.bike_numbers.climb(
        Question(
            slope(body.climb),
            [slope(one) for one in body.coast_downs],
            known(body),
            body.motor_off,
            None if told_pct is None else told_pct / 100,
        )
    )


def slope(asked: SlopeRidden) -> Slope:
    """A window with its rise."""
    return Slope(Window(asked.ride_id, asked.from_s, asked.to_s), asked.rise_m)


def known(body: ClimbRequest) -> Known:
    """What is known besides the rides."""
    names = Known.__dataclass_fields__.keys() - {"gravity_ms2", "gravity_limit_ms2"}
    told = {name: getattr(body, name) for name in names}
    gravity_ms2, gravity_limit_ms2 = gravity_of(body.gravity)
    return Known(gravity_ms2=gravity_ms2, gravity_limit_ms2=gravity_limit_ms2, **told)


def gravity_of(place: GravityAt | GravityGiven | None) -> tuple[float, float]:
    """What a kilogram weighs, and its half width."""
    if place is None:
        return ANYWHERE_MS2, ANYWHERE_LIMIT_MS2
    if isinstance(place, GravityGiven):
        return place.gravity_ms2, ROOT_3 * place.standard_ms2
    told = gravity_at(place.latitude_deg, place.height_m, place.height_standard_m)
    return told.gravity_ms2, ROOT_3 * told.standard_ms2
