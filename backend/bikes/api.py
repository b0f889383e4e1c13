"""Bikes, their owners, and the codes by which they change hands."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from backend.bikes.service import Bikes
from backend.bikes.types import (
    BikeChange,
    BikeDetail,
    BikeGift,
    BikeIn,
    Joined,
    NewRider,
    Offer,
    Pairing,
    PairingIn,
)
from backend.bikes.types import Bikes as BikeList
from backend.people.api import InBrowser, PeopleOf, begun
from backend.web.permissions import OwnerId, address_of
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["bikes"], responses=refusals())
BikeId = Annotated[int, Path(ge=1, le=2**63 - 1)]
Code = Annotated[str, Path(min_length=8, max_length=20)]
TheBikes = Annotated[Bikes, provided("bikes")]


@router.get("/bikes", operation_id="list_bikes")
def list_bikes(bikes: TheBikes, owner_id: OwnerId) -> BikeList:
    """Every bike by name, with unit, owner and rides; a rider's own."""
    return BikeList(bikes.list(owner_id))


@router.post("/bikes", operation_id="add_bike", status_code=201, responses=refusals(403, 409))
def add_bike(body: BikeIn, bikes: TheBikes) -> BikeDetail:
    """A bike without a unit: a unit that connects has one by itself."""
    return bikes.add(body)


@router.get("/bikes/{bike_id}", operation_id="get_bike", responses=refusals(404))
def get_bike(bike_id: BikeId, bikes: TheBikes, owner_id: OwnerId) -> BikeDetail:
    """One bike; for the workshop with everybody who had it."""
    return bikes.get(bike_id, owner_id)


@router.patch("/bikes/{bike_id}", operation_id="change_bike", responses=refusals(403, 404))
def change_bike(
    bike_id: BikeId, body: BikeChange, bikes: TheBikes, owner_id: OwnerId
) -> BikeDetail:
    """What a bike is, which unit is on it, or that it is lost; its owner says name and loss."""
    return bikes.change(bike_id, body, owner_id)


@router.delete(
    "/bikes/{bike_id}", operation_id="remove_bike", status_code=204, responses=refusals(404, 409)
)
def remove_bike(bike_id: BikeId, bikes: TheBikes) -> None:
    """Removes a bike without a history: 409 `bike_in_use` where it has one."""
    bikes.remove(bike_id)


@router.post(
    "/bikes/{bike_id}/rides",
    operation_id="give_rides",
    status_code=204,
    responses=refusals(404, 409),
)
def give_rides(bike_id: BikeId, body: BikeGift, bikes: TheBikes) -> None:
    """Rides were made with this bike. Those that are nobody's are of whom it was then."""
    bikes.give_rides(bike_id, body.ride_ids)


@router.post(
    "/bikes/{bike_id}/pairing",
    operation_id="pair_bike",
    status_code=201,
    responses=refusals(404, 409),
)
def pair_bike(bike_id: BikeId, body: PairingIn, bikes: TheBikes, request: Request) -> Pairing:
    """A code for a week: whoever takes it owns the bike from then on, and whose it was has the
    rides of before. A code that was made earlier is none any more."""
    return bikes.pair(bike_id, body.owned_from, str(request.base_url))


@router.delete(
    "/bikes/{bike_id}/owner", operation_id="leave_bike", status_code=204, responses=refusals(404)
)
def leave_bike(bike_id: BikeId, bikes: TheBikes) -> None:
    """The bike is nobody's from now on; rides stay whose they are."""
    bikes.leave(bike_id)


@router.get("/pairings/{code}", operation_id="get_pairing", responses=refusals(404, 429))
def get_pairing(code: Code, bikes: TheBikes, request: Request) -> Offer:
    """Which bike a code gives. Wrong codes have to wait longer and longer."""
    return bikes.offer(code, address_of(request))


@router.post(
    "/pairings/{code}", operation_id="take_pairing", responses=refusals(403, 404, 409, 429)
)
def take_pairing(code: Code, bikes: TheBikes, caller: InBrowser, request: Request) -> BikeDetail:
    """Makes the signed-in user the owner."""
    return bikes.take(code, caller.person, address_of(request))


@router.post(
    "/pairings/{code}/account",
    operation_id="join_by_pairing",
    status_code=201,
    responses=refusals(404, 409, 429),
)
def join_by_pairing(
    code: Code,
    body: NewRider,
    bikes: TheBikes,
    people: PeopleOf,
    request: Request,
    response: Response,
) -> Joined:
    """A rider's account, by the code of their bike; signs them in."""
    password = body.password.get_secret_value()
    person, bike_id = bikes.join(code, body.name, password, address_of(request))
    begun(people, person.name, password, request, response)
    return Joined(person, bike_id)
