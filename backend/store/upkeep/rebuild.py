"""Every ride of a folder brought back into an empty database, from the rides' own files.

    look -> lock -> set a destroyed database aside -> a new one, marked as being rebuilt
         -> ride by ride, each in one transaction -> the mark taken away

Overviews and figures are computed anew; everything else comes from file and sidecar. A rebuild that
was interrupted goes on where it stood. Nothing in the folder is changed but its identity, which is
written when it has none.
"""

from __future__ import annotations

import secrets
import time
from collections.abc import Iterable
from contextlib import ExitStack, suppress
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path, PurePosixPath

from sqlalchemy import Connection, insert, select

from backend.errors import InvalidRequest, StoreError
from backend.store.calibrations.restored import bring_back_calibration, is_calibration
from backend.store.deletion import FILLED, MADE, join_source
from backend.store.digest import digest
from backend.store.facts import KeptRide, Original, kept_ride
from backend.store.finish import WrittenObject
from backend.store.identity import new_id, write_identity
from backend.store.locks import hold
from backend.store.logbook.book import set_tags
from backend.store.look import DAMAGED, EMPTY, MISSING, OK, DatabaseView, look_at
from backend.store.objects import (
    RIDE_SUFFIX,
    SIDECAR_SUFFIX,
    FileObjects,
    content_key,
    free_name,
    open_objects,
    sidecar_key,
)
from backend.store.parquet import RideFile, read_facts
from backend.store.ride_table import finish_row, inserted, row_of
from backend.store.sidecar import read_sidecar
from backend.store.sql import tables as t
from backend.store.sql.database import Database, shown, sqlite_path
from backend.store.sql.database_url import check_url
from backend.store.store import saying_where
from backend.store.upkeep.check import damage_of

# Where a destroyed SQLite file may have left something.
JOURNALS = ("-wal", "-shm", "-journal")
# What facts raise that make no sense, and words that are none a ride can have.
NONSENSE = (KeyError, TypeError, ValueError, AttributeError, InvalidRequest)


@dataclass
class Rebuilt:
    """What a rebuild did.

    rides, calibrations, calibrations_open: added now. rides_before: there already. lacking: what
    older files do not tell, by key. not_taken: files that are not whole, with the reason; stay:
    those of them that no start moves away. superseded: rides of
    which there is a fuller version. set_aside: files of the destroyed database, under their new
    names.
    """

    store_id: str
    rides: int = 0
    rides_before: int = 0
    calibrations: int = 0
    calibrations_open: int = 0
    lacking: dict[str, tuple[str, ...]] = field(default_factory=dict)
    not_taken: dict[str, str] = field(default_factory=dict)
    stay: dict[str, str] = field(default_factory=dict)
    superseded: list[str] = field(default_factory=list)
    originals_without_ride: list[str] = field(default_factory=list)
    originals_missing: list[str] = field(default_factory=list)
    set_aside: list[str] = field(default_factory=list)

    def as_json(self) -> dict[str, object]:
        """The report as plain JSON."""
        return asdict(self)


def rebuild_store(db_url: str, objects_url: str) -> Rebuilt:
    """Bring every ride of the folder into an empty, missing or destroyed database.

    Repeating it adds what is not there yet. Raises StoreError when a server is running, or when the
    database holds something and is not this folder's; then nothing was changed. InvalidRequest for
    a URL that is none.
    """
    check_url(db_url)
    objects = open_objects(objects_url)
    if not objects.root.is_dir():
        raise StoreError(f"There is no folder {objects.root} to rebuild a database from.")
    with saying_where():
        return rebuilt_store(db_url, objects)


def rebuilt_store(db_url: str, objects: FileObjects) -> Rebuilt:
    """As `rebuild_store`, over a folder that is there. Raises OSError as the system does."""
    may_be_rebuilt(look_at(db_url), db_url, objects)
    with ExitStack() as closing:
        hold(closing, db_url, objects)
        view = look_at(db_url)
        store_id = may_be_rebuilt(view, db_url, objects) or new_id()
        report = Rebuilt(store_id, set_aside=set_aside(view, db_url))
        objects.set_identity(store_id)
        database = Database(db_url)
        closing.callback(database.close)
        server_id = new_id()
        database.write(lambda c: write_identity(c, store_id, server_id, rebuilding=True))
        bring_back(database, objects, view, report)
        database.write(lambda c: write_identity(c, store_id, server_id, rebuilding=False))
    return report


