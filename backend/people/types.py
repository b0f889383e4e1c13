"""What is said of people and keys, and what is asked about them."""

from __future__ import annotations

from datetime import datetime

from pydantic import AwareDatetime, Field, SecretStr

from backend.core.api_models import RequestBody
from backend.core.described import described
from backend.core.person import Permission, Person, RoleName

NAME_MAX = 64
PASSWORD_LENGTH_MIN = 8
# Far beyond any phrase; protects the hash from a megabyte.
PASSWORD_LENGTH_MAX = 256

NameIn = Field(min_length=1, max_length=NAME_MAX)
# What is too long for a hash must not become one; four times for what folds together.
PASSWORD = Field(
    max_length=4 * PASSWORD_LENGTH_MAX,
    description=f"At least {PASSWORD_LENGTH_MIN} characters, none of the commonest; no other rule.",
)


@described
class People:
    items: tuple[Person, ...]


@described
class SignedIn:
    """The signed-in user."""

    person: Person
    permissions: list[Permission]


@described
class Session:
    """What a page needs to know before it shows anything."""

    sign_in: bool
    """Whether this server asks people to sign in."""
    needs_first: bool
    """No administrator yet: the server printed a link."""
    signed_in: SignedIn | None
    passkeys: bool
    """Whether people can sign in with a passkey at this address: it has https and a name."""


class SignInRequest(RequestBody):
    name: str = NameIn
    password: SecretStr = PASSWORD


class FirstPerson(SignInRequest):
    """The first administrator."""

    token: SecretStr = Field(max_length=100, description="Of the link the server printed.")


class PersonIn(SignInRequest):
    role: RoleName


class PersonChange(RequestBody):
    """What is absent stays."""

    name: str | None = Field(default=None, min_length=1, max_length=NAME_MAX)
    role: RoleName | None = None
    enabled: bool | None = None
    password: SecretStr | None = Field(default=None, max_length=4 * PASSWORD_LENGTH_MAX)


class OwnPassword(RequestBody):
    old: SecretStr = Field(max_length=4 * PASSWORD_LENGTH_MAX)
    new: SecretStr = PASSWORD


@described
class ApiKey:
    """A key, without its secret."""

    id: int
    person_id: int
    person_name: str
    name: str
    prefix: str
    """Its beginning, which is no secret: `sp_` and this."""
    scopes: tuple[Permission, ...]
    created_at: datetime
    expires_at: datetime | None
    used_at: datetime | None
    """When last, to a minute."""
    revoked_at: datetime | None
    bike_id: int | None
    """The one bike it is for; null for all."""
    bike_name: str | None


@described
class ApiKeys:
    items: tuple[ApiKey, ...]


class ApiKeyIn(RequestBody):
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
    bike_id: int | None = Field(
        default=None,
        ge=1,
        le=2**63 - 1,
        description="The one bike it sends files of, with `upload_files` as its only scope.",
    )


@described
class NewApiKey:
    """The only answer that holds a key itself."""

    key: ApiKey
    secret: str
    """What a program sends after `Authorization: Bearer`."""


@described
class Ticket:
    ticket: str
    """For `?ticket=` of one WebSocket, soon."""
    valid_s: float
