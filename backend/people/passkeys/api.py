"""Passkeys: the signed-in user's own, and signing in with one."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Path, Request, Response

from backend.core.person import Person
from backend.errors import Conflict
from backend.people.api import InBrowser, PeopleOf, relying_party_of
from backend.people.passkeys.relying_party import RelyingParty
from backend.people.passkeys.types import (
    NewPasskeyChallenge,
    OwnPasswordOnly,
    Passkey,
    PasskeyChallenge,
    PasskeyIn,
    PasskeyProof,
    Passkeys,
)
from backend.web import session_cookie
from backend.web.permissions import address_of
from backend.web.problem import refusals, refusals_only

router = APIRouter(tags=["people"], responses=refusals())
Id = Annotated[int, Path(ge=1, le=2**63 - 1)]


def party_of(request: Request) -> RelyingParty:
    """Raises Conflict `no_passkeys_here` at an address where no browser has any."""
    party = relying_party_of(request)
    if party is None:
        message = "Passkeys need https and a name: this address has not both."
        raise Conflict(message, "no_passkeys_here")
    return party


Party = Annotated[RelyingParty, Depends(party_of)]


@router.get(
    "/session/passkeys",
    operation_id="list_passkeys",
    responses=refusals_only(401, 403, 409),
)
def list_passkeys(people: PeopleOf, caller: InBrowser) -> Passkeys:
    """One's own, the oldest first, of every name of this server."""
    return Passkeys(people.passkeys.list(caller))


@router.post(
    "/session/passkeys/challenges",
    operation_id="begin_passkey",
    status_code=201,
    responses=refusals(401, 403, 409, 429),
)
def begin_passkey(
    body: OwnPasswordOnly, people: PeopleOf, caller: InBrowser, party: Party, request: Request
) -> NewPasskeyChallenge:
    """What `navigator.credentials.create` makes a passkey of, for this browser and five minutes."""
    password = body.password.get_secret_value()
    return people.passkeys.begin(caller, password, party, address_of(request))


@router.post(
    "/session/passkeys",
    operation_id="add_passkey",
    status_code=201,
    responses=refusals(401, 403, 409),
)
def add_passkey(body: PasskeyIn, people: PeopleOf, caller: InBrowser, party: Party) -> Passkey:
    """Takes what the authenticator made: from now on it signs in, at this name alone."""
    return people.passkeys.add(caller, body, party)


@router.delete(
    "/session/passkeys/{passkey_id}",
    operation_id="remove_passkey",
    status_code=204,
    responses=refusals(401, 403, 404, 409),
)
def remove_passkey(passkey_id: Id, people: PeopleOf, caller: InBrowser) -> None:
    """Ends one of one's own. Browsers that signed in with it stay signed in."""
    people.passkeys.remove(caller, passkey_id)


@router.post(
    "/sign-in/passkey/challenges",
    operation_id="begin_passkey_sign_in",
    status_code=201,
    responses=refusals_only(409),
)
def begin_passkey_sign_in(people: PeopleOf, party: Party) -> PasskeyChallenge:
    """What `navigator.credentials.get` signs, within five minutes."""
    return people.passkeys.begin_sign_in(party)


@router.post(
    "/sign-in/passkey",
    operation_id="sign_in_with_passkey",
    responses=refusals(401, 409, 429),
)
def sign_in_with_passkey(
    body: PasskeyProof, people: PeopleOf, party: Party, request: Request, response: Response
) -> Person:
    """Begins a session as a password does."""
    token, person = people.passkeys.sign_in(body, party, address_of(request))
    session_cookie.set_cookie(request, response, token)
    return person
