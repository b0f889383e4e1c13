"""What is deleted stays deleted: SQL forgets it and notes the file; then the file goes.

One rule: an original lives as long as a ride that came from it. With the last ride the upload and
every copy of its bytes go; a ride's own object goes with the last ride that has it.

    one transaction: rows deleted, file noted  ->  file unlinked  ->  note deleted
A crash at any arrow leaves the note (`discard`), and the next sweep finishes the work: such a file
is never an unknown one that might be brought back. A file of which SQL does not know yet
(published, not committed) is never removed: see `Objects.holding`.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable
from functools import partial

from sqlalchemy import Connection, delete, insert, or_, select, update

from backend.errors import StoreError
from backend.store.discard import note_discarded, with_sidecar
from backend.store.logbook.derived import settle_twins
from backend.store.objects import RIDE_SUFFIX, SIDECAR_SUFFIX, Objects
from backend.store.ride_table import remove_ride
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.visit_files import is_named_by_visit, is_of_visits

LOG = logging.getLogger(__name__)

MADE = "made"
FILLED = "filled"
RELATED = "beside"
# The folder, among the objects, of uploads that still arrive.
SPOOL = ".spool"
# States of an upload whose contents nobody has judged yet; its bytes are needed.
UNJUDGED = ("receiving", "queued")
# A ride's object that was replaced may still be read by somebody who asked before.
READING_US = 3600 * 1_000_000


class Deletions:
    """The files that are to go, and the going."""

    def __init__(self, database: Database, objects: Objects) -> None:
        self._database = database
        self._objects = objects
        self._failing: set[str] = set()
        self.files_gone = 0

    def sweep(self, now_us: int | None) -> int:
        """Remove every file that was given up and is due at `now_us`, all if None; how many went.

        A file that cannot go now (it is held, or the disk refuses) stays noted for the next time.
        """
        query = select(t.discarded_object.c.key, t.discarded_object.c.due_us)
        if now_us is not None:
            query = query.where(t.discarded_object.c.due_us <= now_us)
        due = self._database.read(lambda c: [(row[0], row[1]) for row in c.execute(query)])
        gone = [
            (key, due_us)
            for key, due_us in due
            if self._objects.unless_in_use(partial(self._remove, key))
        ]
        if gone:
            self._database.write(lambda c: struck_off(c, gone))
            self.files_gone += len(gone)
        return len(gone)

    def _remove(self, key: str) -> bool:
        """Unlink a file unless it is needed again; whether its row may go."""
        if not self._database.read(lambda c: is_needed(c, key)):
            try:
                self._objects.remove(key)
            except StoreError as error:
                if key not in self._failing:
                    LOG.warning("%s It is tried again until it is gone.", error.message)
                self._failing.add(key)
                return False
        self._failing.discard(key)
        return True


def struck_off(connection: Connection, gone: Iterable[tuple[str, int]]) -> None:
    """Forget files that are gone, or needed again, but for those given up anew since."""
    note = t.discarded_object.c
    for key, due_us in gone:
        connection.execute(delete(t.discarded_object).where(note.key == key, note.due_us == due_us))


def is_needed(connection: Connection, key: str) -> bool:
    """Whether a ride, an upload or a visit has this object, or the ride whose sidecar it is."""
    if is_of_visits(key):
        return is_named_by_visit(connection, key)
    of_ride = key.removesuffix(SIDECAR_SUFFIX) + RIDE_SUFFIX
    ride = select(t.ride.c.id).where(t.ride.c.object_key.in_((key, of_ride))).limit(1)
    arrived = t.upload.c.object_key.is_(None) & (t.upload.c.sha256 == key.rsplit("/", 1)[-1])
    upload = select(t.upload.c.id).where((t.upload.c.object_key == key) | arrived).limit(1)
    return any(connection.execute(query).first() is not None for query in (ride, upload))


def join_source(connection: Connection, ride_id: int, upload_id: int, part: str) -> None:
    """Note that a ride lives on an upload's bytes; `made` and `filled` outlast `beside`."""
    mine = (t.ride_source.c.ride_id == ride_id, t.ride_source.c.upload_id == upload_id)
    if connection.execute(select(t.ride_source.c.id).where(*mine)).first() is None:
        body = {"ride_id": ride_id, "upload_id": upload_id, "part": part}
        connection.execute(insert(t.ride_source).values(body))
    elif part != RELATED:
        connection.execute(update(t.ride_source).where(*mine).values(part=part))


