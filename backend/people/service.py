"""Accounts and keys, as administrators manage them; how the first administrator comes; and who
sends a request.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from datetime import datetime
from typing import Any

from backend.core.person import ROLES, Caller, Permission, Person, RoleName
from backend.errors import NotAllowed
from backend.people.names import good_name
from backend.people.passkeys.records import PasskeyStore, end_passkeys
from backend.people.passkeys.service import Passkeys
from backend.people.passwords import Passwords, field_refusal, require_good
from backend.people.records import AccountStore, KeyStore, Made, SessionStore, WithPerson
from backend.people.sign_in import SignIn
from backend.people.tokens import KEY_FORM, Tickets, is_secret_of, new_key, new_token, token_sha256
from backend.people.types import ApiKey, PersonChange
from backend.store.sql.database import Database

USED = "This link was used, or is of an earlier start: the server prints a new one when it starts."


class Accounts:
    """Accounts, from any thread."""

    def __init__(self, accounts: AccountStore, passwords: Passwords) -> None:
        self._accounts = accounts
        self._passwords = passwords
        self._turn = threading.Lock()
        self._first: str | None = None

    def list(self) -> tuple[Person, ...]:
        """Everybody, by name. Raises StoreError."""
        return self._accounts.list()

    def add(self, name: str, role: RoleName, password: str) -> Person:
        """A new account. Raises InvalidRequest, Conflict `name_taken`, StoreError."""
        name = good_name(name)
        require_good(password, name)
        return self._accounts.add(name, role, self._passwords.hashed(password))

    def add_rider(self, name: str, password: str, then: WithPerson[Made]) -> tuple[Person, Made]:
        """A new account of a rider, and what is made with it in the same transaction; both or
        neither. Raises as `add`, and as `then`.
        """
        name = good_name(name)
        require_good(password, name)
        return self._accounts.add_with(name, "rider", self._passwords.hashed(password), then)

    def get(self, person_id: int) -> Person:
        """One account. Raises NotFound, StoreError."""
        return self._accounts.get(person_id)

    def remove(self, person_id: int) -> None:
        """An account with all it has. Raises NotFound, Conflict `last_admin`, StoreError."""
        self._accounts.remove(person_id)

    def change(self, person_id: int, change: PersonChange) -> Person:
        """Another name, role or password, disabled or enabled; whoever it is signs in anew where
        the password or the right to be here went. With another password the passkeys go: whoever
        had the account may have left one.

        Raises NotFound, InvalidRequest, Conflict `name_taken` and `last_admin`, StoreError.
        """
        changes: dict[str, Any] = {}
        if change.name is not None:
            changes["name"] = good_name(change.name)
        if change.role is not None:
            changes["role"] = change.role
        if change.enabled is not None:
            changes["enabled"] = change.enabled
        if change.password is not None:
            name = changes.get("name") or self.get(person_id).name
            password = change.password.get_secret_value()
            require_good(password, name)
            changes["password"] = self._passwords.hashed(password)
        sign_out = change.password is not None or change.enabled is False
        if change.password is None:
            return self._accounts.change(person_id, changes, sign_out)
        return self._accounts.change(person_id, changes, sign_out, end_passkeys)

    def has_admin(self) -> bool:
        """Whether anybody may manage people. Raises StoreError."""
        return self._accounts.has_admin()

    def first_token(self) -> str | None:
        """What makes the first administrator, once; None where there is one. Raises StoreError."""
        if self._accounts.has_admin():
            return None
        token = new_token()
        with self._turn:
            self._first = token_sha256(token)
        return token

    def make_first(self, token: str, name: str, password: str) -> Person:
        """The first administrator. Raises NotAllowed `link_used`, InvalidRequest, Conflict."""
        with self._turn:
            if self._first is None or not is_secret_of(self._first, token):
                raise NotAllowed(USED, "link_used")
            name = good_name(name)
            require_good(password, name)
            hashed = self._passwords.hashed(password)
            person = self._accounts.add(name, "admin", hashed, only_first=True)
            self._first = None
            return person


class Keys:
    """Keys of programs, from any thread."""

    def __init__(self, keys: KeyStore) -> None:
        self._keys = keys

    def list(self, person_id: int | None = None) -> tuple[ApiKey, ...]:
        """Keys of a person, or all, newest first. Raises StoreError."""
        return self._keys.list(person_id)

    def add(
        self,
        person_id: int,
        name: str,
        scopes: Iterable[Permission],
        expires_at: datetime | None,
        bike_id: int | None = None,
    ) -> tuple[ApiKey, str]:
        """A new key and what a program sends, which is shown only this once.

        bike_id: the one bike it sends files of. Raises InvalidRequest, NotFound, StoreError.
        """
        if bike_id is not None and set(scopes) != {Permission.UPLOAD_FILES}:
            message = "A key for one bike can only send files: its one scope is upload_files."
            raise field_refusal("scopes", "only_files_of_a_bike", message)
        now_us = time.time_ns() // 1000
        expires_us = None if expires_at is None else round(expires_at.timestamp() * 1e6)
        if expires_us is not None and expires_us <= now_us:
            raise field_refusal("expires_at", "in_the_past", "This moment is over already.")
        shown, prefix, secret = new_key()
        key = self._keys.add(
            person_id,
            good_name(name),
            scopes,
            prefix,
            token_sha256(secret),
            now_us,
            expires_us,
            bike_id,
        )
        return key, shown

    def revoke(self, key_id: int, person_id: int | None = None) -> None:
        """End a key, if need be only of this person. Raises NotFound, StoreError."""
        self._keys.revoke(key_id, time.time_ns() // 1000, person_id)

    def caller(self, shown: str) -> Caller | None:
        """Who sends a key: its person, with what the key is for and the role still allows; None
        where it is none, is over or was revoked. Raises StoreError."""
        form = KEY_FORM.fullmatch(shown)
        now_us = time.time_ns() // 1000
        matching_key = self._keys.of_prefix(form[1], now_us) if form else None
        if form is None or matching_key is None or not is_secret_of(matching_key[2], form[2]):
            return None
        key, person, _ = matching_key
        self._keys.note_use(key, now_us)
        return caller_by(key, person)

    def renewed(self, caller: Caller) -> Caller | None:
        """What a key is for now; None where it is over or was revoked. Raises StoreError."""
        matching_key = self._keys.of_number(caller.key_id or 0, time.time_ns() // 1000)
        if matching_key is None:
            return None
        key, person, _ = matching_key
        return caller_by(key, person)


def caller_by(key: ApiKey, person: Person) -> Caller:
    """Who sends a key, with what it is for and the person's role still allows."""
    permissions = ROLES[person.role] & set(key.scopes)
    return Caller(person, permissions, key_id=key.id, key_name=key.name, bike_id=key.bike_id)


