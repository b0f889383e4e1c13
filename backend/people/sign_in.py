"""Signing in and out. The answer to a wrong name and to a wrong password is the same, and takes as
long; each further try waits, by the name and by the address it comes from.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from backend.core.person import Caller, Person, folded
from backend.errors import NotSignedIn
from backend.people.passwords import Passwords, field_refusal, require_good
from backend.people.records import AccountStore, SessionStore
from backend.people.throttle import Throttle, begin
from backend.people.tokens import new_token, token_sha256
from backend.people.types import PASSWORD_LENGTH_MAX

# NIST SP 800-63B, 3.2.2 allows 100 in a row; a person who mistypes needs a few.
FREE_BY_NAME = 5
# A workshop behind one address has many who mistype.
FREE_BY_ADDRESS = 30
WRONG = "Name or password is wrong."


class SignIn:
    """Sessions of browsers, from any thread. now_s: a clock that only goes forward."""

    def __init__(
        self,
        accounts: AccountStore,
        sessions: SessionStore,
        passwords: Passwords,
        now_s: Callable[[], float] = time.monotonic,
        now_us: Callable[[], int] = lambda: time.time_ns() // 1000,
    ) -> None:
        self._accounts = accounts
        self._sessions = sessions
        self._passwords = passwords
        self._now_s = now_s
        self._now_us = now_us
        self._turn = threading.Lock()
        self._by_name = Throttle(FREE_BY_NAME)
        self._by_address = Throttle(FREE_BY_ADDRESS)

    def sign_in(self, name: str, password: str, address: str) -> tuple[str, Person]:
        """A new session's token, and who it is. address: where the request comes from.

        Raises NotSignedIn `wrong_password`, TooManyTries, StoreError.
        """
        key = folded(name)
        self._begin(key, address)
        person, password_hash = self._verified(name, password)
        token = new_token()
        if not self._sessions.open(person.id, password_hash, token_sha256(token), self._now_us()):
            raise NotSignedIn(WRONG, "wrong_password")
        self._succeed(key, address)
        return token, person

    def sign_out(self, caller: Caller, everywhere: bool) -> None:
        """End this session, or all of this person's. Raises StoreError."""
        if everywhere:
            self._sessions.close_all(caller.person.id)
        elif caller.session_id is not None:
            self._sessions.close(caller.session_id)

    def change_password(self, caller: Caller, old: str, new: str, address: str) -> str:
        """Give oneself another password; every session ends, the new one's token is returned.

        Raises InvalidRequest, TooManyTries, StoreError.
        """
        require_good(new, caller.person.name, "new")
        self.require_own_password(caller, old, address, "old")
        hashed = self._passwords.hashed(new)
        self._accounts.change(caller.person.id, {"password": hashed}, sign_out=True)
        token = new_token()
        if not self._sessions.open(caller.person.id, hashed, token_sha256(token), self._now_us()):
            raise NotSignedIn(WRONG, "wrong_password")
        return token

    def require_own_password(
        self, caller: Caller, password: str, address: str, field: str = "password"
    ) -> None:
        """Raises InvalidRequest `wrong_password` for another than the caller's, TooManyTries,
        StoreError. field: what the request calls it.
        """
        name = caller.person.name
        self._begin(folded(name), address)
        try:
            self._verified(name, password)
        except NotSignedIn:
            # The user is known: it is one field that is wrong.
            raise field_refusal(field, "wrong_password", "This is not your password.") from None
        self._succeed(folded(name), address)

    @contextmanager
    def counted(self, address: str) -> Iterator[None]:
        """A try to sign in without a name; what raises in it counts as a wrong one.

        Raises TooManyTries where it comes too soon.
        """
        with self._turn:
            begin(self._now_s(), "passkeys", (self._by_address, address))
        yield
        with self._turn:
            self._by_address.take_back(address)

    def of_token(self, token: str) -> Caller | None:
        """Who has a session's token; None where it is over or was never. Raises StoreError."""
        session = self._sessions.of_token(token_sha256(token), self._now_us())
        if session is None:
            return None
        session_id, person = session
        return Caller(person, person.permissions, by_cookie=True, session_id=session_id)

    def renewed(self, caller: Caller) -> Caller | None:
        """Who has a session now; None where it is over. Raises StoreError."""
        person = self._sessions.person_of(caller.session_id or 0, self._now_us())
        if person is None:
            return None
        return replace(caller, person=person, permissions=person.permissions)

    def _verified(self, name: str, password: str) -> tuple[Person, str]:
        """The person of a right password, and its hash."""
        account = self._accounts.with_password(name)
        password_hash = account[1] if account else None
        right = self._passwords.matches(password_hash, password[: PASSWORD_LENGTH_MAX + 1])
        if not right or account is None or not account[0].enabled:
            raise NotSignedIn(WRONG, "wrong_password")
        return account

    def _begin(self, name: str, address: str) -> None:
        """Counts a try. Raises TooManyTries where it comes too soon."""
        with self._turn:
            tries = ((self._by_name, name), (self._by_address, address))
            begin(self._now_s(), "passwords", *tries)

    def _succeed(self, name: str, address: str) -> None:
        with self._turn:
            self._by_name.forget(name)
            self._by_address.take_back(address)
