"""What is in a database, looked at without writing a byte: before it is opened, or beside a server.

Reads every schema there ever was. An SQLite file that no server has open is read as it lies;
beside a running server, or after a crash, its journal is read with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from sqlalchemy import Connection, Engine, create_engine, event, inspect, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import DatabaseError, OperationalError, SQLAlchemyError

from backend.errors import StoreError
from backend.store.discard import calibration_key
from backend.store.health import DAMAGED as FILE_DAMAGED
from backend.store.health import code_of, reason_of
from backend.store.objects import RIDE_SUFFIX, content_key, sidecar_key
from backend.store.sql.database import HEAD_REVISION, current_revision, shown, sqlite_path
from backend.store.sql.sound_rows import NOT_AS_WRITTEN, decoded, parsed
from backend.store.sql.tables import metadata

MISSING, EMPTY, DAMAGED, FOREIGN, OK = "missing", "empty", "damaged", "foreign", "ok"
# The end of the year 9999, the last that ISO 8601 tells with four digits.
TIME_MAX_US = 253_402_300_800_000_000
# Every schema has these.
OURS = frozenset({"ride", "upload"})
# Tables whose rows somebody would miss.
MISSED = frozenset({"ride", "upload", "unit", "revision", "calibration", "visit", "account"})


@dataclass(frozen=True)
class LiveRecording:
    """A ride that is being recorded, or was when its server died."""

    ride_id: int
    row_count: int
    server_id: str | None
    heartbeat_us: int | None


@dataclass(frozen=True)
class DatabaseView:
    """What a database holds.

    state: `missing` (no file), `empty` (nothing of ours), `damaged`, `foreign` (of another
    program), or `ok`. object_keys: keys of the objects it names, without sidecars. known_keys:
    with them, and with those it gave up.
    """

    state: str
    detail: str | None = None
    identity: str | None = None
    rebuilding: bool = False
    rides: int = 0
    object_keys: frozenset[str] = frozenset()
    named_keys: frozenset[str] = frozenset()
    live: tuple[LiveRecording, ...] = ()


def inspect_database(url: str, check_contents: bool = False) -> DatabaseView:
    """The contents of a database. Raises StoreError when it cannot be reached or used at all.

    check_contents: reads every page of an SQLite file, so that a destroyed one is known as such.
    """
    path = sqlite_path(url)
    if path is not None and (not path.exists() or (path.is_file() and path.stat().st_size == 0)):
        return rest_of(path)
    engine = reading_engine(url, path)
    try:
        with engine.connect() as connection:
            view = view_of(connection)
            if path is not None and check_contents and view.state == OK:
                verdict = connection.execute(text("PRAGMA quick_check(1)")).scalar_one()
                fault = lacking(connection, engine) if verdict == "ok" else str(verdict)
                return view if fault is None else DatabaseView(DAMAGED, fault)
            if path is None and view.state != OK:
                require_unicode(connection, shown(url))
            return view
    except OperationalError as error:
        if path is not None and code_of(error) in (FILE_DAMAGED, None):
            # Not locked, not refused by the disk: its own schema does not hold together.
            return DatabaseView(DAMAGED, str(error.orig))
        raise StoreError(f"The database {shown(url)} cannot be read: {error.orig}") from error
    except DatabaseError as error:
        return DatabaseView(DAMAGED, str(error.orig))
    except NOT_AS_WRITTEN as error:
        # The driver has no words for a fault whose own words are damaged.
        return DatabaseView(DAMAGED, str(error))
    except SQLAlchemyError as error:
        raise StoreError(f"The database {shown(url)} cannot be read: {reason_of(error)}") from error
    finally:
        engine.dispose()


def rest_of(path: Path) -> DatabaseView:
    """An SQLite file without contents. Opened, it would empty a journal that still has some."""
    journal = journal_of(path)
    if journal.exists() and journal.stat().st_size:
        detail = f"it is gone, but not {journal.name}, which holds what was written last"
        return DatabaseView(DAMAGED, detail)
    return DatabaseView(EMPTY if path.exists() else MISSING)


def journal_of(path: Path) -> Path:
    """Where SQLite keeps what is not in the file yet."""
    return path.with_name(path.name + "-wal")


def reading_engine(url: str, path: Path | None) -> Engine:
    """An engine that writes nothing, not even the files SQLite keeps beside a database."""
    if path is None:
        # The driver's own choice for a database without an encoding is bytes instead of text.
        unicode = (
            {"client_encoding": "utf8"} if "psycopg" in make_url(url).get_driver_name() else {}
        )
        return create_engine(url, connect_args=unicode, json_deserializer=parsed)
    mode = "mode=ro" if journal_of(path).exists() else "mode=ro&immutable=1"
    address = f"sqlite:///file:{quote(path.as_posix())}?{mode}&uri=true"
    engine = create_engine(address, json_deserializer=parsed)
    event.listen(engine, "connect", lambda connection, _: read_all_text(connection))
    return engine


def read_all_text(connection: Any) -> None:
    """Let a connection of SQLite read text whose bytes are damaged."""
    connection.text_factory = decoded


def require_unicode(connection: Connection, shown_url: str) -> None:
    """Raises StoreError for a new PostgreSQL database that cannot keep every name people write."""
    encoding = connection.execute(text("SHOW server_encoding")).scalar_one()
    if encoding != "UTF8":
        raise StoreError(
            f"The database {shown_url} has the encoding {encoding}, which cannot keep every name "
            "and note. Make another one with CREATE DATABASE ... ENCODING 'UTF8' TEMPLATE "
            "template0, and name it in SPINDLE_DB. Nothing was changed."
        )


def view_of(connection: Connection) -> DatabaseView:
    """What a connection shows, in one snapshot."""
    inspector = inspect(connection)
    tables = set(inspector.get_table_names())
    if not tables >= OURS:
        foreign = tables - {"alembic_version"} and connection.dialect.name == "sqlite"
        named = ", ".join(sorted(tables)[:3])
        return DatabaseView(FOREIGN, f"its tables are {named}") if foreign else DatabaseView(EMPTY)

    def values(query: str) -> list[str]:
        return [str(value) for value in connection.execute(text(query)).scalars()]

    rides = values("SELECT object_key FROM ride WHERE object_key IS NOT NULL")
    originals = values("SELECT object_key FROM upload WHERE object_key IS NOT NULL")
    objects = frozenset(rides) | frozenset(originals)
    if "calibration" in tables:
        closed = values("SELECT sha256 FROM calibration WHERE sha256 IS NOT NULL")
        objects |= {calibration_key(sha256) for sha256 in closed}
    arrived = values("SELECT sha256 FROM upload WHERE sha256 IS NOT NULL")
    named_by_rows = objects | {content_key("originals", sha256) for sha256 in arrived}
    # Named twice: a row whose key is damaged still has its object.
    hashes = values("SELECT object_sha256 FROM ride WHERE object_sha256 IS NOT NULL")
    rides += [content_key("rides", sha256, RIDE_SUFFIX) for sha256 in hashes]
    named_by_rows |= frozenset(rides)
    row = connection.execute(text("SELECT store_id, rebuilding FROM store_identity")).first()
    identity, rebuilding = (row.store_id, bool(row.rebuilding)) if row else (None, False)
    discarded = values("SELECT key FROM discarded_object")
    holds = any(
        connection.execute(text(f"SELECT 1 FROM {name} LIMIT 1")).first()
        for name in sorted(tables & MISSED)
    )
    return DatabaseView(
        state=OK if holds or identity else EMPTY,
        identity=identity,
        rebuilding=rebuilding,
        rides=int(connection.execute(text("SELECT count(*) FROM ride")).scalar_one()),
        object_keys=objects,
        named_keys=named_by_rows | {sidecar_key(key) for key in rides} | frozenset(discarded),
        live=live_recordings(connection),
    )


def lacking(connection: Connection, engine: Engine) -> str | None:
    """What a database of today's schema lacks of it, None for nothing or for an older one. SQLite
    takes whatever stands in its own schema for a name, also one with a flipped bit."""
    if current_revision(engine) != HEAD_REVISION:
        return None
    inspector = inspect(connection)
    tables = set(inspector.get_table_names())
    for table in metadata.sorted_tables:
        if table.name not in tables:
            return f"it has no table {table.name}"
        there = {column["name"] for column in inspector.get_columns(table.name)}
        if left := sorted(set(table.columns.keys()) - there):
            return f"its table {table.name} has no {', '.join(left)}"
    return None


def live_recordings(connection: Connection) -> tuple[LiveRecording, ...]:
    """The rides that have no object yet; of a damaged row what is a number."""
    query = (
        "SELECT id, row_count, server_id, heartbeat_us FROM ride WHERE state = 'live' ORDER BY id"
    )
    rows = connection.execute(text(query)).all()
    return tuple(
        LiveRecording(row.id, number(row.row_count) or 0, row.server_id, number(row.heartbeat_us))
        for row in rows
    )


def number(value: object) -> int | None:
    """A count or a time of a row, None where the row has none."""
    return value if isinstance(value, int) and 0 <= value < TIME_MAX_US else None
