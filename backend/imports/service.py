"""Files become rides: whole ones, resumable ones, damaged ones; the same bytes only once.

A file arrives piece by piece (`create`, `append`), or at once (`receive_file`). With its last byte
it is kept under its hash, looked at in a child process, and concluded: `complete`, `partial` or
`rejected`, with a stable code, a sentence, and the rides it became. It is kept as long as one of
these rides; without any it can be removed, and goes by itself when its time is over. Reading has
threads of its own (`reading.Lanes`): `begin` and `add` never wait for it.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from backend.core.person import ANYBODY, Sender
from backend.core.ride import Ride, iso_utc
from backend.errors import BadFile, Conflict, InvalidRequest, SpindleError
from backend.formats import (
    NEEDS_MAPPING,
    SNIFFED_BYTES,
    ImportedRide,
    Outcome,
    entries,
    is_archive,
    read_in_child,
    refused_by_head,
)
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED, TOO_SLOW
from backend.formats.questions import TableAnswer, TableQuestion, answer_from_json
from backend.imports.container import Container, Unpacker
from backend.imports.duplicates import Kind, find_duplicate, same_rides
from backend.imports.gap_filling import fill
from backend.imports.outcome import ImportResult, describe_result
from backend.imports.reading import SLOW, UNPACKING, GoesElsewhere, Lanes, ride_name
from backend.imports.records import TableAnswers
from backend.store import Store, Upload, Verdict
from backend.store.soundness import Expected, damaged_upload
from backend.store.wall_clock import now_us

# A ride of a day is 10 MB in any format; the bound keeps one client from filling the disk.
UPLOAD_BYTES_MAX = 256 * 1024 * 1024
NAME_LENGTH_MAX = 255
PIECE_BYTES = 1 << 20
# How long a reader may take before its file is put into the slow lane.
QUICK_S = 5.0
# Code of a file whose ride is still being recorded.
WAITS = "ride_is_live"
# Codes of a file whose rides are here: it waits to be read by another answer, or does not fit them.
ANSWERED, LEFT_AS_READ = "answered_anew", "left_as_read"
CONCLUDED = (COMPLETE, PARTIAL, REJECTED)


class Reader(Protocol):
    """Reads a file into an outcome, whatever its bytes."""

    def __call__(
        self, path: Path, name: str, *, table_answer: TableAnswer | None = None
    ) -> Outcome: ...


@dataclass(frozen=True)
class UploadSettings:
    """length_max: largest file in bytes. expires_s: how long an upload without rides is kept."""

    length_max: int = UPLOAD_BYTES_MAX
    expires_s: int = 7 * 86_400


class Arrival(NamedTuple):
    """How far an upload is, and with its last byte the promise of what becomes of it."""

    offset: int
    reading: Future[Upload] | None


class Uploads:
    """The uploads' use cases; safe to call from any thread.

    reader: has little time, and says `too_slow` when it was not enough; then slow_reader (the same,
    if none is given) reads the file. stop_readers: ends both at once, wherever they are.
    unpack: the files within an archive.
    """

    def __init__(
        self,
        store: Store,
        settings: UploadSettings | None = None,
        reader: Reader = read_in_child,
        slow_reader: Reader | None = None,
        stop_readers: Callable[[], None] = lambda: None,
        unpack: Unpacker = entries,
        judge: Callable[[Ride], None] = lambda _: None,
    ) -> None:
        """judge: told of each ride that was made, before its file is answered for."""
        self._store = store
        self._answers = TableAnswers(store.objects)
        self._settings = settings or UploadSettings()
        self._reader = reader
        self._slow_reader = slow_reader or reader
        self._stop_readers = stop_readers
        self._unpack = unpack
        self._judge = judge
        self._lanes = Lanes(self._process, self.get)

    def close(self) -> None:
        """Stop reading. What was not concluded stays queued and is read at the next start."""
        self._lanes.close(self._stop_readers)

    def create(
        self, name: str, length: int, sha256: str | None = None, sender: Sender = ANYBODY
    ) -> Upload:
        """`begin`; a file without bytes has arrived with it and is concluded."""
        upload = self.begin(name, length, sha256, sender=sender)
        return self._submit(upload.id).result() if length == 0 else upload

    def begin(
        self,
        name: str,
        length: int,
        sha256: str | None = None,
        part_of: str | None = None,
        sender: Sender = ANYBODY,
    ) -> Upload:
        """Begin an upload of `length` bytes. Raises InvalidRequest when it is too large.

        sha256: what the whole file will hash to, if the client knows; it is checked at the end.
        part_of: the container it is within.
        """
        if not 0 <= length <= self._settings.length_max:
            raise InvalidRequest(
                f"The file has {length} bytes; at most {self._settings.length_max} are taken.",
                code="too_large",
            )
        file_name = name.replace("\0", "")[:NAME_LENGTH_MAX] or "upload"
        return self._store.uploads.create(
            file_name, length, sha256, self._settings.expires_s, part_of, sender
        )

    def append(self, upload_id: str, offset: int, data: bytes) -> int:
        """Add bytes at `offset`; returns the new offset, which is safe on the disk.

        With the last byte the file is read; returns when it is concluded or Spindle stops. Raises
        NotFound, Conflict, StoreError.
        """
        arrival = self.add(upload_id, offset, data)
        if arrival.reading is not None:
            arrival.reading.result()
        return arrival.offset

    def add(self, upload_id: str, offset: int, data: bytes) -> Arrival:
        """Add bytes at `offset` without waiting for the file to be read.

        Raises NotFound, Conflict, StoreError; so may the promise. BadFile when what has arrived
        shows that it is no ride: the upload is rejected, and the rest need not be sent.
        """
        upload = self._store.uploads.append(upload_id, offset, data)
        if upload.received == upload.length:
            return Arrival(upload.received, self._submit(upload_id))
        if offset < SNIFFED_BYTES <= upload.received:
            self._refuse_early(upload)
        return Arrival(upload.received, None)

    def resume(self, upload: Upload, data: bytes) -> Future[Upload]:
        """All bytes of an upload, of which some may be here; the promise of what becomes of it."""
        if upload.received < upload.length:
            left = data[upload.received :]
            self._store.uploads.append(upload.id, upload.received, left)
        return self._submit(upload.id)

    def _refuse_early(self, upload: Upload) -> None:
        head = self._store.uploads.head(upload.id, SNIFFED_BYTES)
        if (refused := refused_by_head(upload.name, head)) is not None:
            self._conclude(upload.id, REJECTED, refused.code, refused.detail, 0.0)
            raise BadFile(refused.detail or "", code=refused.code)

    def receive_file(self, name: str, source: bytes | Path, sender: Sender = ANYBODY) -> Upload:
        """A whole file at once -> what became of it."""
        length = len(source) if isinstance(source, bytes) else source.stat().st_size
        upload = self.create(name, length, sender=sender)
        offset = 0
        with (
            suppress(BadFile),
            io.BytesIO(source) if isinstance(source, bytes) else source.open("rb") as file,
        ):
            while piece := file.read(PIECE_BYTES):
                offset = self.append(upload.id, offset, piece)
        return self.get(upload.id)

    def get(self, upload_id: str) -> Upload:
        """Where an upload stands. Raises NotFound."""
        return self._store.uploads.get(upload_id)

    def list(
        self,
        limit: int = 50,
        before: str | None = None,
        part_of: str | None = None,
        sha256: str | None = None,
        whose: Sender = ANYBODY,
    ) -> dict[str, object]:
        """One page, the latest first: {items, next}. before: `next` of the page before.

        part_of: of the files within this upload, else of those that are in none. sha256: of these
        bytes only. whose: sent by these only.
        """
        uploads = self._store.uploads.list(limit + 1, before, part_of, sha256, whose)
        more = len(uploads) > limit
        return {"items": uploads[:limit], "next": uploads[limit - 1].id if more else None}

    def answerable(self, upload_id: str) -> Upload:
        """The upload whose answers count: of the same bytes, the one that became rides.

        Raises NotFound.
        """
        upload = self.get(upload_id)
        return self._store.uploads.first_with(upload.sha256 or "", upload.owner_id) or upload

    def question(self, upload: Upload, answer: TableAnswer | None = None) -> TableQuestion:
        """What its owner can say of a table, or must before it is read; with an answer, what that
        leaves or opens.

        Raises Conflict: `nothing_asked` when it is no table or has not arrived; `left_as_read` when
        the rides that are here cannot become what the file says by the answer.
        """
        question: TableQuestion | None = None
        if upload.code == NEEDS_MAPPING or upload.state in (COMPLETE, PARTIAL):
            outcome = self._slow_reader(self._path(upload), upload.name, table_answer=answer)
            question = outcome.question
        if question is None:
            raise Conflict(f"Nothing can be said of upload {upload.id}.", code="nothing_asked")
        if answer is not None and upload.ride_ids and outcome.code != NEEDS_MAPPING:
            problem = misfit(self._rides_of(upload), outcome)
            if problem is not None:
                raise Conflict(problem, code=LEFT_AS_READ)
        return question

    def answer_for(self, upload: Upload, header_sha256: str) -> TableAnswer | None:
        """What is known of an upload's table: what the rider said who sent it, else what is known
        of all with this header."""
        said: Mapping[str, Any] | None = None
        if upload.owner_id is not None:
            said = self._store.uploads.answer_of(upload.owner_id, header_sha256)
        if said is not None:
            return answer_from_json(said)
        stored = self._answers.get(header_sha256)
        return None if stored is None else stored.answer

    def read_anew(self, upload_id: str) -> Future[Upload]:
        """Have a file read again; the promise of what becomes of it."""
        code = ANSWERED if self.get(upload_id).ride_ids else None
        self._store.uploads.wait_again(upload_id, code)
        return self._submit(upload_id)

    def remove(self, upload_id: str, audited: bool = False) -> None:
        """Give an upload up and free its space, whatever became of it but rides. audited: somebody
        asked for it.

        Raises NotFound; Conflict, naming the rides, when some came from it, or while it is read.
        """
        with self._store.deciding, self._lanes.idle(upload_id):
            self._store.uploads.remove(upload_id, now_us(), audited)

    def recover(self) -> Sequence[Upload]:
        """Look at the files a crash or a stop left waiting; what became of those that were read."""
        promises = [self._submit(upload.id) for upload in self._store.uploads.waiting()]
        return [promise.result() for promise in promises if promise.exception() is None]

    def retry_waiting(self, now_us: int) -> Sequence[Future[Upload]]:
        """Have the files looked at that waited for a ride that is over now, or for the store to
        take them again; does not wait. now_us: Unix time."""
        refused = self._lanes.take_refused(now_us)
        live = set(self._store.rides.live_ids())
        return [
            self._submit(upload.id)
            for upload in self._store.uploads.waiting()
            if upload.id in refused or (upload.code == WAITS and upload.duplicate_of not in live)
        ]

    def _submit(self, upload_id: str) -> Future[Upload]:
        """Keep a whole file, and have it read in its turn."""
        return self._lanes.begin(upload_id, self._store.uploads.store_original)

    def _process(self, upload_id: str, lane: str) -> Upload:
        upload = self.get(upload_id)
        return upload if upload.state in CONCLUDED else self._process_next(upload, lane)

    def _process_next(self, upload: Upload, lane: str) -> Upload:
        if upload.declared_sha256 and upload.declared_sha256 != upload.sha256:
            sentence = f"The bytes that arrived hash to {upload.sha256}, not to what was declared."
            return self._conclude(upload.id, REJECTED, "hash_mismatch", sentence, 0.0)
        with self._store.deciding:
            if (twin := self._twin(upload)) is not None:
                return twin
        path = self._path(upload)
        with path.open("rb") as file:
            holds_files = is_archive(file.read(SNIFFED_BYTES))
        if holds_files:
            return self._unpacked(upload, path, lane)
        outcome = self._read(upload, path, lane)
        # Where this fails the original is kept and the upload is read again.
        with self._store.deciding:
            # The same bytes may have become a ride while these were read.
            if (twin := self._twin(upload)) is not None:
                return twin
            store = self._store_again if upload.code == ANSWERED else self._store_rides
            concluded = store(self.get(upload.id), outcome)
        for ride_id in concluded.ride_ids if concluded.duplicate_of is None else ():
            with suppress(SpindleError):
                self._judge(self._store.rides.get(ride_id))
        return self.get(upload.id)

    def _store_rides(self, upload: Upload, outcome: Outcome) -> Upload:
        """Make rides of what was read, or fill, replace or leave those that are here; say so."""
        result = ImportResult()
        for imported in outcome.rides:
            twins = same_rides(self._store.rides, imported, upload.id, upload.owner_id)
            if live := next((ride for ride in twins if ride.state == "live"), None):
                return self._wait_for(upload, live)
            if twins:
                result.rows_filled += fill(self._store.rides, twins, imported, upload.id)
                result.existing += twins
            else:
                self._settle(upload, imported, outcome, result)
        for number, (imported, other) in enumerate(result.fresh):
            if number < len(upload.ride_ids):
                # A crash came between this ride and the conclusion.
                continue
            ride = ride_of(upload, imported, number, len(result.fresh), outcome.completeness)
            same_as = None if other is None else other.id
            self._store.rides.add(replace(ride, same_ride_as=same_as), imported.rows, upload.id)
        code, detail = describe_result(result, outcome)
        only_existing = result.existing and not (result.fresh or result.completed)
        return self._conclude(
            upload.id,
            outcome.state,
            code,
            detail,
            outcome.completeness,
            result.existing[0].id if only_existing else None,
            [ride.id for ride in result.existing],
            outcome.header_sha256,
        )

    def _store_again(self, upload: Upload, outcome: Outcome) -> Upload:
        """Make the rides of a file what it says by another answer; their numbers and words stay."""
        rides = self._rides_of(upload)
        if problem := misfit(rides, outcome):
            state = COMPLETE if upload.completeness == 1.0 else PARTIAL
            return self._conclude(
                upload.id,
                state,
                LEFT_AS_READ,
                problem,
                upload.completeness,
                asks_sha256=outcome.header_sha256,
            )
        for number, (ride, imported) in enumerate(zip(rides, outcome.rides, strict=True)):
            by_answer = ride_of(upload, imported, number, len(rides), outcome.completeness)
            self._store.rides.replace(ride, by_answer, imported.rows, upload.id)
        return self._conclude(
            upload.id,
            outcome.state,
            outcome.code,
            outcome.detail,
            outcome.completeness,
            asks_sha256=outcome.header_sha256,
        )

    def _rides_of(self, upload: Upload) -> Sequence[Ride]:
        """The rides that are made of an upload's own rows."""
        rides = [self._store.rides.get(ride_id) for ride_id in upload.ride_ids]
        return [ride for ride in rides if ride.upload_id == upload.id]

    def _settle(
        self, upload: Upload, imported: ImportedRide, outcome: Outcome, result: ImportResult
    ) -> None:
        """A ride that no unit's clock tells from others: whether its recording is here already."""
        duplicate = find_duplicate(
            self._store.rides, imported, outcome.state == COMPLETE, upload.id, upload.owner_id
        )
        if duplicate is None:
            result.fresh.append((imported, None))
        elif duplicate.kind is Kind.EXISTING:
            result.existing.append(duplicate.ride)
        elif duplicate.kind is Kind.FULLER:
            fuller = ride_of(upload, imported, 0, 1, outcome.completeness)
            self._store.rides.replace(duplicate.ride, fuller, imported.rows, upload.id)
            result.completed.append(duplicate.ride)
        else:
            result.fresh.append((imported, duplicate.ride))

    def _conclude(
        self,
        upload_id: str,
        state: str,
        code: str | None,
        detail: str | None,
        completeness: float | None,
        duplicate_of: int | None = None,
        related: Sequence[int] = (),
        asks_sha256: str | None = None,
    ) -> Upload:
        over_us = now_us() + self._settings.expires_s * 1_000_000
        verdict = Verdict(state, code, detail, completeness, duplicate_of, over_us, asks_sha256)
        return self._store.uploads.conclude(upload_id, verdict, related)

    def _wait_for(self, upload: Upload, live: Ride) -> Upload:
        """Leave a file until the ride it belongs to is over: only then is known what it lacks."""
        detail = f"This is ride {live.id}, which is being recorded; what it lacks is filled later."
        return self._conclude(upload.id, "queued", WAITS, detail, None, live.id)

    def _unpacked(self, upload: Upload, path: Path, lane: str) -> Upload:
        if lane != UNPACKING:
            raise GoesElsewhere(UNPACKING)
        over_us = now_us() + self._settings.expires_s * 1_000_000
        return Container(self._store, self, upload, over_us).read(self._unpack(path))

    def _path(self, upload: Upload) -> Path:
        if upload.object_key is None:
            raise Conflict(f"Upload {upload.id} has not arrived.")
        expected = Expected(upload.object_key, upload.received)
        if damage := self._store.soundness.damage(expected):
            raise damaged_upload(upload.name, upload.object_key, damage)
        return self._store.objects.local_path(upload.object_key)

    def _read(self, upload: Upload, path: Path, lane: str) -> Outcome:
        read = self._slow_reader if lane == SLOW else self._reader
        outcome = read(path, upload.name)
        if outcome.question is not None:
            answer = self.answer_for(upload, outcome.question.header_sha256)
            if answer is not None:
                outcome = read(path, upload.name, table_answer=answer)
        if outcome.code == TOO_SLOW and lane != SLOW:
            raise GoesElsewhere(SLOW)
        return outcome

    def _twin(self, upload: Upload) -> Upload | None:
        """Conclude an upload of bytes that are here already, naming the ride they became."""
        first = self._store.uploads.first_with(upload.sha256 or "", upload.owner_id)
        if first is None or first.id == upload.id:
            return None
        ride = self._store.rides.get(first.ride_ids[0])
        sentence = (
            f"The same file is here already: ride {ride.id} of {iso_utc(ride.started_us)[:10]}."
        )
        return self._conclude(
            upload.id, first.state, "duplicate", sentence, first.completeness, ride.id
        )


