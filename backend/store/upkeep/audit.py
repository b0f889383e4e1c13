"""The audit's chain walked from its first event to its last. Writes nothing; beside a server, too.

What a chain proves: no event within it was changed, removed, put in or put elsewhere since. It
cannot know of events that were cut off its end together with its head, nor of a chain made anew
from the first changed event on: for that its newest hash has to be noted where nobody who may
write here can reach it, and found in the chain later.
"""

from __future__ import annotations

from dataclasses import dataclass

from sqlalchemy import Connection, inspect, select, text

from backend.errors import NotFound, StoreError
from backend.store.audit import GENESIS, event_sha256
from backend.store.inspect_schema import OK, inspect_database, reading_engine
from backend.store.sql import tables as t
from backend.store.sql.database import shown, sqlite_path
from backend.store.sql.database_url import check_url
from backend.store.sql.sound_rows import NOT_AS_WRITTEN

ROWS_AT_ONCE = 1_000


@dataclass(frozen=True)
class Misfit:
    """The first event that does not fit. reason: for people."""

    event_id: int
    reason: str


@dataclass(frozen=True)
class ChainCheck:
    """What the walk found.

    events: that fit, from the first on. head_sha256: of the last of them. expected_id: the event
    with the hash that was looked for, None where no fitting one has it.
    """

    events: int
    head_sha256: str
    misfit: Misfit | None
    expected_id: int | None


def verify_audit(db_url: str, expected_sha256: str | None = None) -> ChainCheck:
    """Walk the chain of a database, in one snapshot. expected_sha256: a hash to look for.

    Raises StoreError when the database cannot be read, NotFound where it has no audit,
    InvalidRequest for a URL that is none.
    """
    check_url(db_url)
    view = inspect_database(db_url)
    if view.state != OK:
        raise StoreError(f"The database {shown(db_url)} is {view.state}: there is no audit in it.")
    path = sqlite_path(db_url)
    engine = reading_engine(db_url, path)
    try:
        if path is None:
            engine = engine.execution_options(isolation_level="REPEATABLE READ")
        with engine.connect() as connection:
            if path is not None:
                # The driver by itself begins no transaction to read in.
                connection.execute(text("BEGIN"))
            if not inspect(connection).has_table(t.audit_event.name):
                raise NotFound(
                    f"The database {shown(db_url)} is of a version without an audit: it begins "
                    "with the next start of a server."
                )
            return walked(connection, expected_sha256)
    except (*NOT_AS_WRITTEN, OSError) as error:
        raise StoreError(f"The audit of {shown(db_url)} cannot be read: {error}") from error
    finally:
        engine.dispose()


def walked(connection: Connection, expected_sha256: str | None = None) -> ChainCheck:
    """As `verify_audit`, over a connection that sees one state."""
    last_id, last_sha256, expected_id = 0, GENESIS, None
    misfit: Misfit | None = None
    rows = connection.execution_options(yield_per=ROWS_AT_ONCE).execute(
        select(t.audit_event).order_by(t.audit_event.c.id)
    )
    for row in rows.mappings():
        if row["id"] != last_id + 1:
            misfit = Misfit(last_id + 1, "it is not there")
        elif row["previous_sha256"] != last_sha256:
            misfit = Misfit(row["id"], "it does not follow the event before it")
        elif not is_own(dict(row)):
            misfit = Misfit(row["id"], "it is not what its hash was made of")
        if misfit is not None:
            break
        last_id, last_sha256 = row["id"], row["sha256"]
        if last_sha256 == expected_sha256:
            expected_id = last_id
    rows.close()
    return ChainCheck(
        last_id, last_sha256, misfit or head_misfit(connection, last_id, last_sha256), expected_id
    )


def is_own(row: dict[str, object]) -> bool:
    """Whether a row's hash is its own."""
    try:
        return event_sha256(row) == row["sha256"]
    except NOT_AS_WRITTEN:
        return False


def head_misfit(connection: Connection, last_id: int, last_sha256: str) -> Misfit | None:
    """Where the note of the last event says something else than the events."""
    heads = connection.execute(select(t.audit_head)).all()
    if len(heads) != 1:
        return Misfit(last_id + 1, "the note of the last event is gone")
    [head] = heads
    if (head.last_id, head.sha256) == (last_id, last_sha256):
        return None
    if head.last_id > last_id:
        return Misfit(last_id + 1, f"it is not there, and there were {head.last_id}")
    return Misfit(last_id, "the note of the last event names another")
