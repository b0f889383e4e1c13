"""Works out what is kept beside each ride, in the background: of new rides, of old ones, and anew
by a newer method. Whatever is wrong with a ride stops no other."""

from __future__ import annotations

import logging
import time
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TypeVar

from backend.core.ride import Ride
from backend.errors import NotFound, SpindleError
from backend.store import Store

LOG = logging.getLogger(__name__)

# Rides looked up at once, and how long they may take: then somebody looks whether the server ends.
RIDES_AT_ONCE = 20
TICK_S = 1.0

Made = TypeVar("Made")


class DueRides(ABC):
    """The rides that something is due of. due: so many of their ids."""

    def __init__(self, store: Store, due: Callable[[int], list[int]]) -> None:
        self._store = store
        self._due = due
        self._seen = -1

    @abstractmethod
    def make(self, ride: Ride) -> None:
        """Work it out of one ride, and keep it."""

    def tick(self) -> int:
        """Make some of what is due; of how many. Looks only when a ride got its rows."""
        finishes = self._store.rides.finishes
        if finishes == self._seen:
            return 0
        over_s = time.monotonic() + TICK_S
        due = self._due(RIDES_AT_ONCE)
        for made, ride_id in enumerate(due):
            if made and time.monotonic() > over_s:
                return made
            try:
                self.make(self._store.rides.get(ride_id))
            except NotFound:
                continue
        if len(due) < RIDES_AT_ONCE:
            self._seen = finishes
        return len(due)


def made_or(empty: Made, name: str, ride: Ride, make: Callable[[], Made]) -> Made:
    """What is made of a ride; what says nothing where its rows cannot be read, or nobody can."""
    try:
        return make()
    except SpindleError as error:
        LOG.warning("Ride %d has an empty %s: %s", ride.id, name, error.message)
    except Exception:
        LOG.exception("Ride %d has an empty %s.", ride.id, name)
    return empty
