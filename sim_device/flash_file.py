"""The simulated unit's flash memories on disk, as durable as the unit says they are.

A file changes from one moment of the flash to a later one, whenever the process dies: the small
flash is replaced whole, the one for ride logs changes in blocks that are first written to a journal
beside it. When `save` returns, the disk has it.
"""

import os
import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from sim_device.firmware.python.unit import FLASH_LENGTH, LOG_LENGTH

JOURNAL_HEAD = struct.Struct("<4sQII")
"""Magic, address, length, CRC-32 of what follows: the bytes that belong there."""
JOURNAL_MAGIC = b"SPJ1"

NEW_FILE_MODE = 0o644


class ChangingLog(Protocol):
    """A unit's flash for ride logs."""

    @property
    def log_changes(self) -> int:
        """The same number means the same bytes."""

    def log_changed(self) -> tuple[int, bytes]:
        """Address and bytes of what changed since the last call."""


@dataclass
class FlashFile:
    """The unit's flash on disk, so that a simulated unit keeps its configuration."""

    path: Path
    written: bytes = b""

    def load(self) -> bytes | None:
        """The image, or None for a unit that has none yet. Raises ValueError on another length."""
        image = _image_of(self.path, FLASH_LENGTH, "a flash image")
        self.written = image or b""
        return image

    def save(self, image: bytes) -> None:
        """Writes the image if it changed; a crash leaves the old file or the new one.

        Raises OSError, with what to do, where it cannot be written.
        """
        if image == self.written:
            return
        with _errors_named(self.path):
            _replace(self.path, image)
        self.written = image


@dataclass
class LogFile:
    """The unit's flash for ride logs on disk."""

    path: Path
    changes: int = 0
    is_there: bool = False

    @property
    def journal(self) -> Path:
        """Where a change is written down before it is made."""
        return self.path.with_name(f"{self.path.name}.journal")

    def load(self) -> bytes | None:
        """The image, or None for a unit that has none yet. Raises ValueError on another length."""
        self._finish()
        image = _image_of(self.path, LOG_LENGTH, "a flash for ride logs")
        self.is_there = image is not None
        return image

    def save(self, unit: ChangingLog) -> None:
        """Writes what changed since the last call; a crash leaves all of it or nothing.

        Raises OSError, with what to do, where it cannot be written.
        """
        if unit.log_changes == self.changes:
            return
        changes = unit.log_changes
        address, data = unit.log_changed()
        with _errors_named(self.path):
            if not self.is_there:
                _replace(self.path, b"\xff" * LOG_LENGTH)
                self.is_there = True
            head = JOURNAL_HEAD.pack(JOURNAL_MAGIC, address, len(data), zlib.crc32(data))
            _write(self.journal, head + data)
            _sync_folder(self.path.parent)
            self._apply(address, data)
        self.changes = changes

    def _finish(self) -> None:
        """Makes a change that was written down whole. One that was not, nobody was told of."""
        if not self.journal.exists():
            return
        written = self.journal.read_bytes()
        data = written[JOURNAL_HEAD.size :]
        if len(written) >= JOURNAL_HEAD.size:
            magic, address, length, crc = JOURNAL_HEAD.unpack_from(written)
            if (magic, length, crc) == (JOURNAL_MAGIC, len(data), zlib.crc32(data)):
                self._apply(address, data)
                return
        self.journal.unlink()

    def _apply(self, address: int, data: bytes) -> None:
        file = os.open(self.path, os.O_WRONLY)
        try:
            while data:
                written = os.pwrite(file, data, address)
                address, data = address + written, data[written:]
            os.fsync(file)
        finally:
            os.close(file)
        self.journal.unlink()


def _image_of(path: Path, length: int, what: str) -> bytes | None:
    if not path.exists():
        return None
    image = path.read_bytes()
    if len(image) != length:
        raise ValueError(
            f"{path} has {len(image)} bytes, {what} has {length}; "
            "move it away to start with an erased one"
        )
    return image


@contextmanager
def _errors_named(path: Path) -> Iterator[None]:
    """Says which flash an error of the disk is about: the system's own words name no file."""
    try:
        yield
    except OSError as error:
        raise OSError(
            error.errno,
            f"the flash {path} cannot be written ({error.strerror}), and a unit may not say what "
            "its flash does not hold: it stops here. What it has acknowledged is kept; make room "
            "or allow writing there, and start it again",
        ) from error


def _replace(path: Path, data: bytes) -> None:
    fresh = path.with_name(f"{path.name}.new")
    _write(fresh, data)
    fresh.replace(path)
    _sync_folder(path.parent)


def _write(path: Path, data: bytes) -> None:
    file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, NEW_FILE_MODE)
    try:
        while data:
            data = data[os.write(file, data) :]
        os.fsync(file)
    finally:
        os.close(file)


def _sync_folder(folder: Path) -> None:
    """What was created or renamed in it is found again after the machine lost its power."""
    file = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)
