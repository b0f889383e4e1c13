"""Goal: what a person deletes is gone from the disk, and nothing else is; no crash brings it back.

Method: the real store; files are found by their bytes, wherever they lie. A crash is a step of the
disk that fails, or a database that stops; then the store is opened anew.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext, RideRows
from backend.errors import Conflict, NotFound, StoreError
from backend.formats import ImportedRide, Outcome
from backend.formats.outcome import rejected
from backend.imports.service import Uploads, UploadSettings
from backend.rides.logbook.cards import RideCards
from backend.rides.service import Rides
from backend.store import open_store
from backend.store.deletion import Deletions
from backend.store.discard import discarded_keys
from backend.store.objects import Disk

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

DAY_US = 86_400 * 1_000_000
START_US = 1_700_000_000_000_000
ROWS = 300
OURS = (".lock", "spindle-store.json")
POSITION = ChannelSpec("latitude_deg", "deg", 180 / 2**31, wide=True)
SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)


def ridden(seed: int, unit_t0_us: int | None = None, rows: int = ROWS) -> ImportedRide:
    """A ride of noise, so that no two have the same bytes."""
    noise = np.random.default_rng(seed)
    counts = {
        "latitude_deg": noise.integers(5 * 10**8, 6 * 10**8, rows).astype(np.int32),
        "speed_kmh": noise.integers(0, 3000, rows).astype(np.int16),
    }
    times_us = np.arange(rows, dtype=np.int64) * 100_000
    context = RideContext()
    if unit_t0_us is not None:
        context = RideContext("u1", "SP-1", boot_id=7, unit_t0_us=unit_t0_us, unit_key="ebl:SP-1")
    rows_of = RideRows((POSITION, SPEED), times_us, counts)
    return ImportedRide(START_US + seed * DAY_US, 100_000, rows_of, context=context)


class Shop:
    """A store, and uploads whose contents the test decides by the file's bytes."""

    def __init__(self, folder: Path, expires_s: int = 86_400) -> None:
        self.folder = folder
        self.expires_s = expires_s
        self.contents: dict[bytes, tuple[ImportedRide, ...]] = {}
        self.open()

    def open(self, disk: Disk | None = None) -> None:
        self.store = open_store(
            f"sqlite:///{self.folder}/db", f"file://{self.folder}/objects", disk=disk
        )
        self.uploads = Uploads(self.store, UploadSettings(expires_s=self.expires_s), self.read)
        self.rides = Rides(self.store)

    def reopen(self) -> None:
        self.store.close()
        self.open()

    def read(self, path: Path, name: str) -> Outcome:
        found = self.contents.get(path.read_bytes())
        if found is None:
            return rejected("unknown_format", "This is no ride.")
        return Outcome("complete", found, completeness=1.0)

    def take(self, content: bytes, *rides: ImportedRide, name: str = "ride.fit") -> str:
        """Take a file in; the upload's id."""
        if rides:
            self.contents[content] = rides
        return self.uploads.receive_file(name, content).id

    def ride_ids(self) -> list[int]:
        return sorted(ride.id for ride in self.store.rides.list().items)

    def files(self) -> list[bytes]:
        """Contents of every file under the objects' folder, but for the lock and the identity."""
        found = (self.folder / "objects").rglob("*")
        return [path.read_bytes() for path in found if path.is_file() and path.name not in OURS]


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    made = Shop(tmp_path)
    yield made
    made.store.close()


def test_with_the_last_ride_the_original_goes_and_not_before(shop: Shop) -> None:
    upload = shop.take(b"two rides", ridden(1), ridden(2))
    first, second = shop.ride_ids()

    shop.rides.delete(first)
    assert b"two rides" in shop.files()
    assert shop.uploads.get(upload).ride_ids == (second,)

    shop.rides.delete(second)
    assert shop.files() == []
    with pytest.raises(NotFound):
        shop.uploads.get(upload)


def test_nothing_a_person_wrote_of_a_deleted_ride_is_left_in_any_file(shop: Shop) -> None:
    shop.take(b"kept", ridden(1))
    shop.take(b"gone", ridden(2))
    kept, gone = shop.ride_ids()
    words = {"name": "to the clinic", "notes": "met nobody" * 50, "tags": ["secretive"]}
    shop.store.rides.patch(gone, **words)  # type: ignore[arg-type]
    RideCards(shop.store).tick()

    def told() -> list[str]:
        everything = b"".join(
            path.read_bytes() for path in shop.folder.rglob("*") if path.is_file()
        )
        return [word for word in ("clinic", "nobody", "secretive") if word.encode() in everything]

    assert told() == ["clinic", "nobody", "secretive"]
    shop.rides.delete(gone)
    # What a second of housekeeping does: the log of changes is emptied.
    for _ in range(3):
        shop.store.sweep(START_US)

    assert told() == []
    assert shop.ride_ids() == [kept]


