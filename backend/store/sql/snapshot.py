"""A copy of an SQLite database at one moment, made while others write to it, and checked."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

from backend.errors import StoreError


def snapshot(source: Path, target: Path) -> None:
    """Copy the database file `source` to `target`, a new file that is whole by itself.

    Raises StoreError when it cannot be written, or when the copy is not sound.
    """
    try:
        with closing(sqlite3.connect(source)) as old, closing(sqlite3.connect(target)) as new:
            old.backup(new)
            # One file: nothing is left beside it that would have to go with it.
            new.execute("PRAGMA journal_mode=DELETE")
            verdict = new.execute("PRAGMA integrity_check").fetchone()[0]
    except sqlite3.Error as error:
        raise StoreError(f"The database could not be copied for a backup: {error}.") from error
    if verdict != "ok":
        raise StoreError(f"The database is damaged, so there is no backup of it: {verdict}")
