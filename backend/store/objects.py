"""The object store: whole files under a key, written once, addressed by their content.

    spindle-store.json          the store's identity, the same as in the database
    rides/ab/<sha256>.parquet   a finished ride
    rides/ab/<sha256>.json      its sidecar: what a person wrote about it
    originals/ab/<sha256>       a file as it came
    calibrations/ab/<sha256>.json   a closed calibration: captures, certificate, what was done
    lost+found/...              what was in these three and the database did not know
    tables/, calibrating/, visits/   small files of their features, which no start moves away

An object appears under its key all at once or not at all: it is written beside, flushed, renamed,
and the folder is flushed. Only what is named here is ever looked at, moved or removed: the folder
may hold files of other people.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import secrets
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from backend.errors import StoreError
from backend.store.health import WriteWatch, write_a_little

STAGING = ".staging"
STAGED_NAME = re.compile(r"[0-9a-f]{16}")
CALIBRATIONS = "calibrations"
KINDS = ("rides", "originals", CALIBRATIONS)
LOST_FOUND = "lost+found"
# What owners said of tables: small files that no database names.
TABLES = "tables"
# A calibration that is open, a file each: what was captured outlives the database.
CALIBRATING = "calibrating"
# Service visits, a file each, and one for each of their photographs.
VISITS = "visits"
IDENTITY = "spindle-store.json"
IDENTITY_ID = re.compile(r"[0-9a-f]{32}")
RIDE_SUFFIX, SIDECAR_SUFFIX = ".parquet", ".json"
READ_BYTES = 1 << 20


class Disk:
    """The steps that reach the disk; a test replaces them to make the Nth one fail."""

    def flush_file(self, path: Path) -> None:
        descriptor = os.open(path, os.O_RDWR)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

    def rename(self, source: Path, target: Path) -> None:
        source.replace(target)

    def flush_folder(self, path: Path) -> None:
        if os.name == "nt":
            return
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

    def remove(self, path: Path) -> None:
        path.unlink(missing_ok=True)


# The folder's name among the parts of the store that may refuse to be written.
PART = "objects"


@dataclass(frozen=True)
class Arrived:
    """How large an object is, and when it was written."""

    size_bytes: int
    written_us: int


class Objects(Protocol):
    """What the store needs of an object store, whatever its URL."""

    @property
    def watch(self) -> WriteWatch: ...
    def stage(self) -> Path: ...
    def publish(self, staged: Path, key: str) -> None: ...
    def publish_json(self, key: str, body: Mapping[str, object]) -> None: ...
    def read_json(self, key: str) -> dict[str, Any] | None: ...
    def find(self, key: str) -> Path | None: ...
    def here(self, key: str) -> Path | None: ...
    def arrived(self, key: str) -> Arrived | None: ...
    def local_path(self, key: str) -> Path: ...
    def remove(self, key: str) -> None: ...
    def holding(self) -> AbstractContextManager[None]: ...
    def unless_in_use(self, work: Callable[[], bool]) -> bool: ...
    def keys(self) -> Iterator[str]: ...
    def table_keys(self) -> Iterator[str]: ...
    def calibrating_keys(self) -> Iterator[str]: ...
    def visit_keys(self) -> Iterator[str]: ...
    def clear_staging(self) -> int: ...


class FileObjects:
    """Objects as files under a folder (`file:///...`). Makes nothing before `prepare`.

    root: the folder. where: the objects' place in messages. is_folder: whether they are on a disk
    of this machine, which may rot.
    """

    is_folder = True

    def __init__(self, root: Path, disk: Disk | None = None) -> None:
        self.root = root
        self.where = str(root)
        self.disk = disk or Disk()
        # Told of every write to this folder; the database of the same store shares it.
        self.watch = WriteWatch()
        self._turn = threading.Lock()
        self._making = threading.Lock()
        self._holders = 0

    def prepare(self) -> None:
        """Make the folder and our own places in it."""
        (self.root / STAGING).mkdir(parents=True, exist_ok=True)

    def stage(self) -> Path:
        """A path to write a new object to."""
        return self.root / STAGING / secrets.token_hex(8)

    def publish(self, staged: Path, key: str) -> None:
        """Make a staged file the object `key`, for good once this returns.

        Raises StoreError when a step fails; then the key is absent, or whole if it was renamed.
        """
        with self.watch.writing(PART, f"The object {key} was not saved"):
            self.disk.flush_file(staged)
            self._move(staged, self.root / key)

    def publish_json(self, key: str, body: Mapping[str, object]) -> None:
        """Write a small JSON object under a key, in place of the one before. Raises StoreError."""
        staged = self.stage()
        with self.watch.writing(PART, f"The object {key} was not saved"):
            text = json.dumps(body, sort_keys=True, ensure_ascii=False, indent=1)
            staged.write_text(text + "\n", encoding="utf-8")
        try:
            self.publish(staged, key)
        finally:
            staged.unlink(missing_ok=True)

    def try_write(self, part: str) -> None:
        """Write a little for `part` of the store, for the watch to see how that goes."""
        with suppress(StoreError), self.watch.writing(part, "Nothing was lost"):
            write_a_little(self.root / STAGING)

    def read_json(self, key: str) -> dict[str, Any] | None:
        """A small JSON object, None when it is absent. Raises StoreError when it is damaged."""
        try:
            text = (self.root / key).read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise StoreError(f"{self.root / key} cannot be read: {error}.") from error
        return json_object(text, str(self.root / key))

    def find(self, key: str) -> Path | None:
        """Where the object is, if it is there; None where that is known. Raises StoreError."""
        return self.root / key

    def here(self, key: str) -> Path | None:
        """As `find`, of what is on this machine: None where another has to be asked."""
        return self.root / key

    def arrived(self, key: str) -> Arrived | None:
        """Size and age of an object, None when there is none. Raises StoreError."""
        try:
            status = (self.root / key).stat()
        except OSError:
            return None
        return Arrived(status.st_size, status.st_mtime_ns // 1000)

    def local_path(self, key: str) -> Path:
        """Where the object can be read. Raises StoreError when it is not there."""
        path = self.find(key)
        if path is None or not path.is_file():
            raise StoreError(f"The object {key} is missing from {self.where}.")
        return path

    def remove(self, key: str) -> None:
        """Remove an object, for good once this returns; one that is not there is no error."""
        path = self.root / key
        try:
            self.disk.remove(path)
            if path.parent.is_dir():
                self.disk.flush_folder(path.parent)
        except OSError as error:
            raise StoreError(f"The object {key} was not removed: {error}") from error

    @contextmanager
    def holding(self) -> Iterator[None]:
        """From publishing an object until SQL knows it: nothing is removed meanwhile."""
        with self._turn:
            self._holders += 1
        try:
            yield
        finally:
            with self._turn:
                self._holders -= 1

    def unless_in_use(self, work: Callable[[], bool]) -> bool:
        """Do what removes objects, and give its answer; False and nothing while one is held."""
        with self._turn:
            return self._holders == 0 and work()

    def size_bytes(self) -> int:
        """Of every object together."""
        found = (self.arrived(key) for key in self.keys())
        return sum(one.size_bytes for one in found if one is not None)

    def keys(self) -> Iterator[str]:
        """Every object's key, sidecars too."""
        yield from self._files(KINDS)

    def table_keys(self) -> Iterator[str]:
        """Keys of what was said of tables."""
        yield from self._files((TABLES,))

    def calibrating_keys(self) -> Iterator[str]:
        """Keys of the files of open calibrations."""
        yield from self._files((CALIBRATING,))

    def visit_keys(self) -> Iterator[str]:
        """Keys of the files of service visits, and of their photographs."""
        yield from self._files((VISITS,))

    def lost_keys(self) -> Iterator[str]:
        """What lies in `lost+found/`."""
        yield from self._files((LOST_FOUND,))

    def move_to_lost_found(self, key: str, name: str | None = None) -> str:
        """Move a file aside under its key, or another name; its new key. Overwrites nothing.

        Raises StoreError when the disk refuses; the file is then where it was, or moved.
        """
        target = free_name(self.root / LOST_FOUND / (name or key))
        try:
            self._move(self.root / key, target)
        except OSError as error:
            raise StoreError(f"{key} was not moved to {LOST_FOUND}/: {error}") from error
        return target.relative_to(self.root).as_posix()

    def identity(self) -> str | None:
        """The store's id as the folder has it, None when it has none. Raises StoreError."""
        body = self.read_json(IDENTITY)
        if body is None:
            return None
        identity = body.get("id")
        if not isinstance(identity, str) or not IDENTITY_ID.fullmatch(identity):
            raise StoreError(
                f"{IDENTITY} in {self.where} holds no identity. Without that file a database that "
                "knows every object of the folder is taken again."
            )
        return identity

    def set_identity(self, store_id: str) -> None:
        """Write the store's id into the folder. Raises StoreError."""
        self.publish_json(IDENTITY, {"id": store_id, "format": 1})

    def clear_staging(self) -> int:
        """Remove what a crash left half written; returns how many files."""
        left = [p for p in (self.root / STAGING).iterdir() if STAGED_NAME.fullmatch(p.name)]
        for path in left:
            self.disk.remove(path)
        return len(left)

    def _move(self, source: Path, target: Path) -> None:
        """Rename within the store, making folders on the way, each of them flushed."""
        # One at a time: a folder that another thread made is not there for good before its flush.
        with self._making:
            missing = [folder for folder in target.parents if not folder.exists()]
            for folder in reversed(missing):
                folder.mkdir(exist_ok=True)
                self.disk.flush_folder(folder.parent)
        self.disk.rename(source, target)
        self.disk.flush_folder(target.parent)

    def _files(self, folders: tuple[str, ...]) -> Iterator[str]:
        for folder in folders:
            for path in sorted((self.root / folder).rglob("*")):
                if path.is_file() or path.is_symlink():
                    yield path.relative_to(self.root).as_posix()


def json_object(text: bytes, place: str) -> dict[str, Any]:
    """A JSON object. Raises StoreError, which names its place."""
    try:
        body = json.loads(text.decode())
    except (ValueError, RecursionError) as error:
        raise StoreError(f"{place} cannot be read: {error}.") from error
    if not isinstance(body, dict):
        raise StoreError(f"{place} cannot be read: it is no JSON object.")
    return body


def content_key(kind: str, sha256: str, suffix: str = "") -> str:
    """Key of an object by its content: two letters of the hash spread the folders."""
    return f"{kind}/{sha256[:2]}/{sha256}{suffix}"


def sidecar_key(ride_key: str) -> str:
    """Key of the sidecar of a ride's object."""
    return ride_key.removesuffix(RIDE_SUFFIX) + SIDECAR_SUFFIX


def free_name(path: Path) -> Path:
    """The path, or the first of path.1, path.2 ... that is not taken."""
    number, free = 0, path
    while free.exists() or free.is_symlink():
        number += 1
        free = path.with_name(f"{path.name}.{number}")
    return free


def file_sha256(path: Path) -> str:
    """SHA-256 of a file, read in pieces."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(READ_BYTES):
            digest.update(piece)
    return digest.hexdigest()