def may_be_rebuilt(view: DatabaseView, db_url: str, objects: FileObjects) -> str | None:
    """The folder's identity, None when it has none. Raises StoreError for what must not be filled.

    A folder whose identity cannot be read gets a new one with an empty database.
    """
    try:
        store_id = objects.identity()
    except StoreError:
        store_id = None
    if view.state in (MISSING, EMPTY, DAMAGED):
        return store_id
    if view.state == OK and view.identity is not None and view.identity == store_id:
        return store_id
    raise StoreError(
        f"The database {shown(db_url)} is not empty and not of the folder {objects.root}: it was "
        "not touched. Name a new one with SPINDLE_DB, or move this one away, and rebuild again."
    )


def set_aside(view: DatabaseView, db_url: str) -> list[str]:
    """Rename what is left of a destroyed SQLite file; returns the new names."""
    path = sqlite_path(db_url)
    if view.state == OK or path is None:
        return []
    left = [path] if view.state == DAMAGED else []
    left += [path.with_name(path.name + suffix) for suffix in JOURNALS]
    moved = []
    for old in left:
        if old.exists():
            new = free_name(old.with_name(f"{old.name}.damaged"))
            old.rename(new)
            moved.append(str(new))
    return moved


def bring_back(
    database: Database, objects: FileObjects, view: DatabaseView, report: Rebuilt
) -> None:
    """Add every whole ride the database does not know, the oldest first."""
    keys = list(objects.keys())
    kept: list[KeptRide] = []
    for key in keys:
        if key.startswith("originals/") or key.endswith(SIDECAR_SUFFIX):
            continue
        try:
            kept.append(read_kept(objects, key))
        except StoreError as error:
            report.not_taken[key] = error.message
    fuller = {content_key("rides", old, RIDE_SUFFIX) for ride in kept for old in ride.replaces}
    for one in sorted(kept, key=lambda kept: (kept.ride.started_us, str(kept.ride.object_key))):
        key = str(one.ride.object_key)
        if key in fuller:
            report.superseded.append(key)
        elif key in view.known_keys:
            report.rides_before += 1
        else:
            try:
                lacks = add_kept(database, objects, one)
            except NONSENSE as error:
                report.not_taken[key] = f"{key} tells no ride: {error!r}."
                continue
            report.rides += 1
            if lacks:
                report.lacking[key] = lacks
    named = {one.sha256 for ride in kept for one in files_of(ride)}
    here = {PurePosixPath(key).name: key for key in keys if key.startswith("originals/")}
    known = {key for key in here.values() if key in view.known_keys}
    bring_back_calibrations(database, objects, keys, report)
    report.originals_without_ride = sorted(
        key for sha256, key in here.items() if sha256 not in named and key not in known
    )
    report.originals_missing = sorted(content_key("originals", s) for s in named - here.keys())


def bring_back_calibrations(
    database: Database, objects: FileObjects, keys: Iterable[str], report: Rebuilt
) -> None:
    """Add every calibration whose file is whole: the closed ones, then those that are open."""
    for key in filter(is_calibration, keys):
        try:
            if (reason := damage_of(objects, key)) is not None:
                raise StoreError(f"{key} is no whole calibration: {reason}.")
            report.calibrations += bring_back_calibration(database, objects, key)
        except StoreError as error:
            report.not_taken[key] = error.message
    for key in objects.calibrating_keys():
        try:
            report.calibrations_open += bring_back_calibration(database, objects, key)
        except StoreError as error:
            report.stay[key] = error.message


def files_of(kept: KeptRide) -> Iterable[Original]:
    """Every file a ride lives on, also those that held others."""
    for one in (kept.original, *kept.earlier, *kept.filled_from):
        while one is not None:
            yield one
            one = one.container


