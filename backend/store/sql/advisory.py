"""PostgreSQL's own lock: one server has a database, for as long as its session lives.

A session advisory lock is held by a connection that does nothing else, so it goes with the process
and with nothing less. Should that connection drop, the lock is taken again within seconds. Whether
another server came in between is not left to time: the database names the server that took the lock
last, and every transaction asks for that name before it writes (`fence`).
"""

from __future__ import annotations

import logging
import threading

from sqlalchemy import Connection, Engine, create_engine, select, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.pool import NullPool

from backend.errors import StoreError
from backend.store.health import reason_of
from backend.store.sql import tables as t
from backend.store.sql.database import shown

LOG = logging.getLogger(__name__)

# "SPIN" as a number; the second half of the key is the schema, which is a store of its own.
ROOM = 0x5350494E
TAKE = text("SELECT pg_try_advisory_lock(:room, hashtext(current_schema()))")
CHECK_EVERY_S = 2.0
# A server that vanished without a word is noticed by the system after some 20 s.
KEEPALIVE = {"keepalives_idle": 10, "keepalives_interval": 5, "keepalives_count": 2}


class AdvisoryLock:
    """Holds a PostgreSQL database for this process until `release`.

    check_every_s: how often the connection is checked. Raises StoreError when another server has
    the database, or when it cannot be reached.
    """

    def __init__(self, url: str, check_every_s: float = CHECK_EVERY_S) -> None:
        self._shown = shown(url)
        self._engine = lock_engine(url)
        self._check_every_s = check_every_s
        self._connection: Connection | None = None
        self._released = threading.Event()
        try:
            taken = self._take()
        except SQLAlchemyError as error:
            raise StoreError(
                f"The database {self._shown} cannot be reached: {reason_of(error)}"
            ) from error
        if not taken:
            raise StoreError(
                f"Another Spindle is using {self._shown}: stop it, or give this one a database of "
                "its own with SPINDLE_DB. Nothing was changed."
            )
        self._watching = threading.Thread(target=self._watch, name="store-lock", daemon=True)
        self._watching.start()

    def release(self) -> None:
        """Let another server in. The database does it too when this process dies."""
        self._released.set()
        self._watching.join()
        self._drop()
        self._engine.dispose()

    def check(self) -> None:
        """See whether the lock is still held; take it again if it is not, and say so."""
        try:
            if self._connection is not None:
                self._connection.execute(text("SELECT 1"))
                return
            if self._take():
                LOG.warning("The lock of %s is held again.", self._shown)
        except SQLAlchemyError as error:
            if self._connection is not None:
                LOG.error(
                    "The connection that holds the lock of %s is lost: %s. It is taken again as "
                    "soon as that is possible; should another server take it first, this one "
                    "writes nothing any more.",
                    self._shown,
                    reason_of(error),
                )
            self._drop()

    def _watch(self) -> None:
        while not self._released.wait(self._check_every_s):
            self.check()

    def _take(self) -> bool:
        connection = self._engine.connect()
        try:
            taken = bool(connection.execute(TAKE, {"room": ROOM}).scalar_one())
        except SQLAlchemyError:
            connection.invalidate()
            raise
        if taken:
            self._connection = connection
        else:
            connection.close()
        return taken

    def _drop(self) -> None:
        connection, self._connection = self._connection, None
        if connection is not None:
            connection.invalidate()
            connection.close()


def lock_engine(url: str) -> Engine:
    """An engine whose one connection is never given to anybody else, nor used again."""
    options = KEEPALIVE if "psycopg" in make_url(url).get_driver_name() else {}
    return create_engine(
        url, poolclass=NullPool, isolation_level="AUTOCOMMIT", connect_args=options
    )


def fence(connection: Connection, server_id: str) -> None:
    """Refuse to write once another server has taken the database; holds it off until the commit.

    Raises StoreError.
    """
    row = select(t.store_identity.c.server_id).with_for_update(read=True)
    if connection.execute(row).scalar() != server_id:
        raise StoreError(
            "Another Spindle has taken the database: nothing was saved, and this one saves nothing "
            "any more. Stop one of the two, then start this one again."
        )
