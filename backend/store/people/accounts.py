"""Accounts by number and by name. One that is disabled stays: what it did names it."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from sqlalchemy import Connection, Row, delete, func, insert, select, update

from backend.domain.people.permission import RoleName
from backend.domain.people.person import Person, folded
from backend.errors import Conflict, NotFound
from backend.store.sql import tables as t
from backend.store.sql.database import Database

# More than a large workshop has; bounds what a list holds.
ACCOUNTS_MAX = 10_000


class AccountStore:
    """The accounts there are, from any thread."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def list(self) -> tuple[Person, ...]:
        """Everybody, by name."""
        query = select(t.account).order_by(t.account.c.folded)
        rows = self._database.read(lambda connection: connection.execute(query).all())
        return tuple(person_of(row) for row in rows)

    def has_admin(self) -> bool:
        """Whether somebody can sign in who may manage people."""
        return self._database.read(lambda connection: admins(connection) > 0)

    def with_password(self, name: str) -> tuple[Person, str] | None:
        """Who is called so and the hash of the password; None where nobody is."""
        query = select(t.account).where(t.account.c.folded == folded(name))
        row = self._database.read(lambda connection: connection.execute(query).first())
        return None if row is None else (person_of(row), row.password)

    def add(self, name: str, role: RoleName, password: str, only_first: bool = False) -> Person:
        """A new account. password: its hash. only_first: if there is no administrator yet.

        Raises Conflict `name_taken`, `people_full`, `not_the_first`; StoreError.
        """
        values = {
            "name": name,
            "folded": folded(name),
            "role": role,
            "enabled": True,
            "password": password,
            "created_us": now_us(),
        }

        def work(connection: Connection) -> Person:
            if only_first and admins(connection):
                raise Conflict("There is an administrator already: sign in.", "not_the_first")
            count = connection.execute(select(func.count()).select_from(t.account)).scalar_one()
            if count >= ACCOUNTS_MAX:
                raise Conflict(f"There are {ACCOUNTS_MAX} accounts, and no more.", "people_full")
            taken = select(t.account.c.id).where(t.account.c.folded == folded(name))
            if connection.execute(taken).first() is not None:
                raise Conflict(f"Somebody is called {name!r} already.", "name_taken")
            made = insert(t.account).values(values).returning(t.account)
            return person_of(connection.execute(made).one())

        return self._database.write(work)

    def change(self, person_id: int, changes: Mapping[str, Any], sign_out: bool) -> Person:
        """Give an account another role or password (its hash), or disable or enable it.

        sign_out: every browser it signed in with. Raises NotFound; Conflict `last_admin` where
        nobody would be left who may manage people; StoreError.
        """

        def work(connection: Connection) -> Person:
            mine = t.account.c.id == person_id
            found = connection.execute(select(t.account).where(mine)).first()
            if found is None:
                raise NotFound(f"There is no account {person_id}.")
            had_admin = admins(connection) > 0
            if changes:
                connection.execute(update(t.account).where(mine).values(**changes))
            if had_admin and not admins(connection):
                message = "Nobody would be left who may manage people: make another admin first."
                raise Conflict(message, "last_admin")
            if sign_out:
                connection.execute(delete(t.session).where(t.session.c.account_id == person_id))
            return person_of(connection.execute(select(t.account).where(mine)).one())

        return self._database.write(work)


def admins(connection: Connection) -> int:
    """How many may manage people and can sign in."""
    able = (t.account.c.role == "admin") & t.account.c.enabled
    query = select(func.count()).select_from(t.account).where(able)
    return int(connection.execute(query).scalar_one())


def person_of(row: Row[Any]) -> Person:
    """A row of `account`, or of a join that has its columns."""
    return Person(
        id=row.id,
        name=row.name,
        role=row.role,
        enabled=row.enabled,
        created_us=row.created_us,
        signed_in_us=row.signed_in_us,
    )


def now_us() -> int:
    """Unix time."""
    return time.time_ns() // 1000
