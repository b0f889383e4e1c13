"""Every ride of a folder brought back into an empty database, from the rides' own files.

    look -> lock -> set a destroyed database aside -> a new one, marked as being rebuilt
         -> ride by ride, each in one transaction -> the mark taken away

A rebuild that was interrupted goes on where it stood, and mends rows of rides that are damaged.
Nothing in the folder is changed but its identity, which is written when it has none.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field
from pathlib import Path, PurePath, PurePosixPath

from backend.calibration.files import bring_back_calibration, is_calibration
from backend.errors import ObjectsAway, StoreError
from backend.store.bucket import open_objects
from backend.store.entries import Entries
from backend.store.facts import StoredRide
from backend.store.from_object import add_stored, damage_of, files_of, read_stored
from backend.store.identity import finish_rebuild, new_id, write_identity
from backend.store.inspect_schema import DAMAGED, EMPTY, MISSING, OK, DatabaseView, inspect_database
from backend.store.locks import hold
from backend.store.objects import (
    RIDE_SUFFIX,
    SIDECAR_SUFFIX,
    FileObjects,
    content_key,
    free_name,
)
from backend.store.soundness import Soundness
from backend.store.sql.database import Database, shown, sqlite_path
from backend.store.sql.database_url import check_url
from backend.store.sql.sound_rows import NOT_AS_WRITTEN
from backend.store.store import saying_where
from backend.visits.records import bring_back_visit

# Where a destroyed SQLite file may have left something.
JOURNALS = ("-wal", "-shm", "-journal")


@dataclass
class Rebuilt:
    """What a rebuild did.

    rides, calibrations, calibrations_open, visits: added now. rides_before: there already.
    rides_mended: those of them whose rows were damaged; rides_damaged: whose rows still are.
    lost_words: rides whose name, notes and tags are not known, by key. not_taken: files that are
    not whole, with the reason; stay: those of them that no start moves away. superseded: rides of
    which there is a fuller version. set_aside: files of the destroyed database, under their new
    names.
    """

    store_id: str
    rides: int = 0
    rides_before: int = 0
    rides_mended: int = 0
    rides_damaged: tuple[int, ...] = ()
    calibrations: int = 0
    calibrations_open: int = 0
    visits: int = 0
    lost_words: dict[str, str] = field(default_factory=dict)
    not_taken: dict[str, str] = field(default_factory=dict)
    stay: dict[str, str] = field(default_factory=dict)
    superseded: list[str] = field(default_factory=list)
    originals_without_ride: list[str] = field(default_factory=list)
    originals_missing: list[str] = field(default_factory=list)
    set_aside: list[str] = field(default_factory=list)

    def as_json(self) -> dict[str, object]:
        """The report as plain JSON."""
        return asdict(self)


def rebuild_store(db_url: str, objects_url: str, cache: Path | None = None) -> Rebuilt:
    """Bring every ride of the folder into an empty, missing or destroyed database.

    Repeating it adds what is not there yet. Raises StoreError when a server is running, or when the
    database holds something and is not this folder's; then nothing was changed. InvalidRequest for
    a URL that is none.
    """
    check_url(db_url)
    objects = open_objects(objects_url, cache)
    if objects.is_folder and not objects.root.is_dir():
        raise StoreError(f"There is no folder {objects.where} to rebuild a database from.")
    with saying_where():
        return rebuilt_store(db_url, objects)


def rebuilt_store(db_url: str, objects: FileObjects) -> Rebuilt:
    """As `rebuild_store`, over a folder that is there. Raises OSError as the system does."""
    may_be_rebuilt(inspect_database(db_url, check_contents=True), db_url, objects)
    with ExitStack() as closing:
        hold(closing, db_url, objects)
        view = inspect_database(db_url, check_contents=True)
        store_id = may_be_rebuilt(view, db_url, objects) or new_id()
        report = Rebuilt(store_id, set_aside=set_aside(view, db_url))
        objects.set_identity(store_id)
        database = Database(db_url)
        closing.callback(database.close)
        server_id = new_id()
        database.write(lambda c: write_identity(c, store_id, server_id, rebuilding=True))
        mend_rows(database, objects, report)
        bring_back(database, objects, view, report)
        facts = {
            "rides": report.rides,
            "rides_mended": report.rides_mended,
            "calibrations": report.calibrations,
            "set_aside": [PurePath(name).name for name in report.set_aside],
        }
        database.write(lambda c: finish_rebuild(c, store_id, server_id, facts))
    return report


def may_be_rebuilt(view: DatabaseView, db_url: str, objects: FileObjects) -> str | None:
    """The folder's identity, None when it has none. Raises StoreError for what must not be filled.

    A folder whose identity cannot be read gets a new one with an empty database.
    """
    try:
        store_id = objects.identity()
    except ObjectsAway:
        raise
    except StoreError:
        store_id = None
    if view.state in (MISSING, EMPTY, DAMAGED):
        return store_id
    if view.state == OK and view.identity is not None and view.identity == store_id:
        return store_id
    raise StoreError(
        f"The database {shown(db_url)} is not empty and not of the objects in "
        f"{objects.where}: it was not touched. Name a new one with SPINDLE_DB, or move this one "
        "away, and rebuild again."
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


def mend_rows(database: Database, objects: FileObjects, report: Rebuilt) -> None:
    """Mend every ride's row that is damaged, where its object is whole."""
    entries = Entries(database, objects, Soundness(objects))
    entries.check_all()
    report.rides_mended, report.rides_damaged = entries.mended, tuple(sorted(entries.damaged))


