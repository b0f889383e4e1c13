"""The database: opened, brought to today's schema, and written by one thread on SQLite.

SQLite allows one writer. With one writing thread nobody ever meets a locked database, a commit is
one fsync in a row of them, and a slow disk shows as a queue that we can see and bound.
PostgreSQL has its own writers: there the same calls run on the caller's thread.
"""

from __future__ import annotations

import contextvars
import logging
import sqlite3
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

from sqlalchemy import Connection, Engine, create_engine, event, inspect, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError

from backend.errors import StoreError
from backend.store.health import (
    DAMAGED,
    QUEUE_FULL,
    WORDS,
    WriteWatch,
    code_of,
    reason_of,
    write_a_little,
)
from backend.store.sql.sound_rows import decoded, parsed

LOG = logging.getLogger(__name__)
Result = TypeVar("Result")

# The newest migration; a test holds it against the files in migrations/versions.
HEAD_REVISION = "0027"
# What is opened beside it: nothing yet, and the schema of release 0.5.
OLDER_REVISIONS = (None, "0011", "0019", "0020", "0021", "0022", "0023", "0024", "0025", "0026")
# Bounds the memory of writes that wait for a slow disk: about 256 one-second tails.
WRITES_WAITING_MAX = 256
BUSY_TIMEOUT_MS = 10_000
# The database's name among the parts of the store that may refuse to be written.
PART = "database"
# What a transaction does last, among what a connection knows.
LAST = "done_last"
# Some milliseconds of the writing thread.
PAGES_AT_ONCE = 500


class Database:
    """One database by URL (`sqlite:///path`, `postgresql+psycopg://...`).

    watch: notified of every write, whether it succeeded. fence: raises StoreError, in every
    transaction that writes, once another server has the database; None where nobody can.
    """

    part = PART

    def __init__(self, url: str, watch: WriteWatch | None = None) -> None:
        self.watch = watch or WriteWatch()
        self.fence: Callable[[Connection], None] | None = None
        self.engine = open_engine(url)
        self.one_writer = self.engine.dialect.name == "sqlite"
        self._writing_engine = self.engine.execution_options(writes=True)
        self._writer = ThreadPoolExecutor(1, thread_name_prefix="store-writer")
        self._waiting = threading.BoundedSemaphore(WRITES_WAITING_MAX)
        try:
            migrate(self.engine, url)
            if self.one_writer:
                make_shrinkable(self.engine)
        except (SQLAlchemyError, OSError) as error:
            self.close()
            code = code_of(error)
            reason = reason_of(error) if code is None else f"{WORDS[code]}."
            raise StoreError(
                f"The database {shown(url)} cannot be opened: {reason}", code
            ) from error

    def submit(self, work: Callable[[Connection], Result]) -> Future[Result]:
        """Run `work` in one transaction on the writing thread, in a copy of the caller's context;
        blocks while too many wait."""
        if not self.one_writer:
            return done(lambda: self._transaction(work))
        if not self._waiting.acquire(blocking=False):
            self.watch.note(PART, QUEUE_FULL)
            self._waiting.acquire()
        try:
            future = self._writer.submit(contextvars.copy_context().run, self._transaction, work)
        except RuntimeError as error:
            self._waiting.release()
            raise StoreError("The store is closed: nothing was saved.") from error
        future.add_done_callback(lambda _: self._waiting.release())
        return future

    def write(self, work: Callable[[Connection], Result]) -> Result:
        """Run `work` in one transaction and wait for its commit."""
        return self.submit(work).result()

    def wait_written(self) -> None:
        """Wait until everything handed over before is committed or refused."""
        if self.one_writer:
            self._writer.submit(lambda: None).result()

    def read(self, work: Callable[[Connection], Result]) -> Result:
        """Run `work` on a reading connection, on the caller's thread."""
        try:
            with self.engine.connect() as connection:
                return work(connection)
        except SQLAlchemyError as error:
            if code_of(error) == DAMAGED:
                self.watch.note(PART, DAMAGED)
            raise StoreError(f"The database could not be read: {reason_of(error)}") from error

    def give_back(self) -> bool:
        """Give the disk some of what deleted rows took; False once there is nothing left.

        SQLite's file shrinks by a piece at a time, so that a recording hardly waits for it.
        PostgreSQL does so by itself.
        """
        if not self.one_writer:
            return False
        before = self.read(free_pages)
        left = self.write(shrink) if before else 0
        if 0 < left < before:
            return True
        # The log of changes still holds what was deleted; a reader in it only postpones this. It
        # takes the writer's lock, and SQLite does not let a transaction that has read wait for it.
        with suppress(RuntimeError):
            self._writer.submit(truncate_log, self.engine).result()
        return False

    def ping(self) -> None:
        """Ask for nothing in particular. Raises StoreError when there is no answer."""
        self.read(lambda connection: connection.execute(text("SELECT 1")))

    def try_write(self) -> None:
        """Write a little, for the watch to see how that goes."""
        path = sqlite_path(str(self.engine.url)) if self.one_writer else None
        with suppress(StoreError):
            if path is not None:
                # A small change finds room in SQLite's log where a ride's seconds do not.
                with self.watch.writing(PART, "Nothing was lost"):
                    write_a_little(path.parent)
            self.write(count_up if self.one_writer else take_a_number)

    def close(self) -> None:
        """Finish what waits, then close every connection."""
        self._writer.shutdown(wait=True)
        self.engine.dispose()

    def _transaction(self, work: Callable[[Connection], Result]) -> Result:
        try:
            with self._writing_engine.begin() as connection:
                if self.fence is not None:
                    self.fence(connection)
                last: list[Callable[[Connection], None]] = []
                connection.info[LAST] = last
                result = work(connection)
                for finish in last:
                    finish(connection)
        except SQLAlchemyError as error:
            lost = "The database did not save the change"
            raise self.watch.refused(PART, error, lost) from error
        self.watch.worked(PART)
        return result


