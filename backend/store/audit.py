"""Who changed what: events in a chain of hashes, each added in the transaction of its change.

The hash of an event is the SHA-256, in hex, of these bytes: a JSON object of all members of its
row but `sha256`, names sorted, nothing between the tokens, every character beyond ASCII as \\uXXXX
in lower-case hex (`core.canonical_json`). Every value is a whole number, a string or null, so that
no number can be spelled in two ways: `before` and `after` are strings, the canonical JSON that is
stored. `previous_sha256` is that of the event before, 64 zeros for the first. Numbers count from 1
without a gap, also where a transaction failed.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterable, Mapping
from typing import Any

from sqlalchemy import Connection, insert, select, update

from backend.core.actor import Actor, actor_now
from backend.core.audit import AuditEntry, Members
from backend.core.canonical_json import canonical_text, sha256_of
from backend.errors import StoreError
from backend.store.sql import tables as t
from backend.store.sql.database import Database, do_last
from backend.store.wall_clock import now_us

LOG = logging.getLogger(__name__)
GENESIS = "0" * 64
HASHED = tuple(column.name for column in t.audit_event.columns if column.name != "sha256")
# Of events that a full disk does not take; each is a press of a button.
WAITING_MAX = 1_000
# Of one value, in characters of JSON; the largest, a table's rules, has some 600. Protects a table
# that nobody can make smaller.
VALUE_LENGTH_MAX = 4_000
# Of one side; a whole configuration that changed has 5 kB.
SIDE_LENGTH_MAX = 32_000
NAME_LENGTH_MAX = 300
REASON_LENGTH_MAX = 1_000


class AuditLog:
    """Adds events on their own: for what was done to a unit and not to the database. Any thread."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._turn = threading.Lock()
        self._waiting: list[tuple[AuditEntry, Actor, int]] = []

    def note(self, entry: AuditEntry) -> None:
        """Add an event. The unit has the change already: a database that refuses it now is asked
        again until it does not, as long as this process lives."""
        with self._turn:
            self._waiting.append((entry, actor_now(), now_us()))
            if len(self._waiting) > WAITING_MAX:
                LOG.error("The audit lacks an event: %s", self._waiting.pop(0))
        try:
            self.catch_up()
        except StoreError as error:
            LOG.error("The audit lacks an event so far: %s: %s", entry, error.message)

    def close(self) -> None:
        """Try what waits for the last time."""
        try:
            self.catch_up()
        except StoreError:
            LOG.error("The audit lacks events: %s", [entry for entry, _, _ in self._waiting])

    def catch_up(self) -> None:
        """Add what waits. Raises StoreError; then it still waits."""
        with self._turn:
            waiting = list(self._waiting)
            if waiting:
                self._database.write(lambda connection: append_all(connection, waiting))
                self._waiting.clear()


def append_all(connection: Connection, events: Iterable[tuple[AuditEntry, Actor, int]]) -> None:
    """As `append`, of several."""
    for entry, actor, at_us in events:
        append(connection, entry, actor, at_us)


def append(
    connection: Connection,
    entry: AuditEntry,
    actor: Actor | None = None,
    at_us: int | None = None,
) -> None:
    """Add an event to the chain, both or neither with what else the transaction does.

    actor: who did it; None for who acts here. at_us: when; None for now. It is added at the end of
    the transaction, which has to be one of `Database`.
    """
    who, when_us = actor or actor_now(), now_us() if at_us is None else at_us
    do_last(connection, lambda c: add(c, entry, who, when_us))


def add(connection: Connection, entry: AuditEntry, actor: Actor, at_us: int) -> None:
    """Add an event; on PostgreSQL all others that do wait until the commit."""
    bike_id, name = entry.bike_id, entry.name
    if bike_id is None and entry.unit_key is not None:
        bike_id, bike_name = bike_now(connection, entry.unit_key)
        name = name or bike_name
    head = connection.execute(select(t.audit_head).with_for_update()).one()
    event = {
        "id": head.last_id + 1,
        "at_us": at_us,
        "actor_kind": actor.kind,
        "actor_id": actor.account_id,
        "actor_name": clean(actor.name, NAME_LENGTH_MAX) or "",
        "actor_key": clean(actor.key, NAME_LENGTH_MAX),
        "action": entry.action.value,
        "object_kind": entry.action.object_kind,
        "object_id": None if entry.object_id is None else clean(str(entry.object_id)),
        "object_name": clean(name, NAME_LENGTH_MAX),
        "unit_key": clean(entry.unit_key),
        "bike_id": bike_id,
        "before": side(entry.before),
        "after": side(entry.after),
        "reason": clean(entry.reason, REASON_LENGTH_MAX),
        "previous_sha256": head.sha256,
    }
    sha256 = sha256_of(event)
    connection.execute(insert(t.audit_event).values(event | {"sha256": sha256}))
    connection.execute(update(t.audit_head).values(last_id=event["id"], sha256=sha256))


def bike_now(connection: Connection, unit_key: str) -> tuple[int | None, str | None]:
    """Number and name of the bike a unit is on."""
    bike, unit = t.bike.c, t.bike_unit.c
    query = select(bike.id, bike.name).join(t.bike_unit, unit.bike_id == bike.id)
    row = connection.execute(query.where(unit.unit_key == unit_key, unit.to_us.is_(None))).first()
    return (None, None) if row is None else (row.id, row.name)


def event_sha256(row: Mapping[str, Any]) -> str:
    """The hash that an event must have. Raises TypeError for a value that none has."""
    return sha256_of({name: row[name] for name in HASHED})


def clean(text: str | None, length_max: int = 1_000) -> str | None:
    """Text that every database takes, None for nothing: without NUL, as UTF-8 can say it."""
    if not text:
        return None
    return text.replace("\0", "").encode(errors="replace").decode()[:length_max] or None


def side(members: Members | None) -> str | None:
    """Before or after as it is stored; what is too long is told by its hash and length."""
    if not members:
        return None
    text = canonical_text({name: bounded(value) for name, value in members.items()})
    return text if len(text) <= SIDE_LENGTH_MAX else canonical_text(stand_in(members))


def bounded(value: object) -> object:
    """A value, or what stands for one that is too long."""
    is_long = len(canonical_text({"": value})) > VALUE_LENGTH_MAX
    return stand_in({"": value}) if is_long else value


def stand_in(members: Members) -> Members:
    """What stands for a value that is too long to be kept twice."""
    return {"sha256": sha256_of(members), "characters": len(canonical_text(members))}
