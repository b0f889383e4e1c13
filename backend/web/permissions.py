"""Whether who sends a request may have what it is for.

`app.OPERATIONS` says which permission each operation needs. An operation that is not in it is
refused, to everybody and on every server. Whoever has only their own gets from an operation of
`app.OWN` what is theirs, and no other operation on data.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Protocol

from fastapi import Depends
from fastapi.concurrency import run_in_threadpool
from fastapi.requests import HTTPConnection

from backend.core.person import ANYBODY, Caller, Permission, Sender
from backend.errors import NotAllowed, NotFound, NotSignedIn

SIGN_IN_FIRST = (
    "This server asks who you are: sign in at /sign-in, or send a key as `Authorization: Bearer "
    "sp_...` (the command takes it from SPINDLE_KEY or --key)."
)


class Anyone(StrEnum):
    """What needs no permission. STRANGER: not even an account. SIGNED_IN: any account or key."""

    STRANGER = "stranger"
    SIGNED_IN = "signed_in"


class Own(StrEnum):
    """How an operation keeps to what is the caller's own.

    ADDRESSED: what its address names has to be theirs. NARROWED: its route asks `OwnerId`,
    `SenderOf` or `WhoseFiles`.
    """

    ADDRESSED = "addressed"
    NARROWED = "narrowed"


class Ownership(Protocol):
    """Who knows what is whose."""

    def is_own(self, whose: Sender, kind: str, name: str) -> bool: ...


def operation_of(connection: HTTPConnection) -> str:
    """The name of what is asked for, as the table has it."""
    route = connection.scope["route"]
    return getattr(route, "operation_id", None) or str(route.name)


def caller_of(connection: HTTPConnection) -> Caller | None:
    """The caller, as authentication found; None where nobody is known."""
    caller: Caller | None = connection.scope.get("state", {}).get("caller")
    return caller


def address_of(connection: HTTPConnection) -> str:
    """Where a request comes from."""
    return connection.client.host if connection.client else ""


def owner_of(connection: HTTPConnection) -> int | None:
    """Whose bikes and rides alone an answer may be of; None for everybody's."""
    caller = caller_of(connection)
    return None if caller is None else caller.owner_id


def sender_of(connection: HTTPConnection) -> Sender:
    """As whose a file arrives that this request sends."""
    caller = caller_of(connection)
    return ANYBODY if caller is None else caller.sender


def whose_files(connection: HTTPConnection) -> Sender:
    """Whose files alone an answer may be of."""
    caller = caller_of(connection)
    return ANYBODY if caller is None else caller.whose_files


OwnerId = Annotated[int | None, Depends(owner_of)]
SenderOf = Annotated[Sender, Depends(sender_of)]
WhoseFiles = Annotated[Sender, Depends(whose_files)]


async def require_permission(connection: HTTPConnection) -> None:
    """A dependency of every route; it waits only for what is whose.

    Raises NotSignedIn and NotAllowed where accounts are required, NotAllowed everywhere for what
    the table does not have.
    """
    operation = operation_of(connection)
    needed = connection.app.state.needed.get(operation)
    if needed is None:
        raise NotAllowed(f"{operation} is in no role.", "not_in_the_table")
    if connection.app.state.authenticator is None or needed is Anyone.STRANGER:
        return
    caller = caller_of(connection)
    if caller is None:
        raise NotSignedIn(SIGN_IN_FIRST)
    if needed is not Anyone.SIGNED_IN and needed not in caller.permissions:
        raise NotAllowed(f"This needs the permission `{needed}`, which you do not have.")
    whose = caller.whose_files if needed is Permission.UPLOAD_FILES else Sender(caller.owner_id)
    if whose != ANYBODY and needed not in (Anyone.SIGNED_IN, Permission.COMPUTE):
        await require_own(connection, operation, whose)


async def require_own(connection: HTTPConnection, operation: str, whose: Sender) -> None:
    """Raises NotAllowed for an operation that is not for who has only their own; NotFound for what
    is not theirs, as if it were not there."""
    kept: Own | None = connection.app.state.own.get(operation)
    if kept is None:
        raise NotAllowed("This is for the workshop.")
    if kept is Own.NARROWED:
        return
    ownership: Ownership | None = connection.app.state.ownership
    # What is part of something, as a visit's photograph, goes by that.
    names = {kind: name for kind, name in connection.path_params.items() if kind.endswith("_id")}
    if not names:
        raise NotAllowed("This is for the workshop.")
    for kind, name in names.items():
        own = ownership is not None and await run_in_threadpool(ownership.is_own, whose, kind, name)
        if not own:
            raise NotFound(f"There is no {kind.removesuffix('_id')} {name}.")
