"""Passwords as they are kept: Argon2id by RFC 9106. The only user of argon2.

A hash takes 64 MiB and some 50 ms on purpose. Only a few run at once: who sends a thousand wrong
passwords must not fill the memory of a machine that is recording a ride.
"""

from __future__ import annotations

import secrets
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

from backend.domain.people.password import normal
from backend.errors import TooManyTries

# Of 64 MiB each.
AT_ONCE = 2
# Longer than so nobody waits for a turn: threads that wait answer nobody else.
TURN_S = 3.0


class Passwords:
    """Makes and compares hashes, from any thread. Raises TooManyTries when too many want to."""

    def __init__(self) -> None:
        self._hasher = PasswordHasher()
        self._turns = threading.BoundedSemaphore(AT_ONCE)
        # Of a password that nobody has: compared where there is no account, for the same time.
        self._nobodys = self._hasher.hash(secrets.token_hex())

    def hashed(self, password: str) -> str:
        """A password with a new salt, as one line of text."""
        with self._turn():
            return self._hasher.hash(normal(password))

    def matches(self, kept: str | None, password: str) -> bool:
        """Whether a password is the kept one. None, of nobody, takes as long and is False."""
        with self._turn():
            try:
                self._hasher.verify(kept or self._nobodys, normal(password))
            except (VerificationError, InvalidHashError):
                return False
        return kept is not None

    @contextmanager
    def _turn(self) -> Iterator[None]:
        if not self._turns.acquire(timeout=TURN_S):
            raise TooManyTries("Too many passwords are being looked at: try again.", TURN_S)
        try:
            yield
        finally:
            self._turns.release()
