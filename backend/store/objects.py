"""The object store: whole files under a key, written once, addressed by their content.

An object appears under its key all at once or not at all: it is written beside, flushed, renamed,
and the folder is flushed. A crash in between leaves a staged file or an object nobody knows; both
are collected when the store is opened.
"""

from __future__ import annotations

import hashlib
import os
import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import Protocol
from urllib.parse import unquote, urlsplit

from backend.errors import StoreError

STAGING = ".staging"
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


class Objects(Protocol):
    """What the store needs of an object store, whatever its URL."""

    def stage(self) -> Path: ...
    def publish(self, staged: Path, key: str) -> None: ...
    def local_path(self, key: str) -> Path: ...
    def remove(self, key: str) -> None: ...
    def keys(self) -> Iterator[str]: ...
    def clear_staging(self) -> int: ...


class FileObjects:
    """Objects as files under a folder (`file:///...`)."""

    def __init__(self, root: Path, disk: Disk | None = None) -> None:
        self.root = root
        self.disk = disk or Disk()
        (root / STAGING).mkdir(parents=True, exist_ok=True)

    def stage(self) -> Path:
        """A path to write a new object to."""
        return self.root / STAGING / secrets.token_hex(8)

    def publish(self, staged: Path, key: str) -> None:
        """Make a staged file the object `key`, for good once this returns.

        Raises StoreError when a step fails; then the key is absent, or whole if it was renamed.
        """
        target = self.root / key
        try:
            self.disk.flush_file(staged)
            for folder in (target.parent.parent, target.parent):
                if not folder.exists():
                    folder.mkdir()
                    self.disk.flush_folder(folder.parent)
            self.disk.rename(staged, target)
            self.disk.flush_folder(target.parent)
        except OSError as error:
            raise StoreError(f"The object {key} was not saved: {error}") from error

    def local_path(self, key: str) -> Path:
        """Where the object can be read. Raises StoreError when it is not there."""
        path = self.root / key
        if not path.is_file():
            raise StoreError(f"The object {key} is missing from {self.root}.")
        return path

    def remove(self, key: str) -> None:
        """Remove an object; one that is not there is no error."""
        try:
            self.disk.remove(self.root / key)
        except OSError as error:
            raise StoreError(f"The object {key} was not removed: {error}") from error

    def keys(self) -> Iterator[str]:
        """Every object's key."""
        for path in self.root.rglob("*"):
            relative = path.relative_to(self.root)
            if path.is_file() and not relative.parts[0].startswith("."):
                yield relative.as_posix()

    def clear_staging(self) -> int:
        """Remove what a crash left half written; returns how many files."""
        left = list((self.root / STAGING).iterdir())
        for path in left:
            self.disk.remove(path)
        return len(left)


def open_objects(url: str, disk: Disk | None = None) -> FileObjects:
    """The object store of a URL. Raises StoreError for a kind that is not there yet."""
    parts = urlsplit(url)
    if parts.scheme != "file":
        raise StoreError(f"Objects at {parts.scheme}:// are not available: use file:///folder.")
    return FileObjects(Path(unquote(parts.path)), disk)


def content_key(kind: str, sha256: str, suffix: str = "") -> str:
    """Key of an object by its content: two letters of the hash spread the folders."""
    return f"{kind}/{sha256[:2]}/{sha256}{suffix}"


def file_sha256(path: Path) -> str:
    """SHA-256 of a file, read in pieces."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(READ_BYTES):
            digest.update(piece)
    return digest.hexdigest()
