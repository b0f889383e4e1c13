"""Moments of a ride that somebody marked while it was recorded; the finished one has them too."""

from __future__ import annotations

from dataclasses import asdict

from sqlalchemy import Connection, select, update

from backend.domain.ride_events import EVENTS_MAX, MARK, RideEvent
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
            if len(events) >= EVENTS_MAX:
                raise Conflict(f"A ride has at most {EVENTS_MAX} marks.", "marks_full")
            mark = RideEvent(t_s, MARK, 1 + len(events))
            connection.execute(update(t.ride).where(row).values(events=[*events, asdict(mark)]))
            return mark

        return self._database.write(work)
