"""What is said of bikes and their owners, and what is asked about them."""

from __future__ import annotations

from datetime import datetime

from pydantic import AwareDatetime, Field, SecretStr

from backend.core.api_models import RequestBody
from backend.core.described import described
from backend.core.person import Person
from backend.people.types import PASSWORD, NameIn

TEXT_MAX = 120
MILEAGE_KM_MAX = 1e6


@described
class BikeUnit:
    """The drive unit on a bike."""

    key: str
    model: str | None
    serial_number: str | None
    firmware_version: str | None
    last_seen_at: datetime


@described
class BikeOwner:
    """Whose a bike is or was."""

    person_id: int | None
    """Null once the account was removed."""
    name: str
    since: datetime
    until: datetime | None
    """Null while it is theirs."""


@described
class Bike:
    """A bike of the register. Null is what nobody said and no unit reported."""

    id: int
    name: str
    model: str | None
    frame_number: str | None
    battery: str | None
    mileage_km: float | None
    """As its counter showed it when somebody last read it."""
    mileage_at: datetime | None
    lost_at: datetime | None
    """Reported as lost or stolen."""
    created_at: datetime
    unit: BikeUnit | None
    market: str | None
    """By the unit's last configuration that is known here."""
    wheel_circumference_m: float | None
    owner: BikeOwner | None
    rides: int
    """That the caller may see."""
    distance_km: float | None
    last_ride_at: datetime | None


@described
class Bikes:
    items: tuple[Bike, ...]


@described
class BikeDetail:
    """A bike and, for the workshop, everybody who had it, the last first."""

    bike: Bike
    owners: tuple[BikeOwner, ...]


class BikeIn(RequestBody):
    """A bike without a unit."""

    name: str = Field(min_length=1, max_length=TEXT_MAX)
    model: str | None = Field(default=None, max_length=TEXT_MAX)
    frame_number: str | None = Field(default=None, max_length=TEXT_MAX)
    battery: str | None = Field(default=None, max_length=TEXT_MAX)
    mileage_km: float | None = Field(default=None, ge=0.0, le=MILEAGE_KM_MAX)


class BikeChange(RequestBody):
    """What is absent stays; null takes away what was said. An owner changes name and `lost`."""

    name: str | None = Field(default=None, min_length=1, max_length=TEXT_MAX)
    model: str | None = Field(default=None, max_length=TEXT_MAX)
    frame_number: str | None = Field(default=None, max_length=TEXT_MAX)
    battery: str | None = Field(default=None, max_length=TEXT_MAX)
    mileage_km: float | None = Field(default=None, ge=0.0, le=MILEAGE_KM_MAX)
    lost: bool | None = None
    unit_key: str | None = Field(
        default=None,
        max_length=500,
        description="The drive unit that is on it now; it leaves the bike it was on. Null: none.",
    )


class BikeGift(RequestBody):
    """Which rides were made with a bike."""

    ride_ids: list[int] = Field(min_length=1, max_length=500)


class PairingIn(RequestBody):
    owned_from: AwareDatetime | None = Field(
        default=None,
        description="Since when the bike is theirs: rides of it from then on become theirs, too. "
        "From the moment the code is taken if null.",
    )


@described
class Pairing:
    """The only answer that holds the code."""

    code: str
    """`XXXX-XXXX`: whoever enters it first owns the bike."""
    expires_at: datetime
    link: str
    """Where it is entered, by the address this server was reached at."""
    qr: str
    """The link as an image, a `data:` address of an SVG."""


@described
class Offer:
    """What a code gives."""

    bike_name: str
    model: str | None
    expires_at: datetime


class NewRider(RequestBody):
    """An account for who has none, made with the code."""

    name: str = NameIn
    password: SecretStr = PASSWORD


@described
class Joined:
    person: Person
    bike_id: int