def bring_back(
    database: Database, objects: FileObjects, view: DatabaseView, report: Rebuilt
) -> None:
    """Add every whole ride the database does not know, the oldest first."""
    keys = list(objects.keys())
    stored: list[StoredRide] = []
    for key in keys:
        if key.startswith("originals/") or key.endswith(SIDECAR_SUFFIX):
            continue
        try:
            stored.append(read_stored(objects, key))
        except ObjectsAway:
            raise
        except StoreError as error:
            report.not_taken[key] = error.message
    fuller = {content_key("rides", old, RIDE_SUFFIX) for ride in stored for old in ride.replaces}
    for one in sorted(
        stored, key=lambda stored: (stored.ride.started_us, str(stored.ride.object_key))
    ):
        key = str(one.ride.object_key)
        if key in fuller:
            report.superseded.append(key)
        elif key in view.named_keys:
            report.rides_before += 1
        else:
            try:
                add_stored(database, objects, one)
            except NOT_AS_WRITTEN as error:
                report.not_taken[key] = f"{key} tells no ride: {error!r}."
                continue
            report.rides += 1
            if one.lost_words is not None:
                report.lost_words[key] = one.lost_words
    named = {one.sha256 for ride in stored for one in files_of(ride)}
    here = {PurePosixPath(key).name: key for key in keys if key.startswith("originals/")}
    known_keys = {key for key in here.values() if key in view.named_keys}
    bring_back_calibrations(database, objects, keys, report)
    report.originals_without_ride = sorted(
        key for sha256, key in here.items() if sha256 not in named and key not in known_keys
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
        except ObjectsAway:
            raise
        except StoreError as error:
            report.not_taken[key] = error.message
    for key in objects.visit_keys():
        if not key.endswith(SIDECAR_SUFFIX):
            continue
        try:
            report.visits += bring_back_visit(database, objects, objects.read_json(key) or {})
        except ObjectsAway:
            raise
        except StoreError as error:
            report.stay[key] = error.message
    for key in objects.calibrating_keys():
        try:
            report.calibrations_open += bring_back_calibration(database, objects, key)
        except ObjectsAway:
            raise
        except StoreError as error:
            report.stay[key] = error.message


def report_lines(report: Rebuilt) -> Iterable[str]:
    """The report in lines for people."""
    yield f"{report.rides} rides brought back, {report.rides_before} were there already."
    if report.rides_mended:
        yield f"{report.rides_mended} damaged rows of rides mended from their files."
    for ride_id in report.rides_damaged:
        yield f"Ride {ride_id}: its row is damaged, and no whole file is named there."
    if report.calibrations:
        yield f"{report.calibrations} calibrations brought back."
    if report.calibrations_open:
        yield f"{report.calibrations_open} open calibrations brought back: go on with them."
    if report.visits:
        yield f"{report.visits} service visits brought back."
    for name in report.set_aside:
        yield f"The destroyed database is kept as {name}."
    for key, reason in report.lost_words.items():
        yield f"{key}: without its name, notes and tags. {reason}"
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
