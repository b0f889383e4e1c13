"""Goal: a damaged row is one damaged row, and what looks at a damaged database reads any.

Method: a store of some rides, closed; then its SQLite file is changed behind its back, row by row
in every way a flipped bit can show, and bit by bit at places drawn by lot. SQLite itself has no
checksum (sqlite.org/howtocorrupt.html): what is no text, no JSON or of another type comes back as
it lies there.
"""

from __future__ import annotations

import random
import shutil
import sqlite3
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.cli import main
from backend.errors import Conflict, ObjectDamaged, StoreError
from backend.rebuild import rebuild_store
from backend.store import Store, open_store
from backend.store.upkeep.check import check_store
from tests.unit.conftest import urls
from tests.unit.store.test_a_database_is_rebuilt import add_imported, add_recorded

pytestmark = pytest.mark.slow

RIDES = 4
HURT = 2
# A column of the second ride, and what stands there after the damage, as SQL.
DAMAGE = {
    "no JSON": ("context", "replace(context, '\"', '#')"),
    "a member of another name": ("context", "replace(context, 'device_model', 'devibe_model')"),
    "an event of no kind": ("events", "replace(events, 'assist_mode', 'asskst_mode')"),
    "no text": ("name", "CAST(x'41ff42' AS TEXT)"),
    "bytes for text": ("notes", "x'4142'"),
    "text for a number": ("row_count", "'4x0'"),
    "a time after all calendars": ("started_us", "started_us + (1 << 62)"),
    "a state that is none": ("state", "'dond'"),
    "an origin that is none": ("origin", "'recosded'"),
    "another key": ("object_key", "replace(object_key, 'rides/', 'rhdes/')"),
    "another key, and no JSON": ("object_key = 'x', gaps", "'[{'"),
}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A closed store of four rides with words and tags."""
    folder = tmp_path_factory.mktemp("sound")
    with open_store(*urls(folder)) as store:
        for number in range(RIDES):
            ride = (add_imported if number % 2 else add_recorded)(store, number)
            store.rides.patch(ride.id, name=f"Hausrunde {number} \u7ebf", tags=["Wald"])
    return folder


@pytest.fixture
def folder(sound: Path, tmp_path: Path) -> Path:
    """A copy of it to be damaged."""
    return Path(shutil.copytree(sound, tmp_path / "store"))


def hurt(folder: Path, column: str, value: str) -> None:
    with sqlite3.connect(folder / "spindle.db") as connection:
        connection.execute(f"UPDATE ride SET {column} = {value} WHERE id = {HURT}")


def told(store: Store) -> dict[int, dict[str, Any]]:
    return {ride.id: ride.as_json() for ride in store.rides.list().items}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_row_is_one_damaged_row_and_is_mended_from_the_rides_file(
    folder: Path, damage: str
) -> None:
    with open_store(*urls(folder)) as store:
        before = told(store)
    hurt(folder, *DAMAGE[damage])
    with open_store(*urls(folder)) as store:
        found = told(store)
        others = {ride_id: body for ride_id, body in found.items() if ride_id != HURT}
        assert others == {key: body for key, body in before.items() if key != HURT}
        assert found[HURT]["state"] == "bad"
        with pytest.raises(ObjectDamaged, match="row of ride 2"):
            store.rides.reader(HURT)
        store.scrub(1)
        assert told(store) == before
        store.rides.reader(HURT)
        assert store.entries.damaged == frozenset()
    assert list((folder / "objects").glob("lost+found/*")) == []


@pytest.mark.parametrize("meet", ["the list", "the ride"])
def test_a_row_damaged_after_the_days_round_is_mended_once_somebody_met_it(
    folder: Path, meet: str
) -> None:
    with open_store(*urls(folder)) as store:
        before = told(store)
        store.scrub(1)
        hurt(folder, "channels", "'no'")
        store.scrub(2)
        met = store.rides.list().items if meet == "the list" else [store.rides.get(HURT)]
        assert [ride.id for ride in met if ride.state == "bad"] == [HURT]
        store.scrub(3)
        assert told(store) == before


def test_a_ride_whose_state_is_damaged_is_not_deleted_while_it_is_recorded(folder: Path) -> None:
    with open_store(*urls(folder)) as store:
        ride = store.rides.get(1)
        ride_id = store.rides.start_live(ride.channels, 10_000, ride.started_us, ride.context)
        with sqlite3.connect(folder / "spindle.db") as connection:
            connection.execute("UPDATE ride SET state = 'lave' WHERE state = 'live'")
        with pytest.raises(Conflict, match="is being recorded"):
            store.rides.delete(ride_id)


def test_a_row_whose_file_is_gone_too_stays_and_is_named(folder: Path) -> None:
    hurt(folder, "channels", "'no'")
    with open_store(*urls(folder)) as store:
        for path in (folder / "objects" / "rides").rglob("*.parquet"):
            path.unlink()
        store.scrub(1)
        assert store.entries.damaged == {HURT}
        assert len(told(store)) == RIDES
        store.rides.delete(HURT)
        store.scrub(2)
        assert store.entries.damaged == frozenset()


def test_a_live_ride_of_a_damaged_row_keeps_its_rows(folder: Path) -> None:
    """Nothing is finished, and nothing of its tail is deleted, while nobody knows its channels."""
    with open_store(*urls(folder)) as store:
        ride = store.rides.get(1)
        ride_id = store.rides.start_live(ride.channels, 10_000, ride.started_us, ride.context)
        rows = np.ones((50, len(ride.channels)), np.int16)
        store.rides.append_tail(ride_id, 0, rows).result()
    with sqlite3.connect(folder / "spindle.db") as connection:
        (channels,) = connection.execute(
            "SELECT channels FROM ride WHERE state = 'live'"
        ).fetchone()
        connection.execute("UPDATE ride SET channels = '[' WHERE state = 'live'")
    with open_store(*urls(folder)) as store:
        assert store.unfinished == [ride_id]
        assert store.rides.get(ride_id).state == "bad"
    with sqlite3.connect(folder / "spindle.db") as connection:
        connection.execute("UPDATE ride SET channels = ? WHERE state = 'live'", (channels,))
    with open_store(*urls(folder)) as store:
        assert store.rides.get(ride_id).row_count == 50
        assert store.rides.get(ride_id).state == "done"


def test_the_check_names_damaged_rows_and_the_rebuild_mends_them(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with open_store(*urls(folder)) as store:
        before = told(store)
    hurt(folder, "context", "'{'")
    check = check_store(*urls(folder))
    assert check.rides_damaged == (HURT,)
    assert not check.is_fine
    assert main(["store", "check", "--data", str(folder)]) == 1
    assert f"Ride {HURT}: its row in the database is damaged" in capsys.readouterr().out
    report = rebuild_store(*urls(folder))
    assert (report.rides, report.rides_before, report.rides_mended) == (0, RIDES, 1)
    assert check_store(*urls(folder)).is_fine
    with open_store(*urls(folder)) as store:
        assert told(store) == before


def test_a_page_of_the_file_that_is_destroyed_is_told_and_everything_comes_back(
    folder: Path,
) -> None:
    path = folder / "spindle.db"
    with sqlite3.connect(path) as connection:
        (page,) = connection.execute(
            "SELECT rootpage FROM sqlite_master WHERE name = 'ride_summary'"
        ).fetchone()
    data = bytearray(path.read_bytes())
    data[(page - 1) * 4096 : (page - 1) * 4096 + 16] = b"\xa5" * 16
    path.write_bytes(data)
    assert check_store(*urls(folder)).database.state == "damaged"
    with open_store(*urls(folder)) as store:
        with pytest.raises(StoreError, match="could not be read"):
            store.rides.list()
        (trouble,) = store.watch.troubles
        assert (trouble.part, trouble.code) == ("database", "database_damaged")
        assert "spindle store rebuild" in trouble.message
    report = rebuild_store(*urls(folder))
    assert report.rides == RIDES
    assert report.set_aside
    assert check_store(*urls(folder)).is_fine


@pytest.mark.parametrize(
    ("name", "other", "lacks"),
    [
        (b"accepted_doubts", b"accepteddoubts_", "its table ride has no accepted_doubts"),
        (b"passkey", b"pbsskey", "it has no table passkey"),
    ],
    ids=["a column", "a table"],
)
def test_a_schema_that_lacks_a_name_is_damaged_and_rebuilt(
    sound: Path, tmp_path: Path, name: bytes, other: bytes, lacks: str
) -> None:
    folder = tmp_path / "store"
    shutil.copytree(sound, folder)
    data = (folder / "spindle.db").read_bytes()
    assert name in data
    (folder / "spindle.db").write_bytes(data.replace(name, other))

    view = check_store(*urls(folder)).database

    assert (view.state, view.detail) == ("damaged", lacks)
    assert rebuild_store(*urls(folder)).rides == RIDES


@pytest.mark.parametrize("seed", range(12))
def test_whatever_bit_flips_nothing_ends_in_a_traceback(
    sound: Path, tmp_path: Path, seed: int
) -> None:
    """Each answer is a list of every ride, or an error of the store's own."""
    data = bytearray((sound / "spindle.db").read_bytes())
    chance = random.Random(seed)
    used = [place for place, byte in enumerate(data) if byte]
    data[chance.choice(used)] ^= 1 << chance.randrange(8)
    for name in ("served", "rebuilt"):
        shutil.copytree(sound, tmp_path / name)
        (tmp_path / name / "spindle.db").write_bytes(data)
    check_store(*urls(tmp_path / "served")).as_json()
    with suppress(StoreError):
        rebuild_store(*urls(tmp_path / "rebuilt"))
    for name in ("served", "rebuilt"):
        with suppress(StoreError), open_store(*urls(tmp_path / name)) as store:
            store.scrub(1)
            assert len(told(store)) == RIDES
