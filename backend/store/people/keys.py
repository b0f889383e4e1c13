"""Keys of programs. Of the secret only a hash is kept; it is random: a plain hash will do."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sqlalchemy import Connection, Row, Select, func, insert, select, update

from backend.domain.people.permission import Permission
from backend.domain.people.person import ApiKey, Person
from backend.errors import Conflict, NotFound
from backend.store.people.accounts import person_of
from backend.store.sql import tables as t
from backend.store.sql.database import Database

NOTED_EVERY_US = 60_000_000
# Revoked ones too: what a key did stays explained.
KEYS_MAX = 10_000


class KeyStore:
    """Keys by number and by prefix, from any thread. All times in Unix microseconds."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def list(self) -> tuple[ApiKey, ...]:
        """Every key, newest first, revoked ones too."""
        query = keys().order_by(t.api_key.c.id.desc())
        rows = self._database.read(lambda connection: connection.execute(query).all())
        return tuple(key_of(row) for row in rows)

    def add(
        self,
        person_id: int,
        name: str,
        scopes: Iterable[Permission],
        prefix: str,
        secret_sha256: str,
        now_us: int,
        expires_us: int | None,
    ) -> ApiKey:
        """A new key of a person. Raises NotFound, Conflict `keys_full`, StoreError."""
        values = {
            "account_id": person_id,
            "name": name,
            "prefix": prefix,
            "secret_sha256": secret_sha256,
            "scopes": sorted(scopes),
            "created_us": now_us,
            "expires_us": expires_us,
        }

        def work(connection: Connection) -> ApiKey:
            whose = select(t.account.c.id).where(t.account.c.id == person_id)
            if connection.execute(whose).first() is None:
                raise NotFound(f"There is no account {person_id}.")
            count = connection.execute(select(func.count()).select_from(t.api_key)).scalar_one()
            if count >= KEYS_MAX:
                raise Conflict(f"There are {KEYS_MAX} keys, and no more.", "keys_full")
            made = insert(t.api_key).values(values).returning(t.api_key.c.id)
            number = connection.execute(made).scalar_one()
            return key_of(connection.execute(keys().where(t.api_key.c.id == number)).one())

        return self._database.write(work)

    def revoke(self, key_id: int, now_us: int) -> None:
        """End a key; ended again it stays as it is. Raises NotFound, StoreError."""

        def work(connection: Connection) -> None:
            mine = t.api_key.c.id == key_id
            if connection.execute(select(t.api_key.c.id).where(mine)).first() is None:
                raise NotFound(f"There is no key {key_id}.")
            still = mine & t.api_key.c.revoked_us.is_(None)
            connection.execute(update(t.api_key).where(still).values(revoked_us=now_us))

        self._database.write(work)

    def of_prefix(self, prefix: str, now_us: int) -> tuple[ApiKey, Person, str] | None:
        """A key that counts, whose it is, and the hash of its secret; None where there is none."""
        query = (
            select(
                t.account,
                t.api_key.c.id.label("key_id"),
                t.api_key.c.secret_sha256,
            )
            .join(t.api_key, t.api_key.c.account_id == t.account.c.id)
            .where(
                t.api_key.c.prefix == prefix,
                t.account.c.enabled,
                t.api_key.c.revoked_us.is_(None),
                t.api_key.c.expires_us.is_(None) | (t.api_key.c.expires_us > now_us),
            )
        )

        def work(connection: Connection) -> tuple[ApiKey, Person, str] | None:
            row = connection.execute(query).first()
            if row is None:
                return None
            key = connection.execute(keys().where(t.api_key.c.id == row.key_id)).one()
            return key_of(key), person_of(row), row.secret_sha256

        return self._database.read(work)

    def note_use(self, key: ApiKey, now_us: int) -> None:
        """That a key was used; nobody waits for it."""
        if key.used_us is None or now_us - key.used_us > NOTED_EVERY_US:
            noted = update(t.api_key).where(t.api_key.c.id == key.id).values(used_us=now_us)
            self._database.submit(lambda connection: connection.execute(noted).rowcount)


def keys() -> Select[Any]:
    """Every key with its person's name."""
    owner = t.account.c.name.label("person_name")
    return select(t.api_key, owner).join(t.account, t.account.c.id == t.api_key.c.account_id)


def key_of(row: Row[Any]) -> ApiKey:
    """A row of `keys`. A scope that this version does not know allows nothing."""
    known = {str(permission) for permission in Permission}
    return ApiKey(
        id=row.id,
        person_id=row.account_id,
        person_name=row.person_name,
        name=row.name,
        prefix=row.prefix,
        scopes=frozenset(Permission(scope) for scope in row.scopes if scope in known),
        created_us=row.created_us,
        expires_us=row.expires_us,
        used_us=row.used_us,
        revoked_us=row.revoked_us,
    )
