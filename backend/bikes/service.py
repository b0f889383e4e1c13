"""The use cases of the register; safe to call from any thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any, TypeVar

from backend.bikes.codes import new_code, plain_code
from backend.bikes.records import BikeStore, PairingStore, taker
from backend.bikes.types import Bike, BikeChange, BikeDetail, BikeIn, Offer, Pairing
from backend.core.moments import utc
from backend.core.person import Person, Sender
from backend.core.qr import qr_of
from backend.errors import FieldError, InvalidRequest, NotAllowed, NotFound
from backend.people.service import PeopleService
from backend.people.throttle import Throttle, begin
from backend.people.tokens import token_sha256
from backend.store.wall_clock import now_us

Found = TypeVar("Found")
VALID_US = 7 * 86_400 * 1_000_000
# A counter's people type from one address; the rest guess.
FREE_TRIES = 20
OF_AN_OWNER = frozenset({"name", "lost"})
NO_CODE = "No bike is waiting under this code: it was used, is over a week old, or is mistyped."


class Bikes:
    """Bikes, whose they are, and how they change hands.

    people: None on a server without accounts, where nothing is anybody's. moved: called when a unit
    is put on another bike. now_s: a clock that only goes forward.
    """

    def __init__(
        self,
        bikes: BikeStore,
        pairings: PairingStore,
        people: PeopleService | None,
        moved: Callable[[], None] = lambda: None,
        now_s: Callable[[], float] = time.monotonic,
    ) -> None:
        self._bikes = bikes
        self._pairings = pairings
        self._people = people
        self._moved = moved
        self._now_s = now_s
        self._turn = threading.Lock()
        self._tries = Throttle(FREE_TRIES)

    def list(self, owner_id: int | None = None) -> tuple[Bike, ...]:
        """Every bike, or this account's, by name. Raises StoreError."""
        return self._bikes.list(owner_id)

    def get(self, bike_id: int, owner_id: int | None = None) -> BikeDetail:
        """One bike; for its owner without those who had it before. Raises NotFound, StoreError."""
        return self._bikes.get(bike_id, owner_id)

    def add(self, bike: BikeIn) -> BikeDetail:
        """A bike without a unit. Raises InvalidRequest, Conflict, StoreError."""
        return self._bikes.get(self._bikes.add(as_row(bike.model_dump())))

    def change(self, bike_id: int, change: BikeChange, owner_id: int | None = None) -> BikeDetail:
        """Describe a bike otherwise. owner_id: its owner, who changes less than the workshop.

        Raises NotFound, NotAllowed, InvalidRequest, StoreError.
        """
        values = change.model_dump(exclude_unset=True)
        if owner_id is not None and (more := sorted(values.keys() - OF_AN_OWNER)):
            raise NotAllowed(f"The workshop says what a bike is: {', '.join(more)}.")
        unit = [values.pop("unit_key")] if "unit_key" in values else []
        self._bikes.change(bike_id, as_row(values), unit)
        if unit:
            self._moved()
        return self._bikes.get(bike_id, owner_id)

    def remove(self, bike_id: int) -> None:
        """Remove a bike without a history. Raises NotFound, Conflict, StoreError."""
        self._bikes.remove(bike_id)

    def give_rides(self, bike_id: int, ride_ids: Sequence[int]) -> None:
        """Say that rides were made with a bike. Raises NotFound, Conflict, StoreError."""
        self._bikes.give_rides(bike_id, ride_ids)

    def pair(self, bike_id: int, owned_from: datetime | None, base_url: str) -> Pairing:
        """A code that makes whoever takes it the owner; the one before is none any more.

        base_url: the address this server was reached at, with a slash at its end.
        Raises NotFound, InvalidRequest, Conflict, StoreError.
        """
        from_us = None if owned_from is None else round(owned_from.timestamp() * 1e6)
        if from_us is not None and from_us > now_us():
            message = "A bike cannot be somebody's since a moment that is to come."
            raise InvalidRequest(message, fields=[FieldError("owned_from", "to_come", message)])
        code, expires_us = new_code(), now_us() + VALID_US
        self._pairings.add(bike_id, token_sha256(plain_code(code)), from_us, expires_us)
        link = f"{base_url}pair#{code}"
        return Pairing(code, utc(expires_us), link, qr_of(link))

    def offer(self, code: str, address: str) -> Offer:
        """What a code gives. address: where the request comes from. Raises NotFound, TooManyTries,
        StoreError."""
        return self._counted(address, self._pairings.offer, code)

    def take(self, code: str, person: Person, address: str) -> BikeDetail:
        """Make somebody the owner. Raises NotFound, TooManyTries, Conflict, StoreError."""
        bike_id = self._counted(address, lambda sha256: self._pairings.take(sha256, person), code)
        owner_id = person.id if person.role == "rider" else None
        return self._bikes.get(bike_id, owner_id)

    def join(self, code: str, name: str, password: str, address: str) -> tuple[Person, int]:
        """A rider's account and their bike, both or neither.

        Raises NotFound, TooManyTries, InvalidRequest, Conflict `name_taken`, StoreError.
        """
        if self._people is None:
            raise NotFound(NO_CODE)
        self.offer(code, address)
        take = taker(token_sha256(plain_code(code)))
        return self._people.accounts.add_rider(name, password, take)

    def leave(self, bike_id: int) -> None:
        """The bike is nobody's from now on. Raises NotFound, StoreError."""
        self._pairings.leave(bike_id)

    def is_own(self, whose: Sender, kind: str, name: str) -> bool:
        """Whether what an address names is this account's, or was sent with this key.

        Raises StoreError.
        """
        return self._bikes.is_own(whose, kind, name)

    def _counted(self, address: str, look: Callable[[str], Found | None], code: str) -> Found:
        """What a code leads to. Raises NotFound, TooManyTries where it comes too soon."""
        with self._turn:
            begin(self._now_s(), "codes", (self._tries, address))
        found = look(token_sha256(plain_code(code)))
        if found is None:
            raise NotFound(NO_CODE, "no_pairing")
        with self._turn:
            self._tries.take_back(address)
        return found


def as_row(members: dict[str, Any]) -> dict[str, Any]:
    """What is said of a bike as its row has it. Raises InvalidRequest for a name that is none."""
    values = {
        key: text.strip() or None if isinstance(text, str) else text
        for key, text in members.items()
    }
    if "name" in values and values["name"] is None:
        message = "A bike has a name."
        raise InvalidRequest(message, fields=[FieldError("name", "not_a_name", message)])
    if "mileage_km" in values:
        values["mileage_us"] = None if values["mileage_km"] is None else now_us()
    if "lost" in values:
        values["lost_us"] = now_us() if values.pop("lost") else None
    return values
