"""The store as a whole: opened only when database and folder belong together, and for one server.

look (nothing is written) -> lock database, lock folder -> migrate, adopt -> recover
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from types import TracebackType

from backend.core.ride import Ride, iso_utc
from backend.errors import StoreError
from backend.store.bucket import open_objects
from backend.store.deletion import SPOOL, Deletions
from backend.store.discard import expected_objects, named_keys
from backend.store.entries import Entries
from backend.store.health import DISK_FULL, WORDS, code_of
from backend.store.identity import belonging, new_id, require, write_identity
from backend.store.inspect_schema import inspect_database
from backend.store.locks import hold
from backend.store.logbook.book import Logbook
from backend.store.logbook.derived import CardStore, ZeroStore
from backend.store.marks import MarkStore
from backend.store.objects import LOST_FOUND, Disk, FileObjects
from backend.store.rides import Orphan, RideStore
from backend.store.soundness import Soundness
from backend.store.sql.advisory import fence
from backend.store.sql.database import Database, is_postgresql, shown
from backend.store.sql.database_url import check_url
from backend.store.uploads import UploadStore

LOG = logging.getLogger(__name__)

# So many files put aside are named in the log; the rest is counted.
NAMED_MAX = 10


class Store:
    """Everything that is kept: `rides`, `cards`, `zeros`, `logbook`, `marks`, `uploads`.

    closing: lets go of the locks.
    """

    def __init__(
        self, database: Database, objects: FileObjects, closing: ExitStack, server_id: str
    ) -> None:
        self.database = database
        self.watch = database.watch
        self.objects = objects
        self.server_id = server_id
        self.deletions = Deletions(database, objects)
        self.soundness = Soundness(objects)
        self.entries = Entries(database, objects, self.soundness)
        self.rides = RideStore(
            database, objects, self.deletions, self.soundness, self.entries, server_id
        )
        self.marks = MarkStore(database)
        self.cards = CardStore(database)
        self.zeros = ZeroStore(database)
        self.logbook = Logbook(database, objects)
        self.uploads = UploadStore(database, objects, objects.root / SPOOL, self.deletions)
        # Rides that the start could not finish.
        self.unfinished: list[int] = []
        # Held by what decides which rides an upload becomes, and by what deletes either.
        self.deciding = threading.RLock()
        self._files_gone = 0
        self._shrinks = False
        self._closing = closing

    def try_again(self) -> None:
        """Write a little where writes are refused now, so that the end of the trouble is seen."""
        for fault in self.watch.troubles:
            if fault.part == self.database.part:
                self.database.try_write()
            else:
                self.objects.try_write(fault.part)

    def recover(self) -> list[int]:
        """Finish what a crash left: half written files, other servers' rides, unknown objects.

        Returns the ids of the rides that were finished. One that cannot be (a full disk) stays
        live and whole, among the `unfinished`. Safe to repeat; what this server records stays.
        """
        self.objects.clear_staging()
        finished = []
        for orphan in self.rides.orphans():
            try:
                self.rides.end(orphan.ride_id, cut_short=True)
                ride = self.rides.finish(orphan.ride_id)
            except StoreError as error:
                LOG.warning("Ride %d is kept but not finished: %s", orphan.ride_id, error.message)
                self.unfinished.append(orphan.ride_id)
                continue
            if ride is not None:
                finished.append(ride.id)
                log_orphan(orphan, ride)
        named = self.database.read(named_keys)
        self.deletions.sweep(None)
        self._move_unnamed(named)
        return finished

    def sweep(self, now_us: int) -> None:
        """Remove what is over at `now_us`: expired uploads, and files that are to go."""
        self.uploads.remove_expired(now_us)
        self.deletions.sweep(now_us)
        if self._shrinks or self.deletions.files_gone != self._files_gone:
            self._files_gone = self.deletions.files_gone
            self._shrinks = self.database.give_back()

    def scrub(self, now_us: int) -> None:
        """Verify a few of the rides' rows and objects, all of them within a day."""
        mended = self.entries.mended
        self.entries.check_next(now_us)
        # What is worked out of their objects is due again.
        self.rides.finishes += self.entries.mended - mended
        if self.objects.is_folder:
            self.soundness.scrub(now_us, lambda: self.database.read(expected_objects))

    def close(self) -> None:
        """Finish what is being written and let go of database and folder."""
        self._closing.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _move_unnamed(self, named: set[str]) -> None:
        """Move what the database does not know to `lost+found/`; nothing is unlinked."""
        unknown = [(key, key) for key in sorted(set(self.objects.keys()) - named)]
        spooled = [path.name for path in self.uploads.unknown_spooled()]
        unknown += [(f"{SPOOL}/{token}", f"uploads/{token}") for token in spooled]
        for number, (key, name) in enumerate(unknown):
            try:
                moved = self.objects.move_to_lost_found(key, name)
            except StoreError as error:
                LOG.warning("%s Free some room; the next start tries again.", error.message)
                return
            if number < NAMED_MAX:
                LOG.warning("%s is not known to the database: it is now %s.", key, moved)
        if len(unknown) > NAMED_MAX:
            LOG.warning(
                "%d files were not known to the database and are now in %s: if there are rides "
                "among them, this may be an older copy of the database.",
                len(unknown),
                f"{self.objects.where}/{LOST_FOUND}",
            )


