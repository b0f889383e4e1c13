"""The rides' rows in the database, looked over piece by piece and mended where they are damaged."""

from __future__ import annotations

import logging

from sqlalchemy import select

from backend.domain.ride import BAD
from backend.errors import StoreError
from backend.store.from_object import mend_row
from backend.store.objects import FileObjects
from backend.store.ride_table import rides_whole
from backend.store.soundness import ROUND_US
from backend.store.sql import tables as t
from backend.store.sql.database import Database

LOG = logging.getLogger(__name__)

# Some 10 ms, on the thread that keeps house each second.
ROWS_AT_ONCE = 50


class Entries:
    """Every ride's row, looked at once in a day, and at the start.

    damaged: numbers of rides whose row is damaged and could not be mended: none of their objects is
    whole. mended: how many were.
    """

    def __init__(self, database: Database, objects: FileObjects) -> None:
        self._database = database
        self._objects = objects
        self._last_id = 0
        self._next_round_us = 0
        self.damaged: frozenset[int] = frozenset()
        self.mended = 0

    def look(self, now_us: int) -> None:
        """Look at the next rows, and again at those that are damaged. Raises StoreError."""
        self.damaged = frozenset(i for i in self._bad(self.damaged) if not self._mend(i))
        if now_us < self._next_round_us:
            return
        after = select(t.ride.c.id).where(t.ride.c.id > self._last_id).order_by(t.ride.c.id)
        query = after.limit(ROWS_AT_ONCE)
        ids = self._database.read(lambda c: list(c.execute(query).scalars()))
        self.damaged |= frozenset(i for i in self._bad(ids) if not self._mend(i))
        self._last_id = ids[-1] if ids else 0
        if len(ids) < ROWS_AT_ONCE:
            self._last_id, self._next_round_us = 0, now_us + ROUND_US

    def look_at_all(self) -> None:
        """Look at every row, now. Raises StoreError."""
        while self._next_round_us == 0:
            self.look(1)

    def _bad(self, ride_ids: frozenset[int] | list[int]) -> list[int]:
        if not ride_ids:
            return []
        rides = self._database.read(lambda c: rides_whole(c, sorted(ride_ids)))
        return [ride.id for ride in rides if ride.state == BAD]

    def _mend(self, ride_id: int) -> bool:
        try:
            mended = mend_row(self._database, self._objects, ride_id)
        except StoreError as error:
            LOG.warning("Ride %d: its row stays damaged: %s", ride_id, error.message)
            return False
        self.mended += mended
        return mended