def read_kept(objects: FileObjects, key: str) -> KeptRide:
    """A ride as its whole file and sidecar tell it. Raises StoreError when it is not whole."""
    if (reason := damage_of(objects, key)) is not None:
        raise StoreError(f"{key} is no whole ride: {reason}.")
    facts, channels, row_count = read_facts(objects.local_path(key))
    with suppress(StoreError, *NONSENSE):
        return kept_ride(facts, read_sidecar(objects, key), channels, row_count, key)
    try:
        kept = kept_ride(facts, {}, channels, row_count, key)
    except NONSENSE as error:
        raise StoreError(f"{key} tells no ride: {error!r}.") from error
    lost = f"what {sidecar_key(key)} said, which is damaged"
    return replace(kept, lacks=(*kept.lacks, lost))


def add_kept(database: Database, objects: FileObjects, kept: KeptRide) -> tuple[str, ...]:
    """Add one ride with its overview, figures and uploads; returns what it lacks."""
    ride, key = kept.ride, str(kept.ride.object_key)
    path = objects.local_path(key)
    found = digest(RideFile(path, ride.channels), ride)
    if kept.gaps is not None and kept.events is not None:
        found = replace(found, gaps=kept.gaps, events=kept.events)
    completeness = ride.completeness
    if "completeness" in kept.lacks and ride.period_us is not None and ride.row_count:
        completeness = 1.0 - found.rows_empty / ride.row_count
    written = WrittenObject(
        key, path.stem, path.stat().st_size, ride.row_count, found, completeness
    )
    state = "complete" if completeness in (None, 1.0) else "partial"

    def work(connection: Connection) -> None:
        upload_id = None
        if kept.original is not None:
            upload_id = upload_of(connection, objects, kept.original, state, completeness)
        ride_id = inserted(connection, row_of(ride) | {"upload_id": upload_id}, ride.context)
        finish_row(connection, ride_id, written)
        set_tags(connection, ride_id, ride.tags)
        for file in files_of(replace(kept, filled_from=())):
            held = upload_of(connection, objects, file, state, completeness)
            join_source(connection, ride_id, held, MADE)
        for file in kept.filled_from:
            log_id = upload_of(connection, objects, file, "complete", None, filled=ride_id)
            join_source(connection, ride_id, log_id, FILLED)

    database.write(work)
    return kept.lacks


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
    known = connection.execute(query.order_by(t.upload.c.id).limit(1)).scalar()
    if known is not None:
        return int(known)
    key = content_key("originals", file.sha256)
    path = objects.root / key
    size, created_us = arrived(path)
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
        "object_key": key if path.is_file() else None,
        "created_us": created_us,
        "part_of": None
        if file.container is None
        else upload_of(connection, objects, file.container, "complete", None),
    }
    added = insert(t.upload).values(values).returning(t.upload.c.id)
    return int(connection.execute(added).scalar_one())


def arrived(path: Path) -> tuple[int, int]:
    """Size of an original and when it was written; nothing and now when it is gone."""
    try:
        status = path.stat()
    except OSError:
        return 0, time.time_ns() // 1000
    return status.st_size, status.st_mtime_ns // 1000


def told(report: Rebuilt) -> Iterable[str]:
    """The report in lines for people."""
    yield f"{report.rides} rides brought back, {report.rides_before} were there already."
    if report.calibrations:
        yield f"{report.calibrations} calibrations brought back."
    if report.calibrations_open:
        yield f"{report.calibrations_open} open calibrations brought back: go on with them."
    for name in report.set_aside:
        yield f"The destroyed database is kept as {name}."
    for key, lacks in report.lacking.items():
        yield f"{key}: an older file; not known: {', '.join(lacks)}."
    for key, reason in (report.not_taken | report.stay).items():
        yield f"{key}: not taken. {reason}"
    for key in report.superseded:
        yield f"{key}: there is a fuller version of this ride."
    for key in report.originals_without_ride:
        yield f"{key}: no ride names this original."
    for key in report.originals_missing:
        yield f"{key}: the original of a ride is missing."
    if left := len(report.superseded) + len(report.originals_without_ride) + len(report.not_taken):
        yield f"The next start of the server moves {left} of these files to lost+found/."
