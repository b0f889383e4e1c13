"""Descriptions that units sent of themselves, one file each, so that none is read twice.

A file is only a memory: who takes a description out proves it by its hash, and one that is gone or
damaged is read from the unit again.
"""

from __future__ import annotations

import logging
import os
import re
import threading
from collections.abc import Iterator, MutableMapping
from pathlib import Path

LOG = logging.getLogger(__name__)

SUFFIX = ".schema"
NAME = re.compile(r"[0-9a-f]{16}")
# A workshop meets a handful of firmwares; what is beyond goes, the longest unused first.
SCHEMAS_MAX = 64


class SchemaFiles(MutableMapping[str, bytes]):
    """Compressed schemas by their hash in hex, kept in `folder`. For any thread.

    A disk that refuses is logged and costs one more reading at the next start.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._schemas: dict[str, bytes] = {}
        try:
            folder.mkdir(parents=True, exist_ok=True)
            files = [file for file in folder.glob(f"*{SUFFIX}") if NAME.fullmatch(file.stem)]
            files.sort(key=lambda file: file.stat().st_mtime_ns)
            for file in files[-SCHEMAS_MAX:]:
                self._schemas[file.stem] = file.read_bytes()
        except OSError as error:
            LOG.warning("%s: kept descriptions cannot be read: %s", folder, error)

    def __getitem__(self, name: str) -> bytes:
        with self._lock:
            return self._schemas[name]

    def __setitem__(self, name: str, compressed: bytes) -> None:
        if not NAME.fullmatch(name):
            raise ValueError(f"{name} is no hash of a schema")
        with self._lock:
            self._schemas[name] = compressed
            surplus = list(self._schemas)[:-SCHEMAS_MAX]
            self._write(name, compressed)
        for old in surplus:
            del self[old]

    def __delitem__(self, name: str) -> None:
        with self._lock:
            del self._schemas[name]
            try:
                self._file(name).unlink(missing_ok=True)
            except OSError as error:
                LOG.warning("%s: a description cannot be removed: %s", self._folder, error)

    def __iter__(self) -> Iterator[str]:
        with self._lock:
            return iter(tuple(self._schemas))

    def __len__(self) -> int:
        with self._lock:
            return len(self._schemas)

    def _file(self, name: str) -> Path:
        return self._folder / f"{name}{SUFFIX}"

    def _write(self, name: str, compressed: bytes) -> None:
        """Write a file whole or not at all."""
        fresh = self._folder / f"{name}.{os.getpid()}.new"
        try:
            with fresh.open("wb") as file:
                file.write(compressed)
                file.flush()
                os.fsync(file.fileno())
            fresh.replace(self._file(name))
        except OSError as error:
            LOG.warning("%s: a description could not be kept: %s", self._folder, error)
