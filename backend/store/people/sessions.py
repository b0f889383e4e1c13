"""Browsers that signed in. Only the hash of their token is kept: a copy of the database opens none.

A session ends when it was not used for a while, and after some time whatever is done with it.
"""

from __future__ import annotations

from sqlalchemy import ColumnElement, Connection, delete, insert, select, update

from backend.domain.people.person import Person
from backend.store.people.accounts import person_of
from backend.store.sql import tables as t
from backend.store.sql.database import Database

HOUR_US = 3_600_000_000
# A day's work and the night after it; NIST SP 800-63B, 2.1.3: 30 days at the most.
IDLE_US = 24 * HOUR_US
AGE_MAX_US = 30 * 24 * HOUR_US
# A use is noted so seldom that a page that asks twice a second does not keep the disk busy.
NOTED_EVERY_US = 60_000_000
# Of one person: the oldest goes first. Protects the table.
SESSIONS_MAX = 50


class SessionStore:
    """Sessions by the hash of their token, from any thread. All times in Unix microseconds."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def open(self, person_id: int, password: str, token_sha256: str, now_us: int) -> bool:
        """A new session of a person whose password was looked at.

        password: its hash. False, and nothing is opened, where the account was disabled or given
        another password since. Raises StoreError.
        """
        values = {
            "account_id": person_id,
            "token_sha256": token_sha256,
            "created_us": now_us,
            "used_us": now_us,
        }
        mine = t.session.c.account_id == person_id
        newest = (
            select(t.session.c.id).where(mine).order_by(t.session.c.id.desc()).limit(SESSIONS_MAX)
        )
        same = (t.account.c.id == person_id) & (t.account.c.password == password)

        def work(connection: Connection) -> bool:
            still = update(t.account).where(same & t.account.c.enabled)
            if not connection.execute(still.values(signed_in_us=now_us)).rowcount:
                return False
            connection.execute(delete(t.session).where(over(now_us)))
            connection.execute(insert(t.session).values(values))
            connection.execute(delete(t.session).where(mine & t.session.c.id.not_in(newest)))
            return True

        return self._database.write(work)

    def of_token(self, token_sha256: str, now_us: int) -> tuple[int, Person] | None:
        """The session's number and whose it is; None where it is over or the account disabled."""
        query = (
            select(
                t.account,
                t.session.c.id.label("session_id"),
                t.session.c.used_us,
            )
            .join(t.session, t.session.c.account_id == t.account.c.id)
            .where(t.session.c.token_sha256 == token_sha256, t.account.c.enabled, ~over(now_us))
        )
        row = self._database.read(lambda connection: connection.execute(query).first())
        if row is None:
            return None
        if now_us - row.used_us > NOTED_EVERY_US:
            noted = update(t.session).where(t.session.c.id == row.session_id)
            # Nobody waits for it, and a full disk signs nobody out.
            self._database.submit(lambda c: c.execute(noted.values(used_us=now_us)).rowcount)
        return row.session_id, person_of(row)

    def close(self, session_id: int) -> None:
        """Sign one browser out. Raises StoreError."""
        gone = delete(t.session).where(t.session.c.id == session_id)
        self._database.write(lambda connection: connection.execute(gone).rowcount)

    def close_all(self, person_id: int) -> None:
        """Sign a person out everywhere. Raises StoreError."""
        gone = delete(t.session).where(t.session.c.account_id == person_id)
        self._database.write(lambda connection: connection.execute(gone).rowcount)


def over(now_us: int) -> ColumnElement[bool]:
    """Of a session: it was not used for too long, or began too long ago."""
    return (t.session.c.used_us < now_us - IDLE_US) | (t.session.c.created_us < now_us - AGE_MAX_US)