def misfit(rides: Sequence[Ride], outcome: Outcome) -> str | None:
    """Why the rides of a file cannot become what it says by another answer; None where they can."""
    if not outcome.rides:
        return f"By this answer the file cannot be read: {outcome.detail}"
    if not rides:
        return "No ride is made of this file: what it holds was here before it came."
    if filled := [ride for ride in rides if ride.filled]:
        return f"Ride {filled[0].id} holds rows of another file, too: it stays as it is."
    if len(outcome.rides) != len(rides):
        return (
            f"By this answer the file holds {len(outcome.rides)} rides, and {len(rides)} made of "
            "it are here: delete them, and send the file again."
        )
    return None


def ride_of(
    upload: Upload, imported: ImportedRide, number: int, count: int, completeness: float | None
) -> Ride:
    """The ride of one part of a file, not yet in the store."""
    name = ride_name(upload.name)
    # A unit without a clock: the ride was over when its log came.
    over_us = upload.created_us - int(imported.rows.times_us[-1])
    return Ride(
        id=0,
        state="live",
        origin="imported",
        name=name if count == 1 else f"{name} ({number + 1} of {count})",
        notes="; ".join(imported.notes),
        started_us=imported.started_us if imported.start_known else over_us,
        row_count=len(imported.rows.times_us),
        period_us=imported.period_us,
        channels=imported.rows.channels,
        derived=(),
        context=imported.context,
        completeness=completeness,
        events=imported.events,
        sport=imported.sport,
        intake=imported.intake,
        metadata=imported.metadata,
    )
