"""Goal: two servers never have one database, by whatever name they call it; a dead one's rides are
closed by the next, say that they were cut short, and a living one's are left alone.

Method: a second opening in the same process and in another; Windows' lock through a stand-in for
its module, since only Windows has it.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from backend.errors import StoreError
from backend.store import Store, locks, open_store
from backend.store.upkeep.check import check_store
from tests.unit.store.ride_data import honest_ride, recording

ROWS = 300
BEHIND = "import sys; from backend.store import open_store; store = open_store(*sys.argv[1:]); "


def opened(folder: Path, database: str = "spindle.db", objects: str = "objects") -> Store:
    return open_store(f"sqlite:///{folder}/{database}", (folder / objects).as_uri())


def test_a_second_server_with_a_folder_of_its_own_is_refused_and_ends_no_ride(
    tmp_path: Path,
) -> None:
    with opened(tmp_path) as first:
        ride_id = recording(first)

        with pytest.raises(StoreError, match=r"Another Spindle is using .*spindle.db"):
            opened(tmp_path, objects="others")

        first.rides.append_tail(ride_id, ROWS, honest_ride(ROWS)).result()
        ride = first.rides.finish(ride_id)
    assert ride is not None
    assert (ride.row_count, ride.cut_short) == (2 * ROWS, False)


def test_the_same_database_by_a_link_or_another_path_is_refused(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "link.db").symlink_to(tmp_path / "spindle.db")
    with opened(tmp_path):
        for path in (f"{tmp_path}/link.db", f"{tmp_path}/there/../spindle.db"):
            with pytest.raises(StoreError, match="Another Spindle"):
                open_store(f"sqlite:///{path}", (tmp_path / "others").as_uri())


def test_a_second_name_of_the_same_file_is_refused(tmp_path: Path) -> None:
    with opened(tmp_path):
        os.link(tmp_path / "spindle.db", tmp_path / "second.db")

        with pytest.raises(StoreError, match="hard link"):
            opened(tmp_path, "second.db", "others")


@pytest.mark.slow
def test_the_lock_dies_with_its_process(tmp_path: Path) -> None:
    urls = [f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri()]
    waits = BEHIND + "print('in', flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", waits, *urls], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == b"in\n"
        with pytest.raises(StoreError, match=rf"process {child.pid}"):
            open_store(*urls)
        child.kill()

    open_store(*urls).close()


def test_recovery_closes_a_dead_server_s_ride_alone_and_says_so(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    first = opened(tmp_path)
    dead = recording(first)
    first.close()
    with opened(tmp_path) as second:
        left = second.rides.get(dead)
        mine = recording(second)
        with caplog.at_level(logging.WARNING):
            assert second.recover() == []
        assert second.rides.get(mine).state == "live"
        found = check_store(f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())

    assert (left.state, left.cut_short, left.as_json()["cut_short"]) == ("done", True, True)
    (live,) = found.database.live
    assert live.ride_id == mine
    assert found.as_json()["database"]["live"][0]["state"] == "recording"  # type: ignore[index]


def test_a_ride_cut_short_is_in_the_log(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    first = opened(tmp_path)
    dead = recording(first)
    first.close()

    with caplog.at_level(logging.WARNING), opened(tmp_path):
        pass

    assert f"Ride {dead} was cut short after {ROWS} rows" in caplog.text


def test_a_ride_that_had_ended_is_not_called_cut_short_by_the_next_start(tmp_path: Path) -> None:
    first = opened(tmp_path)
    ended = recording(first)
    first.rides.end(ended, cut_short=False)
    first.close()

    with opened(tmp_path) as second:
        assert not second.rides.get(ended).cut_short


def test_rows_for_another_server_s_ride_are_refused(tmp_path: Path) -> None:
    with opened(tmp_path) as first:
        ride_id = recording(first)
        first.rides._server_id = "another"

        with pytest.raises(StoreError, match="not being recorded"):
            first.rides.append_tail(ride_id, ROWS, honest_ride(ROWS)).result()


def test_a_heartbeat_goes_on_while_no_rows_come(tmp_path: Path) -> None:
    with opened(tmp_path) as store:
        recording(store)
        later_us = 4_000_000_000_000_000
        store.rides.beat(later_us)
        found = check_store(f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())

    assert found.database.live[0].heartbeat_us == later_us


def test_windows_locks_a_byte_behind_the_end_and_refuses_a_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held: set[tuple[int, int]] = set()

    def locking(descriptor: int, mode: int, count: int) -> None:
        place = os.fstat(descriptor).st_ino, os.lseek(descriptor, 0, os.SEEK_CUR)
        if place in held:
            raise OSError(13, "Permission denied")
        held.add(place)
        assert (mode, count) == (2, 1)

    monkeypatch.setitem(sys.modules, "msvcrt", SimpleNamespace(locking=locking, LK_NBLCK=2))
    monkeypatch.setattr(locks, "lock", locks.lock_windows)
    first = locks.FileLock(tmp_path / "x.lock", "x")

    with pytest.raises(StoreError, match=rf"process {os.getpid()}"):
        locks.FileLock(tmp_path / "x.lock", "x")

    first.release()
    assert held == {((tmp_path / "x.lock").stat().st_ino, locks.LOCKED_BYTE)}
    assert (tmp_path / "x.lock").stat().st_size < 20