class PeopleService:
    """All that is asked of people and their keys, from any thread.

    sign_in: browsers. passkeys: those that sign in without a password. keys: programs. tickets:
    sockets of programs. now_s: a clock that only goes forward.
    """

    def __init__(self, database: Database, now_s: Callable[[], float] = time.monotonic) -> None:
        passwords = Passwords()
        accounts = AccountStore(database)
        self.accounts = Accounts(accounts, passwords)
        self.sign_in = SignIn(accounts, SessionStore(database), passwords, now_s)
        self.passkeys = Passkeys(PasskeyStore(database), self.sign_in, now_s)
        self.keys = Keys(KeyStore(database))
        self.tickets = Tickets()

    def of_key(self, key: str) -> Caller | None:
        """Who sends a key. Raises StoreError."""
        return self.keys.caller(key)

    def of_ticket(self, ticket: str) -> Caller | None:
        """Who opens a socket with a ticket; it opens no other. Raises StoreError."""
        caller = self.tickets.take(ticket)
        return None if caller is None else self.renewed(caller)

    def renewed(self, caller: Caller) -> Caller | None:
        """A caller as they are now; None where their session or key is over. Raises StoreError."""
        of = self.sign_in if caller.session_id is not None else self.keys
        return of.renewed(caller)

    def of_session(self, token: str) -> Caller | None:
        """Whose browser sends a cookie. Raises StoreError."""
        return self.sign_in.of_token(token)
