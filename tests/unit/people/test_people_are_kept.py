"""Goal: accounts, sessions and keys are kept, end when they should, and hold no secret.

Method: a store on SQLite; times are given, none passes.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.core.moments import utc
from backend.core.person import Permission
from backend.errors import Conflict, NotFound
from backend.people.passwords import Passwords
from backend.people.records import (
    AGE_MAX_US,
    HOUR_US,
    IDLE_US,
    SESSIONS_MAX,
    AccountStore,
    KeyStore,
    SessionStore,
)
from backend.people.tokens import new_key, new_token, token_sha256
from backend.store import Store, open_store

NOW_US = 1_800_000_000_000_000


class Records:
    def __init__(self, store: Store) -> None:
        self.wait_written = store.database.wait_written
        self.accounts = AccountStore(store.database)
        self.sessions = SessionStore(store.database)
        self.keys = KeyStore(store.database)


@pytest.fixture
def records(tmp_path: Path) -> Iterator[Records]:
    url = f"sqlite:///{tmp_path}/spindle.db"
    with open_store(url, (tmp_path / "objects").as_uri()) as store:
        yield Records(store)


def signed_in(records: Records, person_id: int, token: str, at_us: int = NOW_US) -> bool:
    return records.sessions.open(person_id, "hash", token_sha256(token), at_us)


def test_a_name_is_one_person_s_whatever_its_case(records: Records) -> None:
    anna = records.accounts.add("Anna Müller", "admin", "hash")

    with pytest.raises(Conflict, match="ANNA"):
        records.accounts.add("ANNA MÜLLER", "rider", "hash")

    found = records.accounts.with_password("anna müller")
    assert found is not None
    assert found == (anna, "hash")


def test_there_is_one_first_administrator(records: Records) -> None:
    records.accounts.add("Anna", "admin", "hash", only_first=True)

    with pytest.raises(Conflict):
        records.accounts.add("Mallory", "admin", "hash", only_first=True)


@pytest.mark.parametrize("change", [{"enabled": False}, {"role": "dealer"}])
def test_the_last_administrator_stays_one(records: Records, change: dict[str, object]) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")

    with pytest.raises(Conflict, match="Nobody would be left"):
        records.accounts.change(anna.id, change, sign_out=False)

    assert records.accounts.list()[0] == anna


def test_a_session_ends_a_day_after_its_last_use(records: Records) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")
    token = new_token()
    assert signed_in(records, anna.id, token)

    almost = records.sessions.of_token(token_sha256(token), NOW_US + IDLE_US - 1)
    records.wait_written()
    later = records.sessions.of_token(token_sha256(token), NOW_US + 2 * IDLE_US - 2)

    assert almost is not None
    assert later is not None
    records.wait_written()
    assert records.sessions.of_token(token_sha256(token), NOW_US + 3 * IDLE_US) is None


def test_a_session_that_is_used_all_the_time_ends_after_thirty_days(records: Records) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")
    token = new_token()
    signed_in(records, anna.id, token)

    for hour in range(12, 30 * 24, 12):
        assert records.sessions.of_token(token_sha256(token), NOW_US + hour * HOUR_US) is not None
        records.wait_written()

    assert records.sessions.of_token(token_sha256(token), NOW_US + AGE_MAX_US + 1) is None


def test_a_password_that_was_changed_meanwhile_opens_no_session(records: Records) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")
    records.accounts.change(anna.id, {"password": "another"}, sign_out=True)

    assert not signed_in(records, anna.id, new_token())


def test_a_disabled_person_s_sessions_and_keys_end_at_once(records: Records) -> None:
    records.accounts.add("Anna", "admin", "hash")
    bruno = records.accounts.add("Bruno", "dealer", "hash")
    token = new_token()
    signed_in(records, bruno.id, token)
    _, prefix, secret = new_key()
    records.keys.add(
        bruno.id, "field", [Permission.UPLOAD_FILES], prefix, token_sha256(secret), NOW_US, None
    )
    assert records.keys.of_prefix(prefix, NOW_US) is not None

    records.accounts.change(bruno.id, {"enabled": False}, sign_out=True)

    assert records.sessions.of_token(token_sha256(token), NOW_US) is None
    assert records.keys.of_prefix(prefix, NOW_US) is None
    assert not signed_in(records, bruno.id, new_token())


def test_one_person_has_so_many_browsers_and_no_more(records: Records) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")
    tokens = [new_token() for _ in range(SESSIONS_MAX + 1)]
    for token in tokens:
        signed_in(records, anna.id, token)

    alive = [records.sessions.of_token(token_sha256(token), NOW_US) is not None for token in tokens]
    assert alive == [False] + [True] * SESSIONS_MAX


def test_a_key_is_over_at_its_end_and_when_it_is_revoked(records: Records) -> None:
    anna = records.accounts.add("Anna", "admin", "hash")
    ends_us = NOW_US + HOUR_US
    scopes = [Permission.UPLOAD_FILES]
    first = records.keys.add(anna.id, "one", scopes, "aaaaaaaa", token_sha256("s"), NOW_US, ends_us)
    second = records.keys.add(anna.id, "two", scopes, "bbbbbbbb", token_sha256("s"), NOW_US, None)

    assert records.keys.of_prefix(first.prefix, ends_us - 1) is not None
    assert records.keys.of_prefix(first.prefix, ends_us) is None
    records.keys.revoke(second.id, NOW_US)
    records.keys.revoke(second.id, NOW_US + 5)
    assert records.keys.of_prefix(second.prefix, NOW_US) is None
    assert [key.revoked_at for key in records.keys.list()] == [utc(NOW_US), None]
    with pytest.raises(NotFound):
        records.keys.revoke(99, NOW_US)


def test_the_file_holds_neither_password_nor_token_nor_secret(tmp_path: Path) -> None:
    password, token = "eine lange Nacht", new_token()
    shown, prefix, secret = new_key()
    passwords = Passwords()
    database = tmp_path / "spindle.db"
    with open_store(f"sqlite:///{database}", (tmp_path / "objects").as_uri()) as store:
        records = Records(store)
        hashed = passwords.hashed(password)
        anna = records.accounts.add("Anna", "admin", hashed)
        assert records.sessions.open(anna.id, hashed, token_sha256(token), NOW_US)
        records.keys.add(
            anna.id, "k", [Permission.UPLOAD_FILES], prefix, token_sha256(secret), NOW_US, None
        )

    with sqlite3.connect(database) as connection:
        told = "\n".join(connection.iterdump())

    assert "Anna" in told
    assert not [one for one in (password, token, shown, secret) if one in told]


def test_a_hash_is_argon2id_with_a_salt_of_its_own() -> None:
    passwords = Passwords()
    first, second = passwords.hashed("eine lange Nacht"), passwords.hashed("eine lange Nacht")

    assert first != second
    # RFC 9106, 4: the second recommended option is 64 MiB and three passes.
    assert first.startswith("$argon2id$v=19$m=65536,t=3,p=4$")
    assert passwords.matches(first, "eine lange Nacht")
    assert not passwords.matches(first, "eine lange nacht")
    assert not passwords.matches(None, "eine lange Nacht")
