"""Goal: while the database gives the disk some back, what is written beside it is saved.

Method: a reader that stays in the middle of its query, as a long export does, and a write while
the log of changes is to be emptied. With a wait for that reader, the write is refused.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sqlalchemy import text

from backend.store import open_store


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
