"""A container's files become uploads of their own, and the container one upload with one summary.

Each file within is kept under its own hash, read in its turn like any other, and linked to the
container, so that its ride is rebuilt and exported from its own bytes. A crash in the middle loses
nothing: the container still waits, and what of it has become an upload is not made again.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter, deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from backend.core.ride import Ride
from backend.errors import InvalidRequest, NotFound
from backend.formats import (
    NEEDS_MAPPING,
    BrokenArchive,
    Entry,
    Left,
    Outcome,
    ReadingStopped,
    Titles,
)
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED
from backend.imports.reading import ride_name
from backend.store import Store, Upload, Verdict

# Files read side by side: the lanes take them, and what waits in memory stays little.
AHEAD_MAX = 4
# A summary and a file tell the same start, the one rounded.
SAME_START_US = 60_000_000
HERE = "duplicate"
# A file within that waits for an answer, and the code of the container it is in.
ASKS, PART_ASKS = "asks", "part_asks"

Unpacker = Callable[[Path], Iterator[Entry | Left]]


class Desk(Protocol):
    """What takes uploads: `upload.Uploads`."""

    def begin(
        self, name: str, length: int, sha256: str | None = None, part_of: str | None = None
    ) -> Upload: ...

    def resume(self, upload: Upload, data: bytes) -> Future[Upload]: ...


class Container:
    """One container on its way to becoming rides."""

    def __init__(self, store: Store, desk: Desk, upload: Upload, over_us: int) -> None:
        self._store = store
        self._desk = desk
        self._upload = upload
        self._over_us = over_us
        self._existing_parts = {part.name: part for part in store.uploads.parts(upload.id)}

    def read(self, contents: Iterator[Entry | Left]) -> Upload:
        """Every file within to its end, then the summary. Raises ReadingStopped."""
        going: deque[Future[Upload]] = deque()
        broken: Outcome | None = None
        left = Left(Titles({}), 0)
        try:
            for item in contents:
                if isinstance(item, Left):
                    left, broken = item, item.error
                elif (promise := self._take(item)) is not None:
                    going.append(promise)
                if len(going) > AHEAD_MAX:
                    settled(going.popleft())
        except BrokenArchive as error:
            broken = error.outcome
        for promise in going:
            settled(promise)
        parts = self._store.uploads.parts(self._upload.id)
        for part in parts:
            if part.state not in (COMPLETE, PARTIAL, REJECTED):
                return self._wait_for(part)
        self._name_rides(parts, left.titles)
        return self._conclude(parts, left.left_alone, broken)

    def _take(self, entry: Entry) -> Future[Upload] | None:
        """An upload for a file within; the promise of what becomes of it, if that is open."""
        part = self._existing_parts.get(entry.name)
        if part is not None and part.state in (COMPLETE, PARTIAL, REJECTED):
            return None
        if entry.data is None:
            self._refuse(part, entry.name, entry.code, entry.detail)
            return None
        try:
            part = part or self._desk.begin(entry.name, entry.size, part_of=self._upload.id)
        except InvalidRequest as refused:
            self._refuse(None, entry.name, refused.code, refused.message)
            return None
        return self._desk.resume(part, entry.data)

    def _refuse(self, part: Upload | None, name: str, code: str | None, detail: str | None) -> None:
        """Conclude a file within of which no byte is kept, whatever size it says it has."""
        part = part or self._desk.begin(name, 0, part_of=self._upload.id)
        verdict = Verdict(REJECTED, code, detail, 0.0, None, self._over_us)
        self._store.uploads.conclude(part.id, verdict)

    def _wait_for(self, part: Upload) -> Upload:
        """Leave the container until a ride is over that a file within is of.

        Raises ReadingStopped when it is Spindle's stop that left the file unread.
        """
        if part.duplicate_of is None:
            raise ReadingStopped
        verdict = Verdict("queued", part.code, part.detail, None, part.duplicate_of)
        return self._store.uploads.conclude(self._upload.id, verdict)

    def _name_rides(self, parts: tuple[Upload, ...], titles: Titles) -> None:
        """Give rides the names they had where they come from, unless somebody named them here."""
        if not (titles.by_name or titles.by_start_us):
            return
        titles = Titles(titles.by_name, tuple(sorted(titles.by_start_us)))
        for part in parts:
            for ride_id in part.ride_ids if part.duplicate_of is None else ():
                with suppress(NotFound):
                    self._name(part, self._store.rides.get(ride_id), titles)

    def _name(self, part: Upload, ride: Ride, titles: Titles) -> None:
        ride_title = titles.by_name.get(part.name) or started_at(titles, ride.started_us)
        # Somebody may have named it here, and the container come once more after a crash.
        if ride_title is None or ride.name != ride_name(part.name):
            return
        title, about = ride_title
        notes = "\n".join(text for text in (about, ride.notes) if text)
        self._store.rides.patch(ride.id, title or None, notes if about else None)

    def _conclude(
        self, parts: tuple[Upload, ...], left_alone: int, broken: Outcome | None
    ) -> Upload:
        counted = Counter(standing(part) for part in parts)
        made = [i for part in parts if standing(part) != HERE for i in part.ride_ids]
        related = [i for part in parts if standing(part) == HERE for i in part.ride_ids]
        state, code = judged(counted, broken)
        sentence = summary(counted, left_alone)
        detail = f"{sentence} {broken.detail}" if broken is not None and broken.detail else sentence
        verdict = Verdict(state, code, detail, None, None, self._over_us)
        return self._store.uploads.conclude(self._upload.id, verdict, related, made)


def settled(promise: Future[Upload]) -> None:
    """Wait for a file within. One that was removed meanwhile is no matter; other errors are."""
    with suppress(NotFound):
        promise.result()


def standing(part: Upload) -> str:
    """What became of a file within, in one word."""
    if part.code == NEEDS_MAPPING:
        return ASKS
    return HERE if part.code in (HERE, "filled") else part.state


def judged(counted: Counter[str], broken: Outcome | None) -> tuple[str, str | None]:
    """State and code of a container, from those of its files; first what somebody can do."""
    saved = any(counted[one] for one in (COMPLETE, PARTIAL, HERE))
    if counted[ASKS]:
        return PARTIAL if saved else REJECTED, PART_ASKS
    if not saved:
        return REJECTED, (broken.code if broken is not None else "no_rides_inside")
    if broken is not None:
        return PARTIAL, broken.code
    if counted[REJECTED] or counted[PARTIAL]:
        return PARTIAL, "part_unreadable"
    return COMPLETE, None if counted[COMPLETE] else HERE


def summary(counted: Counter[str], left_alone: int) -> str:
    """What became of the files within, in words."""
    kinds = (
        (COMPLETE, "read completely"),
        (HERE, "already here"),
        (PARTIAL, "read in part"),
        (ASKS, "waiting for what only their owner knows"),
        (REJECTED, "no rides"),
    )
    sentence = ", ".join(f"{counted[one]} {words}" for one, words in kinds if counted[one])
    total = sum(counted.values())
    files = f"{total} file{'' if total == 1 else 's'}"
    alone = f" {left_alone} other files of the export were left alone." if left_alone else ""
    return (f"{files}: {sentence}." if sentence else "No file within.") + alone


def started_at(titles: Titles, started_us: int) -> tuple[str, str] | None:
    """What the export calls the ride that began then. titles: in order of their starts."""
    at = bisect_left(titles.by_start_us, (started_us, "", ""))
    near = [
        (abs(start_us - started_us), title, about)
        for start_us, title, about in titles.by_start_us[max(at - 1, 0) : at + 1]
        if abs(start_us - started_us) <= SAME_START_US
    ]
    return min(near)[1:] if near else None
