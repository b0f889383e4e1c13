"""Events added to a ride while it is recorded: moments that somebody marked, settings that changed.

The finished ride has them too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

from sqlalchemy import Connection, select, update

from backend.core.ride_events import EVENTS_MAX, MARK, RideEvent
from backend.errors import Conflict
from backend.store.sql import tables as t
from backend.store.sql.database import Database


class MarkStore:
    """Adds marks to the events of rides."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def add(self, ride_id: int, t_s: float) -> RideEvent:
        """Mark the moment t_s seconds after the ride's start.

        Raises Conflict `no_ride` where the ride is over, `marks_full`, StoreError.
        """

        def work(connection: Connection) -> RideEvent:
            row = t.ride.c.id == ride_id
            # How it ended is noted before its rows are gathered: no mark comes too late for them.
            recorded = (t.ride.c.state == "live") & t.ride.c.cut_short.is_(None)
            events = connection.execute(select(t.ride.c.events).where(row, recorded)).scalar()
            if events is None:
                raise Conflict("The ride is over: only what is recorded is marked.", "no_ride")
            marks = sum(event["kind"] == MARK for event in events)
            if marks >= EVENTS_MAX:
                raise Conflict(f"A ride has at most {EVENTS_MAX} marks.", "marks_full")
            mark = RideEvent(t_s, MARK, 1 + marks)
            add_events(connection, ride_id, [mark])
            return mark

        return self._database.write(work)


def add_events(connection: Connection, ride_id: int, events: Sequence[RideEvent]) -> None:
    """Add to what is known of a ride that is being recorded."""
    row = t.ride.c.id == ride_id
    existing = connection.execute(select(t.ride.c.events).where(row)).scalar_one()
    added = [asdict(event) for event in events]
    connection.execute(update(t.ride).where(row).values(events=[*existing, *added]))
