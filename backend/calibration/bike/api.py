"""The bike's other numbers, measured in the hour of a calibration: computed, never kept."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter

from backend.calibration.bike.climb_check import Question, Slope
from backend.calibration.bike.coast_down import ClimbInputs
from backend.calibration.bike.service import BikeNumbers
from backend.calibration.bike.types import (
    Cadence,
    CadenceRequest,
    ClimbRequest,
    ClimbResult,
    PulseComparison,
    PulsesRequest,
    RollOut,
    SlopeRidden,
    Wheel,
    WheelByTrack,
)
from backend.calibration.bike.wheel import ROOT_3
from backend.calibration.bike.wheel_measure import TrackQuestion
from backend.calibration.setup import ANYWHERE_LIMIT_MS2, ANYWHERE_MS2, gravity_at
from backend.calibration.types import GravityAt, GravityInput
from backend.rides.rows import Window
from backend.web.problem import DAMAGED, refusals
from backend.web.services import provided

router = APIRouter(prefix="/calibration", tags=["calibration"])
UNIT = refusals(404, 503, 504)
Provided = Annotated[BikeNumbers, provided("bike_numbers")]


@router.post("/wheel/roll-out", operation_id="roll_out_wheel", responses=UNIT)
def roll_out_wheel(body: RollOut, bike_numbers: Provided) -> Wheel:
    """The circumference from rolls on the ground, with its uncertainty, beside the unit's."""
    marks = body.distances_m, body.turns, body.tape_limit_m
    return bike_numbers.wheel.rolled(*marks, body.device_id)


@router.post(
    "/wheel/track",
    operation_id="track_wheel",
    responses={**UNIT, **DAMAGED},
)
def track_wheel(body: WheelByTrack, bike_numbers: Provided) -> Wheel:
    """The circumference from the positions of a ride against the turns of its wheel; refused by
    name where the rides cannot tell."""
    window = Window(body.ride_id, body.from_s, body.to_s)
    question = TrackQuestion(window, body.track_ride_id, body.device_circumference_m)
    return bike_numbers.wheel.tracked(question, body.device_id)


@router.post(
    "/wheel/pulses",
    operation_id="count_wheel_pulses",
    responses={**refusals(404), **DAMAGED},
)
def count_wheel_pulses(body: PulsesRequest, bike_numbers: Provided) -> PulseComparison:
    """The speed sensor's pulses in a turn of its wheel, from a ride of a wheel turned by hand."""
    window = Window(body.ride_id, body.from_s, body.to_s)
    return bike_numbers.pulses(window, body.turns)


@router.post(
    "/cadence",
    operation_id="check_cadence",
    responses={**refusals(404), **DAMAGED},
)
def check_cadence(body: CadenceRequest, bike_numbers: Provided) -> Cadence:
    """The cadence of a ride against the turns of its crank, counted by the crank's angle."""
    return bike_numbers.cadence(Window(body.ride_id, body.from_s, body.to_s))


@router.post(
    "/climb",
    operation_id="check_by_climb",
    responses={**refusals(404), **DAMAGED},
)
def check_by_climb(body: ClimbRequest, bike_numbers: Provided) -> ClimbResult:
    """The torque gain from the energy of a climb, which shares nothing with masses on a pedal;
    refused by name where the rides cannot tell."""
    calibrated_pct = body.calibrated_expanded_pct
    return bike_numbers.climb(
        Question(
            slope(body.climb),
            [slope(one) for one in body.coast_downs],
            climb_inputs(body),
            body.motor_off,
            None if calibrated_pct is None else calibrated_pct / 100,
        )
    )


def slope(requested: SlopeRidden) -> Slope:
    """A window with its rise."""
    return Slope(Window(requested.ride_id, requested.from_s, requested.to_s), requested.rise_m)


def climb_inputs(body: ClimbRequest) -> ClimbInputs:
    """What is known besides the rides."""
    names = ClimbInputs.__dataclass_fields__.keys() - {"gravity_ms2", "gravity_limit_ms2"}
    values = {name: getattr(body, name) for name in names}
    gravity_ms2, gravity_limit_ms2 = gravity_of(body.gravity)
    return ClimbInputs(gravity_ms2=gravity_ms2, gravity_limit_ms2=gravity_limit_ms2, **values)


def gravity_of(place: GravityAt | GravityInput | None) -> tuple[float, float]:
    """What a kilogram weighs, and its half width."""
    if place is None:
        return ANYWHERE_MS2, ANYWHERE_LIMIT_MS2
    if isinstance(place, GravityInput):
        return place.gravity_ms2, ROOT_3 * place.standard_ms2
    gravity = gravity_at(place.latitude_deg, place.height_m, place.height_standard_m)
    return gravity.gravity_ms2, ROOT_3 * gravity.standard_ms2
