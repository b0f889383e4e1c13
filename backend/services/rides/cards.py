"""Makes the cards of rides."""

from __future__ import annotations

from backend.core.energy import RIDER_POWER
from backend.core.ride import Ride, RidePlace
from backend.core.ride_card import BEST_S, RideCard, ends_of, speed_line
from backend.core.ride_events import FAULT_SET, MARK
from backend.gazetteer import Gazetteer
from backend.services.rides.derived import DueRides, made_or
from backend.services.rides.insight.rows import WAY, RideColumns, columns_of
from backend.store import Store
from backend.views.insight.power_curve import power_curve
from backend.views.insight.way import climb_of

CHANNELS = (*WAY, "altitude_m", "latitude_deg", "longitude_deg", RIDER_POWER.name)
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
        self._store.cards.keep(ride, card, self._place(card))

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
    heights, way = rows["altitude_m"], rows.way
    climb = None if heights is None or way is None else climb_of(heights, way, rows.start_s)
    return RideCard(
        speed_line=speed_line(rows.start_s, rows["speed_kmh"]),
        ascent_m=None if climb is None else climb.ascent_m,
        power_w_best=best_powers(rows),
        notable=sum(event.kind in (FAULT_SET, MARK) for event in rows.ride.events),
        begin_deg=begin,
        is_loop=is_loop,
    )


def best_powers(rows: RideColumns) -> tuple[float | None, ...]:
    """The rider's best mean over each of BEST_S; None where the ride has no such stretch."""
    power = rows[RIDER_POWER.name]
    if power is None or not (power > 0.0).any():
        return (None,) * len(BEST_S)
    curve = power_curve(power, rows.start_s, rows.seconds, BEST_S)
    best = {found.duration_s: found.power_w for found in curve}
    return tuple(best.get(float(seconds)) for seconds in BEST_S)
