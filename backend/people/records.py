"""Accounts, the browsers that are signed in, and the keys of programs, in the database.

An account that is disabled stays: what it did names it. Of a session's token and of a key only a
hash is kept: a copy of the database opens nothing. They are random, so a plain hash will do. A
session ends when it was not used for a while, and after some time whatever is done with it. All
times are Unix microseconds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeAlias, TypeVar

from sqlalchemy import ColumnElement, Connection, Row, Select, delete, func, insert, select, update

from backend.core.actor import actor_of_person
from backend.core.audit import Action, AuditEntry, Members, differing
from backend.core.moments import utc, utc_or_none
from backend.core.person import Permission, Person, RoleName, folded
from backend.errors import Conflict, NotFound
from backend.people.types import ApiKey
from backend.store import audit
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.wall_clock import now_us

# More than a large workshop has; bounds what a list holds.
ACCOUNTS_MAX = 10_000
# Revoked ones too: what a key did stays explained.
KEYS_MAX = 10_000
HOUR_US = 3_600_000_000
# A day's work and the night after it; NIST SP 800-63B, 2.1.3: 30 days at the most.
IDLE_US = 24 * HOUR_US
AGE_MAX_US = 30 * 24 * HOUR_US
# Of one person: the oldest goes first. Protects the table.
SESSIONS_MAX = 50
# A use is noted so seldom that a page that asks twice a second does not keep the disk busy.
USE_RECORDED_EVERY_US = 60_000_000


Made = TypeVar("Made")
WithPerson: TypeAlias = Callable[[Connection, Person], Made]


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

        def work(connection: Connection) -> Person:
            if only_first and admins(connection):
                raise Conflict("There is an administrator already: sign in.", "not_the_first")
            person = added(connection, name, role, password)
            # Whoever has the link is nobody yet.
            who = actor_of_person(person) if only_first else None
            action = Action.ACCOUNT_FIRST_ADDED if only_first else Action.ACCOUNT_ADDED
            audit.append(connection, of_account(action, person, after=facts_of(person)), who)
            return person

        return self._database.write(work)

    def add_with(
        self, name: str, role: RoleName, password: str, then: WithPerson[Made]
    ) -> tuple[Person, Made]:
        """As `add`, and something made with it in the same transaction; both or neither."""

        def work(connection: Connection) -> tuple[Person, Made]:
            person = added(connection, name, role, password)
            entry = of_account(Action.ACCOUNT_ADDED, person, after=facts_of(person))
            audit.append(connection, entry, actor_of_person(person))
            return person, then(connection, person)

        return self._database.write(work)

    def get(self, person_id: int) -> Person:
        """One account. Raises NotFound."""
        return self._database.read(lambda connection: account_of(connection, person_id))

    def change(
        self,
        person_id: int,
        changes: Mapping[str, Any],
        sign_out: bool,
        then: WithPerson[None] = lambda connection, person: None,
    ) -> Person:
        """Give an account another name, role or password (its hash), or disable or enable it.

        sign_out: every browser it signed in with. then: what is done with it in the same
        transaction. Raises NotFound; Conflict `name_taken`, and `last_admin` where nobody would be
        left who may manage people; StoreError.
        """

        def work(connection: Connection) -> Person:
            before = account_of(connection, person_id)
            values = dict(changes)
            if "name" in values:
                values["folded"] = folded(values["name"])
                if values["folded"] != folded(before.name):
                    require_free(connection, values["name"])
            had_admin = admins(connection) > 0
            if values:
                mine = t.account.c.id == person_id
                connection.execute(update(t.account).where(mine).values(**values))
            require_admin(connection, had_admin)
            if sign_out:
                connection.execute(delete(t.session).where(t.session.c.account_id == person_id))
            after = account_of(connection, person_id)
            old, new = differing(facts_of(before), facts_of(after))
            if new:
                entry = of_account(Action.ACCOUNT_CHANGED, after, before=old, after=new)
                audit.append(connection, entry)
            if "password" in values:
                audit.append(connection, of_account(Action.ACCOUNT_PASSWORD_SET, after))
            then(connection, after)
            return after

        return self._database.write(work)

    def remove(self, person_id: int) -> None:
        """Remove an account with its ways in; its bikes and rides are nobody's then.

        Raises NotFound, Conflict `last_admin`.
        """

        def work(connection: Connection) -> None:
            person = account_of(connection, person_id)
            had_admin = admins(connection) > 0
            keys = select(t.api_key.c.id).where(t.api_key.c.account_id == person_id)
            by_key = update(t.upload).where(t.upload.c.key_id.in_(keys))
            connection.execute(by_key.values(key_id=None))
            for table in (t.session, t.passkey, t.api_key):
                connection.execute(delete(table).where(table.c.account_id == person_id))
            owner = t.bike_owner.c.account_id == person_id
            still = owner & t.bike_owner.c.to_us.is_(None)
            connection.execute(update(t.bike_owner).where(still).values(to_us=now_us()))
            connection.execute(update(t.bike_owner).where(owner).values(account_id=None))
            for table in (t.ride, t.upload):
                own = table.c.owner_id == person_id
                connection.execute(update(table).where(own).values(owner_id=None))
            connection.execute(delete(t.account).where(t.account.c.id == person_id))
            require_admin(connection, had_admin)
            entry = of_account(Action.ACCOUNT_REMOVED, person, before=facts_of(person))
            audit.append(connection, entry)

        self._database.write(work)


def added(connection: Connection, name: str, role: RoleName, password: str) -> Person:
    """A new account. Raises Conflict `name_taken`, `people_full`."""
    count = connection.execute(select(func.count()).select_from(t.account)).scalar_one()
    if count >= ACCOUNTS_MAX:
        raise Conflict(f"There are {ACCOUNTS_MAX} accounts, and no more.", "people_full")
    require_free(connection, name)
    values = {
        "name": name,
        "folded": folded(name),
        "role": role,
        "enabled": True,
        "password": password,
        "created_us": now_us(),
    }
    made = insert(t.account).values(values).returning(t.account)
    return person_of(connection.execute(made).one())


def account_of(connection: Connection, person_id: int) -> Person:
    """One account. Raises NotFound."""
    row = connection.execute(select(t.account).where(t.account.c.id == person_id)).first()
    if row is None:
        raise NotFound(f"There is no account {person_id}.")
    return person_of(row)


def facts_of(person: Person) -> Members:
    """What the audit tells of an account; never a password, nor its hash."""
    return {"name": person.name, "role": person.role, "enabled": person.enabled}


def of_account(
    action: Action, person: Person, before: Members | None = None, after: Members | None = None
) -> AuditEntry:
    """Something that was done to an account."""
    return AuditEntry(action, person.id, person.name, before, after)


def require_free(connection: Connection, name: str) -> None:
    """Raises Conflict `name_taken`."""
    taken = select(t.account.c.id).where(t.account.c.folded == folded(name))
    if connection.execute(taken).first() is not None:
        raise Conflict(f"Somebody is called {name!r} already.", "name_taken")


def require_admin(connection: Connection, had_admin: bool) -> None:
    """Raises Conflict `last_admin` where nobody is left who may manage people."""
    if had_admin and not admins(connection):
        message = "Nobody would be left who may manage people: make another admin first."
        raise Conflict(message, "last_admin")


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
        created_at=utc(row.created_us),
        signed_in_at=utc_or_none(row.signed_in_us),
    )


class SessionStore:
    """Sessions by the hash of their token, from any thread. All times in Unix microseconds."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def open(self, person_id: int, password: str, token_sha256: str, now_us: int) -> bool:
        """A new session of a person whose password was looked at.

        password: its hash. False, and nothing is opened, where the account was disabled or given
        another password since. Raises StoreError.
        """
        same = (t.account.c.id == person_id) & (t.account.c.password == password)
        return self._database.write(
            lambda connection: begun(connection, same, token_sha256, now_us) is not None
        )

    def of_token(self, token_sha256: str, now_us: int) -> tuple[int, Person] | None:
        """The session's number and whose it is; None where it is over or the account disabled."""
        query = sessions(now_us).where(t.session.c.token_sha256 == token_sha256)
        row = self._database.read(lambda connection: connection.execute(query).first())
        if row is None:
            return None
        if now_us - row.used_us > USE_RECORDED_EVERY_US:
            use = update(t.session).where(t.session.c.id == row.session_id)
            # Nobody waits for it, and a full disk signs nobody out.
            self._database.submit(lambda c: c.execute(use.values(used_us=now_us)).rowcount)
        return row.session_id, person_of(row)

    def person_of(self, session_id: int, now_us: int) -> Person | None:
        """Whose session it is; None where it is over or the account disabled."""
        query = sessions(now_us).where(t.session.c.id == session_id)
        row = self._database.read(lambda connection: connection.execute(query).first())
        return None if row is None else person_of(row)

    def close(self, session_id: int) -> None:
        """Sign one browser out. Raises StoreError."""
        gone = delete(t.session).where(t.session.c.id == session_id)
        self._database.write(lambda connection: connection.execute(gone).rowcount)

    def close_all(self, person_id: int) -> None:
        """Sign a person out everywhere. Raises StoreError."""
        gone = delete(t.session).where(t.session.c.account_id == person_id)

        def work(connection: Connection) -> None:
            sessions = {"sessions": connection.execute(gone).rowcount}
            person = account_of(connection, person_id)
            entry = of_account(Action.ACCOUNT_SIGNED_OUT_EVERYWHERE, person, before=sessions)
            audit.append(connection, entry)

        self._database.write(work)


