"""People, their sessions, and the keys of their programs."""

from __future__ import annotations

from datetime import datetime

from pydantic import AwareDatetime, Field, SecretStr

from backend.api.models.base import Answer, Question
from backend.domain.people.password import LENGTH_MAX, LENGTH_MIN
from backend.domain.people.permission import Permission, RoleName
from backend.domain.people.person import NAME_MAX

NameIn = Field(min_length=1, max_length=NAME_MAX)
# What is too long for a hash must not become one; four times for what folds together.
PASSWORD = Field(
    max_length=4 * LENGTH_MAX,
    description=f"At least {LENGTH_MIN} characters, none of the commonest; no other rule.",
)


class Person(Answer):
    """An account."""

    id: int
    name: str
    role: RoleName
    enabled: bool
    created_at: datetime
    signed_in_at: datetime | None = Field(description="When last.")


class People(Answer):
    items: list[Person]


class SignedIn(Answer):
    """Who asks."""

    person: Person
    permissions: list[Permission]


class Session(Answer):
    """What a page needs to know before it shows anything."""

    sign_in: bool = Field(description="Whether this server asks people to sign in.")
    needs_first: bool = Field(description="No administrator yet: the server printed a link.")
    signed_in: SignedIn | None


class SignInRequest(Question):
    name: str = NameIn
    password: SecretStr = PASSWORD


class FirstPerson(SignInRequest):
    """The first administrator."""

    token: SecretStr = Field(max_length=100, description="Of the link the server printed.")


class PersonIn(SignInRequest):
    role: RoleName


class PersonChange(Question):
    """What is absent stays."""

    role: RoleName | None = None
    enabled: bool | None = None
    password: SecretStr | None = Field(default=None, max_length=4 * LENGTH_MAX)


class OwnPassword(Question):
    old: SecretStr = Field(max_length=4 * LENGTH_MAX)
    new: SecretStr = PASSWORD


class ApiKey(Answer):
    """A key, without its secret."""

    id: int
    person_id: int
    person_name: str
    name: str
    prefix: str = Field(description="Its beginning, which is no secret: `sp_` and this.")
    scopes: list[Permission]
    created_at: datetime
    expires_at: datetime | None
    used_at: datetime | None = Field(description="When last, to a minute.")
    revoked_at: datetime | None


class ApiKeys(Answer):
    items: list[ApiKey]


class ApiKeyIn(Question):
    name: str = NameIn
    scopes: list[Permission] = Field(
        min_length=1,
        max_length=len(Permission),
        description="What it is for; it never allows more than its person's role.",
    )
    person_id: int | None = Field(
        default=None, ge=1, le=2**31 - 1, description="Whose it is; of who asks if null."
    )
    expires_at: AwareDatetime | None = Field(default=None, description="Never if null.")


class NewApiKey(Answer):
    """The only answer that holds a key itself."""

    key: ApiKey
    secret: str = Field(description="What a program sends after `Authorization: Bearer`.")


class Ticket(Answer):
    ticket: str = Field(description="For `?ticket=` of one WebSocket, soon.")
    valid_s: float