def forget_ride(connection: Connection, ride_id: int, now_us: int) -> None:
    """Delete a ride and what only it needed: its object, and the originals it came from."""
    link = t.ride_source.c
    key = connection.execute(select(t.ride.c.object_key).where(t.ride.c.id == ride_id)).scalar()
    sources = select(link.upload_id).where(link.ride_id == ride_id)
    uploads = connection.execute(sources).scalars().all()
    connection.execute(delete(t.ride_source).where(link.ride_id == ride_id))
    connection.execute(
        update(t.upload).where(t.upload.c.duplicate_of == ride_id).values(duplicate_of=None)
    )
    twins = t.ride.c.same_ride_as == ride_id
    left = connection.execute(select(t.ride.c.id).where(twins)).scalars().all()
    connection.execute(update(t.ride).where(twins).values(same_ride_as=None))
    remove_ride(connection, ride_id)
    for twin_id in left:
        settle_twins(connection, twin_id)
    for upload_id in uploads:
        rides = select(link.id).where(link.upload_id == upload_id).limit(1)
        if connection.execute(rides).first() is None:
            forget_original(connection, upload_id, now_us)
    earlier = t.discarded_object.c.ride_id == ride_id
    connection.execute(update(t.discarded_object).where(earlier).values(due_us=now_us))
    if key is not None and not is_needed(connection, key):
        note_discarded(connection, with_sidecar(key), now_us)


def forget_original(connection: Connection, upload_id: int, now_us: int) -> None:
    """Delete an upload without rides, and every other judged one of the same bytes that its sender
    has without any."""
    columns = (t.upload.c.object_key, t.upload.c.owner_id)
    row = connection.execute(select(*columns).where(t.upload.c.id == upload_id)).first()
    key, owner_id = (None, None) if row is None else row
    with_rides = select(t.ride_source.c.upload_id)
    copies = t.upload.c.object_key == key
    copies &= t.upload.c.owner_id.is_not_distinct_from(owner_id)
    forget_parts(connection, upload_id, now_us)
    connection.execute(
        delete(t.upload).where(
            or_(t.upload.c.id == upload_id, copies),
            t.upload.c.state.not_in(UNJUDGED),
            t.upload.c.id.not_in(with_rides),
        )
    )
    if key is not None and not is_needed(connection, key):
        note_discarded(connection, [key], now_us)


def forget_parts(connection: Connection, upload_id: int, now_us: int) -> None:
    """Delete what was within a container without rides; files that live on are on their own."""
    within = t.upload.c.part_of == upload_id
    with_rides = select(t.ride_source.c.upload_id)
    gone = select(t.upload.c.id).where(within, t.upload.c.id.not_in(with_rides))
    for part_id in connection.execute(gone).scalars().all():
        forget_upload(connection, part_id, now_us)
    connection.execute(update(t.upload).where(within).values(part_of=None))


def forget_upload(connection: Connection, upload_id: int, now_us: int) -> None:
    """Delete one upload that no ride came from, and its bytes unless another has them too."""
    forget_parts(connection, upload_id, now_us)
    columns = (t.upload.c.object_key, t.upload.c.token)
    row = connection.execute(select(*columns).where(t.upload.c.id == upload_id)).first()
    key, spooled = (row.object_key, f"{SPOOL}/{row.token}") if row else (None, "")
    connection.execute(delete(t.ride_source).where(t.ride_source.c.upload_id == upload_id))
    connection.execute(delete(t.upload).where(t.upload.c.id == upload_id))
    if key is None:
        note_discarded(connection, [spooled], now_us)
    elif not is_needed(connection, key):
        note_discarded(connection, [key], now_us)
