"""What somebody may give others: never more than they have, and by a key no way in at all.

A key's scopes are what a program needs. One that may manage people and could set a password, make
an account or another key would be a key to everything.
"""

from __future__ import annotations

from collections.abc import Iterable

from backend.core.person import ROLES, Caller, Permission, RoleName
from backend.errors import NotAllowed


def require_session(caller: Caller) -> None:
    """Raises NotAllowed `needs_session` for a key: what is asked gives somebody a way in."""
    if caller.session_id is None:
        raise NotAllowed("A key cannot do this: sign in.", "needs_session")


def require_within(caller: Caller, *roles: RoleName) -> None:
    """Raises NotAllowed `more_than_yours` where a role has what the caller has not."""
    for role in roles:
        require_scopes_within(caller, ROLES[role])


def require_scopes_within(caller: Caller, permissions: Iterable[Permission]) -> None:
    """As `require_within`, of permissions."""
    if more := sorted(set(permissions) - caller.permissions):
        message = f"This needs what you do not have yourself: {', '.join(more)}."
        raise NotAllowed(message, "more_than_yours")


def whose_keys(caller: Caller) -> int | None:
    """Whose keys a caller sees, makes and revokes: everybody's (None), or their own.

    Raises NotAllowed for a key that does not manage people: it knows of no other.
    """
    if Permission.MANAGE_PEOPLE in caller.permissions:
        return None
    require_session(caller)
    return caller.person.id
