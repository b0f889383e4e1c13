"""Goal: not one byte of a ride's file leaves that is not what was written, whatever the damage.

Method: a real ride of a real file; then its object is cut, emptied, removed, exchanged, or has one
bit flipped in each of its regions, and everything that is made of it is asked for. Where the
regions begin is read from the format: "PAR1", pages, footer, its length (u32), "PAR1".
"""

from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import RideRows
from backend.errors import ObjectDamaged
from backend.formats import ImportedRide, Outcome
from backend.imports.service import Uploads
from backend.main import open_services
from backend.rides.service import Rides
from backend.settings import load
from backend.store import RideReader, open_store
from tests.fakes.server import eventually

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ORIGINAL = b"the file as it came"
ROWS = 40_000
CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
    ChannelSpec("assist_mode", "", 1.0),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
)


def read(path: Path, name: str) -> Outcome:
    noise = np.random.default_rng(1)
    counts = {c.name: noise.integers(0, 3000, ROWS).astype(np.int16) for c in CHANNELS}
    times_us = np.arange(ROWS, dtype=np.int64) * 10_000
    ride = ImportedRide(1_700_000_000_000_000, 10_000, RideRows(CHANNELS, times_us, counts))
    return Outcome("complete", (ride,), completeness=1.0)


class Shop:
    """One ride, its object and its original."""

    def __init__(self, folder: Path) -> None:
        self.store = open_store(f"sqlite:///{folder}/db", f"file://{folder}/objects")

        def replay(reader: RideReader, *question: object) -> object:
            return reader.counts(["speed_kmh"], 0, reader.row_count)

        self.rides = Rides(self.store, replay)
        self.uploads = Uploads(self.store, reader=read)
        (self.ride_id,) = self.uploads.receive_file("a.fit", ORIGINAL).ride_ids
        ride = self.store.rides.get(self.ride_id)
        self.object = self.store.objects.local_path(str(ride.object_key))
        original = self.store.uploads.get(str(ride.upload_id)).object_key
        self.original = self.store.objects.local_path(str(original))

    def everything(self) -> dict[str, Callable[[], object]]:
        """All that is made of a ride's samples."""
        ride_id = self.ride_id
        return {
            "series": lambda: self.rides.series(ride_id).to_json(),
            "binary series": lambda: self.rides.series(ride_id, pixels=10_000).to_bytes(),
            "figure": lambda: self.rides.figure(ride_id),
            "csv": lambda: self.rides.export(ride_id, "csv"),
            "parquet": lambda: self.rides.export(ride_id, "parquet"),
            "replay": lambda: self.rides.replay(ride_id),
        }


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    made = Shop(tmp_path)
    yield made
    made.store.close()


def flipped(place: Callable[[bytes], int]) -> Callable[[Path], None]:
    """Damage: one bit at a place."""

    def work(path: Path) -> None:
        data = bytearray(path.read_bytes())
        data[place(bytes(data))] ^= 0x10
        path.write_bytes(data)

    return work


def footer_start(data: bytes) -> int:
    return len(data) - 8 - int(struct.unpack_from("<I", data, len(data) - 8)[0])