def test_copies_of_the_same_bytes_keep_nothing(shop: Shop) -> None:
    shop.take(b"a ride", ridden(1))
    copies = [shop.take(b"a ride", name="copy.fit") for _ in range(2)]
    (ride_id,) = shop.ride_ids()

    shop.uploads.remove(copies[0])
    assert b"a ride" in shop.files()
    shop.rides.delete(ride_id)

    assert shop.files() == []
    with pytest.raises(NotFound):
        shop.uploads.get(copies[1])


def test_a_copy_that_is_still_arriving_keeps_its_own_bytes(shop: Shop) -> None:
    shop.take(b"a ride", ridden(1))
    arriving = shop.uploads.create("again.fit", len(b"a ride"))
    shop.uploads.append(arriving.id, 0, b"a ri")

    shop.rides.delete(shop.ride_ids()[0])
    shop.uploads.append(arriving.id, 4, b"de")

    assert shop.uploads.get(arriving.id).state == "complete"
    assert b"a ride" in shop.files()


def test_a_log_that_filled_a_ride_goes_with_it(shop: Shop) -> None:
    heard = ridden(1, unit_t0_us=5_000_000)
    for counts in heard.rows.counts.values():
        counts[100:200] = np.iinfo(counts.dtype).min
    shop.take(b"recorded", heard)
    log = shop.take(b"log", ridden(1, unit_t0_us=5_000_000))
    assert shop.uploads.get(log).code == "filled"
    (ride_id,) = shop.ride_ids()

    with pytest.raises(Conflict, match=f"Ride {ride_id} "):
        shop.uploads.remove(log)
    shop.rides.delete(ride_id)

    assert shop.files() == []


def test_a_log_of_two_rides_goes_with_the_last_of_them(shop: Shop) -> None:
    for number, t0_us in enumerate((0, 40_000_000)):
        recorded = ridden(number, unit_t0_us=t0_us)
        shop.take(b"recorded %d" % number, replace(recorded))
    both = ridden(9, unit_t0_us=0, rows=2 * ROWS + 100)
    shop.take(b"log of both", both)
    first, second = shop.ride_ids()

    shop.rides.delete(first)
    assert b"log of both" in shop.files()
    shop.rides.delete(second)

    assert shop.files() == []


def test_a_rejected_file_can_be_removed_and_its_space_is_free(shop: Shop) -> None:
    uploads = [shop.take(bytes([number]) * 1_000_000) for number in range(8)]
    assert sum(map(len, shop.files())) == 8_000_000

    for upload in uploads:
        shop.uploads.remove(upload)

    assert shop.files() == []
    assert shop.uploads.list() == {"items": (), "next": None}


