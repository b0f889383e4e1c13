"""A ride brought back from its own file: added to a database that has lost it, or its damaged row
written anew. Overviews and figures are computed again; everything else comes from file and sidecar.
"""

from __future__ import annotations

import logging
import re
import secrets
import time
from collections.abc import Iterable
from dataclasses import replace
from pathlib import PurePosixPath

from sqlalchemy import Connection, delete, insert, select, update

from backend.errors import ObjectsAway, StoreError
from backend.store.bikes import whose_ride
from backend.store.deletion import FILLED, MADE, join_source
from backend.store.digest import digest
from backend.store.discard import named_objects
from backend.store.facts import Original, StoredRide, stored_ride
from backend.store.finish import WrittenObject
from backend.store.logbook.book import set_tags
from backend.store.objects import SIDECAR_SUFFIX, FileObjects, content_key, file_sha256, sidecar_key
from backend.store.parquet import RideFile, read_facts
from backend.store.ride_table import finish_row, inserted, row_of
from backend.store.sidecar import read_sidecar
from backend.store.soundness import Expected, Soundness
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.sql.sound_rows import NOT_AS_WRITTEN

LOG = logging.getLogger(__name__)

# What no object knows of its ride's row.
STAY = tuple(
    t.ride.c[name] for name in ("upload_id", "bike_id", "owner_id", "same_ride_as", "created_us")
)
OBJECT_NAME = re.compile(
    r"(rides/([0-9a-f]{2})/(\2[0-9a-f]{62})\.(parquet|json))|"
    r"(originals/([0-9a-f]{2})/(\6[0-9a-f]{62}))|"
    r"(calibrations/([0-9a-f]{2})/(\9[0-9a-f]{62})\.json)"
)


def damage_of(objects: FileObjects, key: str) -> str | None:
    """Why a file is not what its name says, None when it is."""
    if OBJECT_NAME.fullmatch(key) is None:
        return "it has no name that Spindle gives"
    try:
        if key.endswith(SIDECAR_SUFFIX) and key.startswith("rides/"):
            objects.read_json(key)
        elif file_sha256(objects.local_path(key)) != PurePosixPath(key).name.split(".")[0]:
            return "its bytes do not hash to its name"
    except ObjectsAway:
        raise
    except (OSError, StoreError) as error:
        return error.message if isinstance(error, StoreError) else str(error)
    return None


def files_of(stored: StoredRide) -> Iterable[Original]:
    """Every file a ride lives on, also those that held others."""
    for one in (stored.original, *stored.earlier, *stored.filled_from):
        while one is not None:
            yield one
            one = one.container


def read_stored(objects: FileObjects, key: str) -> StoredRide:
    """A ride as its whole file and sidecar tell it. Raises StoreError when it is not whole."""
    if (reason := damage_of(objects, key)) is not None:
        raise StoreError(f"{key} is no whole ride: {reason}.")
    facts, channels, row_count = read_facts(objects.local_path(key))
    try:
        return stored_ride(facts, read_sidecar(objects, key), channels, row_count, key)
    except ObjectsAway:
        raise
    except (StoreError, *NOT_AS_WRITTEN):
        pass
    try:
        stored = stored_ride(facts, {}, channels, row_count, key)
    except NOT_AS_WRITTEN as error:
        raise StoreError(f"{key} tells no ride: {error!r}.") from error
    return replace(stored, lost_words=f"{sidecar_key(key)} is damaged.")


def add_stored(database: Database, objects: FileObjects, stored: StoredRide) -> None:
    """Add one ride with its overview, figures and uploads."""
    ride, written = stored.ride, digested(objects, stored)
    completeness = written.completeness
    state = "complete" if completeness in (None, 1.0) else "partial"

    def work(connection: Connection) -> None:
        upload_id = None
        if stored.original is not None:
            upload_id = upload_of(connection, objects, stored.original, state, completeness)
        ride_id = inserted(connection, row_of(ride) | {"upload_id": upload_id}, ride.context)
        finish_row(connection, ride_id, written)
        set_tags(connection, ride_id, ride.tags)
        for file in files_of(replace(stored, filled_from=())):
            upload_row = upload_of(connection, objects, file, state, completeness)
            join_source(connection, ride_id, upload_row, MADE)
        for file in stored.filled_from:
            log_id = upload_of(connection, objects, file, "complete", None, filled=ride_id)
            join_source(connection, ride_id, log_id, FILLED)

    database.write(work)


def mend_row(database: Database, objects: FileObjects, soundness: Soundness, ride_id: int) -> bool:
    """Write a finished ride's damaged row anew from its object and sidecar; its number, its bike
    and the upload it came with stay. False where none of the objects it names is whole."""
    mine = t.ride.c.id == ride_id
    names = (t.ride.c.object_key, t.ride.c.object_sha256)
    row = database.read(lambda c: c.execute(select(*names, *STAY).where(mine)).first())
    named = () if row is None else named_objects(row.object_key, row.object_sha256)
    ours = (Expected(key, None) for key in named if OBJECT_NAME.fullmatch(key))
    key = next((one.key for one in ours if soundness.damage(one) is None), None)
    if row is None or key is None:
        return False
    stored = read_stored(objects, key)
    ride, written = stored.ride, digested(objects, stored)
    stays = {column.name: row._mapping[column.name] for column in STAY}

    def work(connection: Connection) -> None:
        body = row_of(ride) | whose_ride(connection, ride.context, ride.started_us)
        body |= {name: value for name, value in stays.items() if isinstance(value, int)}
        connection.execute(update(t.ride).where(mine).values(body))
        finish_row(connection, ride_id, written)
        set_tags(connection, ride_id, ride.tags)
        # Worked out anew of the object.
        for table in (t.ride_card, t.ride_zero):
            connection.execute(delete(table).where(table.c.ride_id == ride_id))

    database.write(work)
    LOG.warning("Ride %d: its damaged row was written anew from %s.", ride_id, key)
    return True


def digested(objects: FileObjects, stored: StoredRide) -> WrittenObject:
    """A ride's object as if it had just been written, its overview and figures worked out anew."""
    ride, key = stored.ride, str(stored.ride.object_key)
    path = objects.local_path(key)
    worked_out = digest(RideFile(path, ride.channels), ride)
    result = replace(worked_out, gaps=stored.gaps, events=stored.events)
    size = path.stat().st_size
    return WrittenObject(key, path.stem, size, ride.row_count, result, ride.completeness)


def upload_of(
    connection: Connection,
    objects: FileObjects,
    file: Original,
    state: str,
    completeness: float | None,
    filled: int | None = None,
) -> int:
    """The row id of the upload that brought a file, made anew; filled: the ride it filled."""
    query = select(t.upload.c.id).where(t.upload.c.sha256 == file.sha256)
    existing = connection.execute(query.order_by(t.upload.c.id).limit(1)).scalar()
    if existing is not None:
        return int(existing)
    key = content_key("originals", file.sha256)
    found = objects.arrived(key)
    size = 0 if found is None else found.size_bytes
    values = {
        "token": secrets.token_hex(16),
        "name": file.name,
        "length": size,
        "received": size,
        "sha256": file.sha256,
        "state": state,
        "code": None if filled is None else "filled",
        "completeness": completeness,
        "duplicate_of": filled,
        "object_key": None if found is None else key,
        "created_us": time.time_ns() // 1000 if found is None else found.written_us,
        "part_of": None
        if file.container is None
        else upload_of(connection, objects, file.container, "complete", None),
    }
    added = insert(t.upload).values(values).returning(t.upload.c.id)
    return int(connection.execute(added).scalar_one())
