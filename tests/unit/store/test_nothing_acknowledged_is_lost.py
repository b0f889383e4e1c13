"""Goal: no crash and no failing disk loses a row that was acknowledged, or leaves half a ride.

Method: a child process records and is killed with SIGKILL; and, SQLite's way, the Nth step that
reaches the disk fails, for N = 1, 2, 3 ... until finishing succeeds.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from backend.core.ride import RideContext
from backend.errors import StoreError
from backend.store import Store
from backend.store.objects import Disk, FileObjects
from backend.store.sql.database import Database
from tests.fakes.failing_disk import FailingDisk
from tests.unit.store.ride_data import CHANNELS, PERIOD_US, STARTED_US, honest_ride

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[3]
ROWS = 2_000
OpenStore = Callable[..., Store]

RECORDING = """
import sys
from backend.core.ride import RideContext
from backend.store import open_store
from tests.unit.store.ride_data import CHANNELS, PERIOD_US, STARTED_US, honest_ride

store = open_store(sys.argv[1], sys.argv[2])
rows = honest_ride(100_000)
ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext())
for start in range(0, len(rows), 100):
    store.rides.append_tail(ride_id, start, rows[start : start + 100]).result()
    print(start + 100, flush=True)
"""


def test_a_killed_recording_is_a_whole_ride_at_the_next_start(
    tmp_path: Path, reopen: OpenStore
) -> None:
    urls = [f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects"]
    child = subprocess.Popen(
        [sys.executable, "-c", RECORDING, *urls], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    assert child.stdout is not None
    acknowledged = [int(next(child.stdout)) for _ in range(25)][-1]

    child.send_signal(signal.SIGKILL)
    acknowledged = max([acknowledged, *(int(line) for line in child.stdout if line.strip())])
    child.wait()
    store = reopen()

    (ride,) = store.rides.list().items
    assert ride.state == "done"
    assert ride.row_count >= acknowledged
    names = [channel.name for channel in CHANNELS]
    counts = store.rides.reader(ride.id).counts(names, 0, acknowledged)
    back = np.stack([counts[name] for name in names], axis=1)
    assert np.array_equal(back, honest_ride(100_000)[:acknowledged])


def recorded(store: Store) -> int:
    rows = honest_ride(ROWS)
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext())
    for start in range(0, ROWS, 100):
        store.rides.append_tail(ride_id, start, rows[start : start + 100]).result()
    return ride_id


def is_whole(store: Store, ride_id: int) -> bool:
    """Whether the one ride there is has all its rows, as live or done."""
    (ride,) = store.rides.list().items
    counts = store.rides.reader(ride_id).counts(["rider_torque_nm"], 0, ROWS)
    return ride.row_count == ROWS and np.array_equal(
        counts["rider_torque_nm"], honest_ride(ROWS)[:, 2]
    )


def test_whichever_step_of_the_disk_fails_the_ride_stays_whole_and_can_be_finished(
    tmp_path: Path, reopen: OpenStore
) -> None:
    failures = 0
    for failing_step in range(1, 50):
        store = reopen()
        ride_id = recorded(store)
        store.objects.disk = FailingDisk(failing_step)
        try:
            store.rides.finish(ride_id)
            finished = True
        except StoreError:
            finished = False
            failures += 1
            assert store.rides.get(ride_id).state == "live"
            assert is_whole(store, ride_id)
        store.close()

        again = reopen()
        assert again.rides.get(ride_id).state == "done"
        assert is_whole(again, ride_id)
        assert len(list(again.objects.keys())) == 1
        again.rides.delete(ride_id)
        again.close()
        if finished:
            break

    assert failures >= 3


def test_a_transaction_that_fails_leaves_the_ride_live_and_its_object_to_be_taken(
    reopen: OpenStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = reopen()
    ride_id = recorded(store)

    def refuse(*_: object) -> None:
        raise StoreError("the database is gone")

    monkeypatch.setattr(Database, "write", refuse)
    with pytest.raises(StoreError):
        store.rides.finish(ride_id)
    monkeypatch.undo()
    assert store.rides.get(ride_id).state == "live"
    store.close()

    again = reopen()
    assert again.rides.get(ride_id).state == "done"
    assert is_whole(again, ride_id)


def test_what_nobody_knows_is_put_aside_and_what_is_known_is_kept(
    reopen: OpenStore, tmp_path: Path
) -> None:
    store = reopen()
    ride_id = recorded(store)
    store.rides.finish(ride_id)
    orphan = tmp_path / "objects" / "rides" / "00" / "orphan.parquet"
    orphan.parent.mkdir(exist_ok=True)
    orphan.write_bytes(b"left by a crash")
    store.objects.stage().write_bytes(b"half written")
    store.close()

    again = reopen()

    assert not orphan.exists()
    aside = tmp_path / "objects" / "lost+found" / "rides" / "00" / "orphan.parquet"
    assert aside.read_bytes() == b"left by a crash"
    assert again.objects.clear_staging() == 0
    assert is_whole(again, ride_id)


class SomebodyElseSaves(Disk):
    """While a folder is being made, another file of the same folder is saved."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def flush_folder(self, path: Path) -> None:
        super().flush_folder(path)
        if path == self.folder.parent.parent:
            self.folder.mkdir(exist_ok=True)


def test_two_files_whose_folder_is_not_there_yet_are_both_saved(tmp_path: Path) -> None:
    objects = FileObjects(tmp_path, SomebodyElseSaves(tmp_path / "originals" / "ab"))
    objects.prepare()
    staged = objects.stage()
    staged.write_bytes(b"one of them")

    objects.publish(staged, "originals/ab/abcd")

    assert objects.local_path("originals/ab/abcd").read_bytes() == b"one of them"


def test_a_full_disk_at_the_start_does_not_keep_the_server_from_starting(
    reopen: OpenStore,
) -> None:
    store = reopen()
    ride_id = recorded(store)
    store.close()

    starting = reopen(FailingDisk(1))

    assert list(starting.unfinished) == [ride_id]
    assert is_whole(starting, ride_id)
