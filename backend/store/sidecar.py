"""What a person wrote about a ride, beside its object: `rides/ab/<sha256>.json`.

    {"schema_version": 1, "name": "...", "notes": "...", "tags": ["..."],
     "accepted_doubts": ["..."]}

It is written in the transaction that changes the ride, so that SQL and file say the same, and only
for rides that have something to say.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

from sqlalchemy import Connection, select

from backend.errors import ObjectsAway, StoreError
from backend.store.facts import WORDS
from backend.store.objects import Objects, sidecar_key
from backend.store.ride_table import tags_of
from backend.store.sql import tables as t

LOG = logging.getLogger(__name__)

SIDECAR_VERSION = 1


def read_sidecar(objects: Objects, ride_key: str) -> dict[str, Any]:
    """The sidecar of a ride's object, empty if it has none. Raises StoreError if it is damaged."""
    key = sidecar_key(ride_key)
    body = objects.read_json(key) or {}
    lists = (body.get("tags", []), body.get("accepted_doubts", []))
    if not all(is_text(body[name]) for name in WORDS if name in body) or not all(
        isinstance(one, list) and all(map(is_text, one)) for one in lists
    ):
        raise StoreError(f"{key} cannot be read: it is no sidecar of a ride.")
    return body


def is_text(value: object) -> bool:
    """Whether every database can keep this as text."""
    try:
        return isinstance(value, str) and "\0" not in value and value.encode() is not None
    except UnicodeEncodeError:
        return False


def write_sidecar(
    objects: Objects,
    ride_key: str,
    name: str,
    notes: str,
    tags: Sequence[str],
    accepted_doubts: Sequence[str] = (),
) -> None:
    """Write what a person wrote; what else is there stays. Raises StoreError."""
    try:
        body = read_sidecar(objects, ride_key)
    except ObjectsAway:
        raise
    except StoreError as error:
        LOG.warning("%s It is written anew.", error.message)
        body = {}
    body |= {"schema_version": SIDECAR_VERSION, "name": name, "notes": notes, "tags": list(tags)}
    body |= {"accepted_doubts": list(accepted_doubts)}
    objects.publish_json(sidecar_key(ride_key), body)


def save_words(
    connection: Connection, objects: Objects, ride_id: int, even_if_empty: bool = False
) -> None:
    """Write a finished ride's sidecar as the transaction has it, when there is something to say."""
    columns = (t.ride.c.name, t.ride.c.notes, t.ride.c.object_key, t.ride.c.accepted_doubts)
    row = connection.execute(select(*columns).where(t.ride.c.id == ride_id)).first()
    tags = tags_of(connection, [ride_id]).get(ride_id, ())
    if row is None or not row.object_key:
        return
    if row.name or row.notes or tags or row.accepted_doubts or even_if_empty:
        accepted = row.accepted_doubts
        write_sidecar(objects, row.object_key, row.name, row.notes, tags, accepted)
