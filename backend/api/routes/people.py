"""Signing in and out, accounts and keys."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Path, Query, Request, Response

from backend.api import session_cookie
from backend.api.models import people as m
from backend.api.permissions import caller_of
from backend.api.problem import refusals, refusals_only
from backend.domain.people.person import ApiKey, Caller, Person
from backend.errors import Conflict, NotAllowed, NotSignedIn
from backend.services.people.manage import PersonChange
from backend.services.people.people import People
from backend.services.people.tickets import VALID_S

router = APIRouter(tags=["people"], responses=refusals())
Id = Annotated[int, Path(ge=1, le=2**31 - 1)]


def people_of(request: Request) -> People:
    """Raises Conflict `no_accounts` on a server that asks nobody."""
    people = known_people(request)
    if people is None:
        message = "This server asks nobody to sign in. SPINDLE_AUTH=required makes it."
        raise Conflict(message, "no_accounts")
    return people


def known_people(request: Request) -> People | None:
    """None on a server that asks nobody."""
    people: People | None = request.app.state.people
    return people


def asking(request: Request) -> Caller:
    """Who asks. Raises NotSignedIn."""
    caller = caller_of(request)
    if caller is None:
        raise NotSignedIn("Nobody is signed in.")
    return caller


Asked = Annotated[People, Depends(people_of)]
Asking = Annotated[Caller, Depends(asking)]


def in_browser(caller: Asking) -> Caller:
    """Who asks, by a session. Raises NotAllowed for a key: it must not take over its person."""
    if caller.session_id is None:
        raise NotAllowed("A key cannot do this: sign in.", "needs_session")
    return caller


InBrowser = Annotated[Caller, Depends(in_browser)]


@router.get("/session", operation_id="get_session", response_model=m.Session)
def get_session(request: Request) -> dict[str, Any]:
    """Whether people sign in here, and who asks."""
    caller = caller_of(request)
    people = known_people(request)
    return {
        "sign_in": people is not None,
        "needs_first": people is not None and not people.managed.has_admin(),
        "signed_in": None if caller is None else signed_in(caller),
    }


@router.post(
    "/sign-in",
    operation_id="sign_in",
    response_model=m.Person,
    responses=refusals(401, 409, 429),
)
def sign_in(body: m.SignInRequest, people: Asked, request: Request, response: Response) -> Any:
    """Begins a session: its token goes into a cookie that no script reads."""
    password = body.password.get_secret_value()
    return begun(people, body.name, password, request, response)


@router.post(
    "/first-person",
    operation_id="make_first_person",
    response_model=m.Person,
    status_code=201,
    responses=refusals(401, 403, 409, 429),
)
def make_first_person(
    body: m.FirstPerson, people: Asked, request: Request, response: Response
) -> Any:
    """The first administrator, by the link that the server printed; signs them in."""
    password = body.password.get_secret_value()
    person = people.managed.make_first(body.token.get_secret_value(), body.name, password)
    return begun(people, person.name, password, request, response)


@router.delete(
    "/session", operation_id="sign_out", status_code=204, responses=refusals(401, 403, 409)
)
def sign_out(
    people: Asked,
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
    body: m.OwnPassword, people: Asked, caller: InBrowser, request: Request, response: Response
) -> None:
    """Gives oneself another password; every other browser is signed out."""
    old, new = body.old.get_secret_value(), body.new.get_secret_value()
    token = people.sign_in.change_password(caller, old, new, address_of(request))
    session_cookie.put(request, response, token)


@router.post(
    "/tickets",
    operation_id="give_ticket",
    response_model=m.Ticket,
    status_code=201,
    responses=refusals_only(401, 403, 409),
)
def give_ticket(people: Asked, caller: Asking) -> dict[str, Any]:
    """Opens one WebSocket without a header: for programs. A browser's cookie does by itself."""
    return {"ticket": people.tickets.give(caller), "valid_s": VALID_S}


