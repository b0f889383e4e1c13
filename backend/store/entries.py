"""The rides' rows in the database, looked over piece by piece and mended where they are damaged."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence

from sqlalchemy import select

from backend.core.ride import BAD, Ride
from backend.errors import StoreError
from backend.store.from_object import mend_row
from backend.store.objects import FileObjects
from backend.store.ride_table import damaged_rows
from backend.store.soundness import ROUND_US, Soundness
from backend.store.sql import tables as t
from backend.store.sql.database import Database

LOG = logging.getLogger(__name__)

# Some 10 ms, on the thread that keeps house each second.
ROWS_AT_ONCE = 50


class Entries:
    """Every ride's row, looked at once in a day, at the start, and when somebody met a damaged one.

    damaged: numbers of rides whose row is damaged and could not be mended: none of their objects is
    whole. mended: how many were.
    """

    def __init__(self, database: Database, objects: FileObjects, soundness: Soundness) -> None:
        self._database = database
        self._objects = objects
        self._soundness = soundness
        self._last_id = 0
        self._next_round_us = 0
        self._lock = threading.Lock()
        self._suspects: set[int] = set()
        self.damaged: frozenset[int] = frozenset()
        self.mended = 0

    def suspect(self, rides: Sequence[Ride]) -> None:
        """Look at those of some rides that are damaged with the next look. From any thread."""
        if met := {ride.id for ride in rides if ride.state == BAD}:
            with self._lock:
                self._suspects |= met

    def check_next(self, now_us: int) -> None:
        """Look at the next rows, and at those that are or were met damaged. Raises StoreError."""
        with self._lock:
            suspects, self._suspects = self._suspects, set()
        self.damaged = self._left_of(self.damaged | suspects)
        if now_us < self._next_round_us:
            return
        after = select(t.ride.c.id).where(t.ride.c.id > self._last_id).order_by(t.ride.c.id)
        query = after.limit(ROWS_AT_ONCE)
        ids = self._database.read(lambda c: list(c.execute(query).scalars()))
        self.damaged |= self._left_of(ids)
        self._last_id = ids[-1] if ids else 0
        if len(ids) < ROWS_AT_ONCE:
            self._last_id, self._next_round_us = 0, now_us + ROUND_US

    def check_all(self) -> None:
        """Look at every row, now. Raises StoreError."""
        while self._next_round_us == 0:
            self.check_next(1)

    def _left_of(self, ride_ids: frozenset[int] | list[int]) -> frozenset[int]:
        """Mend what is damaged of some rides' rows; returns those that stay so."""
        if not ride_ids:
            return frozenset()
        bad = self._database.read(lambda c: damaged_rows(c, sorted(ride_ids)))
        return frozenset(ride_id for ride_id in bad if not self._mend(ride_id))

    def _mend(self, ride_id: int) -> bool:
        try:
            mended = mend_row(self._database, self._objects, self._soundness, ride_id)
        except StoreError as error:
            if ride_id not in self.damaged:
                LOG.warning("Ride %d: its row stays damaged: %s", ride_id, error.message)
            return False
        self.mended += mended
        return mended