def test_rejected_and_unfinished_files_go_by_themselves_while_the_server_runs(shop: Shop) -> None:
    made = shop.take(b"a ride", ridden(1))
    copy = shop.take(b"a ride", name="copy.fit")
    refused = shop.take(b"no ride")
    unfinished = shop.uploads.create("half.fit", 100)
    shop.uploads.append(unfinished.id, 0, b"half")
    created_us = unfinished.created_us

    shop.store.sweep(created_us + DAY_US // 2)
    assert len(shop.uploads.list()["items"]) == 4  # type: ignore[arg-type]
    shop.store.sweep(created_us + 2 * DAY_US)

    assert shop.uploads.get(made).expires_at is None
    for gone in (copy, refused, unfinished.id):
        with pytest.raises(NotFound):
            shop.uploads.get(gone)
    originals = [content for content in shop.files() if not content.startswith(b"PAR1")]
    assert originals == [b"a ride"]


def test_a_file_that_rides_came_from_says_which(shop: Shop) -> None:
    upload = shop.take(b"two rides", ridden(1), ridden(2))
    first, second = shop.ride_ids()

    with pytest.raises(Conflict, match=f"Rides {first}, {second} came from") as refusal:
        shop.uploads.remove(upload)

    assert refusal.value.code == "has_rides"
    assert b"two rides" in shop.files()


class StoppingDisk(Disk):
    """Dies before or after its Nth removal of a file."""

    def __init__(self, at: int, after: bool) -> None:
        self.left = at
        self.after = after

    def remove(self, path: Path) -> None:
        self.left -= 1
        if self.left == 0 and not self.after:
            raise OSError(5, "Input/output error")
        super().remove(path)
        if self.left == 0:
            raise OSError(5, "Input/output error")


@pytest.mark.parametrize("after", [False, True])
@pytest.mark.parametrize("at", [1, 2])
def test_no_disk_that_fails_while_deleting_brings_a_position_back(
    shop: Shop, at: int, after: bool
) -> None:
    shop.take(b"a ride", ridden(1))
    shop.store.objects.disk = StoppingDisk(at, after)

    shop.rides.delete(shop.ride_ids()[0])
    assert shop.ride_ids() == []
    shop.reopen()

    assert shop.files() == []
    assert shop.ride_ids() == []
    assert shop.store.database.read(discarded_keys) == set()


def test_a_crash_between_commit_and_file_brings_no_position_back(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    shop.take(b"a ride", ridden(1))
    ride_id = shop.ride_ids()[0]

    def crash(*_: object) -> int:
        raise StoreError("the power went")

    monkeypatch.setattr(Deletions, "sweep", crash)
    with pytest.raises(StoreError):
        shop.rides.delete(ride_id)
    monkeypatch.undo()
    assert len(shop.files()) == 2
    shop.reopen()

    assert shop.files() == []


def test_a_delete_that_was_not_committed_deletes_nothing(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    shop.take(b"a ride", ridden(1))
    before = sorted(shop.files())

    def refuse(*_: object) -> None:
        raise StoreError("the database is gone")

    monkeypatch.setattr(type(shop.store.database), "submit", refuse)
    with pytest.raises(StoreError):
        shop.rides.delete(shop.ride_ids()[0])
    monkeypatch.undo()
    shop.reopen()

    assert len(shop.ride_ids()) == 1
    assert sorted(shop.files()) == before


def test_an_object_that_sql_does_not_know_yet_is_not_removed(shop: Shop) -> None:
    shop.take(b"a ride", ridden(1))
    with shop.store.objects.holding():
        shop.rides.delete(shop.ride_ids()[0])
        assert len(shop.files()) == 2
        arrived = shop.take(b"a ride")

    shop.store.sweep(START_US * 2)

    assert shop.uploads.get(arrived).state == "complete"
    assert len(shop.files()) == 2
    assert shop.store.database.read(discarded_keys) == set()


def test_the_object_before_a_filling_goes_when_nobody_reads_it_any_more(shop: Shop) -> None:
    heard = ridden(1, unit_t0_us=5_000_000)
    for counts in heard.rows.counts.values():
        counts[100:200] = np.iinfo(counts.dtype).min
    shop.take(b"recorded", heard)
    (ride,) = shop.store.rides.list().items
    before = shop.store.objects.local_path(str(ride.object_key))

    shop.take(b"log", ridden(1, unit_t0_us=5_000_000))
    assert before.exists()
    shop.store.sweep(shop.uploads.create("x", 1).created_us + 2 * 3600 * 1_000_000)

    assert not before.exists()
    assert shop.store.rides.reader(ride.id).row_count == ROWS


def database_bytes(shop: Shop) -> int:
    """Bytes of the database, as its pages count them, and of its log of changes."""
    pages = shop.store.database.read(
        lambda c: int(c.exec_driver_sql("PRAGMA page_count").scalar_one())
    )
    return 4096 * pages


def test_the_database_s_file_shrinks_when_rides_go(shop: Shop) -> None:
    empty = database_bytes(shop)
    for number in range(6):
        shop.take(b"long %d" % number, ridden(number, rows=100_000))
    assert database_bytes(shop) > empty + 40_000

    for ride_id in shop.ride_ids():
        shop.rides.delete(ride_id)
    for _ in range(20):
        shop.store.sweep(START_US)

    assert database_bytes(shop) <= empty + 4 * 4096
    assert (shop.folder / "db").stat().st_size == database_bytes(shop)
    assert (shop.folder / "db-wal").stat().st_size == 0


def test_a_file_whose_move_a_crash_cut_off_is_still_read(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    shop.contents[b"a ride"] = (ridden(1),)
    upload = shop.uploads.create("a.fit", 6)
    kept = shop.store.uploads._set

    def crash(token: str, **values: object) -> None:
        if "object_key" in values:
            raise StoreError("the power went")
        kept(token, **values)

    monkeypatch.setattr(shop.store.uploads, "_set", crash)
    with pytest.raises(StoreError):
        shop.uploads.append(upload.id, 0, b"a ride")
    monkeypatch.undo()
    shop.reopen()

    assert [found.state for found in shop.uploads.recover()] == ["complete"]
    assert b"a ride" in shop.files()
