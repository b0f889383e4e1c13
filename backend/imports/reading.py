"""Who reads which upload: threads of its own, a quick lane, a slow one, and one for containers.

A file that takes longer than the quick lane allows is read again, from its start, in the slow lane.
So whatever waits there, the quick lane goes on; and no request waits on a thread of the server. A
container waits for the files within it, which are read in the other lanes.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager

from backend.errors import Conflict, NotFound, SpindleError, StoreError
from backend.formats import ReadingStopped
from backend.store import Upload

LOG = logging.getLogger(__name__)

# The lanes, and how many read at once in each: child processes that may take half a gigabyte.
QUICK, SLOW, UNPACKING = "quick", "slow", "unpacking"
AT_ONCE = {QUICK: 2, SLOW: 1, UNPACKING: 1}
# How often uploads that the store refused to work on are begun again.
AGAIN_S = 10.0


class GoesElsewhere(Exception):
    """A file that is for another lane."""

    def __init__(self, lane: str) -> None:
        super().__init__(lane)
        self.lane = lane


class Lanes:
    """Uploads being read or waiting for it, each once; safe to call from any thread.

    work(upload_id, lane): reads and concludes an upload; raises GoesElsewhere in the quick lane.
    unread: how an upload stands whose reading was stopped.
    """

    def __init__(self, work: Callable[[str, str], Upload], unread: Callable[[str], Upload]) -> None:
        self._work = work
        self._unread = unread
        self._lanes = {
            lane: ThreadPoolExecutor(at_once, thread_name_prefix=f"{lane}-import")
            for lane, at_once in AT_ONCE.items()
        }
        self._lock = threading.RLock()
        self._going: dict[str, Future[Upload]] = {}
        # What is done for each of them, and in which lane.
        self._tasks: dict[str, tuple[Future[None], str]] = {}
        self._closed = False
        self._logged: set[str] = set()
        self._refused: set[str] = set()
        self._again_us = 0

    def begin(self, upload_id: str, prepare: Callable[[str], object]) -> Future[Upload]:
        """Read an upload in its turn; the promise of what becomes of it, which nobody can cancel.

        prepare: what is done first, here and now. Its error is the promise's too.
        """
        with self._lock:
            if (going := self._going.get(upload_id)) is not None:
                return going
            promise: Future[Upload] = Future()
            promise.set_running_or_notify_cancel()
            self._going[upload_id] = promise
        try:
            prepare(upload_id)
        except Exception as error:
            self._fail(upload_id, promise, error)
        else:
            self._submit(upload_id, promise, QUICK)
        return promise

    def take_refused(self, now_us: int) -> set[str]:
        """Uploads that the store refused to work on and that are to be begun again now.

        now_us: Unix time.
        """
        later_us = now_us + round(AGAIN_S * 1e6)
        with self._lock:
            # What is due later than that was noted before the clock was set back.
            if now_us < self._again_us <= later_us:
                return set()
            refused, self._refused, self._again_us = self._refused, set(), later_us
            return refused

    @contextmanager
    def idle(self, upload_id: str) -> Iterator[None]:
        """Inside, nobody begins to read the upload, which is to be removed.

        One that waits for its turn loses it, and whoever waits for that gets NotFound. Raises
        Conflict while the upload is read.
        """
        with self._lock:
            promise = self._going.get(upload_id)
            task, lane = self._tasks.get(upload_id, (None, QUICK))
            if promise is not None and not (task is not None and task.cancel()):
                raise Conflict(
                    f"Upload {upload_id} is being read: remove it when that is over.",
                    code="being_read",
                )
            try:
                yield
            except BaseException:
                if promise is not None:
                    self._submit(upload_id, promise, lane)
                raise
            removed = promise is not None and self._end(upload_id)
        if promise is not None and removed:
            promise.set_exception(NotFound(f"Upload {upload_id} was removed before it was read."))

    def close(self, stop_readers: Callable[[], None]) -> None:
        """End the reading. What is not concluded stays as it is, for the next start."""
        with self._lock:
            self._closed = True
        stop_readers()
        # Containers last: they wait for what is within them.
        for lane in (QUICK, SLOW, UNPACKING):
            if lane == UNPACKING:
                self._leave_all()
            self._lanes[lane].shutdown(cancel_futures=True)
        self._leave_all()

    def _leave_all(self) -> None:
        with self._lock:
            left = list(self._going.items())
        for upload_id, promise in left:
            self._leave(upload_id, promise)

    def _submit(self, upload_id: str, promise: Future[Upload], lane: str) -> None:
        with self._lock:
            if not self._closed:
                task = self._lanes[lane].submit(self._run, upload_id, promise, lane)
                self._tasks[upload_id] = (task, lane)
                return
        self._leave(upload_id, promise)

    def _run(self, upload_id: str, promise: Future[Upload], lane: str) -> None:
        try:
            upload = self._work(upload_id, lane)
        except GoesElsewhere as goes:
            self._submit(upload_id, promise, goes.lane)
        except ReadingStopped:
            self._leave(upload_id, promise)
        except Exception as error:
            self._fail(upload_id, promise, error)
        else:
            if self._end(upload_id):
                promise.set_result(upload)

    def _leave(self, upload_id: str, promise: Future[Upload]) -> None:
        """Keep the promise with how the upload stands."""
        try:
            upload = self._unread(upload_id)
        except SpindleError as error:
            self._fail(upload_id, promise, error)
        else:
            if self._end(upload_id):
                promise.set_result(upload)

    def _fail(self, upload_id: str, promise: Future[Upload], error: Exception) -> None:
        """Whoever waits gets the error; the log gets it too, once while it lasts."""
        sentence = f"Upload {upload_id} is not read: {error}"
        if sentence not in self._logged:
            self._logged.add(sentence)
            fault = None if isinstance(error, SpindleError) else error
            LOG.warning("%s", sentence, exc_info=fault)
        if isinstance(error, StoreError):
            with self._lock:
                self._refused.add(upload_id)
        if self._end(upload_id):
            promise.set_exception(error)

    def _end(self, upload_id: str) -> bool:
        """Whether the promise is still to be kept: a stop may have kept it."""
        with self._lock:
            self._tasks.pop(upload_id, None)
            return self._going.pop(upload_id, None) is not None


def ride_name(file_name: str) -> str:
    """`activities/Morning.fit.gz` -> `Morning`."""
    last = file_name.replace("\\", "/").rsplit("/", 1)[-1] or file_name
    packed = last[:-3] if last.lower().endswith(".gz") else last
    return packed.rsplit(".", 1)[0] or packed
