"""Goal: no start of the server deletes or mixes up what another database or a person put there.

Method: a store with a ride and an original; then its database is moved away, emptied, overwritten,
exchanged, or the folder is another one; what the folder held is compared byte for byte.
"""

from __future__ import annotations

import logging
import os
import shutil
import sqlite3
from collections.abc import Callable
from pathlib import Path

import pytest

import backend.store
from backend.core.ride import RideContext
from backend.errors import StoreError
from backend.store import Store, open_store
from backend.store.objects import IDENTITY, Disk
from tests.unit.store.ride_data import CHANNELS, PERIOD_US, STARTED_US, honest_ride

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

MIGRATIONS = Path(backend.store.__file__).parent / "sql" / "migrations"
OpenStore = Callable[..., Store]
Files = dict[str, bytes]


def opened(folder: Path, database: str = "spindle.db", disk: Disk | None = None) -> Store:
    return open_store(f"sqlite:///{folder}/{database}", (folder / "objects").as_uri(), disk=disk)


def add_ride(store: Store, rows: int = 300, seed: int = 1) -> int:
    started_us = STARTED_US + seed * 3_600_000_000
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, started_us, RideContext())
    store.rides.append_tail(ride_id, 0, honest_ride(rows, seed)).result()
    store.rides.finish(ride_id)
    return ride_id


def add_original(store: Store, data: bytes = b"a log as it came") -> None:
    upload = store.uploads.create("log.fit", len(data), None, 3600)
    store.uploads.append(upload.id, 0, data)
    store.uploads.store_original(upload.id)


