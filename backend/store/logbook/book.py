"""The door of the logbook: what the rider's home shows, and tags on many rides at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from sqlalchemy import Connection, delete, func, insert, select

from backend.core.audit import Action, AuditEntry
from backend.core.calendar import Period
from backend.core.ride_tags import clean_tags
from backend.errors import NotFound
from backend.store import audit
from backend.store.logbook import totals
from backend.store.logbook.derived import note_words
from backend.store.logbook.find import Sought, count_of, ids_of
from backend.store.objects import Objects
from backend.store.ride_table import tags_of
from backend.store.sidecar import save_words
from backend.store.sql import tables as t
from backend.store.sql.database import Database

# Rides tagged in one transaction: a recording waits so long for its turn, 0.2 s on a slow disk.
RIDES_AT_ONCE = 20
ANYBODY = totals.Whose()


@dataclass(frozen=True)
class Home:
    """What the rider's home shows, of all rides, a bike's or an account's; the bikes are those of
    the account."""

    by_period: tuple[tuple[totals.Totals, ...], ...]
    bikes: tuple[totals.BikeTotals, ...]
    records: tuple[totals.Best, ...]
    faults: tuple[totals.RideFault, ...]
    tags: tuple[tuple[str, int], ...]


class Logbook:
    """Sums, records and tags of all rides."""

    def __init__(self, database: Database, objects: Objects) -> None:
        self._database = database
        self._objects = objects

    def home(self, spans: Sequence[Sequence[Period]], whose: totals.Whose = ANYBODY) -> Home:
        """Totals for each of the spans of periods, and all else, at one moment."""

        def work(connection: Connection) -> Home:
            return Home(
                tuple(totals.totals_by(connection, span, whose) for span in spans),
                totals.bikes(connection, whose.owner_id),
                totals.records(connection, whose),
                totals.last_faults(connection, whose),
                tags_in_use(connection, whose.owner_id),
            )

        return self._database.read(work)

    def count(self, sought: Sought) -> int:
        """How many rides there are of these."""
        return self._database.read(lambda c: count_of(c, sought))

    def ids(self, sought: Sought) -> list[int]:
        """Every one of these rides that is over, the oldest first."""
        return self._database.read(lambda c: ids_of(c, sought))

    def own(self, ride_ids: Sequence[int], owner_id: int | None) -> Sequence[int]:
        """Those of some rides that are this account's, in their order; all for None."""
        if owner_id is None:
            return ride_ids
        mine = select(t.ride.c.id).where(t.ride.c.id.in_(ride_ids), t.ride.c.owner_id == owner_id)
        own = set(self._database.read(lambda c: c.execute(mine).scalars().all()))
        return [ride_id for ride_id in ride_ids if ride_id in own]

    def require_own(self, ride_ids: Sequence[int], owner_id: int | None) -> None:
        """Raises NotFound for a ride that is not this account's, as for one that is not there."""
        own = set(self.own(ride_ids, owner_id))
        if foreign := [ride_id for ride_id in ride_ids if ride_id not in own]:
            raise NotFound(f"There is no ride {foreign[0]}.")

    def tag(self, ride_ids: Sequence[int], add: Sequence[str], remove: Sequence[str]) -> None:
        """Add and remove tags of rides. Raises NotFound, InvalidRequest; then none is changed.

        Each ride's file is flushed to the disk: other writes come in between, some rides at a time.
        """
        gone = {tag.casefold() for tag in clean_tags(remove)}

        def tags_for(connection: Connection, some: Sequence[int]) -> dict[int, tuple[str, ...]]:
            here = select(t.ride.c.id).where(t.ride.c.id.in_(some))
            tags = tags_of(connection, some)
            return {
                ride_id: clean_tags(
                    [*(tag for tag in tags.get(ride_id, ()) if tag.casefold() not in gone), *add]
                )
                for ride_id in connection.execute(here).scalars().all()
            }

        def work(connection: Connection, some: Sequence[int]) -> None:
            before = tags_of(connection, some)
            tagged = tags_for(connection, some)
            for ride_id, tags in tagged.items():
                set_tags(connection, ride_id, tags)
                save_words(connection, self._objects, ride_id, even_if_empty=True)
            changed = [one for one, tags in tagged.items() if {*tags} != {*before.get(one, ())}]
            note_tagged(connection, changed)

        tagged = self._database.read(lambda c: tags_for(c, ride_ids))
        if missing := [ride_id for ride_id in ride_ids if ride_id not in tagged]:
            raise NotFound(f"There is no ride {missing[0]}.")
        for start in range(0, len(ride_ids), RIDES_AT_ONCE):
            self._database.write(partial(work, some=ride_ids[start : start + RIDES_AT_ONCE]))


def note_tagged(connection: Connection, ride_ids: Sequence[int]) -> None:
    """Note that rides have other tags; which, only the rides tell."""
    columns = (t.ride.c.id, t.ride.c.bike_id)
    for row in connection.execute(select(*columns).where(t.ride.c.id.in_(ride_ids))).all():
        after = {"changed": ["tags"]}
        entry = AuditEntry(Action.RIDE_CHANGED, row.id, after=after, bike_id=row.bike_id)
        audit.append(connection, entry)


def set_tags(connection: Connection, ride_id: int, tags: Sequence[str]) -> None:
    """Give a ride these tags and no other."""
    connection.execute(delete(t.ride_tag).where(t.ride_tag.c.ride_id == ride_id))
    if tags:
        rows = [{"ride_id": ride_id, "tag": tag} for tag in tags]
        connection.execute(insert(t.ride_tag), rows)
    note_words(connection, ride_id)


def tags_in_use(connection: Connection, owner_id: int | None = None) -> tuple[tuple[str, int], ...]:
    """Every tag with how many rides, if need be of this account, have it, the commonest first."""
    count = func.count()
    query = select(t.ride_tag.c.tag, count).group_by(t.ride_tag.c.tag)
    if owner_id is not None:
        query = query.join(t.ride, t.ride.c.id == t.ride_tag.c.ride_id)
        query = query.where(t.ride.c.owner_id == owner_id)
    rows = connection.execute(query.order_by(count.desc(), t.ride_tag.c.tag).limit(100))
    return tuple((row[0], row[1]) for row in rows)
