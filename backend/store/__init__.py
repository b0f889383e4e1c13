"""SQL and objects: rides, revisions, uploads. The only door to SQLAlchemy and pyarrow."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

from backend.errors import StoreError
from backend.store.database import Database
from backend.store.objects import Disk, FileObjects, open_objects
from backend.store.reader import RideReader
from backend.store.revisions import RevisionLog
from backend.store.rides import RidePage, RideStore
from backend.store.trouble import Trouble, WriteWatch
from backend.store.uploads import Upload, UploadStore

__all__ = [
    "RevisionLog",
    "RidePage",
    "RideReader",
    "RideStore",
    "Store",
    "Trouble",
    "Upload",
    "UploadStore",
    "WriteWatch",
    "open_store",
]


class Store:
    """Everything that is kept: `rides`, `revisions`, `uploads`."""

    def __init__(self, database: Database, objects: FileObjects, lock: FolderLock) -> None:
        self.database = database
        self.watch = database.watch
        self.objects = objects
        self.rides = RideStore(database, objects)
        self.revisions = RevisionLog(database)
        self.uploads = UploadStore(database, objects, objects.root / ".spool")
        self.unfinished: dict[int, str] = {}
        self._lock = lock

    def recover(self) -> list[int]:
        """Finish what a crash left: half written files, live rides, objects nobody knows.

        Returns the ids of the rides that were finished. One that cannot be (a full disk) stays
        live and whole, and `unfinished` says why. Safe to repeat.
        """
        self.objects.clear_staging()
        finished = []
        for ride_id in self.rides.live_ids():
            try:
                if self.rides.finish(ride_id) is not None:
                    finished.append(ride_id)
            except StoreError as error:
                self.unfinished[ride_id] = error.message
        self.uploads.clear_spool()
        known = self.rides.object_keys() | self.uploads.object_keys()
        for key in list(self.objects.keys()):
            if key not in known:
                self.objects.remove(key)
        return finished

    def close(self) -> None:
        """Finish what is being written and let go of the folder."""
        self.rides.close()
        self.database.close()
        self._lock.release()

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


class FolderLock:
    """One Spindle at a time in a folder of objects: two would finish each other's rides."""

    def __init__(self, folder: Path) -> None:
        self._file = (folder / ".lock").open("a+b")
        if os.name == "nt":
            return
        import fcntl

        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._file.close()
            raise StoreError(
                f"Another Spindle is using {folder}: stop it, or start this one with --data DIR."
            ) from error

    def release(self) -> None:
        """Let another one in. The kernel does it too when the process dies."""
        self._file.close()


def open_store(db_url: str, objects_url: str, disk: Disk | None = None) -> Store:
    """Open the store and finish what a crash left behind.

    db_url: `sqlite:///path` or `postgresql+psycopg://...`. objects_url: `file:///folder`.
    disk: the disk's steps, for tests. Raises StoreError.
    """
    objects = open_objects(objects_url, disk)
    lock = FolderLock(objects.root)
    try:
        store = Store(Database(db_url), objects, lock)
    except BaseException:
        lock.release()
        raise
    try:
        store.recover()
    except BaseException:
        store.close()
        raise
    return store