def log_orphan(orphan: Orphan, ride: Ride) -> None:
    """Say in the log that a ride may lack its end."""
    if ride.cut_short:
        beat_us = orphan.heartbeat_us
        LOG.warning(
            "Ride %d was cut short after %d rows: its server stopped without ending it%s.",
            ride.id,
            ride.row_count,
            "" if beat_us is None else f", later than {iso_utc(beat_us)}",
        )


def open_store(
    db_url: str, objects_url: str, cache: Path | None = None, *, disk: Disk | None = None
) -> Store:
    """Open the store and finish what a crash left behind.

    db_url: `sqlite:///path` or `postgresql+psycopg://...`. objects_url: `file:///folder`
    or `s3://bucket/prefix`, of which copies are in the folder `cache`. disk: the disk's steps, for
    tests. Raises InvalidRequest for a URL that cannot be used; StoreError, and then nothing was
    changed if the two do not belong together or another server has them.
    """
    check_url(db_url)
    objects = open_objects(objects_url, cache, disk)
    with saying_where():
        return opened_store(db_url, objects)


@contextmanager
def saying_where() -> Iterator[None]:
    """Turn what the system refuses into a StoreError that says where and what to do."""
    try:
        yield
    except OSError as error:
        where = error.filename or "the folder of the data"
        code = code_of(error)
        reason = f"{error.strerror or error}. Give this user the right to write there"
        raise StoreError(
            f"The store cannot be opened: {where}: {WORDS[code] if code == DISK_FULL else reason}, "
            "or choose another folder with --data DIR.",
            code,
        ) from error


def opened_store(db_url: str, objects: FileObjects) -> Store:
    """As `open_store`, over open objects. Raises OSError where the system refuses a path."""
    require(belonging(inspect_database(db_url), objects), shown(db_url), objects)
    server_id = new_id()
    closing = ExitStack()
    try:
        hold(closing, db_url, objects)
        # Another server may have come and gone since the first look.
        state = belonging(inspect_database(db_url), objects)
        store_id = require(state, shown(db_url), objects)
        database = Database(db_url, objects.watch)
        closing.callback(database.close)
        store = Store(database, objects, closing, server_id)
        closing.callback(store.rides.close)
        if state.adopted:
            objects.set_identity(store_id)
        database.write(lambda c: write_identity(c, store_id, server_id, rebuilding=False))
        if is_postgresql(db_url):
            database.fence = partial(fence, server_id=server_id)
        store.recover()
    except BaseException:
        closing.close()
        raise
    return store
