"""Goal: a store that refuses rows is waited for, told once, and every row is accounted for.

Method: a database that SQLite itself keeps from growing (max_page_count), so that "full" is the
engine's own word. Rows in are counted here and compared with what the recorder says of them.
"""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest
from sqlalchemy import Connection, event

from backend.errors import StoreFull
from backend.main import open_services
from backend.rides.recording.recorder import Recorder
from backend.rides.recording.unit_recorder import RecordSettings
from backend.settings import load
from backend.store import Store, open_store
from backend.store.health import CALM_S, WriteWatch
from backend.store.objects import FileObjects
from tests.fakes.server import eventually
from tests.unit.rides.test_recording import (
    PERIOD_US,
    WALL_US,
    Rows16,
    blocks,
    feed,
    riding,
    rows_of,
    standing,
)

SETTINGS = RecordSettings(idle_s=5.0, lead_in_s=1.0, lost_s=10.0, tails_waiting_max=20)
UNLIMITED_PAGES = 2**30


class FullDisk:
    """Keeps the database of a store from growing, until there is room again."""

    def __init__(self, store: Store) -> None:
        self._pages = UNLIMITED_PAGES
        event.listen(store.database.engine, "begin", self._limit)

    def fill(self) -> None:
        self._pages = 1

    def free(self) -> None:
        self._pages = UNLIMITED_PAGES

    def _limit(self, connection: Connection) -> None:
        # A number below the present size means the present size.
        connection.exec_driver_sql(f"PRAGMA max_page_count={self._pages}")


@pytest.fixture
def disk(store: Store) -> FullDisk:
    return FullDisk(store)


@pytest.fixture
def recorder(store: Store) -> Recorder:
    return Recorder(store.rides, settings=SETTINGS)


def told(recorder: Recorder, store: Store) -> tuple[int, int, int]:
    """Rows saved, lost and waiting, once what is on the way has arrived."""
    store.database.wait_written()
    recorder.status("u1")
    counts = recorder.counts("u1")
    return counts.rows_saved, counts.rows_lost, counts.rows_waiting


def test_every_row_is_saved_lost_or_waiting_at_every_moment(
    store: Store, recorder: Recorder, disk: FullDisk
) -> None:
    rows, taken = riding(60), 0

    for number, block in enumerate(blocks(rows, block_rows=100)):
        if number == 10:
            disk.fill()
        if number == 50:
            disk.free()
        feed(recorder, block)
        taken += len(block.values)
        assert sum(told(recorder, store)) == taken

    saved, lost, _ = told(recorder, store)
    # 40 s were refused and 20 of them wait at most; the ride says which are missing.
    assert lost > 0
    recorder.close()
    (ride,) = store.rides.list().items
    back = rows_of(store, ride)
    empty = (back == np.iinfo(np.int16).min).all(axis=1)
    assert int(empty.sum()) == recorder.counts("u1").rows_lost == lost
    assert np.array_equal(back[~empty], rows[~empty])
    assert recorder.counts("u1").rows_saved == taken - lost >= saved


def test_a_full_disk_that_is_freed_in_time_costs_no_row(
    store: Store, recorder: Recorder, disk: FullDisk
) -> None:
    rows = riding(40)
    sent = blocks(rows, block_rows=100)

    feed(recorder, *sent[:10])
    disk.fill()
    feed(recorder, *sent[10:25])
    disk.free()
    feed(recorder, *sent[25:])

    recorder.close()
    (ride,) = store.rides.list().items
    assert np.array_equal(rows_of(store, ride), rows)
    assert told(recorder, store) == (len(rows), 0, 0)


@pytest.mark.slow
def test_a_ride_that_ends_on_a_full_disk_is_saved_when_there_is_room(
    store: Store, recorder: Recorder, disk: FullDisk
) -> None:
    rows: Rows16 = np.concatenate((riding(12), standing(5)))

    feed(recorder, *blocks(rows[:300]))
    disk.fill()
    feed(recorder, *blocks(rows[300:], t0_us=300 * PERIOD_US))
    assert recorder.status("u1") is None
    disk.free()
    for second in range(3):
        recorder.tick(WALL_US + 20_000_000 + second * 1_000_000)
        store.database.wait_written()

    recorder.close()
    (ride,) = store.rides.list().items
    assert ride.state == "done"
    assert np.array_equal(rows_of(store, ride), rows)


def test_a_ride_that_could_not_be_finished_is_finished_without_a_restart(
    store: Store, recorder: Recorder, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise StoreFull("no space left")

    monkeypatch.setattr(store.objects, "publish", refuse)
    feed(recorder, *blocks(np.concatenate((riding(5), standing(6)))))
    store.rides.finish_later(1).exception()
    assert [ride.state for ride in store.rides.list().items] == ["live"]
    monkeypatch.undo()

    recorder.tick(WALL_US + 60_000_000)
    recorder.close()
    store.rides.close()

    assert [ride.state for ride in store.rides.list().items] == ["done"]


@pytest.mark.slow
def test_a_ride_that_a_start_could_not_finish_is_finished_without_another_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = load({"data": str(tmp_path), "device": "none"}, {})
    with open_store(settings.db, settings.objects) as died:
        feed(Recorder(died.rides, settings=SETTINGS), *blocks(riding(5)))

    def refuse(*_: object) -> None:
        raise StoreFull("no space left")

    monkeypatch.setattr(FileObjects, "publish", refuse)
    with open_services(settings) as services:
        assert services.rides.get(1)["state"] == "live"
        monkeypatch.undo()

        ride = eventually(lambda: services.rides.get(1), lambda ride: ride["state"] == "done")

    assert ride["cut_short"] is True
    # A server that dies loses less than a second.
    assert 400 < ride["row_count"] <= 500


def test_a_spell_of_trouble_is_logged_once_when_it_begins_and_once_when_it_ends(
    caplog: pytest.LogCaptureFixture,
) -> None:
    now_s = 100.0
    watch = WriteWatch(lambda: now_s)

    with caplog.at_level(logging.WARNING):
        for _ in range(300):
            now_s += 1.0
            watch.refused("database", OSError(28, "No space left on device"), "Not saved")
            watch.worked("database")  # a small write that still found room
        assert [trouble.code for trouble in watch.troubles] == ["disk_full"]
        now_s += CALM_S
        watch.worked("database")

    assert watch.troubles == ()
    assert len(caplog.messages) == 2
    assert "no space" in caplog.messages[0]
    assert "again" in caplog.messages[1]


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (28, "disk_full"),
        (122, "disk_full"),
        (27, "disk_full"),
        (30, "store_read_only"),
        (5, "io_error"),
    ],
)
def test_the_reason_is_the_system_s_own(number: int, code: str) -> None:
    watch = WriteWatch()

    error = watch.refused("objects", OSError(number, "refused"), "Not saved")

    assert error.code == code
    assert [(trouble.part, trouble.code) for trouble in watch.troubles] == [("objects", code)]


def test_the_database_s_own_word_for_full_is_the_reason(store: Store, disk: FullDisk) -> None:
    disk.fill()

    with pytest.raises(StoreFull):
        store.uploads.create("x" * 100_000, 1, None, 60)

    assert [trouble.code for trouble in store.watch.troubles] == ["disk_full"]