def files(folder: Path) -> Files:
    """What is in a folder, but for our own locks and empty places."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.endswith(".lock")
    }


@pytest.fixture
def used(tmp_path: Path) -> Path:
    """A folder with a closed store that holds a ride and an original."""
    with opened(tmp_path) as store:
        add_ride(store)
        add_original(store)
    return tmp_path


def refused(folder: Path, database: str = "spindle.db") -> str:
    """The refusal of a start that must change nothing; what it says."""
    before = files(folder)
    with pytest.raises(StoreError) as refusal:
        opened(folder, database)
    assert files(folder) == before
    return refusal.value.message


def names_both_commands(message: str) -> bool:
    return "spindle store check" in message and "spindle store rebuild" in message


def test_a_database_moved_away_is_not_made_anew_over_its_rides(used: Path) -> None:
    (used / "spindle.db").rename(used / "elsewhere.db")

    assert names_both_commands(refused(used))
    assert not (used / "spindle.db").exists()


@pytest.mark.parametrize("rest", [b"", os.urandom(4096), b"SQLite format 3\0" + os.urandom(9000)])
def test_a_destroyed_database_is_refused_and_stays_as_it_is(used: Path, rest: bytes) -> None:
    (used / "spindle.db").write_bytes(rest)

    assert names_both_commands(refused(used))


@pytest.mark.parametrize("rest", [None, b""])
def test_what_a_killed_server_wrote_last_is_kept_when_its_database_is_gone(
    tmp_path: Path, rest: bytes | None
) -> None:
    crashed, whole = tmp_path / "crashed", tmp_path / "whole"
    with opened(whole) as store:
        ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext())
        store.rides.append_tail(ride_id, 0, honest_ride(300)).result()
        # What a kill leaves: all of the ride is in SQLite's journal.
        shutil.copytree(whole, crashed)
    shutil.rmtree(crashed / "objects")
    (crashed / "spindle.db").rename(tmp_path / "elsewhere.db")
    if rest is not None:
        (crashed / "spindle.db").write_bytes(rest)

    assert "spindle.db-wal" in refused(crashed)

    shutil.move(tmp_path / "elsewhere.db", crashed / "spindle.db")
    with opened(crashed) as again:
        assert again.rides.get(ride_id).row_count == 300


def test_another_database_is_refused_by_the_folder_that_has_one(used: Path) -> None:
    (used / "other").mkdir()
    with opened(used / "other") as other:
        add_ride(other, seed=2)

    message = refused(used, "other/spindle.db")

    assert names_both_commands(message)
    assert "store" in message


def test_a_new_name_for_the_database_is_refused(used: Path) -> None:
    assert names_both_commands(refused(used, "typing-mistake.db"))
    assert not (used / "typing-mistake.db").exists()


def test_a_database_whose_folder_is_not_there_is_refused(used: Path) -> None:
    shutil.move(used / "objects", used / "unmounted")

    assert names_both_commands(refused(used))


def test_another_program_s_database_is_left_alone(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "places.sqlite") as theirs:
        theirs.execute("CREATE TABLE bookmark (url TEXT)")
    theirs.close()

    assert "bookmark" in refused(tmp_path, "places.sqlite")


def test_a_person_s_own_folder_of_rides_is_refused_untouched(tmp_path: Path) -> None:
    mine = tmp_path / "objects"
    (mine / "rides" / "2025").mkdir(parents=True)
    (mine / "rides" / "2025" / "alps.gpx").write_bytes(b"<gpx/>")

    assert names_both_commands(refused(tmp_path))
    assert files(mine) == {"rides/2025/alps.gpx": b"<gpx/>"}
    assert sorted(path.name for path in mine.iterdir()) == ["rides"]


def test_a_person_s_other_files_stay_where_they_are(tmp_path: Path) -> None:
    mine = tmp_path / "objects"
    theirs = {
        "letter.txt": b"dear",
        "photos/a.jpg": b"jpg",
        ".staging/note": b"n",
        ".spool/x": b"y",
    }
    for name, data in theirs.items():
        (mine / name).parent.mkdir(parents=True, exist_ok=True)
        (mine / name).write_bytes(data)

    for _ in range(2):
        with opened(tmp_path) as store:
            add_ride(store)

    assert theirs.items() <= files(mine).items()


def test_what_the_database_of_the_folder_does_not_know_goes_to_lost_and_found(
    used: Path, caplog: pytest.LogCaptureFixture
) -> None:
    old = (used / "spindle.db").read_bytes()
    with opened(used) as store:
        add_ride(store, seed=3)
        add_original(store, b"newer")
    before = files(used / "objects")
    (used / "spindle.db").write_bytes(old)

    with caplog.at_level(logging.WARNING), opened(used):
        pass

    after = files(used / "objects")
    moved = {name for name in before if name not in after}
    assert len(moved) == 2
    assert all(after[f"lost+found/{name}"] == before[name] for name in moved)
    assert all(any(name in line for line in caplog.messages) for name in moved)


def test_lost_and_found_overwrites_nothing_and_the_log_is_bounded(
    used: Path, caplog: pytest.LogCaptureFixture
) -> None:
    folder = used / "objects" / "originals" / "00"
    for turn in (b"first", b"second"):
        folder.mkdir(exist_ok=True)
        for number in range(200):
            (folder / f"{number:064d}").write_bytes(turn)
        caplog.clear()
        with caplog.at_level(logging.WARNING), opened(used):
            pass

    kept = sorted((used / "objects" / "lost+found" / "originals" / "00").iterdir())
    assert [path.read_bytes() for path in kept].count(b"first") == 200
    assert [path.read_bytes() for path in kept].count(b"second") == 200
    assert len(caplog.messages) == 11
    assert "200 files" in caplog.messages[-1]


def test_bytes_of_an_upload_nobody_knows_are_put_aside_too(used: Path) -> None:
    token = "0123456789abcdef" * 2
    (used / "objects" / ".spool" / token).write_bytes(b"half a ride")

    opened(used).close()

    assert (used / "objects" / "lost+found" / "uploads" / token).read_bytes() == b"half a ride"


def test_a_deletion_that_a_crash_cut_in_two_is_completed_and_not_put_aside(
    used: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Torn(Disk):
        def remove(self, path: Path) -> None:
            raise OSError("The power is gone.")

    store = opened(used)
    (ride,) = store.rides.list().items
    store.objects.disk = Torn()
    store.rides.delete(ride.id)
    store.close()
    assert [name for name in files(used / "objects") if name.endswith(".parquet")]

    opened(used).close()

    assert not [name for name in files(used / "objects") if name.endswith(".parquet")]


def without_identity(folder: Path) -> None:
    """Neither the folder nor the database says which store it is."""
    (folder / "objects" / IDENTITY).unlink()
    with sqlite3.connect(folder / "spindle.db") as database:
        database.execute("DELETE FROM store_identity")
    database.close()


def test_a_store_without_identity_is_adopted_when_its_database_knows_every_object(
    used: Path,
) -> None:
    without_identity(used)

    with opened(used) as store:
        assert len(store.rides.list().items) == 1
        identity = store.objects.identity()

    assert identity is not None
    with opened(used) as store:
        assert store.objects.identity() == identity


def test_a_store_without_identity_with_an_unknown_object_is_refused(used: Path) -> None:
    without_identity(used)
    stranger = used / "objects" / "originals" / "ff" / ("f" * 64)
    stranger.parent.mkdir(parents=True)
    stranger.write_bytes(b"who am I")

    message = refused(used)
    assert names_both_commands(message)
    assert "move them elsewhere" in message
    stranger.rename(used / "elsewhere")
    opened(used).close()


def test_a_folder_that_lost_its_identity_is_taken_again_by_its_database(used: Path) -> None:
    with opened(used) as store:
        identity = store.objects.identity()
    (used / "objects" / IDENTITY).unlink()

    with opened(used) as store:
        assert store.objects.identity() == identity


def test_two_databases_cannot_take_turns_with_one_folder(tmp_path: Path) -> None:
    opened(tmp_path, "one.db").close()
    with opened(tmp_path, "two.db") as second:
        add_ride(second)

    assert names_both_commands(refused(tmp_path, "one.db"))
    with opened(tmp_path, "two.db") as second:
        assert len(second.rides.list().items) == 1
