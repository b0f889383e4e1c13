"""Patience with failed sign-ins: some are free, then each waits twice as long as the one before.

A try counts before its password is looked at, so that a thousand at once are not a thousand tries.
Forgotten when the process ends; what it protects against takes days.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from math import ceil

from backend.errors import TooManyTries

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
        self._failures: OrderedDict[str, Failures] = OrderedDict()

    def wait_s(self, key: str, now_s: float) -> float:
        """How long the next try has to wait; 0 if it need not."""
        failures = self._fresh(key, now_s)
        return 0.0 if failures is None else max(0.0, failures.next_s - now_s)

    def count(self, key: str, now_s: float) -> None:
        """A try begins; it is taken for a failure until it is forgiven."""
        failures = self._fresh(key, now_s) or Failures(0, now_s, now_s)
        failures.count += 1
        failures.last_s = now_s
        over = failures.count - self._free
        failures.next_s = now_s + (min(WAIT_MAX_S, 2.0 ** min(over, 20)) if over >= 0 else 0.0)
        self._failures[key] = failures
        self._failures.move_to_end(key)
        while len(self._failures) > KEYS_MAX:
            self._failures.popitem(last=False)

    def forget(self, key: str) -> None:
        """The right one came: nothing of it is held against anybody."""
        self._failures.pop(key, None)

    def take_back(self, key: str) -> None:
        """The last try was right, and says nothing of those before it."""
        failures = self._failures.get(key)
        if failures is not None:
            failures.count -= 1
            failures.next_s = failures.last_s

    def _fresh(self, key: str, now_s: float) -> Failures | None:
        failures = self._failures.get(key)
        if failures is not None and now_s - failures.last_s > FORGET_S:
            del self._failures[key]
            return None
        return failures


def begin(now_s: float, what: str, *tries: tuple[Throttle, str]) -> None:
    """A try begins, counted by each of these with its key. what: of which there were wrong ones.

    Raises TooManyTries where one of them has to wait; then nothing is counted.
    """
    wait_s = max(throttle.wait_s(key, now_s) for throttle, key in tries)
    if wait_s > 0.0:
        message = f"Too many wrong {what}: wait {ceil(wait_s)} s, then try again."
        raise TooManyTries(message, wait_s)
    for throttle, key in tries:
        throttle.count(key, now_s)
