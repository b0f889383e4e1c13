"""Makes figures and cards of rides: what is kept beside each, worked out in the background.

Of new rides, of old ones, and anew by a newer method. Whatever is wrong with a ride stops no other.
"""

from __future__ import annotations

import logging
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import TypeVar

from backend.core.distance import DISTANCE_CHANNELS
from backend.core.doubts import Evidence, doubts_of
from backend.core.energy import RIDER_POWER
from backend.core.ride import Ride, RidePlace, RideSummary
from backend.core.ride_card import BEST_S, RideCard, ends_of, speed_line
from backend.core.ride_events import FAULT_SET, MARK
from backend.errors import NotFound, SpindleError
from backend.rides.insight.gradient import climb_of
from backend.rides.insight.power_curve import power_curve
from backend.rides.logbook.towns import Gazetteer
from backend.rides.rows import RideColumns, columns_of
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
        self._finishes_done = -1

    @abstractmethod
    def make(self, ride: Ride) -> None:
        """Work it out of one ride, and keep it."""

    def tick(self) -> int:
        """Make some of what is due; of how many. Looks only when a ride got its rows."""
        finishes = self._store.rides.finishes
        if finishes == self._finishes_done:
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
            self._finishes_done = finishes
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


class RideFigures(DueRides):
    """The rides whose figures an older version worked out in another way."""

    def __init__(self, store: Store) -> None:
        super().__init__(store, store.rides.outdated)

    def make(self, ride: Ride) -> None:
        """Figures and gaps of its rows; what cannot be read keeps those that it has."""
        found = made_or(None, "summary", ride, lambda: self._store.rides.digest_anew(ride))
        self._store.rides.save_figures(ride, found)


CHANNELS = (*DISTANCE_CHANNELS, "altitude_m", RIDER_POWER.name)
# A town further away is not where the ride was; its time zone still is.
TOWN_MAX_M = 20_000.0
ZONE_MAX_M = 300_000.0


class RideCards(DueRides):
    """The cards that are due."""

    def __init__(self, store: Store, gazetteer: Gazetteer | None = None) -> None:
        super().__init__(store, store.cards.due)
        self._gazetteer = gazetteer or Gazetteer()

    def make(self, ride: Ride) -> None:
        """A ride's card; an empty one where none can be made of it."""
        card = made_or(
            RideCard(), "card", ride, lambda: card_of(columns_of(self._store, ride.id, CHANNELS))
        )
        self._store.cards.save(ride, card, self._place(card))

    def _place(self, card: RideCard) -> RidePlace:
        """Where the ride began, as far as the gazetteer knows."""
        if card.begin_deg is None:
            return RidePlace()
        town = self._gazetteer.nearest(*card.begin_deg)
        near = town.away_m <= TOWN_MAX_M
        return RidePlace(
            name=town.name if near else None,
            country=town.country if near else None,
            zone=town.zone if town.away_m <= ZONE_MAX_M else None,
            is_loop=card.is_loop,
        )


def card_of(rows: RideColumns) -> RideCard:
    """The card of a ride whose CHANNELS these are; climb and powers as the ride's page tells."""
    begin, is_loop = ends_of(rows["latitude_deg"], rows["longitude_deg"])
    heights, distances = rows["altitude_m"], rows.distances
    climb = (
        None if heights is None or distances is None else climb_of(heights, distances, rows.start_s)
    )
    ascent_m = None if climb is None else climb.ascent_m
    powers_w = best_powers(rows)
    return RideCard(
        speed_line=speed_line(rows.start_s, rows["speed_kmh"]),
        ascent_m=ascent_m,
        power_w_best=powers_w,
        doubts=doubts_of(evidence_of(rows, ascent_m, powers_w)),
        notable=sum(event.kind in (FAULT_SET, MARK) for event in rows.ride.events),
        begin_deg=begin,
        is_loop=is_loop,
    )


def evidence_of(
    rows: RideColumns, ascent_m: float | None, powers_w: Sequence[float | None]
) -> Evidence:
    """What the ride's figures are judged by."""
    ride = rows.ride
    return Evidence(
        rows.values,
        rows.start_s,
        rows.seconds,
        rows.distances,
        ride.summary or RideSummary(duration_s=0.0),
        ascent_m,
        dict(zip(BEST_S, powers_w, strict=True)),
        ride.intake,
        ride.metadata,
    )


def best_powers(rows: RideColumns) -> tuple[float | None, ...]:
    """The rider's best mean over each of BEST_S; None where the ride has no such stretch."""
    power = rows[RIDER_POWER.name]
    if power is None or not (power > 0.0).any():
        return (None,) * len(BEST_S)
    curve = power_curve(power, rows.start_s, rows.seconds, BEST_S)
    best = {point.duration_s: point.power_w for point in curve}
    return tuple(best.get(float(seconds)) for seconds in BEST_S)
