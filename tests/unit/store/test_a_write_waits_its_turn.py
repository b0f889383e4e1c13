"""Goal: a change waits for whoever else holds SQLite's one write lock: another program for a
second, or a reader for an instant, who takes it to look at the head of a log just being written.

While the database gives the disk some back, what is written beside it is saved.

Method: a second connection holds the lock while a change that reads first is under way; a reader
that stays in the middle of its query while the log of changes is to be emptied.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from pathlib import Path
from threading import Timer

import pytest
from sqlalchemy import Connection, text

from backend.errors import StoreError
from backend.store import open_store
from backend.store.sql import database as module
from backend.store.sql.database import Database

HELD_S = 0.3


@contextmanager
def held(path: Path) -> Iterator[sqlite3.Connection]:
    """Another connection that has the write lock."""
    with closing(sqlite3.connect(path, isolation_level=None, check_same_thread=False)) as other:
        other.execute("BEGIN IMMEDIATE")
        yield other


def read_then_write(connection: Connection) -> None:
    count = connection.execute(text("SELECT count(*) FROM upload")).scalar_one()
    connection.exec_driver_sql(f"PRAGMA user_version={count + 7}")


@pytest.mark.slow
def test_a_change_that_reads_first_waits_too(tmp_path: Path) -> None:
    database = Database(f"sqlite:///{tmp_path}/db")
    with closing(database), held(tmp_path / "db") as other:
        over = Timer(HELD_S, other.execute, ["ROLLBACK"])
        over.start()

        database.write(read_then_write)

        over.join()
        version = database.read(
            lambda connection: connection.exec_driver_sql("PRAGMA user_version").scalar_one()
        )
        assert version == 7


def test_who_waits_too_long_is_told_without_a_word_of_sql(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "BUSY_TIMEOUT_MS", 50)
    database = Database(f"sqlite:///{tmp_path}/db")
    with (
        closing(database),
        held(tmp_path / "db"),
        pytest.raises(StoreError, match=r"^The database did not save the change: database is loc"),
    ):
        database.write(read_then_write)


def test_a_long_reader_and_a_shrinking_database_refuse_no_write(tmp_path: Path) -> None:
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        store.uploads.create("before", 1, None, 60)
        with store.database.engine.connect() as reader, ThreadPoolExecutor(1) as housekeeping:
            reader.execute(text("SELECT count(*) FROM upload")).scalar()
            store.uploads.create("what the reader does not see", 1, None, 60)
            shrinking = housekeeping.submit(store.database.give_back)

            for number in range(20):
                store.uploads.create(f"meanwhile {number}", 1, None, 60)

            shrinking.result()

        assert len(store.uploads.list(50)) == 22
        assert (tmp_path / "db-wal").stat().st_size > 0
        store.database.give_back()
        assert (tmp_path / "db-wal").stat().st_size == 0
