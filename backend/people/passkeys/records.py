"""Passkeys in the database. All times are Unix microseconds.

Of a passkey the public key is kept: a copy of the database opens nothing.
"""

from __future__ import annotations

from typing import Any

from sqlalchemy import Connection, Row, delete, func, insert, select, update

from backend.core.audit import Action, Members
from backend.core.moments import utc, utc_or_none
from backend.core.person import Person
from backend.errors import Conflict, NotFound, NotSignedIn
from backend.people.passkeys.proof import WRONG, Credential
from backend.people.passkeys.types import Passkey
from backend.people.records import account_of, begun, of_account, person_of
from backend.store import audit
from backend.store.sql import tables as t
from backend.store.sql.database import Database

# Of one person: a phone, a computer and a key for each, and old ones.
PASSKEYS_MAX = 20
mine = t.passkey.c


class PasskeyStore:
    """The passkeys there are, from any thread."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def list(self, person_id: int) -> tuple[Passkey, ...]:
        """A person's, the oldest first."""
        query = select(t.passkey).where(mine.account_id == person_id).order_by(mine.id)
        rows = self._database.read(lambda connection: connection.execute(query).all())
        return tuple(passkey_of(row) for row in rows)

    def credential_ids(self, person_id: int, rp_id: str) -> tuple[str, ...]:
        """Of a person's passkeys for a name of this server."""
        query = select(mine.credential_id).where(mine.account_id == person_id, mine.rp_id == rp_id)
        rows = self._database.read(lambda connection: connection.execute(query).scalars().all())
        return tuple(rows)

    def add(
        self, person_id: int, name: str, rp_id: str, credential: Credential, now_us: int
    ) -> Passkey:
        """A new one of a person. Raises NotFound; Conflict `passkeys_full`, `passkey_known`."""
        values = {
            "account_id": person_id,
            "credential_id": credential.id,
            "public_key": credential.public_key,
            "sign_count": credential.sign_count,
            "rp_id": rp_id,
            "name": name,
            "created_us": now_us,
        }

        def work(connection: Connection) -> Passkey:
            person = account_of(connection, person_id)
            count = select(func.count()).where(mine.account_id == person_id)
            if connection.execute(count).scalar_one() >= PASSKEYS_MAX:
                message = f"You have {PASSKEYS_MAX} passkeys, and no more: remove one first."
                raise Conflict(message, "passkeys_full")
            known = select(mine.id).where(mine.credential_id == credential.id)
            if connection.execute(known).first() is not None:
                raise Conflict("This passkey is somebody's already.", "passkey_known")
            made = insert(t.passkey).values(values).returning(t.passkey)
            passkey = passkey_of(connection.execute(made).one())
            entry = of_account(Action.ACCOUNT_PASSKEY_ADDED, person, after=facts_of(passkey))
            audit.append(connection, entry)
            return passkey

        return self._database.write(work)

    def remove(self, person_id: int, passkey_id: int) -> None:
        """End one of a person's. Raises NotFound, also for another's; StoreError."""
        which = (mine.account_id == person_id) & (mine.id == passkey_id)

        def work(connection: Connection) -> None:
            row = connection.execute(delete(t.passkey).where(which).returning(t.passkey)).first()
            if row is None:
                raise NotFound(f"You have no passkey {passkey_id}.")
            note_removed(connection, account_of(connection, person_id), row)

        self._database.write(work)

    def of_credential(
        self, credential_id: str, rp_id: str
    ) -> tuple[int, Credential, Person] | None:
        """Number, key and person of a passkey for a name of this server; None where there is
        none."""
        # An account has a number, too.
        columns = (t.account, mine.id.label("passkey_id"), mine.public_key, mine.sign_count)
        joined = select(*columns).join(t.passkey, mine.account_id == t.account.c.id)
        query = joined.where(mine.credential_id == credential_id, mine.rp_id == rp_id)
        row = self._database.read(lambda connection: connection.execute(query).first())
        if row is None:
            return None
        credential = Credential(credential_id, row.public_key, row.sign_count)
        return row.passkey_id, credential, person_of(row)

    def open(
        self, passkey_id: int, counts: tuple[int, int], token_sha256: str, now_us: int
    ) -> Person:
        """A new session of who proved to have a passkey.

        counts: its counter as it was when the proof was looked at, and by the proof. Raises
        NotSignedIn `wrong_passkey`, and nothing is opened, where the account is disabled, or the
        passkey was removed or used since; StoreError.
        """
        before, after = counts
        same = (mine.id == passkey_id) & (mine.sign_count == before)
        use = update(t.passkey).where(same).values(sign_count=after, used_us=now_us)

        def work(connection: Connection) -> Person:
            row = connection.execute(use.returning(t.passkey)).first()
            whose = t.account.c.id == (0 if row is None else row.account_id)
            how = None if row is None else {"passkey": row.name}
            person = begun(connection, whose, token_sha256, now_us, how)
            if person is None:
                raise NotSignedIn(WRONG, "wrong_passkey")
            return person

        return self._database.write(work)


def end_passkeys(connection: Connection, person: Person) -> None:
    """Remove all of a person's, in somebody's transaction."""
    all_of = delete(t.passkey).where(mine.account_id == person.id)
    for row in connection.execute(all_of.returning(t.passkey)).all():
        note_removed(connection, person, row)


def note_removed(connection: Connection, person: Person, row: Row[Any]) -> None:
    """Adds to the audit that one is gone."""
    before = facts_of(passkey_of(row))
    audit.append(connection, of_account(Action.ACCOUNT_PASSKEY_REMOVED, person, before=before))


def facts_of(passkey: Passkey) -> Members:
    """What the audit tells of a passkey; never its key."""
    return {"passkey": passkey.name, "rp_id": passkey.rp_id}


def passkey_of(row: Row[Any]) -> Passkey:
    """A row of `passkey`."""
    return Passkey(
        id=row.id,
        name=row.name,
        rp_id=row.rp_id,
        created_at=utc(row.created_us),
        used_at=utc_or_none(row.used_us),
    )