def begun(
    connection: Connection,
    which: ColumnElement[bool],
    token_sha256: str,
    now_us: int,
    how: Members | None = None,
) -> Person | None:
    """Whose session began, of an enabled account; None where there is none. how: for the audit."""
    still = update(t.account).where(which & t.account.c.enabled)
    row = connection.execute(still.values(signed_in_us=now_us).returning(t.account)).first()
    if row is None:
        return None
    values = {"account_id": row.id, "created_us": now_us, "used_us": now_us}
    connection.execute(delete(t.session).where(over(now_us)))
    connection.execute(insert(t.session).values(values | {"token_sha256": token_sha256}))
    mine = t.session.c.account_id == row.id
    newest = select(t.session.c.id).where(mine).order_by(t.session.c.id.desc()).limit(SESSIONS_MAX)
    connection.execute(delete(t.session).where(mine & t.session.c.id.not_in(newest)))
    person = person_of(row)
    entry = of_account(Action.ACCOUNT_SIGNED_IN, person, after=how)
    audit.append(connection, entry, actor_of_person(person))
    return person


def sessions(now_us: int) -> Select[Any]:
    """Every session that is not over, with its person, who is enabled."""
    columns = (t.account, t.session.c.id.label("session_id"), t.session.c.used_us)
    joined = select(*columns).join(t.session, t.session.c.account_id == t.account.c.id)
    return joined.where(t.account.c.enabled, ~over(now_us))


