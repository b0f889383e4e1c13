"""What is there: database, folder, and how the one fits the other. Writes nothing.

Every object is read and hashed against its name. Works beside a running server, and with a
database that is damaged or gone.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from sqlalchemy import select

from backend.core.ride import iso_utc
from backend.errors import ObjectsAway, StoreError
from backend.store.bucket import open_objects
from backend.store.entries import ROWS_AT_ONCE
from backend.store.from_object import damage_of
from backend.store.identity import belonging
from backend.store.inspect_schema import (
    OK,
    DatabaseView,
    LiveRecording,
    inspect_database,
    reading_engine,
)
from backend.store.objects import FileObjects
from backend.store.ride_table import damaged_rows
from backend.store.sql import tables as t
from backend.store.sql.database import HEAD_REVISION, current_revision, shown, sqlite_path
from backend.store.sql.database_url import check_url
from backend.store.store import saying_where

# A recording commits once a second; one that has not for so long has no server any more.
HEARTBEAT_LATE_US = 30_000_000


@dataclass(frozen=True)
class Damage:
    """A file that is not what its name says. reason: for people."""

    key: str
    reason: str


@dataclass(frozen=True)
class StoreCheck:
    """What `check_store` found.

    reason: why database and folder are not one store, None when they are. sound: objects that are
    what their name says, known or not. rides_damaged: rides whose rows in the database cannot be
    read. missing: the database names them and they are not there.
    """

    database_url: str
    database: DatabaseView
    folder: str
    folder_id: str | None
    reason: str | None
    sound: int
    bytes: int
    missing: tuple[str, ...]
    damaged: tuple[Damage, ...]
    rides_damaged: tuple[int, ...]
    unknown: tuple[str, ...]
    lost_found: tuple[str, ...]

    @property
    def is_fine(self) -> bool:
        """Whether a server would start and find everything."""
        return not (
            self.reason or self.missing or self.damaged or self.rides_damaged or self.unknown
        )

    def as_json(self) -> dict[str, object]:
        """The check as plain JSON."""
        view = self.database
        return {
            "ok": self.is_fine,
            "belongs": self.reason is None,
            "reason": self.reason,
            "database": {
                "url": self.database_url,
                "state": view.state,
                "detail": view.detail,
                "identity": view.identity,
                "rides": view.rides,
                "rides_damaged": list(self.rides_damaged),
                "live": [live_json(recording) for recording in view.live],
            },
            "folder": {"path": self.folder, "identity": self.folder_id},
            "objects": {
                "sound": self.sound,
                "bytes": self.bytes,
                "missing": list(self.missing),
                "damaged": [asdict(damage) for damage in self.damaged],
                "unknown": list(self.unknown),
                "lost_found": list(self.lost_found),
            },
        }


def check_store(db_url: str, objects_url: str, cache: Path | None = None) -> StoreCheck:
    """Look at everything.

    Raises StoreError when the database's server cannot be reached or a file may not be read,
    InvalidRequest for a URL that is none.
    """
    check_url(db_url)
    with saying_where():
        return checked(db_url, open_objects(objects_url, cache))


def checked(db_url: str, objects: FileObjects) -> StoreCheck:
    """As `check_store`. Raises OSError where the system refuses a path."""
    view = inspect_database(db_url, check_contents=True)
    try:
        folder_id = objects.identity()
    except ObjectsAway:
        raise
    except StoreError:
        folder_id = None
    keys = set(objects.keys())
    sound, size, damaged = 0, 0, []
    for key in sorted(keys):
        reason = damage_of(objects, key)
        if reason is None:
            sound += 1
            size += objects.local_path(key).stat().st_size
        else:
            damaged.append(Damage(key, reason))
    return StoreCheck(
        database_url=shown(db_url),
        database=view,
        folder=objects.where,
        folder_id=folder_id,
        reason=belonging(view, objects).reason,
        sound=sound,
        bytes=size,
        missing=tuple(sorted(view.object_keys - keys)),
        damaged=tuple(damaged),
        rides_damaged=damaged_rides(db_url) if view.state == OK else (),
        unknown=tuple(sorted(keys - view.named_keys)),
        lost_found=tuple(objects.lost_keys()),
    )


def damaged_rides(db_url: str) -> tuple[int, ...]:
    """Rides whose rows cannot be read; of a database of today's schema only."""
    engine = reading_engine(db_url, sqlite_path(db_url))
    try:
        if current_revision(engine) != HEAD_REVISION:
            return ()
        with engine.connect() as connection:
            ids = connection.execute(select(t.ride.c.id).order_by(t.ride.c.id)).scalars().all()
            damaged: list[int] = []
            for start in range(0, len(ids), ROWS_AT_ONCE):
                damaged += damaged_rows(connection, ids[start : start + ROWS_AT_ONCE])
            return tuple(damaged)
    finally:
        engine.dispose()


def live_json(recording: LiveRecording) -> Mapping[str, object]:
    """A ride without an object: whether somebody records it now."""
    beat_us = recording.heartbeat_us
    late = beat_us is None or time.time_ns() // 1000 - beat_us > HEARTBEAT_LATE_US
    return {
        "ride_id": recording.ride_id,
        "row_count": recording.row_count,
        "state": "orphan" if late else "recording",
        "heartbeat_at": None if beat_us is None else iso_utc(beat_us),
    }
