"""The rows of one ride on their way to the store: kept while it refuses them, each one counted.

    add -> (a tail a second) send -> on the way -> saved
                                        |  ^
                              refused   v  | again: one to try, all as soon as one is taken
                                      waiting -> given up when there are too many: lost

rows taken = rows saved + rows waiting + rows lost, at every moment. Rows that never came from the
unit are written as missing ones and are none of these.
"""

from __future__ import annotations

from bisect import insort
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.ride_events import RideEvent
from backend.errors import StoreError
from backend.store import RideStore

Rows16 = npt.NDArray[np.int16]

# How often what was refused is tried again when the ride ends.
LAST_TRIES = 3


@dataclass
class RecorderHealth:
    """Rows of rides since the server started."""

    rows_saved: int = 0
    """Committed in the store."""
    rows_lost: int = 0
    """Given up, because the store refused them too long."""
    rows_waiting: int = 0
    """On the way to the store, or waiting for it."""
    rows_missing: int = 0
    """Never came while the bike was ridden: gaps of its rides. None of the others."""


@dataclass(frozen=True)
class _Tail:
    """Rows from `row_start` on; `taken` of them came from the unit. events: told meanwhile."""

    row_start: int
    rows: Rows16
    taken: int
    events: tuple[RideEvent, ...]


class RideTail:
    """One ride's rows. The caller sees to it that one thread at a time is in here.

    begin: makes the ride in the store, once it lets us, and returns its id. report: gets the
    changes of rows_saved, rows_lost and rows_waiting.
    """

    def __init__(
        self, rides: RideStore, begin: Callable[[], int], report: Callable[[int, int, int], None]
    ) -> None:
        self._rides = rides
        self._begin = begin
        self._report = report
        self._unsent: list[Rows16] = []
        self._unsent_taken = 0
        self._unsent_events: tuple[RideEvent, ...] = ()
        # By row_start: what is given up is the oldest, however often it was tried.
        self._waiting: list[_Tail] = []
        self._in_progress: deque[tuple[Future[None], _Tail]] = deque()
        self._refused = False
        self.ride_id: int | None = None
        # Rows of the ride, missing ones included.
        self.rows = 0
        self.rows_unsent = 0
        self.counts = RecorderHealth()
        # Why the store refused last.
        self.error: StoreError | None = None

    @property
    def is_empty(self) -> bool:
        """Whether every row is saved or lost."""
        return not (self._unsent or self._waiting or self._in_progress)

    @property
    def tails_waiting(self) -> int:
        """Seconds or so that the store has refused and that are kept here."""
        return len(self._waiting)

    def add(self, rows: Rows16, taken: bool = True) -> None:
        """Add rows (n, channels) behind the last; taken: False for those that never came."""
        self._unsent.append(rows)
        self.rows += len(rows)
        self.rows_unsent += len(rows)
        if taken:
            self._unsent_taken += len(rows)
            self._count(0, 0, len(rows))

    def note(self, event: RideEvent) -> None:
        """Keep an event with the rows that come next; one behind the last row is of no ride."""
        self._unsent_events += (event,)

    def send(self) -> None:
        """Hand what was added to the store, and see what became of what went before."""
        if self._unsent:
            rows = np.concatenate(self._unsent)
            start, events = self.rows - len(rows), self._unsent_events
            self._waiting.append(_Tail(start, rows, self._unsent_taken, events))
            self._unsent, self._unsent_events = [], ()
            self._unsent_taken = self.rows_unsent = 0
        self.push()

    def push(self) -> None:
        """Give the store what waits: one tail while it refuses, everything else at once."""
        self.collect()
        if not self._is_begun():
            return
        if not self._refused:
            self._submit(len(self._waiting))
        elif not self._in_progress:
            self._submit(1)

    def collect(self) -> None:
        """Count what the store has taken, and take back what it refused. Never waits."""
        while self._in_progress and self._in_progress[0][0].done():
            future, tail = self._in_progress.popleft()
            error = future.exception()
            self._refused = error is not None
            if error is None:
                self._count(tail.taken, 0, -tail.taken)
                continue
            self.error = error if isinstance(error, StoreError) else StoreError(str(error))
            insort(self._waiting, tail, key=_row_start)

    def drain(self) -> bool:
        """Wait until the store has taken everything or refused it again; True for everything."""
        self.send()
        for _ in range(LAST_TRIES):
            for future, _tail in self._in_progress:
                future.exception()
            self.collect()
            if self.is_empty:
                return True
            self.push()
        for future, _tail in self._in_progress:
            future.exception()
        self.collect()
        return self.is_empty

    def give_up(self, tails: int = 1) -> None:
        """Lose the oldest of what waits."""
        for _ in range(min(tails, len(self._waiting))):
            lost = self._waiting.pop(0)
            self._unsent_events = lost.events + self._unsent_events
            self._count(0, lost.taken, -lost.taken)

    def _is_begun(self) -> bool:
        if self.ride_id is None:
            try:
                self.ride_id = self._begin()
                self._refused = False
            except StoreError as error:
                self.error = error
                return False
        return True

    def _submit(self, tails: int) -> None:
        assert self.ride_id is not None
        for _ in range(tails):
            tail = self._waiting.pop(0)
            try:
                future = self._rides.append_tail(
                    self.ride_id, tail.row_start, tail.rows, tail.events
                )
            except StoreError as error:
                self.error = error
                self._refused = True
                self._waiting.insert(0, tail)
                return
            self._in_progress.append((future, tail))

    def _count(self, saved: int, lost: int, waiting: int) -> None:
        self.counts.rows_saved += saved
        self.counts.rows_lost += lost
        self.counts.rows_waiting += waiting
        self._report(saved, lost, waiting)


def _row_start(tail: _Tail) -> int:
    return tail.row_start
