"""A person with an account, a key that acts for one, and who is behind a request."""

from __future__ import annotations

from dataclasses import dataclass

from backend.domain.people.permission import ROLES, Permission, RoleName

NAME_MAX = 64


@dataclass(frozen=True)
class Person:
    """An account. name: unique whatever its case, and what changes are signed with.

    signed_in_us: when last, None if never.
    """

    id: int
    name: str
    role: RoleName
    enabled: bool
    created_us: int
    signed_in_us: int | None = None

    @property
    def permissions(self) -> frozenset[Permission]:
        """What the role allows."""
        return ROLES[self.role]


@dataclass(frozen=True)
class ApiKey:
    """A key of a person, for a program. prefix: the part that is no secret, by which it is found.

    scopes: what it is for; it never allows more than its person may. revoked_us: from then on it
    is refused, None while it counts.
    """

    id: int
    person_id: int
    person_name: str
    name: str
    prefix: str
    scopes: frozenset[Permission]
    created_us: int
    expires_us: int | None
    used_us: int | None
    revoked_us: int | None


@dataclass(frozen=True)
class Caller:
    """Who is behind a request. by_cookie: a browser sent the proof by itself, unasked."""

    person: Person
    permissions: frozenset[Permission]
    by_cookie: bool = False
    session_id: int | None = None


def folded(name: str) -> str:
    """A name as it is compared: case does not tell people apart."""
    return name.casefold()