def do_last(connection: Connection, work: Callable[[Connection], None]) -> None:
    """Have something done in a transaction of `Database` behind all else that it does.

    For what holds off all others until the commit: on PostgreSQL two that hold it and still want
    each other's rows would wait for ever.
    """
    connection.info[LAST].append(work)


def count_up(connection: Connection) -> None:
    """A change of one page that means nothing."""
    number = connection.exec_driver_sql("PRAGMA user_version").scalar_one()
    connection.exec_driver_sql(f"PRAGMA user_version={(int(number) + 1) % 1000}")


def take_a_number(connection: Connection) -> None:
    """A transaction of PostgreSQL that its log has to keep."""
    connection.exec_driver_sql("SELECT txid_current()")


def done(work: Callable[[], Result]) -> Future[Result]:
    """A future that has already run."""
    future: Future[Result] = Future()
    try:
        future.set_result(work())
    except StoreError as error:
        future.set_exception(error)
    return future


def sqlite_path(url: str) -> Path | None:
    """The file of an SQLite URL, links followed; None for any other and for one in memory."""
    parts = make_url(url)
    name = parts.database
    if parts.get_backend_name() != "sqlite" or not name or name.startswith((":memory:", "file:")):
        return None
    return Path(name).resolve()


def is_postgresql(url: str) -> bool:
    """Whether a URL names a PostgreSQL database."""
    return make_url(url).get_backend_name() == "postgresql"


def shown(url: str) -> str:
    """A database's URL as it may be shown: without the password."""
    return make_url(url).render_as_string(hide_password=True)


def open_engine(url: str) -> Engine:
    """An engine with SQLite's durable settings, or PostgreSQL's own."""
    if not url.startswith("sqlite"):
        # A connection that a restart of the database broke is found out before it is used.
        return create_engine(url, pool_pre_ping=True, json_deserializer=parsed)
    path = sqlite_path(url)
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
    engine = create_engine(url, pool_size=8, max_overflow=32, json_deserializer=parsed)
    event.listen(engine, "connect", prepare_sqlite)
    event.listen(engine, "begin", begin_sqlite)
    return engine


