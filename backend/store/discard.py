"""Objects the store gave up: noted in the transaction that gives them up, removed afterwards.

Only what is noted here is ever unlinked. A crash between the two leaves the note, and the next
opening removes the object; an object without a note is somebody's and is kept.
"""

from __future__ import annotations

from collections.abc import Iterable

from sqlalchemy import Connection, delete, insert, select

from backend.store import tables as t
from backend.store.database import Database
from backend.store.objects import Objects, sidecar_key


def with_sidecar(ride_key: str) -> tuple[str, str]:
    """A ride's object and what a person wrote about it."""
    return ride_key, sidecar_key(ride_key)


def note_discarded(connection: Connection, keys: Iterable[str]) -> None:
    """Say that nobody needs these objects any more."""
    for key in keys:
        take_back(connection, [key])
        connection.execute(insert(t.discarded_object).values(key=key))


def take_back(connection: Connection, keys: Iterable[str]) -> None:
    """Say that these objects are needed, or are gone."""
    wanted = list(keys)
    connection.execute(delete(t.discarded_object).where(t.discarded_object.c.key.in_(wanted)))


def discarded_keys(connection: Connection) -> set[str]:
    """Every object that was given up and may still be there."""
    return set(connection.execute(select(t.discarded_object.c.key)).scalars())


def remove_discarded(database: Database, objects: Objects, keys: Iterable[str]) -> None:
    """Remove objects that were given up, then their notes. Raises StoreError; safe to repeat."""
    gone = list(keys)
    for key in gone:
        objects.remove(key)
    if gone:
        database.write(lambda connection: take_back(connection, gone))
