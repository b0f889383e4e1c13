"""Patience with failed sign-ins: some are free, then each waits twice as long as the one before.

A try counts before its password is looked at, so that a thousand at once are not a thousand tries.
Forgotten when the process ends; what it protects against takes days.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass

# Bounds the memory that strangers can take.
KEYS_MAX = 10_000
WAIT_MAX_S = 900.0
# A name or an address that was left alone for so long begins anew.
FORGET_S = 3600.0


@dataclass
class Failures:
    """Of one name or address. next_s: when the next try is let through."""

    count: int
    next_s: float
    last_s: float


class Throttle:
    """Counts by key. free: failures before the first wait. Not for several threads at once."""

    def __init__(self, free: int) -> None:
        self._free = free
        self._known: OrderedDict[str, Failures] = OrderedDict()

    def wait_s(self, key: str, now_s: float) -> float:
        """How long the next try has to wait; 0 if it need not."""
        known = self._fresh(key, now_s)
        return 0.0 if known is None else max(0.0, known.next_s - now_s)

    def count(self, key: str, now_s: float) -> None:
        """A try begins; it is taken for a failure until it is forgiven."""
        known = self._fresh(key, now_s) or Failures(0, now_s, now_s)
        known.count += 1
        known.last_s = now_s
        over = known.count - self._free
        known.next_s = now_s + (min(WAIT_MAX_S, 2.0 ** min(over, 20)) if over >= 0 else 0.0)
        self._known[key] = known
        self._known.move_to_end(key)
        while len(self._known) > KEYS_MAX:
            self._known.popitem(last=False)

    def forget(self, key: str) -> None:
        """The right one came: nothing of it is held against anybody."""
        self._known.pop(key, None)

    def take_back(self, key: str) -> None:
        """The last try was right, and says nothing of those before it."""
        known = self._known.get(key)
        if known is not None:
            known.count -= 1
            known.next_s = known.last_s

    def _fresh(self, key: str, now_s: float) -> Failures | None:
        known = self._known.get(key)
        if known is not None and now_s - known.last_s > FORGET_S:
            del self._known[key]
            return None
        return known
