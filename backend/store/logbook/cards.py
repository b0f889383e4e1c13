"""Cards of rides: which ones are due, what is kept of them, and the words a search looks at."""

from __future__ import annotations

from sqlalchemy import Connection, select, update

from backend.core.ride import Ride, RidePlace
from backend.core.ride_card import BEST_S, METHOD, RideCard
from backend.store.logbook.derived import due_rides, save_row
from backend.store.sql import tables as t
from backend.store.sql.database import Database


class CardStore:
    """Cards, derived: any of them may be missing, and is made anew."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def due(self, limit: int) -> list[int]:
        """Finished rides without a card of today's method and of their present rows."""
        return self._database.read(lambda c: due_rides(c, t.ride_card, METHOD, limit))

    def save(self, ride: Ride, card: RideCard, place: RidePlace) -> None:
        """Keep a ride's card, unless the ride is gone or another meanwhile. Raises StoreError."""
        bests = zip(BEST_S, card.power_w_best, strict=True)
        values = {
            "speed_line": card.speed_line,
            "notable": card.notable,
            "ascent_m": card.ascent_m,
            **{f"power_w_best_{seconds}s": power_w for seconds, power_w in bests},
            "place": place.name,
            "country": place.country,
            "zone": place.zone,
            "is_loop": place.is_loop,
            "words": "",
        }

        def work(connection: Connection) -> None:
            if save_row(connection, t.ride_card, METHOD, ride, values):
                note_words(connection, ride.id)

        self._database.write(work)


def note_words(connection: Connection, ride_id: int) -> None:
    """Write anew what a search looks at; a ride without a card gets it with its card."""
    columns = (t.ride.c.name, t.ride.c.notes, t.ride_card.c.place)
    joined = t.ride.join(t.ride_card, t.ride_card.c.ride_id == t.ride.c.id)
    query = select(*columns).select_from(joined).where(t.ride.c.id == ride_id)
    row = connection.execute(query).first()
    if row is None:
        return
    tags = connection.execute(select(t.ride_tag.c.tag).where(t.ride_tag.c.ride_id == ride_id))
    lines = [" ".join(text.split()) for text in (row.name, row.notes, row.place or "")]
    lines += [f"#{tag}" for tag in tags.scalars()]
    words = "\n".join(["", *lines, ""]).casefold()
    mine = t.ride_card.c.ride_id == ride_id
    connection.execute(update(t.ride_card).where(mine).values(words=words))
