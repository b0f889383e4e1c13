"""One server at a time: a lock that belongs to the thing it guards and dies with its process.

The operating system holds it, so a killed server leaves nothing behind that has to be cleaned up.
A folder of objects is locked by a file in it, an SQLite database by a file beside it. PostgreSQL
holds its own (`advisory.py`).
"""

from __future__ import annotations

import os
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any, BinaryIO

from backend.errors import StoreError
from backend.store.objects import FileObjects
from backend.store.sql import advisory
from backend.store.sql.advisory import AdvisoryLock
from backend.store.sql.database import is_postgresql, sqlite_path

FOLDER_LOCK = ".lock"
SUFFIX = ".lock"
# Windows locks bytes, and nobody else may read those: one that is never written.
LOCKED_BYTE = 1 << 30


class FileLock:
    """Holds a file locked until `release` or the end of the process.

    what: the thing that is guarded, as shown in the refusal.
    """

    def __init__(self, path: Path, what: str) -> None:
        try:
            self._file = path.open("a+b", buffering=0)
        except OSError as error:
            raise StoreError(f"{what} cannot be locked: {error}") from error
        try:
            lock(self._file)
        except OSError:
            owner = written_owner(path)
            self._file.close()
            raise StoreError(
                f"Another Spindle is using {what}{owner}: stop it, or start this one with "
                "--data DIR. Nothing was changed."
            ) from None
        # Only for the refusal of another one: a full disk may keep it from being written.
        with suppress(OSError):
            self._file.truncate(0)
            self._file.write(str(os.getpid()).encode())

    def release(self) -> None:
        """Let another one in. The system does it too when the process dies."""
        self._file.close()


def lock(file: BinaryIO) -> None:
    """Lock an open file for this process alone. Raises OSError when another one has it."""
    if os.name == "nt":
        lock_windows(file)
    else:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def lock_windows(file: BinaryIO) -> None:
    """Windows has no lock of a file as a whole: one byte far behind its end stands for it."""
    import msvcrt

    # Only Windows' own build of Python declares these.
    windows: Any = msvcrt
    file.seek(LOCKED_BYTE)
    windows.locking(file.fileno(), windows.LK_NBLCK, 1)
    file.seek(0)


def written_owner(path: Path) -> str:
    """` (process 123)`, as the owner of a lock wrote it into the file."""
    try:
        text = path.read_text(encoding="ascii").strip()
    except (OSError, UnicodeDecodeError):
        return ""
    return f" (process {text})" if text.isdigit() else ""


def lock_folder(objects: FileObjects) -> FileLock:
    """Lock a folder of objects. Raises StoreError when another server has it."""
    return FileLock(objects.root / FOLDER_LOCK, str(objects.root))


def lock_database_file(path: Path) -> FileLock:
    """Lock an SQLite database by the file beside it; path: with links followed.

    Raises StoreError when another server has it, or when the file has a second name: SQLite keeps
    its journal by name, so two names of one file lose what is written (sqlite.org/howtocorrupt).
    """
    if path.exists() and path.stat().st_nlink > 1:
        raise StoreError(
            f"The database {path} has a second name (a hard link): SQLite would damage it. Copy it "
            "instead of linking it, and remove one of the names. Nothing was changed."
        )
    path.parent.mkdir(parents=True, exist_ok=True)
    return FileLock(path.with_name(path.name + SUFFIX), str(path))


def hold(closing: ExitStack, db_url: str, objects: FileObjects) -> None:
    """Lock the database, then the folder, until the stack is closed. Raises StoreError."""
    path = sqlite_path(db_url)
    if path is not None:
        closing.callback(lock_database_file(path).release)
    elif is_postgresql(db_url):
        closing.callback(AdvisoryLock(db_url, advisory.CHECK_EVERY_S).release)
    try:
        objects.prepare()
    except OSError as error:
        raise StoreError(f"The folder {objects.root} cannot be used: {error}.") from error
    closing.callback(lock_folder(objects).release)