@router.get(
    "/people",
    operation_id="list_people",
    response_model=m.People,
    responses=refusals_only(401, 403, 409),
)
def list_people(people: Asked) -> dict[str, Any]:
    """Everybody with an account, by name."""
    return {"items": [person_answer(one) for one in people.managed.list()]}


@router.post(
    "/people",
    operation_id="add_person",
    response_model=m.Person,
    status_code=201,
    responses=refusals(401, 403, 409, 429),
)
def add_person(body: m.PersonIn, people: Asked) -> dict[str, Any]:
    """A new account."""
    password = body.password.get_secret_value()
    return person_answer(people.managed.add(body.name, body.role, password))


@router.patch(
    "/people/{person_id}",
    operation_id="change_person",
    response_model=m.Person,
    responses=refusals(401, 403, 404, 409, 429),
)
def change_person(person_id: Id, body: m.PersonChange, people: Asked) -> dict[str, Any]:
    """Another role or password, or disabled; with the last two every browser is signed out."""
    password = None if body.password is None else body.password.get_secret_value()
    change = PersonChange(body.role, body.enabled, password)
    return person_answer(people.managed.change(person_id, change))


@router.get(
    "/keys",
    operation_id="list_keys",
    response_model=m.ApiKeys,
    responses=refusals_only(401, 403, 409),
)
def list_keys(people: Asked) -> dict[str, Any]:
    """Every key, newest first, revoked ones too."""
    return {"items": [key_answer(one) for one in people.keys.list()]}


@router.post(
    "/keys",
    operation_id="add_key",
    response_model=m.NewApiKey,
    status_code=201,
    responses=refusals(401, 403, 404, 409),
)
def add_key(body: m.ApiKeyIn, people: Asked, caller: Asking) -> dict[str, Any]:
    """A new key. It is in this answer and nowhere else: only its hash is kept."""
    whose = caller.person.id if body.person_id is None else body.person_id
    key, secret = people.keys.add(whose, body.name, set(body.scopes), body.expires_at)
    return {"key": key_answer(key), "secret": secret}


@router.delete(
    "/keys/{key_id}",
    operation_id="revoke_key",
    status_code=204,
    responses=refusals(401, 403, 404, 409),
)
def revoke_key(key_id: Id, people: Asked) -> None:
    """Ends a key; it stays in the list."""
    people.keys.revoke(key_id)


def begun(
    people: People, name: str, password: str, request: Request, response: Response
) -> dict[str, Any]:
    """A new session, whatever the browser came with."""
    token, person = people.sign_in.sign_in(name, password, address_of(request))
    session_cookie.put(request, response, token)
    return person_answer(person)


def address_of(request: Request) -> str:
    """Where a request comes from."""
    return request.client.host if request.client else ""


def signed_in(caller: Caller) -> dict[str, Any]:
    """Who asks, and what they may."""
    return {
        "person": person_answer(caller.person),
        "permissions": sorted(caller.permissions),
    }


def person_answer(person: Person) -> dict[str, Any]:
    """An account as the API tells it."""
    return {
        "id": person.id,
        "name": person.name,
        "role": person.role,
        "enabled": person.enabled,
        "created_at": moment(person.created_us),
        "signed_in_at": moment(person.signed_in_us),
    }


def key_answer(key: ApiKey) -> dict[str, Any]:
    """A key as the API tells it."""
    return {
        "id": key.id,
        "person_id": key.person_id,
        "person_name": key.person_name,
        "name": key.name,
        "prefix": key.prefix,
        "scopes": sorted(key.scopes),
        "created_at": moment(key.created_us),
        "expires_at": moment(key.expires_us),
        "used_at": moment(key.used_us),
        "revoked_at": moment(key.revoked_us),
    }


def moment(at_us: int | None) -> datetime | None:
    """A moment as the API tells it."""
    return None if at_us is None else datetime.fromtimestamp(at_us / 1e6, UTC)
