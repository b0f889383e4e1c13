"""Whether an object is still what was written: its key is the hash of its bytes.

Nothing of an object leaves before it was verified. Hashing a ride of two hours takes some
milliseconds; a window of it must not, so the verdict is remembered with the file's time of change,
size and inode and holds while these do. What is sent as a file is hashed each time, through the
handle it is then sent from. Rows read for a window have their pages' checksums besides.
"""

from __future__ import annotations

import hashlib
import logging
import os
import threading
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from backend.core.ride import BAD, Ride
from backend.errors import Conflict, ObjectDamaged
from backend.store.objects import Objects

LOG = logging.getLogger(__name__)

MISSING = "missing"
WRONG_SIZE = "wrong_size"
CHANGED = "changed"
UNREADABLE = "unreadable"
# Not the object, but the ride's row in the database.
ROW_DAMAGED = "row"
WORDS = {
    MISSING: "the file is missing",
    WRONG_SIZE: "the file has not the size it was written with",
    CHANGED: "its bytes are not those that were written",
    UNREADABLE: "the disk does not let it be read",
}
READ_BYTES = 1 << 20
# What one look at the folder may read: some 20 ms, on the thread that keeps house each second.
SCRUB_BYTES = 8 << 20
# How often the whole folder is read: a disk that rots does not change a file's time.
ROUND_US = 86_400 * 1_000_000

Signature = tuple[int, int, int]


@dataclass(frozen=True)
class Expected:
    """An object as it was written. size_bytes: None where it was not recorded."""

    key: str
    size_bytes: int | None

    @property
    def sha256(self) -> str:
        return Path(self.key).name.partition(".")[0]


class Soundness:
    """What is known of the objects; safe to ask from any thread. What an object store that does not
    answer raises, StoreError, says nothing of an object."""

    def __init__(self, objects: Objects) -> None:
        self._objects = objects
        self._verdicts: dict[str, tuple[Signature, str | None]] = {}
        self._lock = threading.Lock()
        self._waiting: deque[Expected] = deque()
        self._next_round_us = 0
        # What is wrong with the objects that are known to be damaged now, by key.
        self.damaged: dict[str, str] = {}

    def damage(self, expected: Expected) -> str | None:
        """What is wrong with an object, None when nothing is; hashed unless it was before."""
        return self._damage(expected, read=True)

    def cached_damage(self, expected: Expected) -> str | None:
        """As `damage`, without reading the file: what its size and earlier looks tell."""
        return self._damage(expected, read=False)

    def opened(self, expected: Expected) -> tuple[BinaryIO | None, str | None]:
        """The object's file, every byte of it verified, at its start; or what is wrong with it."""
        path = self._objects.find(expected.key)
        if path is None:
            return None, MISSING
        try:
            file = path.open("rb")
        except FileNotFoundError:
            return None, MISSING
        except OSError:
            return None, UNREADABLE
        damage = self._judged(expected, file)
        if damage is None:
            return file, None
        file.close()
        return None, damage

    def require(self, ride: Ride) -> None:
        """Raises ObjectDamaged unless a ride's row and samples are what was written."""
        require_row(ride)
        if ride.object_key is not None and (damage := self.damage(expected_of(ride))):
            raise damaged_samples(ride.id, ride.object_key, damage)

    def open_ride(self, ride: Ride) -> BinaryIO:
        """A finished ride's file, every byte of it verified. Raises ObjectDamaged, Conflict."""
        require_row(ride)
        if ride.object_key is None:
            raise Conflict(f"Ride {ride.id} is being recorded: export it when it ended.")
        file, damage = self.opened(expected_of(ride))
        if file is None:
            raise damaged_samples(ride.id, ride.object_key, damage or MISSING)
        return file

    def open_original(self, ride: Ride, name: str, key: str, size_bytes: int) -> BinaryIO:
        """The file a ride came from, every byte of it verified. Raises ObjectDamaged."""
        file, damage = self.opened(Expected(key, size_bytes))
        if file is None:
            raise damaged_original(ride.id, name, key, damage or MISSING)
        return file

    def scrub(self, now_us: int, objects: Callable[[], Iterable[Expected]]) -> None:
        """Read a few of the objects, so that damage is known before somebody asks; all in a day.

        What is damaged is looked at each time: it may have been restored, or deleted.
        """
        suspects = set(self.damaged)
        if not self._waiting and now_us >= self._next_round_us:
            self._next_round_us = now_us + ROUND_US
            self._waiting.extend(objects())
            waiting = {expected.key for expected in self._waiting}
            with self._lock:
                verdicts = {key: value for key, value in self._verdicts.items() if key in waiting}
                self._verdicts = verdicts
        read = 0
        while self._waiting and read < SCRUB_BYTES:
            expected = self._waiting.popleft()
            file, damage = self.opened(expected)
            if file is not None:
                read += file.seek(0, 2)
                file.close()
            elif damage is not None:
                suspects.add(expected.key)
            read += 1
        present = [one for one in objects() if one.key in suspects] if suspects else []
        self.damaged = {one.key: damage for one in present if (damage := self.damage(one))}

    def _damage(self, expected: Expected, read: bool) -> str | None:
        path = (self._objects.find if read else self._objects.here)(expected.key)
        if path is None:
            return MISSING if read else None
        try:
            signature = signature_of(path.stat())
        except FileNotFoundError:
            return MISSING
        except OSError:
            return UNREADABLE
        with self._lock:
            verdict = self._verdicts.get(expected.key)
        if verdict is not None and verdict[0] == signature:
            return verdict[1]
        if expected.size_bytes is not None and signature[1] != expected.size_bytes:
            return WRONG_SIZE
        if not read:
            return None
        file, damage = self.opened(expected)
        if file is not None:
            file.close()
        return damage

    def _judged(self, expected: Expected, file: BinaryIO) -> str | None:
        """Hash an open file from its start to its end and go back to the start."""
        damage: str | None = None
        digest = hashlib.sha256()
        try:
            signature = signature_of(os.fstat(file.fileno()))
            while piece := file.read(READ_BYTES):
                digest.update(piece)
            file.seek(0)
        except OSError:
            return UNREADABLE
        if digest.hexdigest() != expected.sha256:
            size_bytes = expected.size_bytes
            damage = CHANGED if size_bytes is None or signature[1] == size_bytes else WRONG_SIZE
        self._remember(expected.key, signature, damage)
        return damage

    def _remember(self, key: str, signature: Signature, damage: str | None) -> None:
        with self._lock:
            before = self._verdicts.get(key)
            self._verdicts[key] = (signature, damage)
        if damage is not None and (before is None or before[1] != damage):
            LOG.error("The object %s is damaged: %s.", key, WORDS[damage])


