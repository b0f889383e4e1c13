"""Goal: a backup, unpacked, is a store with everything that was kept, whatever went on meanwhile;
what is not whole is named, and what is cut short does not open.

Method: a real store with finished and live rides; the zip is unpacked into another folder, which
is checked and opened like any other.
"""

from __future__ import annotations

import io
import json
from pathlib import Path
from zipfile import BadZipFile, ZipFile

import numpy as np
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext
from backend.errors import StoreError
from backend.store import Store, backup_of, open_store, place_of
from backend.store.upkeep.check import check_store

pytestmark = pytest.mark.slow

SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
STARTED_US = 1_700_000_000_000_000


def ride(store: Store, number: int, done: bool = True) -> int:
    """A ride of ten rows with a speed of its own."""
    context = RideContext(unit_key="ebl:SP-1")
    started_us = STARTED_US + number * 60_000_000
    ride_id = store.rides.start_live((SPEED,), 100_000, started_us, context, f"ride {number}")
    store.rides.append_tail(ride_id, 0, np.full((10, 1), number, np.int16)).result()
    if done:
        store.rides.finish(ride_id)
        store.rides.patch(ride_id, notes=f"notes {number}")
    return ride_id


def unpacked(data: bytes, folder: Path) -> tuple[str, str]:
    """URLs of database and objects of a zip that is unpacked into a folder."""
    with ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        archive.extractall(folder)
    return f"sqlite:///{folder}/spindle.db", f"file://{folder}/objects"


def test_a_backup_is_a_store_with_every_ride_of_its_moment(store: Store, tmp_path: Path) -> None:
    for number in range(3):
        ride(store, number)
    recorded = ride(store, 3, done=False)
    pieces = backup_of(store, "0.4.0")
    # What comes after the first moment is not in it, and disturbs nothing.
    later = ride(store, 4)
    store.rides.finish(recorded)
    store.rides.delete(1)

    urls = unpacked(b"".join(pieces), tmp_path / "other")

    found = check_store(*urls)
    assert found.is_fine, found
    assert found.database.rides == 4
    with open_store(*urls) as other:
        names = [ride.name for ride in other.rides.list().items]
        assert names == ["ride 3", "ride 2", "ride 1", "ride 0"]
        assert other.rides.get(1).notes == "notes 0"
        assert other.rides.get(recorded).row_count == 10
        assert list(other.rides.reader(1).counts(["speed_kmh"], 0, 10)["speed_kmh"]) == [0] * 10
    assert store.rides.get(later).state == "done"
    told = json.loads((tmp_path / "other" / "backup.json").read_text())
    assert (told["missing"], told["damaged"], told["spindle"]) == ([], [], "0.4.0")
    # Nothing of the copy stays behind, and what was deleted meanwhile goes now.
    assert list((tmp_path / "objects" / ".staging").iterdir()) == []


def test_what_is_missing_or_damaged_is_named_and_the_rest_is_there(
    store: Store, tmp_path: Path
) -> None:
    keys = [store.rides.get(ride(store, number)).object_key for number in range(3)]
    gone, damaged = (tmp_path / "objects" / str(key) for key in keys[:2])
    gone.unlink()
    damaged.write_bytes(damaged.read_bytes()[:-1] + b"x")

    unpacked(b"".join(backup_of(store, "0.4.0")), tmp_path / "other")

    told = json.loads((tmp_path / "other" / "backup.json").read_text())
    assert (told["missing"], told["damaged"]) == ([keys[0]], [keys[1]])
    assert (tmp_path / "other" / "objects" / str(keys[2])).is_file()


def test_a_backup_that_is_cut_short_does_not_open(store: Store) -> None:
    ride(store, 0)
    data = b"".join(backup_of(store, "0.4.0"))

    with pytest.raises(BadZipFile):
        ZipFile(io.BytesIO(data[: len(data) * 9 // 10]))


def test_a_reader_that_leaves_leaves_nothing_behind(store: Store, tmp_path: Path) -> None:
    ride_id = ride(store, 0)
    key = store.rides.get(ride_id).object_key
    pieces = backup_of(store, "0.4.0")
    next(pieces)
    store.rides.delete(ride_id)
    assert (tmp_path / "objects" / str(key)).is_file()

    pieces.close()  # type: ignore[attr-defined]

    store.deletions.sweep(None)
    assert not (tmp_path / "objects" / str(key)).exists()
    assert list((tmp_path / "objects" / ".staging").iterdir()) == []


def test_a_database_that_cannot_be_copied_is_refused_before_the_first_byte(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(store.objects, "stage", lambda: tmp_path / "nowhere" / "copy")

    with pytest.raises(StoreError, match="could not be copied"):
        backup_of(store, "0.4.0")


def test_the_place_tells_what_is_there(store: Store, tmp_path: Path) -> None:
    before = place_of(store)
    ride(store, 0)

    place = place_of(store)

    assert (before.rides, place.rides) == (0, 1)
    assert place.folder == str(tmp_path / "objects")
    files = [path for path in (tmp_path / "objects" / "rides").rglob("*") if path.is_file()]
    assert place.object_bytes == sum(path.stat().st_size for path in files)
    assert (place.database_bytes or 0) > 4096
    assert place.free_bytes > 0
