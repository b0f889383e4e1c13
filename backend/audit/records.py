"""Events read from the chain; what appends them is the store's."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from sqlalchemy import ColumnElement, Row, Select, func, select

from backend.audit.types import AuditEvent, AuditFilter
from backend.core.audit import Action
from backend.core.moments import utc
from backend.errors import StoreError
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.sql.sound_rows import NOT_AS_WRITTEN

OF_PEOPLE = ("account", "key")
ROWS_AT_ONCE = 500


class AuditReader:
    """Every event there is. From any thread; all of it raises StoreError."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def page(self, sought: AuditFilter, limit: int, before_id: int | None) -> list[AuditEvent]:
        """At most `limit` events before the one with this number, the newest first."""
        query = events(sought).order_by(t.audit_event.c.id.desc()).limit(limit)
        if before_id is not None:
            query = query.where(t.audit_event.c.id < before_id)
        return [sound_event(row) for row in self._read(query)]

    def rows(self, sought: AuditFilter) -> Iterator[Mapping[str, Any]]:
        """The events as they are stored, the oldest first, read some at a time."""
        last_id = 0
        query = events(sought).order_by(t.audit_event.c.id).limit(ROWS_AT_ONCE)
        while rows := self._read(query.where(t.audit_event.c.id > last_id)):
            for row in rows:
                yield {column.name: row._mapping[column.name] for column in t.audit_event.columns}
            last_id = rows[-1].id

    def _read(self, query: Select[Any]) -> list[Row[Any]]:
        return self._database.read(lambda connection: list(connection.execute(query).all()))


def events(sought: AuditFilter) -> Select[Any]:
    """Events that are looked for, with what their bike is called now."""
    bike = t.bike.c.name.label("bike_name")
    query = select(t.audit_event, bike).outerjoin(t.bike, t.bike.c.id == t.audit_event.c.bike_id)
    return query.where(*conditions(sought))


def conditions(sought: AuditFilter) -> Iterator[ColumnElement[bool]]:
    """What is true of the events that are looked for."""
    event = t.audit_event.c
    for column, value in (
        (event.action, sought.action),
        (event.object_kind, sought.object_kind),
        (event.unit_key, sought.unit_key),
        (event.bike_id, sought.bike_id),
    ):
        if value is not None:
            yield column == value
    if sought.from_us is not None:
        yield event.at_us >= sought.from_us
    if sought.to_us is not None:
        yield event.at_us < sought.to_us
    if not sought.with_people:
        yield event.object_kind.not_in(OF_PEOPLE)
    if sought.who:
        part = sought.who.lower()
        name = func.lower(event.actor_name).contains(part, autoescape=True)
        yield name | func.lower(event.actor_key).contains(part, autoescape=True)


def sound_event(row: Row[Any]) -> AuditEvent:
    """As `event_of`. Raises StoreError for a row that nobody wrote so."""
    try:
        return event_of(row)
    except NOT_AS_WRITTEN:
        message = f"Event {row.id} of the audit is damaged: `spindle audit verify` says where."
        raise StoreError(message) from None


def event_of(row: Row[Any]) -> AuditEvent:
    """A row of `events`."""
    return AuditEvent(
        id=row.id,
        at=utc(row.at_us),
        actor_kind=row.actor_kind,
        actor_name=row.actor_name,
        person_id=row.actor_id,
        key_name=row.actor_key,
        action=Action(row.action),
        object_kind=row.object_kind,
        object_id=row.object_id,
        object_name=row.object_name,
        unit_key=row.unit_key,
        bike_id=row.bike_id,
        bike_name=row.bike_name,
        before=None if row.before is None else json.loads(row.before),
        after=None if row.after is None else json.loads(row.after),
        reason=row.reason,
        sha256=row.sha256,
    )
