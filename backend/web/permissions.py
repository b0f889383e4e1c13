"""Whether who sends a request may have what it is for.

`app.OPERATIONS` says which permission each operation needs. An operation that is not in it is
refused, to everybody and on every server.
"""

from __future__ import annotations

from enum import StrEnum

from fastapi.requests import HTTPConnection

from backend.core.person import Caller
from backend.errors import NotAllowed, NotSignedIn

SIGN_IN_FIRST = (
    "This server asks who you are: sign in at /sign-in, or send a key as `Authorization: Bearer "
    "sp_...` (the command takes it from SPINDLE_KEY or --key)."
)


class Anyone(StrEnum):
    """What needs no permission. STRANGER: not even an account. SIGNED_IN: any account or key."""

    STRANGER = "stranger"
    SIGNED_IN = "signed_in"


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


async def require_permission(connection: HTTPConnection) -> None:
    """A dependency of every route; without waiting, so that no request takes a thread for it.

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
