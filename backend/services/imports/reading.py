"""Who reads which upload: threads of its own, a quick lane and a slow one.

A file that takes longer than the quick lane allows is read again, from its start, in the slow lane.
So whatever waits there, the quick lane goes on; and no request waits on a thread of the server.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager

from backend.errors import Conflict, NotFound, SpindleError
from backend.ingest import ReadingStopped
from backend.store import Upload

LOG = logging.getLogger(__name__)

# Child processes that read files at once; each may take half a gigabyte.
QUICK_AT_ONCE = 2
SLOW_AT_ONCE = 1


class TakesLong(Exception):
    """A file that the quick lane could not read in its time."""


class Lanes:
    """Uploads being read or waiting for it, each once; safe to call from any thread.

    work(upload_id, slow): reads and concludes an upload; raises TakesLong in the quick lane.
    unread: how an upload stands whose reading was stopped.
    """

    def __init__(
        self, work: Callable[[str, bool], Upload], unread: Callable[[str], Upload]
    ) -> None:
        self._work = work
        self._unread = unread
        self._quick = ThreadPoolExecutor(QUICK_AT_ONCE, thread_name_prefix="import")
        self._slow = ThreadPoolExecutor(SLOW_AT_ONCE, thread_name_prefix="slow-import")
        self._lock = threading.RLock()
        self._going: dict[str, Future[Upload]] = {}
        # What is done in a lane for each of them, and whether that is the slow one.
        self._tasks: dict[str, tuple[Future[None], bool]] = {}
        self._closed = False
        self._told: set[str] = set()

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
            self._submit(upload_id, promise, slow=False)
        return promise

    @contextmanager
    def idle(self, upload_id: str) -> Iterator[None]:
        """Inside, nobody begins to read the upload, which is to be removed.

        One that waits for its turn loses it, and whoever waits for that gets NotFound. Raises
        Conflict while the upload is read.
        """
        with self._lock:
            promise = self._going.get(upload_id)
            task, slow = self._tasks.get(upload_id, (None, False))
            if promise is not None and not (task is not None and task.cancel()):
                raise Conflict(
                    f"Upload {upload_id} is being read: remove it when that is over.",
                    code="being_read",
                )
            try:
                yield
            except BaseException:
                if promise is not None:
                    self._submit(upload_id, promise, slow=slow)
                raise
            removed = promise is not None and self._end(upload_id)
        if promise is not None and removed:
            promise.set_exception(NotFound(f"Upload {upload_id} was removed before it was read."))

    def close(self, stop_readers: Callable[[], None]) -> None:
        """End the reading. What is not concluded stays as it is, for the next start."""
        with self._lock:
            self._closed = True
        stop_readers()
        for lane in (self._quick, self._slow):
            lane.shutdown(cancel_futures=True)
        with self._lock:
            left = list(self._going.items())
        for upload_id, promise in left:
            self._leave(upload_id, promise)

    def _submit(self, upload_id: str, promise: Future[Upload], *, slow: bool) -> None:
        with self._lock:
            if not self._closed:
                lane = self._slow if slow else self._quick
                task = lane.submit(self._run, upload_id, promise, slow)
                self._tasks[upload_id] = (task, slow)
                return
        self._leave(upload_id, promise)

    def _run(self, upload_id: str, promise: Future[Upload], slow: bool) -> None:
        try:
            upload = self._work(upload_id, slow)
        except TakesLong:
            self._submit(upload_id, promise, slow=True)
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
        """Whoever waits is told; nobody may, so the log is told as well, once of what lasts."""
        told = f"Upload {upload_id} is not read: {error}"
        if told not in self._told:
            self._told.add(told)
            fault = None if isinstance(error, SpindleError) else error
            LOG.warning("%s", told, exc_info=fault)
        if self._end(upload_id):
            promise.set_exception(error)

    def _end(self, upload_id: str) -> bool:
        """Whether the promise is still to be kept: a stop may have kept it."""
        with self._lock:
            self._tasks.pop(upload_id, None)
            return self._going.pop(upload_id, None) is not None