def signature_of(status: os.stat_result) -> Signature:
    """What changes when a file is written: time of change, size, inode."""
    return status.st_mtime_ns, status.st_size, status.st_ino


def expected_of(ride: Ride) -> Expected:
    """A finished ride's object as it was written."""
    return Expected(ride.object_key or "", ride.object_bytes)


def require_row(ride: Ride) -> None:
    """Raises ObjectDamaged for a ride whose row in the database cannot be read."""
    if ride.state == BAD:
        raise ObjectDamaged(
            f"The row of ride {ride.id} in the database is damaged. It is mended by itself while "
            "its file is whole; if this stays, restore the file from a backup."
        )


def damaged_samples(ride_id: int, key: str, damage: str) -> ObjectDamaged:
    """Why a ride's samples are not shown, and what to do."""
    return ObjectDamaged(
        f"The samples of ride {ride_id} are damaged: {WORDS[damage]} ({key}). Nothing of them was "
        "sent. Restore this file from a backup; or, if you have the file the ride came from, "
        "delete the ride and import it again."
    )


def damaged_original(ride_id: int, name: str, key: str, damage: str) -> ObjectDamaged:
    """Why an original is not sent, and what to do."""
    return ObjectDamaged(
        f"The original file of ride {ride_id}, {name!r}, is damaged: {WORDS[damage]} ({key}). "
        "Nothing of it was sent. Restore it from a backup, or import the same file again; the "
        "ride itself is not touched by this."
    )


def damaged_upload(name: str, key: str, damage: str) -> ObjectDamaged:
    """Why a file that arrived is not read, and what to do."""
    return ObjectDamaged(
        f"The file {name!r} is damaged since it arrived: {WORDS[damage]} ({key}). It was not read. "
        "Send it again."
    )
