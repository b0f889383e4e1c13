"""Random secrets, their hashes, and tickets: with one a program without a cookie opens a WebSocket.

A secret is long enough that a plain hash will do.
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
            self._open[token_sha256(ticket)] = (
                replace(caller, by_cookie=False),
                self._now_s() + VALID_S,
            )
            while len(self._open) > TICKETS_MAX:
                self._open.popitem(last=False)
        return ticket

    def take(self, ticket: str) -> Caller | None:
        """Whose it is; from now on it is nobody's. None where it was used or is over."""
        with self._turn:
            caller, until_s = self._open.pop(token_sha256(ticket), (None, 0.0))
            return caller if self._now_s() < until_s else None
