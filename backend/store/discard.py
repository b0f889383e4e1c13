"""Objects the store gave up: noted in the transaction that gives them up, removed afterwards.

Only what is noted here is ever unlinked. A crash between the two leaves the note, and the next
sweep removes the object; an object without a note is somebody's and is kept.
"""

from __future__ import annotations

from collections.abc import Iterable

from sqlalchemy import Connection, delete, insert, select

from backend.store.objects import sidecar_key
from backend.store.sql import tables as t


def with_sidecar(ride_key: str) -> tuple[str, str]:
    """A ride's object and what a person wrote about it."""
    return ride_key, sidecar_key(ride_key)


def note_discarded(
    connection: Connection, keys: Iterable[str], due_us: int, ride_id: int | None = None
) -> None:
    """Say that nobody needs these objects any more, and from when on they may go.

    ride_id: whose object it was before it got another; it goes at once with that ride.
    """
    for key in keys:
        take_back(connection, [key])
        body = {"key": key, "due_us": due_us, "ride_id": ride_id}
        connection.execute(insert(t.discarded_object).values(body))


def take_back(connection: Connection, keys: Iterable[str]) -> None:
    """Say that these objects are needed, or are gone."""
    keys_to_keep = list(keys)
    connection.execute(delete(t.discarded_object).where(t.discarded_object.c.key.in_(keys_to_keep)))


def discarded_keys(connection: Connection) -> set[str]:
    """Every object that was given up and may still be there."""
    return set(connection.execute(select(t.discarded_object.c.key)).scalars())
