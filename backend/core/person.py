"""A person with an account, what a role permits, and who is behind a request.

What a rider may is of their own bikes and rides; of others' a rider sees nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import Literal
from unicodedata import normalize

from backend.core.described import described

RoleName = Literal["rider", "dealer", "engineer", "admin"]


class Permission(StrEnum):
    """One thing that may be allowed."""

    COMPUTE = "compute"
    """Ask the law about values that come with the request."""
    SEE_BIKES = "see_bikes"
    """Units, their live values, configurations, faults and calibrations."""
    CHANGE_BIKES = "change_bikes"
    """Connect units, write what they are set to, try values, clear faults."""
    CALIBRATE = "calibrate"
    """Calibrate sensors and write what was found."""
    SEE_REGISTER = "see_register"
    """The bikes, whose they are, and what was done to them."""
    CHANGE_REGISTER = "change_register"
    """Add and describe bikes, and hand them over."""
    SEE_RIDES = "see_rides"
    """Rides, where they went, and the files they came from."""
    CHANGE_RIDES = "change_rides"
    """Name, tag and delete rides and files."""
    UPLOAD_FILES = "upload_files"
    """Send files that become rides, and see what became of them."""
    SEE_LIBRARY = "see_library"
    """Items of the library."""
    CHANGE_LIBRARY = "change_library"
    """Add, change and delete them."""
    SIMULATE = "simulate"
    """Control the surroundings of a simulated unit."""
    SEE_SERVER = "see_server"
    """How the server is: health, numbers, ports, where it keeps things."""
    BACK_UP = "back_up"
    """Take everything away as one file, accounts too."""
    SEE_AUDIT = "see_audit"
    """Who changed what, and when."""
    MANAGE_PEOPLE = "manage_people"
    """Accounts and keys of everybody."""


P = Permission
RIDER = frozenset(
    {P.COMPUTE, P.SEE_REGISTER, P.CHANGE_REGISTER, P.SEE_RIDES, P.CHANGE_RIDES, P.UPLOAD_FILES}
)
DEALER = RIDER | {
    P.SEE_BIKES,
    P.CHANGE_BIKES,
    P.CALIBRATE,
    P.SEE_LIBRARY,
    P.CHANGE_LIBRARY,
    P.SEE_SERVER,
    P.SEE_AUDIT,
}
ENGINEER = DEALER | {P.SIMULATE}
ADMIN = ENGINEER | {P.BACK_UP, P.MANAGE_PEOPLE}

ROLES: dict[RoleName, frozenset[Permission]] = {
    "rider": RIDER,
    "dealer": DEALER,
    "engineer": ENGINEER,
    "admin": ADMIN,
}


@described
class Person:
    """An account."""

    id: int
    name: str
    """Unique whatever its case, and what changes are signed with."""
    role: RoleName
    enabled: bool
    created_at: datetime
    signed_in_at: datetime | None = None
    """When last."""

    @property
    def permissions(self) -> frozenset[Permission]:
        """What the role allows."""
        return ROLES[self.role]


@dataclass(frozen=True)
class Sender:
    """Who sends a file. owner_id: the rider, whose rides it makes; None for others, who send
    anybody's. key_id: the key it is sent with. bike_id: the one bike which that key is for."""

    owner_id: int | None = None
    key_id: int | None = None
    bike_id: int | None = None


ANYBODY = Sender()


@dataclass(frozen=True)
class Caller:
    """Who is behind a request, by a session or a key. by_cookie: a browser sent the proof by
    itself, unasked. bike_id: the one bike a key is for."""

    person: Person
    permissions: frozenset[Permission]
    by_cookie: bool = False
    session_id: int | None = None
    key_id: int | None = None
    bike_id: int | None = None
    key_name: str | None = None

    @property
    def owner_id(self) -> int | None:
        """Whose bikes and rides alone are the caller's affair; None for everybody's."""
        return self.person.id if self.person.role == "rider" else None

    @property
    def sender(self) -> Sender:
        """As whose a file arrives that the caller sends."""
        return Sender(self.owner_id, self.key_id, self.bike_id)

    @property
    def whose_files(self) -> Sender:
        """Whose files alone are the caller's affair: of a key that sees no rides what it sent."""
        by_key = None if Permission.SEE_RIDES in self.permissions else self.key_id
        return Sender(self.owner_id, by_key)


def folded(name: str) -> str:
    """A name as it is compared: neither case nor width tells people apart (Unicode's NFKC)."""
    return normalize("NFKC", normalize("NFKC", name).casefold())
