"""Objects that the database names, and those it gave up: listed in the transaction that gives them
up, removed afterwards."""

from __future__ import annotations

from collections.abc import Iterable

from sqlalchemy import Connection, delete, insert, select

from backend.store.objects import RIDE_SUFFIX, content_key, sidecar_key
from backend.store.soundness import Expected
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


def named_objects(key: object, sha256: object) -> tuple[str, ...]:
    """A finished ride's object by its key and by its hash: the same, unless one is damaged."""
    named = [key] if isinstance(key, str) else []
    if isinstance(sha256, str):
        named.append(content_key("rides", sha256, RIDE_SUFFIX))
    return tuple(dict.fromkeys(named))


def calibration_key(sha256: str) -> str:
    """The file of a closed calibration."""
    return content_key("calibrations", sha256, ".json")


def named_keys(connection: Connection) -> set[str]:
    """Keys of every object that a row needs, sidecars too, and of those that were given up and may
    still be there."""
    ride, upload, calibration = t.ride.c, t.upload.c, t.calibration.c
    rides = select(ride.object_key, ride.object_sha256).where(ride.object_key.is_not(None))
    originals = select(upload.object_key, upload.sha256).where(upload.sha256.is_not(None))
    closed = select(calibration.sha256).where(calibration.sha256.is_not(None))
    keys = {
        part
        for row in connection.execute(rides)
        for key in named_objects(*row)
        for part in with_sidecar(key)
    }
    # An original whose key a crash kept from being noted, too.
    keys |= {
        key or content_key("originals", sha256) for key, sha256 in connection.execute(originals)
    }
    keys |= {calibration_key(sha256) for sha256 in connection.execute(closed).scalars()}
    return keys | discarded_keys(connection)


def expected_objects(connection: Connection) -> list[Expected]:
    """Every finished ride's object and every closed calibration's file, as they were written."""
    ride, calibration = t.ride.c, t.calibration.c
    rides = select(ride.object_key, ride.object_bytes).where(ride.object_key.is_not(None))
    closed = select(calibration.sha256).where(calibration.sha256.is_not(None))
    expected = [Expected(*row) for row in connection.execute(rides)]
    files = connection.execute(closed).scalars()
    return expected + [Expected(calibration_key(sha256), None) for sha256 in files]
