"""Rides in the store: a live one grows by tails, a finished one is an object with its digest.

    start_live -> append_tail ... -> finish        recording; a tail is safe when its future is done
    add                                            a whole ride from a file
    orphans                                        at open: what a crash left to be finished
finish(): object first, then ONE transaction that makes the ride `done`, stores overview and
figures and deletes the tail. A crash before the transaction leaves a live ride with its whole
tail, and at worst an unreferenced object; finishing again gives the same bytes and so the same key.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import asdict, dataclass, replace

import numpy as np
from sqlalchemy import Connection, case, delete, insert, select, update

from backend.core.channels import ChannelSpec
from backend.core.pyramid import Level
from backend.core.ride import BAD, DONE, LIVE, SUMMARY_METHOD, Ride, RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.core.ride_tags import clean_tags
from backend.errors import Conflict, InvalidRequest, NotFound, StoreError
from backend.store import audit, ride_audit
from backend.store.deletion import (
    FILLED,
    MADE,
    READING_US,
    Deletions,
    forget_ride,
    is_needed,
    join_source,
)
from backend.store.digest import Digest, digest
from backend.store.discard import note_discarded, with_sidecar
from backend.store.entries import Entries
from backend.store.filling import Filling, facts_before, filled_chunks, grown
from backend.store.finish import RowsInMemory, drafted, write_object
from backend.store.logbook.book import set_tags
from backend.store.logbook.derived import accept_doubts, note_words
from backend.store.logbook.find import RidePage, Sought, page_of
from backend.store.marks import add_events
from backend.store.objects import Objects
from backend.store.parquet import RideFile
from backend.store.reader import LiveRows, ReaderCache, RideReader, RowSource
from backend.store.ride_table import (
    NAME_LENGTH_MAX,
    correct,
    finish_row,
    inserted,
    refill_row,
    remove_ride,
    ride_row,
    rides_by_ids,
    row_of,
    save_summary,
    upload_file,
    upload_key,
)
from backend.store.sidecar import save_words
from backend.store.soundness import Soundness
from backend.store.sql import tables as t
from backend.store.sql.blobs import Rows16, decode_level, encode_tail
from backend.store.sql.database import Database
from backend.store.tail import tail_blocks, tail_chunks

LOG = logging.getLogger(__name__)

NOTES_LENGTH_MAX = 20_000
# How often a server says of a recording that it lives, when no rows come that say it.
HEARTBEAT_US = 10_000_000


@dataclass(frozen=True)
class Orphan:
    """A ride whose server died. heartbeat_us: when that was last known to live."""

    ride_id: int
    row_count: int
    heartbeat_us: int | None


class RideStore:
    """Every ride there is."""

    def __init__(
        self,
        database: Database,
        objects: Objects,
        deletions: Deletions,
        soundness: Soundness,
        entries: Entries,
        server_id: str,
    ) -> None:
        self._server_id = server_id
        self._recording: set[int] = set()
        # How often a ride got its rows: their cards are due.
        self.finishes = 0
        self._beaten_us = 0
        self._database = database
        self._objects = objects
        self._deletions = deletions
        self._soundness = soundness
        self._entries = entries
        self._readers = ReaderCache()
        self._finisher = ThreadPoolExecutor(1, thread_name_prefix="store-finisher")

    def start_live(
        self,
        channels: Sequence[ChannelSpec],
        period_us: int,
        started_us: int,
        context: RideContext,
        name: str = "",
    ) -> int:
        """Begin a ride whose rows come with `append_tail`; returns its id.

        channels: 16 bit ones only. started_us: wall time of row 0. Raises StoreError.
        """
        if any(channel.wide for channel in channels) or period_us <= 0:
            raise InvalidRequest("A live ride needs 16 bit channels and a period above 0.")
        body = ride_row("recorded", channels, period_us, started_us, context, name)
        body |= {"server_id": self._server_id, "heartbeat_us": time.time_ns() // 1000}
        ride_id = self._database.write(lambda c: inserted(c, body, context))
        self._recording.add(ride_id)
        return ride_id

    def append_tail(
        self, ride_id: int, row_start: int, rows: Rows16, events: Sequence[RideEvent] = ()
    ) -> Future[None]:
        """Add rows [row_start, row_start + n) of a live ride, int16 (n, channels), with what the
        unit told meanwhile.

        They are safe once the future is done; its exception is a StoreError. Blocks while too
        many writes wait for the disk.
        """
        body = {
            "ride_id": ride_id,
            "row_start": row_start,
            "row_count": len(rows),
            "payload": encode_tail(rows),
        }

        def work(connection: Connection) -> None:
            # A second that failed may be tried again after later ones: the count never shrinks.
            stop = row_start + len(rows)
            count = case((t.ride.c.row_count < stop, stop), else_=t.ride.c.row_count)
            mine = (t.ride.c.state == "live") & (t.ride.c.server_id == self._server_id)
            now_us = time.time_ns() // 1000
            grown = connection.execute(
                update(t.ride)
                .where(t.ride.c.id == ride_id, mine)
                .values(row_count=count, heartbeat_us=now_us)
            )
            if grown.rowcount != 1:
                raise StoreError(f"Ride {ride_id} is not being recorded: rows were not saved.")
            connection.execute(insert(t.ride_tail).values(body))
            if events:
                add_events(connection, ride_id, events)

        return self._database.submit(work)

    def set_context(self, ride_id: int, context: RideContext) -> None:
        """Say what was true of the bike, when it is known only after the start."""
        self._database.write(lambda c: correct(c, ride_id, context=context))

    def redate(self, ride_id: int, by_us: int, event: RideEvent) -> None:
        """Move the start of a live ride, and say so among its events. Raises StoreError."""

        def work(connection: Connection) -> None:
            correct(connection, ride_id, by_us=by_us)
            add_events(connection, ride_id, [event])

        self._database.write(work)

    def finish(self, ride_id: int) -> Ride | None:
        """Make a live ride an immutable object. Safe to repeat after any failure.

        Returns the ride; None when it had no rows and was removed. Raises StoreError, and then
        the ride is still live and whole.
        """
        ride = self.get(ride_id)
        if ride.state == DONE:
            return ride
        if ride.state == BAD:
            raise StoreError(f"Ride {ride_id} cannot be finished: its row is damaged.")
        if ride.row_count == 0:
            self._database.write(lambda c: remove_ride(c, ride_id))
            return None
        with (
            drafted(self._objects, ride.channels, tail_chunks(self._database, ride)) as rows,
            self._objects.holding(),
        ):
            written = write_object(self._objects, ride, rows, counted=True, more={})

            def work(connection: Connection) -> None:
                finish_row(connection, ride.id, written)
                connection.execute(delete(t.ride_tail).where(t.ride_tail.c.ride_id == ride.id))
                save_words(connection, self._objects, ride.id)

            self._database.write(work)
        self._recording.discard(ride.id)
        self.finishes += 1
        return self.get(ride.id)

    def end(self, ride_id: int, cut_short: bool) -> None:
        """Note how a recording ended, unless that is noted; it is still live. Raises StoreError."""
        self._recording.discard(ride_id)
        unknown = (t.ride.c.state == "live") & t.ride.c.cut_short.is_(None)
        body = {"cut_short": cut_short}
        self._database.write(
            lambda c: c.execute(update(t.ride).where(t.ride.c.id == ride_id, unknown).values(body))
        )

    def beat(self, now_us: int) -> None:
        """Say of the rides that are being recorded here that their server lives; now_us: Unix time.

        A store that refuses it has told so elsewhere.
        """
        if not self._recording or abs(now_us - self._beaten_us) < HEARTBEAT_US:
            return
        self._beaten_us = now_us
        mine = t.ride.c.id.in_(sorted(self._recording))
        with suppress(StoreError):
            self._database.write(
                lambda c: c.execute(update(t.ride).where(mine).values(heartbeat_us=now_us))
            )

    def finish_later(self, ride_id: int, cut_short: bool = False) -> Future[Ride | None]:
        """`finish` on the store's own thread, after every tail handed over before this call."""

        def work() -> Ride | None:
            self._database.wait_written()
            self.end(ride_id, cut_short)
            return self.finish(ride_id)

        return self._finisher.submit(work)

    def close(self) -> None:
        """Wait for the rides that are being finished."""
        self._finisher.shutdown(wait=True)

    def add(self, ride: Ride, rows: RideRows, upload_id: str | None = None) -> Ride:
        """Store a whole ride from a file. ride.id is ignored; the ride with its id is returned.

        The object is written before the ride is known, so a failure leaves no half ride.
        """
        more: dict[str, object] = {"name": ride.name[:NAME_LENGTH_MAX], "notes": ride.notes}
        if file := self._database.read(lambda c: upload_file(c, upload_id)):
            more["original"] = file
        with self._objects.holding():
            source = RowsInMemory(rows)
            written = write_object(self._objects, ride, source, counted=False, more=more)

            def work(connection: Connection) -> int:
                key = upload_key(connection, upload_id)
                ride_id = inserted(connection, row_of(ride) | {"upload_id": key}, ride.context)
                finish_row(connection, ride_id, written)
                # Whichever of both is looked at names the other.
                beside = select(t.ride.c.same_ride_as).where(t.ride.c.id == ride_id)
                twin = t.ride.c.id == connection.execute(beside).scalar()
                twin &= t.ride.c.same_ride_as.is_(None)
                connection.execute(update(t.ride).where(twin).values(same_ride_as=ride_id))
                if key is not None:
                    join_source(connection, ride_id, key, MADE)
                return ride_id

            ride_id = self._database.write(work)
        self.finishes += 1
        return self.get(ride_id)

    def fill(self, ride: Ride, filling: Filling, upload_id: str | None = None) -> Ride:
        """Put rows from elsewhere into a finished ride; name, notes and number stay.

        upload_id: where the rows are from; its original lives as long as the ride. The object is
        written before the ride points to it; the one before goes an hour later, since somebody may
        be reading it. Raises StoreError and Conflict, when the ride became another meanwhile; then
        it is as it was.
        """
        if ride.object_key is None or ride.period_us is None:
            raise Conflict(f"Ride {ride.id} cannot be filled: it is being recorded.")
        key = ride.object_key
        self._soundness.open_ride(ride).close()
        file = RideFile(self._objects.local_path(key), ride.channels)
        chunks = filled_chunks(file, ride, filling)
        with drafted(self._objects, ride.channels, chunks) as rows:
            return self._replace_object(ride, grown(ride, filling), rows, upload_id, FILLED)

    def replace(self, ride: Ride, fuller: Ride, rows: RideRows, upload_id: str) -> Ride:
        """Make a finished ride what a fuller file says of it; its number and words stay.

        The file that it was made of stays beside the new one. As `fill` otherwise.
        """
        new = replace(fuller, id=ride.id, name=ride.name, same_ride_as=ride.same_ride_as)
        return self._replace_object(ride, new, RowsInMemory(rows), upload_id, MADE)

    def _replace_object(
        self, ride: Ride, new: Ride, rows: RowSource, upload_id: str | None, part: str
    ) -> Ride:
        """Let a ride point to a new object, and note what its upload gave."""
        key = str(ride.object_key)
        with self._objects.holding():
            more = self._database.read(
                lambda c: facts_before(c, self._objects, ride, upload_id, part)
            )
            counted = part == FILLED
            written = write_object(self._objects, new, rows, counted=counted, more=more)

            def work(connection: Connection) -> None:
                source = upload_key(connection, upload_id)
                made_of = source if part == MADE else None
                if not refill_row(connection, new, key, made_of):
                    raise Conflict(f"Ride {ride.id} is another since it was looked at.")
                finish_row(connection, ride.id, written)
                save_words(connection, self._objects, ride.id)
                if source is not None:
                    join_source(connection, ride.id, source, part)
                if not is_needed(connection, key):
                    due_us = time.time_ns() // 1000 + READING_US
                    note_discarded(connection, with_sidecar(key), due_us, ride.id)

            self._database.write(work)
        self._readers.forget(ride.id)
        self.finishes += 1
        return self.get(ride.id)

    def live_ids(self) -> list[int]:
        """Rides that are being recorded, or were when their server died."""
        query = select(t.ride.c.id).where(t.ride.c.state == "live").order_by(t.ride.c.id)
        return list(self._database.read(lambda c: c.execute(query).scalars().all()))

    def orphans(self) -> list[Orphan]:
        """Live rides of another server. It is dead, since this one has the database's lock."""
        columns = (t.ride.c.id, t.ride.c.row_count, t.ride.c.heartbeat_us)
        other = t.ride.c.server_id.is_(None) | (t.ride.c.server_id != self._server_id)
        query = select(*columns).where(t.ride.c.state == "live", other).order_by(t.ride.c.id)
        return self._database.read(lambda c: [Orphan(*row) for row in c.execute(query)])

    def get(self, ride_id: int) -> Ride:
        """One ride. Raises NotFound."""
        rides = self._database.read(lambda c: rides_by_ids(c, [ride_id]))
        if not rides:
            raise NotFound(f"There is no ride {ride_id}.")
        self._entries.suspect(rides)
        return rides[0]

    def outdated(self, limit: int) -> list[int]:
        """Finished rides whose figures are by an older method, newest first."""
        query = (
            select(t.ride.c.id)
            .join(t.ride_summary, t.ride_summary.c.ride_id == t.ride.c.id)
            .where(t.ride.c.state == DONE, t.ride_summary.c.method < SUMMARY_METHOD)
            .order_by(t.ride.c.started_us.desc())
            .limit(limit)
        )
        return self._database.read(lambda c: list(c.execute(query).scalars()))

    def digest_anew(self, ride: Ride) -> Digest:
        """Figures and gaps of a finished ride by today's method. Raises ObjectDamaged."""
        reader = self.reader(ride.id)
        return digest(reader.source, reader.ride)

    def save_figures(self, ride: Ride, found: Digest | None) -> None:
        """Keep what was found of a ride's rows, unless these are others by now; its card is due
        then. None: nothing can be found, and nothing is looked for again. Raises StoreError."""
        mine = (t.ride.c.id == ride.id) & (t.ride.c.object_key == ride.object_key)

        def work(connection: Connection) -> None:
            if connection.execute(select(t.ride.c.id).where(mine)).first() is None:
                return
            if found is None:
                unread = update(t.ride_summary).where(t.ride_summary.c.ride_id == ride.id)
                connection.execute(unread.values(method=SUMMARY_METHOD))
                return
            gaps = [asdict(gap) for gap in found.gaps]
            connection.execute(update(t.ride).where(mine).values(gaps=gaps))
            save_summary(connection, ride.id, found.summary)
            card = update(t.ride_card).where(t.ride_card.c.ride_id == ride.id)
            connection.execute(card.values(method=0))

        self._database.write(work)
        self._readers.forget(ride.id)
        self.finishes += 1

    def list(
        self, sought: Sought | None = None, limit: int = 50, cursor: str | None = None
    ) -> RidePage:
        """Rides by start, newest first; `cursor` is the `next` of the page before."""
        what = sought or Sought()
        page = self._database.read(lambda c: page_of(c, what, limit, cursor))
        self._entries.suspect(page.items)
        return page

    def patch(
        self,
        ride_id: int,
        name: str | None = None,
        notes: str | None = None,
        tags: Sequence[str] | None = None,
        doubts_accepted: bool | None = None,
        audited: bool = False,
    ) -> Ride:
        """Change what people wrote about a ride. Raises NotFound, InvalidRequest.

        doubts_accepted: all that it has now, or none. audited: somebody asked for it.
        """
        cleaned = None if tags is None else clean_tags(tags)
        # PostgreSQL has no text with a NUL in it.
        words = {"name": name, "notes": notes}
        changes = {key: text.replace("\0", "") for key, text in words.items() if text is not None}
        if len(name or "") > NAME_LENGTH_MAX or len(notes or "") > NOTES_LENGTH_MAX:
            raise InvalidRequest(
                f"A ride's name has at most {NAME_LENGTH_MAX} characters, "
                f"its notes {NOTES_LENGTH_MAX}."
            )
        ride = self.get(ride_id)

        def work(connection: Connection) -> None:
            if changes:
                connection.execute(update(t.ride).where(t.ride.c.id == ride_id).values(changes))
                note_words(connection, ride_id)
            if cleaned is not None:
                set_tags(connection, ride_id, cleaned)
            if doubts_accepted is not None:
                accept_doubts(connection, ride, doubts_accepted)
            save_words(connection, self._objects, ride_id, even_if_empty=True)
            if audited:
                doubts = [one.code for one in ride.doubts] if doubts_accepted else []
                accepted = None if doubts_accepted is None else doubts
                ride_audit.note_changed(connection, ride, {**changes, "tags": cleaned}, accepted)

        if changes or cleaned is not None or doubts_accepted is not None:
            self._database.write(work)
        self._readers.forget(ride_id)
        return self.get(ride_id)

    def delete(self, ride_id: int) -> None:
        """Remove a finished ride, and what only it needed: its object, originals without a ride.

        It is gone once this returns, whatever happens; a file that cannot go now goes later.
        Raises NotFound, Conflict while it is live.
        """
        now_us = time.time_ns() // 1000

        def work(connection: Connection) -> str | None:
            # A damaged state may hide that rows are still coming.
            state = select(t.ride.c.state).where(t.ride.c.id == ride_id)
            recorded = ride_id in self._recording
            current_state: str | None = LIVE if recorded else connection.execute(state).scalar()
            if current_state not in (None, LIVE):
                entry = ride_audit.deletion_of(connection, ride_id)
                forget_ride(connection, ride_id, now_us)
                audit.append(connection, entry)
            return current_state

        found = self._database.write(work)
        if found is None:
            raise NotFound(f"There is no ride {ride_id}.")
        if found == LIVE:
            raise Conflict(f"Ride {ride_id} is being recorded: it can be deleted when it is over.")
        self._readers.forget(ride_id)
        self._deletions.sweep(now_us)

    def reader(self, ride_id: int) -> RideReader:
        """Rows and overview of a ride, its object verified. Raises NotFound, ObjectDamaged."""
        reader = self._readers.get(ride_id, lambda: self._open_reader(self.get(ride_id)))
        self._soundness.require(reader.ride)
        return reader

    def _open_reader(self, ride: Ride) -> RideReader:
        self._soundness.require(ride)
        if ride.object_key is not None:
            path = self._objects.local_path(ride.object_key)
            return RideReader(ride, RideFile(path, ride.channels), self._level)
        blocks = [np.empty((0, len(ride.channels)), np.int16), *tail_blocks(self._database, ride)]
        return RideReader(ride, LiveRows(ride, np.concatenate(blocks)), self._level)

    def _level(self, ride_id: int, step: int) -> Level | None:
        query = select(t.ride_lod.c.payload).where(
            t.ride_lod.c.ride_id == ride_id, t.ride_lod.c.step == step
        )
        payload = self._database.read(lambda c: c.execute(query).scalar())
        try:
            return None if payload is None else decode_level(payload)
        except StoreError as error:
            # The rows tell the same, only slower.
            LOG.warning("Ride %d, overview of %d rows: %s", ride_id, step, error.message)
            return None