DAMAGES: dict[str, Callable[[Path], None]] = {
    "missing": lambda path: path.unlink(),
    "empty": lambda path: path.write_bytes(b""),
    "cut": lambda path: path.write_bytes(path.read_bytes()[:-1]),
    "longer": lambda path: path.write_bytes(path.read_bytes() + b"x"),
    "another": lambda path: path.write_bytes(bytes(path.stat().st_size)),
    "magic": flipped(lambda data: 0),
    "page header": flipped(lambda data: 6),
    "first page": flipped(lambda data: 200),
    "data": flipped(lambda data: footer_start(data) // 2),
    "metadata": flipped(lambda data: footer_start(data) + 20),
    "ride's own facts": flipped(lambda data: data.index(b"schema_version")),
    "footer's length": flipped(lambda data: len(data) - 8),
    "last byte": flipped(lambda data: len(data) - 1),
}


@pytest.mark.parametrize("warm", [False, True], ids=["unseen", "looked at before"])
@pytest.mark.parametrize("damage", DAMAGES)
def test_whatever_the_damage_nothing_of_it_leaves(shop: Shop, damage: str, warm: bool) -> None:
    if warm:
        for ask in shop.everything().values():
            ask()
    DAMAGES[damage](shop.object)

    for ask in shop.everything().values():
        with pytest.raises(ObjectDamaged) as refusal:
            ask()
        assert f"ride {shop.ride_id} " in refusal.value.message
        assert "Restore" in refusal.value.message
    assert shop.rides.get(shop.ride_id)["damage"] is not None
    listed = shop.rides.list()["items"]
    assert [ride["damage"] is not None for ride in listed] == [True]  # type: ignore[attr-defined]


@pytest.mark.parametrize("damage", ["missing", "empty", "cut", "magic"])
def test_a_damaged_original_is_not_sent_and_the_ride_is_still_shown(
    shop: Shop, damage: str
) -> None:
    DAMAGES[damage](shop.original)

    with pytest.raises(ObjectDamaged, match=f"original file of ride {shop.ride_id}"):
        shop.rides.export(shop.ride_id, "original")

    assert b"".join(shop.rides.export(shop.ride_id, "parquet").chunks)
    assert shop.rides.get(shop.ride_id)["damage"] is None


def test_sending_the_original_again_repairs_it(shop: Shop) -> None:
    DAMAGES["magic"](shop.original)

    shop.uploads.receive_file("again.fit", ORIGINAL)

    assert b"".join(shop.rides.export(shop.ride_id, "original").chunks) == ORIGINAL


def test_a_file_that_comes_back_from_a_backup_is_shown_again(shop: Shop) -> None:
    backup = shop.object.read_bytes()
    DAMAGES["data"](shop.object)
    with pytest.raises(ObjectDamaged):
        shop.rides.figure(shop.ride_id)

    shop.object.write_bytes(backup)

    assert shop.rides.figure(shop.ride_id)["data"]
    assert shop.rides.get(shop.ride_id)["damage"] is None
    assert b"".join(shop.rides.export(shop.ride_id, "parquet").chunks)


def rotten(path: Path) -> None:
    """A disk that rots changes bytes and not the file's time of change."""
    before = path.stat()
    with path.open("r+b") as file:
        file.seek(footer_start(path.read_bytes()) // 2)
        file.write(b"\xff\x00\xff\x00")
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def test_a_rotting_disk_is_caught_by_pages_exports_and_the_daily_look(shop: Shop) -> None:
    shop.rides.figure(shop.ride_id)
    rotten(shop.object)

    with pytest.raises(ObjectDamaged):
        shop.rides.replay(shop.ride_id)
    shop.store.scrub(1_700_000_000_000_000)

    assert shop.rides.get(shop.ride_id)["damage"] == "changed"
    for file_format in ("parquet", "csv"):
        with pytest.raises(ObjectDamaged):
            shop.rides.export(shop.ride_id, file_format)


def test_a_window_of_a_ride_does_not_hash_it_anew(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    shop.rides.series(shop.ride_id)
    hashed: list[object] = []
    monkeypatch.setattr(shop.store.soundness, "opened", lambda *a: hashed.append(a))

    shop.rides.series(shop.ride_id, from_s=10.0, to_s=20.0)

    assert hashed == []


def test_a_damaged_overview_is_made_good_by_the_rows(shop: Shop) -> None:
    whole = shop.rides.series(shop.ride_id, pixels=100)
    shop.store.database.write(
        lambda c: c.exec_driver_sql("UPDATE ride_lod SET payload = substr(payload, 1, 40)")
    )
    shop.store.rides.patch(shop.ride_id, notes="the reader is opened anew")

    again = shop.rides.series(shop.ride_id, pixels=100)

    assert again.minimum["speed_kmh"].min() == whole.minimum["speed_kmh"].min()
    assert again.maximum["speed_kmh"].max() == whole.maximum["speed_kmh"].max()


def test_a_damaged_recording_is_not_filled(shop: Shop) -> None:
    ride = shop.store.rides.get(shop.ride_id)
    DAMAGES["page header"](shop.object)

    from backend.store.filling import Filling

    nothing = Filling(0, 0, np.empty(0, np.int64), {}, (), ())
    with pytest.raises(ObjectDamaged):
        shop.store.rides.fill(ride, nothing)


def test_damage_that_nobody_asked_for_is_known_until_the_ride_is_restored_or_deleted(
    shop: Shop,
) -> None:
    whole, day_us = shop.object.read_bytes(), 86_400_000_000
    shop.object.unlink()
    shop.store.scrub(0)
    assert [Path(key).name for key in shop.store.soundness.damaged] == [shop.object.name]

    shop.object.write_bytes(whole)
    shop.store.scrub(1)
    assert shop.store.soundness.damaged == {}

    shop.object.write_bytes(whole[:-1] + b"?")
    shop.store.scrub(day_us)
    assert list(shop.store.soundness.damaged.values()) == ["changed"]

    shop.store.rides.delete(shop.ride_id)
    shop.store.scrub(day_us + 1)
    assert shop.store.soundness.damaged == {}


def test_the_server_s_health_names_a_damaged_ride_without_being_asked_for_it(
    tmp_path: Path,
) -> None:
    settings = load({"data": str(tmp_path), "device": "none"}, {})
    with open_store(settings.db, settings.objects) as store:
        Uploads(store, reader=read).receive_file("a.fit", ORIGINAL)
    (item,) = (tmp_path / "objects").rglob("*.parquet")
    item.write_bytes(b"")

    with open_services(settings) as services:
        health = eventually(services.health.current, lambda health: health.reasons)

    assert [(reason.code, reason.part) for reason in health.reasons] == [
        ("rides_damaged", "objects")
    ]
    assert item.name in health.reasons[0].message


def test_the_server_s_health_names_a_ride_whose_row_cannot_be_mended(tmp_path: Path) -> None:
    """Its file is gone as well; the list is answered all the same."""
    settings = load({"data": str(tmp_path), "device": "none"}, {})
    with open_store(settings.db, settings.objects) as store:
        (ride_id,) = Uploads(store, reader=read).receive_file("a.fit", ORIGINAL).ride_ids
        body = {"context": "{"}
        store.database.write(
            lambda c: c.exec_driver_sql("UPDATE ride SET context = :context", body)
        )
    (item,) = (tmp_path / "objects").rglob("*.parquet")
    item.unlink()

    with open_services(settings) as services:
        (ride,) = services.rides.list()["items"]
        health = eventually(services.health.current, lambda health: len(health.reasons) == 2)

    assert (ride["id"], ride["state"], ride["damage"]) == (ride_id, "bad", "row")
    of_file, of_row = health.reasons
    assert item.name in of_file.message
    assert (of_row.code, of_row.part) == ("rides_damaged", "database")
    assert f"mend them from: {ride_id}. Restore files or" in of_row.message


def test_a_store_of_sound_files_says_so(shop: Shop) -> None:
    shop.store.scrub(1_700_000_000_000_000)

    assert shop.rides.get(shop.ride_id)["damage"] is None
