"""Passwords: which are taken (NIST SP 800-63B, 3.1.1: length, no rules on composition, none of the
commonest), and Argon2id hashes of them (RFC 9106). The only user of argon2.

A hash takes 64 MiB and some 50 ms on purpose. Only a few run at once: who sends a thousand wrong
passwords must not fill the memory of a machine that is recording a ride.
"""

from __future__ import annotations

import secrets
import threading
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

from backend.errors import FieldError, InvalidRequest, TooManyTries
from backend.people.types import PASSWORD_LENGTH_MAX, PASSWORD_LENGTH_MIN

# The commonest of eight characters and more in lists of passwords that were stolen.
COMMON_TEXT = """
password passw0rd password1 password12 password123 password1234 password! p@ssw0rd p@ssword
12345678 123456789 1234567890 12345678910 0123456789 87654321 987654321 0987654321 123123123
11223344 12341234 123454321 147258369 1234qwer qwer1234 1q2w3e4r 1q2w3e4r5t q1w2e3r4 1qaz2wsx
zaq12wsx zaq1zaq1 qazwsxedc qwertyui qwertyuiop qwerty123 qwerty1234 qwerty12 asdfghjk asdfghjkl
zxcvbnm1 asdf1234 abcd1234 abc12345 abcdefgh abcdefghi a1b2c3d4 aa123456 a12345678 a123456789
iloveyou iloveyou1 princess princess1 sunshine sunshine1 football football1 baseball baseball1
basketball superman superman1 batman123 spiderman starwars computer internet michelle jennifer
victoria trustno1 whatever welcome1 welcome123 letmein1 letmein123 changeme changeme1 dragon123
monkey123 master123 shadow123 charlie1 jordan23 liverpool chelsea1 arsenal1 barcelona manchester
admin123 admin1234 administrator adminadmin root1234 rootroot test1234 testtest guest123
default1 login123 secret123 samsung1 google123 facebook hello123 helloworld blink182 nirvana1
metallica pokemon1 pokemon123 minecraft mercedes corvette mustang1 maverick midnight butterfly
chocolate elephant cocacola snoopy123 woaini1314 woaini520 5201314520 a5201314 147852369
789456123 159753456 741852963 bicycle1 bicycles spindle1 spindle123 workshop workshop1
"""
COMMON = frozenset(COMMON_TEXT.split())


def normal(password: str) -> str:
    """One spelling of what looks the same, as 800-63B asks for: NFKC."""
    return unicodedata.normalize("NFKC", password)


def fault_of(password: str, name: str) -> tuple[str, str] | None:
    """Why a password is not taken, as a code and a sentence; None if it is. name: its person's."""
    spelled = normal(password)
    if len(spelled) < PASSWORD_LENGTH_MIN:
        return (
            "too_short",
            f"A password has at least {PASSWORD_LENGTH_MIN} characters; a sentence is good.",
        )
    if len(spelled) > PASSWORD_LENGTH_MAX:
        return "too_long", f"A password has at most {PASSWORD_LENGTH_MAX} characters."
    if spelled.casefold() in COMMON or len(set(spelled)) == 1:
        return "too_common", "This is among the first passwords that anybody tries."
    if spelled.casefold() == normal(name).casefold():
        return "is_the_name", "A password must not be the name it belongs to."
    return None


# Of 64 MiB each.
HASHES_AT_ONCE = 2
# Longer than so nobody waits for a turn: threads that wait answer nobody else.
TURN_S = 3.0


def require_good(password: str, name: str, field: str = "password") -> None:
    """Raises InvalidRequest for a password that is not taken. name: its person's."""
    fault = fault_of(password, name)
    if fault is not None:
        raise field_refusal(field, *fault)


def field_refusal(field: str, code: str, message: str) -> InvalidRequest:
    """The refusal of one field."""
    return InvalidRequest(message, code, fields=[FieldError(field, code, message)])


class Passwords:
    """Makes and compares hashes, from any thread. Raises TooManyTries when too many want to."""

    def __init__(self) -> None:
        self._hasher = PasswordHasher()
        self._turns = threading.BoundedSemaphore(HASHES_AT_ONCE)
        # Of a password that nobody has: compared where there is no account, for the same time.
        self._nobodys = self._hasher.hash(secrets.token_hex())

    def hashed(self, password: str) -> str:
        """A password with a new salt, as one line of text."""
        with self._turn():
            return self._hasher.hash(normal(password))

    def matches(self, stored: str | None, password: str) -> bool:
        """Whether a password is the kept one. None, of nobody, takes as long and is False."""
        with self._turn():
            try:
                self._hasher.verify(stored or self._nobodys, normal(password))
            except (VerificationError, InvalidHashError):
                return False
        return stored is not None

    @contextmanager
    def _turn(self) -> Iterator[None]:
        if not self._turns.acquire(timeout=TURN_S):
            raise TooManyTries("Too many passwords are being looked at: try again.", TURN_S)
        try:
            yield
        finally:
            self._turns.release()
