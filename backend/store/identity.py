"""Which database belongs to which folder: one random id, kept in both.

A database that does not know the objects beside it is most likely the wrong one: moved away and
made anew, restored from elsewhere, or another folder's. It is refused before anything is written.

    both have an id          the same: open. different: refused
    at least one has none    adopted, if the database knows every object of the folder; else refused
"""

from __future__ import annotations

import secrets
import time
from dataclasses import dataclass

from sqlalchemy import Connection, delete, insert, select, update

from backend.core.audit import Action, AuditEntry, Members
from backend.errors import ObjectsAway, StoreError
from backend.store import audit
from backend.store.inspect_schema import DAMAGED, FOREIGN, DatabaseView
from backend.store.objects import FileObjects
from backend.store.sql import tables as t

WAYS_OUT = (
    "Nothing was changed. `spindle store check` says what is there; `spindle store rebuild` brings "
    "every ride of the folder back into an empty or missing database."
)
FEW = 3


@dataclass(frozen=True)
class Belonging:
    """Whether a database and a folder are one store.

    reason: why not, None when they are. adopted: they become one now, under `store_id`.
    """

    store_id: str | None
    adopted: bool = False
    reason: str | None = None


def new_id() -> str:
    """A store's identity: 128 random bits in hex."""
    return secrets.token_hex(16)


def belonging(view: DatabaseView, objects: FileObjects) -> Belonging:
    """Judge a database and a folder; reads only."""
    try:
        folder_id = objects.identity()
    except ObjectsAway:
        raise
    except StoreError as error:
        return Belonging(None, reason=error.message.rstrip("."))
    if view.state == DAMAGED:
        return Belonging(None, reason=f"the database is damaged ({view.detail})")
    if view.state == FOREIGN:
        return Belonging(None, reason=f"the database is another program's ({view.detail})")
    if view.rebuilding:
        return Belonging(None, reason="a rebuild of the database did not come to its end")
    if view.identity and folder_id:
        if view.identity == folder_id:
            return Belonging(folder_id)
        owners = f"the database is of store {view.identity}, the folder of store {folder_id}"
        return Belonging(None, reason=owners)
    keys = set(objects.keys())
    unknown = sorted(keys - view.named_keys)
    if unknown:
        some = ", ".join(unknown[:FEW]) + (" ..." if len(unknown) > FEW else "")
        reason = f"the database does not know {len(unknown)} files of the folder ({some})"
        if view.object_keys & keys:
            reason += "; if it is the right one, move them elsewhere and start again"
        return Belonging(None, reason=reason)
    if view.identity and view.object_keys and not view.object_keys & keys:
        return Belonging(
            None, reason=f"none of the database's {len(view.object_keys)} objects is in the folder"
        )
    # A folder that two databases took turns with would lose what the other one knows: so an
    # identity that only the folder has is not passed on.
    return Belonging(view.identity or new_id(), adopted=True)


def require(state: Belonging, database: str, objects: FileObjects) -> str:
    """The store's id. Raises StoreError with what to do when the two are not one store."""
    if state.store_id is None:
        raise StoreError(
            f"The database {database} does not belong to the objects in {objects.where}: "
            f"{state.reason}. {WAYS_OUT}"
        )
    return state.store_id


def write_identity(connection: Connection, store_id: str, server_id: str, rebuilding: bool) -> None:
    """Make the database a part of this store, written by this server."""
    values: dict[str, object] = {"rebuilding": rebuilding, "server_id": server_id}
    if connection.execute(select(t.store_identity.c.store_id)).scalar() == store_id:
        connection.execute(update(t.store_identity).values(values))
        return
    connection.execute(delete(t.store_identity))
    now_us = time.time_ns() // 1000
    connection.execute(
        insert(t.store_identity).values(store_id=store_id, created_us=now_us, **values)
    )


def finish_rebuild(connection: Connection, store_id: str, server_id: str, facts: Members) -> None:
    """Take the mark of a rebuild away. In the place of a destroyed database the audit begins anew
    and says so, with `facts`."""
    write_identity(connection, store_id, server_id, rebuilding=False)
    audit.append(connection, AuditEntry(Action.STORE_REBUILT, after=facts))