def prepare_sqlite(connection: Any, _record: object) -> None:
    """WAL with FULL: a commit that returned survives kill -9 and a power cut.

    Auto-commit off in the driver: SQLAlchemy sends BEGIN itself, so DDL is transactional too.
    Incremental vacuum has to be chosen before the first table; it lets the file shrink.
    Deleted rows are written over: what a person deletes is not to be read off the file.
    """
    connection.isolation_level = None
    connection.text_factory = decoded
    for pragma in (
        "auto_vacuum=INCREMENTAL",
        "journal_mode=WAL",
        "synchronous=FULL",
        "foreign_keys=ON",
        f"busy_timeout={BUSY_TIMEOUT_MS}",
        "secure_delete=ON",
    ):
        connection.execute(f"PRAGMA {pragma}")


def begin_sqlite(connection: Connection) -> None:
    """Begin a transaction; one that writes takes the lock at once.

    Readers take that lock for an instant to look at the head of a log that is just being written.
    A transaction that has read before it wants the lock does not wait for them: it is refused.
    """
    writes = connection.get_execution_options().get("writes")
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


def free_pages(connection: Connection) -> int:
    """Pages of the file that hold nothing any more."""
    return int(connection.exec_driver_sql("PRAGMA freelist_count").scalar_one())


def shrink(connection: Connection) -> int:
    """Cut some free pages off the file; how many are left."""
    # SQLite frees a page at each step of a statement, and Python takes one step where no rows come.
    for _ in range(min(free_pages(connection), PAGES_AT_ONCE)):
        connection.exec_driver_sql("PRAGMA incremental_vacuum(1)")
    return free_pages(connection)


def make_shrinkable(engine: Engine) -> None:
    """Lets a file of before this rule shrink too: it is written anew, once. A full disk may not."""
    if outside_transaction(engine, "PRAGMA auto_vacuum") == 0:
        outside_transaction(engine, "VACUUM")


def truncate_log(engine: Engine) -> None:
    """Empty SQLite's log of changes, if nobody reads from it just now.

    Waiting for a reader would keep every writer waiting too, until its patience is over.
    """
    connection = engine.raw_connection()
    try:
        cursor = connection.cursor()
        cursor.execute("PRAGMA busy_timeout=0")
        cursor.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()
    except sqlite3.Error as error:
        LOG.warning("The database's log was not emptied: %s. It is reused.", error)
    finally:
        connection.cursor().execute(f"PRAGMA busy_timeout={BUSY_TIMEOUT_MS}")
        connection.close()


def outside_transaction(engine: Engine, statement: str) -> object:
    """The first value a statement of SQLite gives that must not stand in a transaction."""
    connection = engine.raw_connection()
    try:
        row = connection.cursor().execute(statement).fetchone()
        return None if row is None else row[0]
    except sqlite3.Error as error:
        LOG.warning("The database's file did not shrink: %s. Deleted rows are reused.", error)
        return None
    finally:
        connection.close()


def migrate(engine: Engine, url: str) -> None:
    """Bring the schema to `HEAD_REVISION`; alembic is loaded only when there is work to do.

    Raises StoreError for a schema of a newer version, and of one before 0.5.
    """
    revision = current_revision(engine)
    if revision == HEAD_REVISION:
        return
    if revision not in OLDER_REVISIONS:
        raise StoreError(
            f"The database {shown(url)} has schema {revision}, which this Spindle does not know: a "
            "newer version wrote it, or one before 0.5. Nothing was changed. Open it with the "
            "version that wrote it, or bring its rides into a new database with `spindle store "
            "rebuild`."
        )
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent / "migrations"))
    config.set_main_option("sqlalchemy.url", url.replace("%", "%%"))
    with engine.execution_options(writes=True).begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
        if engine.dialect.name == "sqlite":
            # Tables that went leave room that nobody is going to need.
            shrink(connection)


def current_revision(engine: Engine) -> str | None:
    """The revision the database is at, None for an empty one."""
    with engine.connect() as connection:
        if not inspect(connection).has_table("alembic_version"):
            return None
        return connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