def over(now_us: int) -> ColumnElement[bool]:
    """Of a session: it was not used for too long, or began too long ago."""
    return (t.session.c.used_us < now_us - IDLE_US) | (t.session.c.created_us < now_us - AGE_MAX_US)


class KeyStore:
    """Keys by number and by prefix, from any thread. All times in Unix microseconds."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def list(self, person_id: int | None = None) -> tuple[ApiKey, ...]:
        """Keys of a person, or all, newest first, revoked ones too."""
        query = keys().order_by(t.api_key.c.id.desc())
        if person_id is not None:
            query = query.where(t.api_key.c.account_id == person_id)
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
        bike_id: int | None = None,
    ) -> ApiKey:
        """A new key of a person. bike_id: the one bike it is for, of a rider one of their own.

        Raises NotFound, Conflict `keys_full`, StoreError.
        """
        values = {
            "account_id": person_id,
            "name": name,
            "prefix": prefix,
            "secret_sha256": secret_sha256,
            "scopes": sorted(scopes),
            "created_us": now_us,
            "expires_us": expires_us,
            "bike_id": bike_id,
        }

        def work(connection: Connection) -> ApiKey:
            person = account_of(connection, person_id)
            if bike_id is not None:
                require_bike(connection, bike_id, person)
            count = connection.execute(select(func.count()).select_from(t.api_key)).scalar_one()
            if count >= KEYS_MAX:
                raise Conflict(f"There are {KEYS_MAX} keys, and no more.", "keys_full")
            made = insert(t.api_key).values(values).returning(t.api_key.c.id)
            number = connection.execute(made).scalar_one()
            key = key_of(connection.execute(keys().where(t.api_key.c.id == number)).one())
            audit.append(connection, of_key(Action.KEY_ADDED, key, after=facts_of_key(key)))
            return key

        return self._database.write(work)

    def revoke(self, key_id: int, now_us: int, person_id: int | None = None) -> None:
        """End a key, if need be only of this person; ended again it stays as it is.

        Raises NotFound, StoreError.
        """

        def work(connection: Connection) -> None:
            mine = t.api_key.c.id == key_id
            if person_id is not None:
                mine &= t.api_key.c.account_id == person_id
            row = connection.execute(keys().where(mine)).first()
            if row is None:
                raise NotFound(f"There is no key {key_id}.")
            still = mine & t.api_key.c.revoked_us.is_(None)
            ended = connection.execute(update(t.api_key).where(still).values(revoked_us=now_us))
            if ended.rowcount:
                key = key_of(row)
                entry = of_key(Action.KEY_REVOKED, key, before=facts_of_key(key))
                audit.append(connection, entry)

        self._database.write(work)

    def of_prefix(self, prefix: str, now_us: int) -> tuple[ApiKey, Person, str] | None:
        """A key that counts, whose it is, and the hash of its secret; None where there is none."""
        return self._counting(t.api_key.c.prefix == prefix, now_us)

    def of_number(self, key_id: int, now_us: int) -> tuple[ApiKey, Person, str] | None:
        """As `of_prefix`, by the key's number."""
        return self._counting(t.api_key.c.id == key_id, now_us)

    def _counting(
        self, which: ColumnElement[bool], now_us: int
    ) -> tuple[ApiKey, Person, str] | None:
        columns = (t.account, t.api_key.c.id.label("key_id"), t.api_key.c.secret_sha256)
        query = (
            select(*columns)
            .join(t.api_key, t.api_key.c.account_id == t.account.c.id)
            .where(
                which,
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
        if key.used_at is None or utc(now_us - USE_RECORDED_EVERY_US) > key.used_at:
            use = update(t.api_key).where(t.api_key.c.id == key.id).values(used_us=now_us)
            self._database.submit(lambda connection: connection.execute(use).rowcount)


def require_bike(connection: Connection, bike_id: int, person: Person) -> None:
    """Raises NotFound where there is no such bike, or it is not this rider's."""
    query = select(t.bike.c.id).where(t.bike.c.id == bike_id)
    if person.role == "rider":
        owner = t.bike_owner.c
        theirs = select(owner.bike_id).where(owner.account_id == person.id, owner.to_us.is_(None))
        query = query.where(t.bike.c.id.in_(theirs))
    if connection.execute(query).first() is None:
        raise NotFound(f"{person.name} has no bike {bike_id}.")


def keys() -> Select[Any]:
    """Every key with the names of its person and its bike."""
    names = (t.account.c.name.label("person_name"), t.bike.c.name.label("bike_name"))
    joined = select(t.api_key, *names).join(t.account, t.account.c.id == t.api_key.c.account_id)
    return joined.outerjoin(t.bike, t.bike.c.id == t.api_key.c.bike_id)


def key_of(row: Row[Any]) -> ApiKey:
    """A row of `keys`. A scope that this version does not know allows nothing."""
    permissions = {str(permission) for permission in Permission}
    return ApiKey(
        id=row.id,
        person_id=row.account_id,
        person_name=row.person_name,
        name=row.name,
        prefix=row.prefix,
        scopes=tuple(sorted(Permission(scope) for scope in row.scopes if scope in permissions)),
        created_at=utc(row.created_us),
        expires_at=utc_or_none(row.expires_us),
        used_at=utc_or_none(row.used_us),
        revoked_at=utc_or_none(row.revoked_us),
        bike_id=row.bike_id,
        bike_name=row.bike_name,
    )


def facts_of_key(key: ApiKey) -> Members:
    """What the audit tells of a key; never its secret, nor the hash of it."""
    expires_at = None if key.expires_at is None else key.expires_at.isoformat()
    facts: Members = {
        "person": key.person_name,
        "scopes": list(key.scopes),
        "expires_at": expires_at,
    }
    return facts if key.bike_id is None else {**facts, "bike": key.bike_name}


def of_key(
    action: Action, key: ApiKey, before: Members | None = None, after: Members | None = None
) -> AuditEntry:
    """Something that was done to a key."""
    return AuditEntry(action, key.id, key.name, before, after)
