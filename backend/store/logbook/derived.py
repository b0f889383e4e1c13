"""What is worked out of each ride and stored with it: cards, zeros; which rides are due."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any

from sqlalchemy import Connection, Table, delete, insert, or_, select, update

from backend.core.doubts import open_doubts
from backend.core.ride import Ride, RidePlace
from backend.core.ride_card import BEST_S, CARD_METHOD, RideCard
from backend.core.ride_zero import ZERO_METHOD, RideZero, ZeroOfRide
from backend.store.sql import tables as t
from backend.store.sql.database import Database


def due_rides(connection: Connection, table: Table, method: int, limit: int) -> list[int]:
    """Finished rides without a row by this method and of their present rows, newest first."""
    row = table.c
    query = (
        select(t.ride.c.id)
        .outerjoin(table, row.ride_id == t.ride.c.id)
        .where(t.ride.c.state == "done")
        .where(
            or_(row.ride_id.is_(None), row.method < method, row.object_key != t.ride.c.object_key)
        )
        .order_by(t.ride.c.started_us.desc())
        .limit(limit)
    )
    return list(connection.execute(query).scalars())


def save_row(
    connection: Connection, table: Table, method: int, ride: Ride, values: Mapping[str, object]
) -> bool:
    """Keep what was worked out; False where the ride is gone or another meanwhile."""
    connection.execute(delete(table).where(table.c.ride_id == ride.id))
    mine = (t.ride.c.id == ride.id) & (t.ride.c.object_key == ride.object_key)
    if connection.execute(select(t.ride.c.id).where(mine)).first() is None:
        return False
    made = {"ride_id": ride.id, "method": method, "object_key": ride.object_key}
    connection.execute(insert(table).values(made | dict(values)))
    return True


class CardStore:
    """Cards, derived: any of them may be missing, and is made anew."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def due(self, limit: int) -> list[int]:
        """Finished rides without a card of today's method and of their present rows."""
        return self._database.read(lambda c: due_rides(c, t.ride_card, CARD_METHOD, limit))

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
            "doubts": [asdict(doubt) for doubt in card.doubts],
        }

        def work(connection: Connection) -> None:
            query = select(t.ride.c.accepted_doubts).where(t.ride.c.id == ride.id)
            accepted = connection.execute(query).scalar() or []
            values["open_doubts"] = open_doubts(card.doubts, accepted)
            if save_row(connection, t.ride_card, CARD_METHOD, ride, values):
                note_words(connection, ride.id)
                settle_twins(connection, ride.id)

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


def settle_twins(connection: Connection, ride_id: int) -> None:
    """Of the recordings of one ride let the best count: nothing doubtful or impossible in it, then
    the most channels and rows, then the first that came."""
    ride, card = t.ride.c, t.ride_card.c
    twin_id = connection.execute(select(ride.same_ride_as).where(ride.id == ride_id)).scalar()
    one = ride.id == ride_id
    # Most rides have no twin, and none of these looks through all the others.
    if twin_id is not None:
        one = or_(one, ride.id == twin_id, ride.same_ride_as.in_((ride_id, twin_id)))
    columns = (ride.id, ride.intake, ride.channels, ride.row_count, card.open_doubts)
    query = select(*columns).outerjoin(t.ride_card, card.ride_id == ride.id).where(one)

    def worth(row: Any) -> tuple[int, ...]:
        impossible = sum((row.intake or {}).get("values_dropped", {}).values())
        return (-(row.open_doubts or 0), -impossible, len(row.channels), row.row_count, -row.id)

    rows = connection.execute(query.where(ride.state == "done")).all()
    best = max(rows, key=worth).id if rows else None
    for row in rows:
        summary = update(t.ride_summary).where(t.ride_summary.c.ride_id == row.id)
        connection.execute(summary.values(outdone=int(row.id != best)))


def accept_doubts(connection: Connection, ride: Ride, accepted: bool) -> None:
    """Note that somebody accepts all that is doubtful of a ride, or takes that back."""
    codes = [doubt.code for doubt in ride.doubts] if accepted else []
    connection.execute(update(t.ride).where(t.ride.c.id == ride.id).values(accepted_doubts=codes))
    card = update(t.ride_card).where(t.ride_card.c.ride_id == ride.id)
    connection.execute(card.values(open_doubts=open_doubts(ride.doubts, codes)))
    settle_twins(connection, ride.id)


FIELDS = tuple(field.name for field in fields(RideZero))


class ZeroStore:
    """The zero of every ride, derived."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def due(self, limit: int) -> list[int]:
        """Finished rides without a zero by today's method and of their present rows."""
        return self._database.read(lambda c: due_rides(c, t.ride_zero, ZERO_METHOD, limit))

    def save(self, ride: Ride, zero: RideZero) -> None:
        """Keep a ride's zero, unless the ride is gone or another meanwhile. Raises StoreError."""
        self._database.write(lambda c: save_row(c, t.ride_zero, ZERO_METHOD, ride, asdict(zero)))

    def of_unit(self, unit_key: str, limit: int) -> tuple[ZeroOfRide, ...]:
        """The newest rides of a unit with their zeros, newest first; those not yet made are not
        among them."""

        def work(connection: Connection) -> tuple[ZeroOfRide, ...]:
            columns = (t.ride.c.started_us, t.ride.c.context, t.ride_zero.c.ride_id)
            query = (
                select(*columns, *(t.ride_zero.c[name] for name in FIELDS))
                .join(t.ride, t.ride.c.id == t.ride_zero.c.ride_id)
                .where(t.ride.c.unit_key == unit_key)
                .order_by(t.ride.c.started_us.desc(), t.ride.c.id.desc())
                .limit(limit)
            )
            return tuple(
                ZeroOfRide(
                    row.ride_id,
                    row.started_us,
                    RideZero(**{name: getattr(row, name) for name in FIELDS}),
                    row.context.get("config_generation"),
                    row.context.get("config_crc32"),
                )
                for row in connection.execute(query)
            )

        return self._database.read(work)
