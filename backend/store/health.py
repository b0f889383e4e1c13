"""Whether the store can be written: told once when it begins to fail, once when that is over.

A spell of trouble begins with a refused write. It ends with a write that succeeds after `CALM_S`
without a refusal: on a full disk small writes still find room while large ones do not, and a log
that says "full" and "not full" by turns tells nothing.
"""

from __future__ import annotations

import errno
import logging
import os
import secrets
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy.exc import DBAPIError

from backend.errors import StoreError, StoreFull

LOG = logging.getLogger(__name__)

# Longer than a recorder waits before it tries a refused second again.
CALM_S = 5.0

# What is written to see whether there is room again.
PROBE_BYTES = 256 * 1024

DISK_FULL = "disk_full"
READ_ONLY = "store_read_only"
IO_ERROR = "io_error"
QUEUE_FULL = "queue_full"
UNREACHABLE = "database_unreachable"
DAMAGED = "database_damaged"
BUCKET_UNREACHABLE = "objects_unreachable"
BUCKET_REFUSES = "objects_refused"
WORDS = {
    DISK_FULL: "no space is left on its disk. Free some",
    READ_ONLY: "it may only be read. Give this user the right to write there",
    IO_ERROR: "its disk reports a fault. Look at the system's log, and make a copy of the data",
    QUEUE_FULL: "its disk is slower than the rows that come. Look for what else uses it",
    DAMAGED: "its file is damaged. Stop the server; `spindle store check` tells how much, and "
    "`spindle store rebuild` brings every ride back",
    BUCKET_UNREACHABLE: "its server does not answer as it should. It is tried again",
    BUCKET_REFUSES: "it refuses the keys of access, or is not there. Look at AWS_ACCESS_KEY_ID, "
    "AWS_SECRET_ACCESS_KEY and SPINDLE_OBJECTS",
    UNREACHABLE: "it does not answer. Look whether its server runs",
}

OF_ERRNO = {
    errno.ENOSPC: DISK_FULL,
    errno.EDQUOT: DISK_FULL,
    errno.EFBIG: DISK_FULL,
    errno.EIO: IO_ERROR,
    errno.ENXIO: IO_ERROR,
    errno.ENODEV: IO_ERROR,
    errno.ESTALE: IO_ERROR,
    errno.EROFS: READ_ONLY,
    errno.EACCES: READ_ONLY,
    errno.EPERM: READ_ONLY,
}
OF_SQLITE = {
    sqlite3.SQLITE_FULL: DISK_FULL,
    # The index of its log did not get the room it needs.
    sqlite3.SQLITE_IOERR_SHMSIZE: DISK_FULL,
    sqlite3.SQLITE_READONLY: READ_ONLY,
    sqlite3.SQLITE_PERM: READ_ONLY,
    sqlite3.SQLITE_IOERR: IO_ERROR,
    sqlite3.SQLITE_CANTOPEN: IO_ERROR,
    sqlite3.SQLITE_CORRUPT: DAMAGED,
    sqlite3.SQLITE_NOTADB: DAMAGED,
    sqlite3.SQLITE_BUSY: QUEUE_FULL,
    sqlite3.SQLITE_LOCKED: QUEUE_FULL,
}
# Classes of SQLSTATE (PostgreSQL manual, appendix A).
OF_SQLSTATE = {"53": DISK_FULL, "25": READ_ONLY, "58": IO_ERROR, "08": UNREACHABLE}


@dataclass(frozen=True)
class WriteFault:
    """Something that cannot be written now.

    part: what (`database`, `objects`, `uploads`). code: why, one of `WORDS`. message: for people.
    """

    part: str
    code: str
    message: str


class WriteWatch:
    """What of the store refuses writes. For any thread. now_s: a clock that never goes back."""

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self._now_s = now_s
        self._lock = threading.Lock()
        self._troubles: dict[str, WriteFault] = {}
        self._refused_s: dict[str, float] = {}
        self._since_s: dict[str, float] = {}

    @property
    def troubles(self) -> tuple[WriteFault, ...]:
        """What cannot be written now, in the order in which it began."""
        with self._lock:
            return tuple(self._troubles.values())

    def refused(self, part: str, error: Exception, lost: str) -> StoreError:
        """Note a refused write; the error to raise. lost: what was not done, a sentence's start."""
        code = code_of(error)
        message = f"{lost}: {reason_of(error)}"
        if code is None:
            return StoreError(message)
        self.note(part, code)
        if code == DISK_FULL:
            return StoreFull(message)
        return StoreError(message, code)

    @contextmanager
    def writing(self, part: str, lost: str) -> Iterator[None]:
        """Note whether what is done in here reached the disk. Raises StoreError where not."""
        try:
            yield
        except OSError as error:
            raise self.refused(part, error, lost) from error
        self.worked(part)

    def note(self, part: str, code: str) -> None:
        """Note that `part` cannot be written because of `code`; in the log once a spell."""
        done = "be trusted" if code == DAMAGED else "be written"
        fault = WriteFault(part, code, f"The {part} cannot {done}: {WORDS[code]}.")
        now_s = self._now_s()
        with self._lock:
            is_new = part not in self._troubles
            if is_new:
                self._since_s[part] = now_s
            self._troubles[part] = fault
            self._refused_s[part] = now_s
        if is_new:
            LOG.error("%s", fault.message)

    def worked(self, part: str) -> None:
        """Note that something was written to `part`."""
        if part not in self._troubles:
            return
        now_s = self._now_s()
        with self._lock:
            if part not in self._troubles or now_s - self._refused_s[part] < CALM_S:
                return
            if self._troubles[part].code == DAMAGED:
                # Other pages of the file can be written all the same.
                return
            del self._troubles[part]
            spell_s = now_s - self._since_s[part]
        LOG.warning("The %s can be written again, after %.0f s.", part, spell_s)


def write_a_little(folder: Path) -> None:
    """Write a file as large as some seconds of a ride, and remove it. Raises OSError."""
    path = folder / f".probe-{secrets.token_hex(4)}"
    try:
        with path.open("wb") as file:
            file.write(os.urandom(PROBE_BYTES))
            file.flush()
            os.fsync(file.fileno())
    finally:
        path.unlink(missing_ok=True)


def reason_of(error: BaseException) -> str:
    """What the disk or the database said, without the SQL it was asked."""
    return str(getattr(error, "orig", None) or error)


def code_of(error: BaseException) -> str | None:
    """Why a write was refused; None for what is not the disk's or the database's trouble, such as a
    file that is not there."""
    if isinstance(error, OSError):
        return OF_ERRNO.get(error.errno or 0)
    if not isinstance(error, DBAPIError):
        return None
    number = getattr(error.orig, "sqlite_errorcode", None)
    if number is not None:
        # The low byte of an extended code is what kind it is.
        return OF_SQLITE.get(number, OF_SQLITE.get(number & 0xFF))
    state = getattr(error.orig, "sqlstate", None)
    if state is not None:
        return OF_SQLSTATE.get(state[:2])
    return UNREACHABLE if error.connection_invalidated else None
