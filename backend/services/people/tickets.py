"""Tickets: what a program without a cookie shows when it opens a WebSocket. Each opens one."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import replace

from backend.domain.people.person import Caller
from backend.services.people.tokens import kept, new_token

VALID_S = 30.0
# Bounds the memory of tickets that nobody uses; the oldest go first.
TICKETS_MAX = 10_000


class Tickets:
    """Tickets in memory, from any thread. now_s: a clock that only goes forward."""

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self._now_s = now_s
        self._turn = threading.Lock()
        self._open: OrderedDict[str, tuple[Caller, float]] = OrderedDict()

    def give(self, caller: Caller) -> str:
        """A ticket that stands for a caller, once and soon."""
        ticket = new_token()
        with self._turn:
            # A ticket is shown on purpose: no browser sends it by itself.
            self._open[kept(ticket)] = (replace(caller, by_cookie=False), self._now_s() + VALID_S)
            while len(self._open) > TICKETS_MAX:
                self._open.popitem(last=False)
        return ticket

    def take(self, ticket: str) -> Caller | None:
        """Whose it is; from now on it is nobody's. None where it was used or is over."""
        with self._turn:
            caller, until_s = self._open.pop(kept(ticket), (None, 0.0))
            return caller if self._now_s() < until_s else None
