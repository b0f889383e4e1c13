"""The whole store as one zip, made while the server runs, and where the store is.

    spindle.db         the database at one moment, checked before the first byte is sent
    objects/...        every object that database names, and the store's identity
    backup.json        last: what is in it, and what was missing or damaged

Unpacked into an empty folder it is a data folder: `spindle store check` and `spindle serve` take it
with `--data`. What is cut short on the way has no directory at its end and opens nowhere. A
PostgreSQL database is not in it, since its own tools copy that; the folder alone brings every ride
back with `spindle store rebuild`.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import time
from collections.abc import Generator, Iterator, Sequence
from pathlib import Path, PurePosixPath
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

from sqlalchemy import func, select

from backend.core.described import described
from backend.core.ride import iso_utc
from backend.errors import ObjectsAway, StoreError
from backend.store.inspect_schema import inspect_database
from backend.store.objects import IDENTITY, READ_BYTES, RIDE_SUFFIX, sidecar_key
from backend.store.pipe import Pipe
from backend.store.sql import tables as t
from backend.store.sql.database import shown, sqlite_path
from backend.store.sql.snapshot import snapshot
from backend.store.store import Store

DATABASE = "spindle.db"
FOLDER = "objects"
MANIFEST = "backup.json"


@described
class StorePlace:
    """The database and the folder of rides and files, with what they hold."""

    database: str
    """Its URL, without a password."""
    folder: str
    """Of rides and originals: a folder of the server's machine, or a bucket."""
    rides: int
    database_bytes: int | None
    """Null where a database server keeps it."""
    object_bytes: int
    free_bytes: int | None
    """On the disk of the folder; null for a bucket."""


def place_of(store: Store) -> StorePlace:
    """Where a store is and how much it holds. Raises StoreError."""
    url = url_of(store)
    path = sqlite_path(url)
    root = store.objects.root
    files = [path, path.with_name(f"{path.name}-wal")] if path else []
    rides = select(func.count()).select_from(t.ride)
    return StorePlace(
        database=shown(url),
        folder=store.objects.where,
        rides=int(store.database.read(lambda c: c.execute(rides).scalar_one())),
        database_bytes=sum(map(size_of, files)) if path else None,
        object_bytes=store.objects.size_bytes(),
        free_bytes=shutil.disk_usage(root).free if store.objects.is_folder else None,
    )


def url_of(store: Store) -> str:
    """The database's URL with everything that opens it."""
    return store.database.engine.url.render_as_string(hide_password=False)


def size_of(path: Path) -> int:
    """Bytes of a file; none of one that is just going."""
    try:
        return path.stat().st_size
    except OSError:
        return 0


def backup_of(store: Store, version: str) -> Iterator[bytes]:
    """The zip, piece by piece; nothing is deleted from the folder until the last.

    version: of this Spindle, for the list in it. Raises StoreError before the first piece, when the
    database cannot be copied; then there is no zip.
    """
    chunks = written(store, version)
    next(chunks)
    return chunks


def written(store: Store, version: str) -> Iterator[bytes]:
    """As `backup_of`; the first piece is empty and comes once the database is copied."""
    copy = store.objects.stage()
    path = sqlite_path(url_of(store))
    pipe = Pipe()
    try:
        with store.objects.holding():
            if path is not None:
                snapshot(path, copy)
            yield b""
            with ZipFile(pipe, "w") as archive:
                if path is not None:
                    yield from added(archive, pipe, DATABASE, copy, ZIP_DEFLATED)
                url = url_of(store) if path is None else f"sqlite:///{copy}"
                keys = sorted(inspect_database(url).object_keys)
                lacking = yield from added_objects(archive, pipe, store, keys)
                contents = {
                    "format": 1,
                    "made_at": iso_utc(time.time_ns() // 1000),
                    "spindle": version,
                    "database": None if path is None else DATABASE,
                    "objects": len(keys),
                    **lacking,
                }
                archive.writestr(MANIFEST, json.dumps(contents, indent=1))
            yield pipe.taken()
    finally:
        copy.unlink(missing_ok=True)


def added_objects(
    archive: ZipFile, pipe: Pipe, store: Store, keys: Sequence[str]
) -> Generator[bytes, None, dict[str, list[str]]]:
    """Adds the folder's part; returns which objects were `missing` or `damaged`."""
    missing, damaged = [], []
    rides = [key for key in keys if key.endswith(RIDE_SUFFIX)]
    # A sidecar is there for most rides; without it a ride lacks only what a person wrote.
    companions = [*map(sidecar_key, rides), *store.objects.table_keys()]
    companions += [*store.objects.calibrating_keys(), *store.objects.visit_keys()]
    for key in [IDENTITY, *keys, *companions]:
        try:
            file = store.objects.local_path(key)
        except ObjectsAway:
            raise
        except StoreError:
            missing += [key] if key in keys else []
            continue
        sha256 = yield from added(archive, pipe, f"{FOLDER}/{key}", file, ZIP_STORED)
        if key in keys and sha256 != PurePosixPath(key).stem:
            damaged.append(key)
    return {"missing": missing, "damaged": damaged}


def added(
    archive: ZipFile, pipe: Pipe, name: str, path: Path, method: int
) -> Generator[bytes, None, str]:
    """Adds one file; returns the SHA-256 of its bytes. An OSError cuts the zip short."""
    member = ZipInfo.from_file(path, name, strict_timestamps=False)
    member.compress_type = method
    hashed = hashlib.sha256()
    with path.open("rb") as file, archive.open(member, "w", force_zip64=True) as target:
        while piece := file.read(READ_BYTES):
            hashed.update(piece)
            target.write(piece)
            yield pipe.taken()
    return hashed.hexdigest()
