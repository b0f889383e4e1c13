"""Signing in and out, accounts and keys."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Path, Query, Request, Response

from backend.core.person import Caller, Person
from backend.errors import Conflict, NotFound, NotSignedIn
from backend.people.authority import (
    require_scopes_within,
    require_session,
    require_within,
    whose_keys,
)
from backend.people.passkeys.relying_party import RelyingParty, relying_party
from backend.people.service import PeopleService
from backend.people.tokens import VALID_S
from backend.people.types import (
    ApiKeyIn,
    ApiKeys,
    FirstPerson,
    NewApiKey,
    OwnPassword,
    People,
    PersonChange,
    PersonIn,
    Session,
    SignedIn,
    SignInRequest,
    Ticket,
)
from backend.web import session_cookie
from backend.web.permissions import address_of, caller_of
from backend.web.problem import refusals, refusals_only

router = APIRouter(tags=["people"], responses=refusals())
Id = Annotated[int, Path(ge=1, le=2**31 - 1)]


def people_of(request: Request) -> PeopleService:
    """Raises Conflict `no_accounts` on a server that asks nobody."""
    people = people_or_none(request)
    if people is None:
        message = "This server asks nobody to sign in. SPINDLE_AUTH=required makes it."
        raise Conflict(message, "no_accounts")
    return people


def people_or_none(request: Request) -> PeopleService | None:
    """None on a server that asks nobody."""
    people: PeopleService | None = request.app.state.authenticator
    return people


def asking(request: Request) -> Caller:
    """The signed-in user. Raises NotSignedIn."""
    caller = caller_of(request)
    if caller is None:
        raise NotSignedIn("Nobody is signed in.")
    return caller


def relying_party_of(request: Request) -> RelyingParty | None:
    """As whom an authenticator knows this server, as it is called; None where it cannot."""
    encrypted = session_cookie.is_encrypted(request)
    return relying_party(request.headers.get("host", ""), encrypted)


PeopleOf = Annotated[PeopleService, Depends(people_of)]
Asking = Annotated[Caller, Depends(asking)]


def in_browser(caller: Asking) -> Caller:
    """The signed-in user, by a session. Raises NotAllowed for a key."""
    require_session(caller)
    return caller


InBrowser = Annotated[Caller, Depends(in_browser)]


@router.get(
    "/session",
    operation_id="get_session",
)
def get_session(request: Request) -> Session:
    """Whether people sign in here, and who asks."""
    caller = caller_of(request)
    people = people_or_none(request)
    return Session(
        sign_in=people is not None,
        needs_first=people is not None and not people.accounts.has_admin(),
        signed_in=None if caller is None else SignedIn(caller.person, sorted(caller.permissions)),
        passkeys=people is not None and relying_party_of(request) is not None,
    )


@router.post(
    "/sign-in",
    operation_id="sign_in",
    responses=refusals(401, 409, 429),
)
def sign_in(body: SignInRequest, people: PeopleOf, request: Request, response: Response) -> Person:
    """Begins a session: its token goes into a cookie that no script reads."""
    password = body.password.get_secret_value()
    return begun(people, body.name, password, request, response)


@router.post(
    "/first-person",
    operation_id="make_first_person",
    status_code=201,
    responses=refusals(401, 403, 409, 429),
)
def make_first_person(
    body: FirstPerson, people: PeopleOf, request: Request, response: Response
) -> Person:
    """The first administrator, by the link that the server printed; signs them in."""
    password = body.password.get_secret_value()
    person = people.accounts.make_first(body.token.get_secret_value(), body.name, password)
    return begun(people, person.name, password, request, response)


@router.delete(
    "/session", operation_id="sign_out", status_code=204, responses=refusals(401, 403, 409)
)
def sign_out(
    people: PeopleOf,
    caller: InBrowser,
    request: Request,
    response: Response,
    everywhere: Annotated[bool, Query(description="All of this person's browsers.")] = False,
) -> None:
    """Ends this session."""
    people.sign_in.sign_out(caller, everywhere)
    session_cookie.take_away(request, response)


@router.put(
    "/session/password",
    operation_id="change_own_password",
    status_code=204,
    responses=refusals(401, 403, 409, 429),
)
def change_own_password(
    body: OwnPassword, people: PeopleOf, caller: InBrowser, request: Request, response: Response
) -> None:
    """Gives oneself another password; every other browser is signed out."""
    old, new = body.old.get_secret_value(), body.new.get_secret_value()
    token = people.sign_in.change_password(caller, old, new, address_of(request))
    session_cookie.set_cookie(request, response, token)


@router.post(
    "/tickets",
    operation_id="give_ticket",
    status_code=201,
    responses=refusals_only(401, 403, 409),
)
def give_ticket(people: PeopleOf, caller: Asking) -> Ticket:
    """Opens one WebSocket without a header: for programs. A browser's cookie does by itself."""
    return Ticket(people.tickets.give(caller), VALID_S)


