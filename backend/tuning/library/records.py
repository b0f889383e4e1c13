"""What users keep in the library: every state of every item; the newest is what counts.

Nothing is overwritten and nothing is removed: a change and a deletion add a state. This server
alone writes, so one lock decides who was first.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

from sqlalchemy import Connection, Row, Select, func, insert, select, update

from backend.core.audit import Action, AuditEntry, Members, differing
from backend.core.author import proof_of
from backend.core.canonical_json import sha256_of
from backend.errors import Conflict
from backend.store import audit
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.wall_clock import now_us
from backend.tuning.library.types import LibraryVersion

Body = Mapping[str, Any]
# Called with what an item is now, before it is changed; raises to refuse the change.
Check = Callable[[LibraryVersion], None]

ITEMS_MAX = 1000
VERSIONS_MAX = 1000


class LibraryStore:
    """Items by their number, from any thread."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._turn = threading.Lock()

    def newest(self) -> tuple[LibraryVersion, ...]:
        """What every item is, deleted ones too, by number."""
        last = select(
            t.library_version.c.item_id, func.max(t.library_version.c.seq).label("seq")
        ).group_by(t.library_version.c.item_id)
        newest = last.subquery()
        query = (
            versions()
            .join(
                newest,
                (newest.c.item_id == t.library_version.c.item_id)
                & (newest.c.seq == t.library_version.c.seq),
            )
            .order_by(t.library_version.c.item_id)
        )
        return self._read(query)

    def versions(self, item_id: int) -> tuple[LibraryVersion, ...]:
        """Every state of an item, newest first; empty for one that never was."""
        mine = versions().where(t.library_version.c.item_id == item_id)
        return self._read(mine.order_by(t.library_version.c.seq.desc()).limit(VERSIONS_MAX))

    def add(self, body: Body, author: str) -> LibraryVersion:
        """A new item. body: a checked document. Raises Conflict if its name is taken or there are
        too many items, StoreError."""

        def work(connection: Connection) -> LibraryVersion:
            count = connection.execute(
                select(func.count()).select_from(t.library_item)
            ).scalar_one()
            if count >= ITEMS_MAX:
                message = f"The library holds {ITEMS_MAX} items, deleted ones too, and no more."
                raise Conflict(message, "library_full")
            require_free(connection, body["name"])
            values = {"name": body["name"], "created_us": now_us()}
            made = insert(t.library_item).values(values).returning(t.library_item.c.id)
            item_id = int(connection.execute(made).scalar_one())
            version = append(connection, item_id, 1, body, author)
            audit.append(connection, entry_of(Action.LIBRARY_ITEM_ADDED, version, {}, flat(body)))
            return version

        with self._turn:
            return self._database.write(work)

    def change(
        self, item_id: int, check: Check, author: str, body: Body | None
    ) -> LibraryVersion | None:
        """Give an item another content, or delete it; its new state.

        body: a checked document, which brings a deleted item back; None deletes. None is returned
        for an item that never was. Raises what `check` does, Conflict if its name is taken by
        another or it has changed too often, StoreError.
        """

        def work(connection: Connection) -> LibraryVersion | None:
            row = connection.execute(
                versions()
                .where(t.library_version.c.item_id == item_id)
                .order_by(t.library_version.c.seq.desc())
                .limit(1)
            ).first()
            if row is None:
                return None
            now = version_of(row)
            check(now)
            if now.seq >= VERSIONS_MAX:
                message = f"This item has changed {VERSIONS_MAX} times: save it as a new one."
                raise Conflict(message, "library_full")
            name = None if body is None else body["name"]
            if name is not None:
                require_free(connection, name, item_id)
            mine = t.library_item.c.id == item_id
            connection.execute(update(t.library_item).where(mine).values(name=name))
            stored = now.body if body is None else body
            version = append(connection, item_id, now.seq + 1, stored, author, deleted=body is None)
            gone = body is None
            action = Action.LIBRARY_ITEM_REMOVED if gone else Action.LIBRARY_ITEM_CHANGED
            entry = entry_of(action, version, state_of(now), state_of(version))
            audit.append(connection, entry)
            return version

        with self._turn:
            return self._database.write(work)

    def _read(self, query: Select[Any]) -> tuple[LibraryVersion, ...]:
        rows = self._database.read(lambda connection: connection.execute(query).all())
        return tuple(version_of(row) for row in rows)


def versions() -> Select[Any]:
    """Every state of every item, with when the item was made."""
    made = t.library_item.c.created_us.label("made_us")
    of_item = t.library_item.c.id == t.library_version.c.item_id
    return select(t.library_version, made).join(t.library_item, of_item)


def version_of(row: Row[Any]) -> LibraryVersion:
    """A row of `versions`."""
    return LibraryVersion(
        item_id=row.item_id,
        seq=row.seq,
        deleted=row.deleted,
        body=row.body,
        sha256=row.sha256,
        author=row.author,
        author_proof=row.author_proof,
        made_us=row.made_us,
        created_us=row.created_us,
    )


def require_free(connection: Connection, name: str, item_id: int | None = None) -> None:
    """Raises Conflict if another item is called so."""
    taken = select(t.library_item.c.id).where(t.library_item.c.name == name)
    owner = connection.execute(taken).scalar()
    if owner is not None and owner != item_id:
        raise Conflict(f"The library has a {name!r} already: choose another name.", "name_taken")


def append(
    connection: Connection, item_id: int, seq: int, body: Body, author: str, deleted: bool = False
) -> LibraryVersion:
    """Add a state to an item."""
    values = {
        "item_id": item_id,
        "seq": seq,
        "deleted": deleted,
        "body": dict(body),
        "sha256": sha256_of(body),
        "author": str(author),
        "author_proof": proof_of(author),
        "created_us": now_us(),
    }
    connection.execute(insert(t.library_version).values(values))
    query = versions().where(t.library_version.c.item_id == item_id, t.library_version.c.seq == seq)
    return version_of(connection.execute(query).one())


def flat(body: Body) -> Members:
    """A document's members for the audit, each parameter under its own name."""
    values = {name: one.get("value") for name, one in body.get("parameters", {}).items()}
    return {name: value for name, value in body.items() if name != "parameters"} | values


def state_of(version: LibraryVersion) -> Members:
    """As `flat`, of a state that may be a deletion."""
    return {**flat(version.body), "deleted": version.deleted}


def entry_of(
    action: Action, version: LibraryVersion, before: Members, after: Members
) -> AuditEntry:
    """A new state of an item for the audit."""
    old, new = differing(before, after)
    return AuditEntry(action, f"own-{version.item_id}", version.name, old if before else None, new)
