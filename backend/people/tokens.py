"""Random secrets, their hashes, and what is kept for one until it is taken.

A secret is long enough that a plain hash will do. What is kept is in this process's memory: with
another server process it opens nothing.
"""

from __future__ import annotations

import hashlib
import re
import secrets
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import replace
from typing import Generic, TypeVar

from backend.core.person import Caller

# A key as a program sends it: `sp_`, what it is found by, the secret.
KEY_FORM = re.compile(r"sp_([0-9a-f]{8})_([0-9a-f]{64})")


def new_token() -> str:
    """256 bits that go into a cookie, a ticket or a link."""
    return secrets.token_urlsafe(32)


def token_sha256(secret: str) -> str:
    """What is kept of a secret: SHA-256 in hex."""
    return hashlib.sha256(secret.encode()).hexdigest()


def is_secret_of(sha256: str, secret: str) -> bool:
    """Whether a hash is that of a secret, in the same time whatever it is."""
    return secrets.compare_digest(sha256, token_sha256(secret))


def new_key() -> tuple[str, str, str]:
    """A key as it is shown once, its prefix, and its secret."""
    prefix, secret = secrets.token_hex(4), secrets.token_hex(32)
    return f"sp_{prefix}_{secret}", prefix, secret


VALID_S = 30.0
# Bounds the memory of secrets that nobody uses; the oldest go first.
SECRETS_MAX = 10_000
Held = TypeVar("Held")


class OneUse(Generic[Held]):
    """What is kept in memory for new secrets, from any thread.

    valid_s: how long. now_s: a clock that only goes forward.
    """

    def __init__(self, valid_s: float, now_s: Callable[[], float] = time.monotonic) -> None:
        self.valid_s = valid_s
        self._now_s = now_s
        self._turn = threading.Lock()
        self._open: OrderedDict[str, tuple[Held, float]] = OrderedDict()

    def give(self, held: Held) -> str:
        """A secret that something is kept for, once and soon."""
        secret = new_token()
        with self._turn:
            self._open[token_sha256(secret)] = (held, self._now_s() + self.valid_s)
            while len(self._open) > SECRETS_MAX:
                self._open.popitem(last=False)
        return secret

    def take(self, secret: str) -> Held | None:
        """What was kept for it; from now on nothing is. None where it was used or is over."""
        with self._turn:
            held, until_s = self._open.pop(token_sha256(secret), (None, 0.0))
            return held if self._now_s() < until_s else None


class Tickets(OneUse[Caller]):
    """Tickets: with one a program without a cookie opens a WebSocket."""

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        super().__init__(VALID_S, now_s)

    def give(self, held: Caller) -> str:
        """A ticket that stands for a caller, once and soon."""
        # A ticket is shown on purpose: no browser sends it by itself.
        return super().give(replace(held, by_cookie=False))