@router.get(
    "/people",
    operation_id="list_people",
    responses=refusals_only(401, 403, 409),
)
def list_people(people: PeopleOf) -> People:
    """Everybody with an account, by name."""
    return People(people.accounts.list())


@router.post(
    "/people",
    operation_id="add_person",
    status_code=201,
    responses=refusals(401, 403, 409, 429),
)
def add_person(body: PersonIn, people: PeopleOf, caller: InBrowser) -> Person:
    """A new account."""
    require_within(caller, body.role)
    password = body.password.get_secret_value()
    return people.accounts.add(body.name, body.role, password)


@router.patch(
    "/people/{person_id}",
    operation_id="change_person",
    responses=refusals(401, 403, 404, 409, 429),
)
def change_person(person_id: Id, body: PersonChange, people: PeopleOf, caller: Asking) -> Person:
    """Another name, role or password, or disabled; with the last two every browser is signed out,
    with another password the passkeys are removed.

    What was done under the name before keeps that name.
    """
    if body.password is not None:
        require_session(caller)
    before = people.accounts.get(person_id)
    require_within(caller, before.role, body.role or before.role)
    return people.accounts.change(person_id, body)


@router.delete(
    "/people/{person_id}",
    operation_id="remove_person",
    status_code=204,
    responses=refusals(401, 403, 404, 409),
)
def remove_person(person_id: Id, people: PeopleOf, caller: InBrowser) -> None:
    """Removes an account with its sessions, passkeys and keys. What it did stays under its name."""
    require_within(caller, people.accounts.get(person_id).role)
    people.accounts.remove(person_id)


@router.get(
    "/keys",
    operation_id="list_keys",
    responses=refusals_only(401, 403, 409),
)
def list_keys(people: PeopleOf, caller: Asking) -> ApiKeys:
    """Every key, newest first, revoked ones too; one's own where others' are not one's affair."""
    return ApiKeys(people.keys.list(whose_keys(caller)))


@router.post(
    "/keys",
    operation_id="add_key",
    status_code=201,
    responses=refusals(401, 403, 404, 409),
)
def add_key(body: ApiKeyIn, people: PeopleOf, caller: Asking) -> NewApiKey:
    """A new key. It is in this answer and nowhere else: only its hash is kept.

    For oneself; for others by who manages people. Nobody gives more than they have. With `bike_id`
    it can only send files, of that bike: a rider's own.
    """
    require_session(caller)
    require_scopes_within(caller, body.scopes)
    whose = caller.person.id if body.person_id is None else body.person_id
    if whose_keys(caller) not in (None, whose):
        raise NotFound(f"There is no account {whose}.")
    key, secret = people.keys.add(whose, body.name, set(body.scopes), body.expires_at, body.bike_id)
    return NewApiKey(key, secret)


@router.delete(
    "/keys/{key_id}",
    operation_id="revoke_key",
    status_code=204,
    responses=refusals(401, 403, 404, 409),
)
def revoke_key(key_id: Id, people: PeopleOf, caller: Asking) -> None:
    """Ends a key, one's own or, by who manages people, anybody's; it stays in the list."""
    people.keys.revoke(key_id, whose_keys(caller))


def begun(
    people: PeopleService, name: str, password: str, request: Request, response: Response
) -> Person:
    """A new session, whatever the browser came with."""
    token, person = people.sign_in.sign_in(name, password, address_of(request))
    session_cookie.set_cookie(request, response, token)
    return person
