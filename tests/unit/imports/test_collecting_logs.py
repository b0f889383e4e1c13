"""Goal: a log becomes a ride whatever happens on the way, and the unit keeps it until that is so.

Method: the real firmware in virtual time with a ride in its flash, the real threads and the real
store; the cable is pulled by the test after so many bytes. What a download must give is the flash
itself, read past the wire.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from backend.errors import Conflict, NotFound, SpindleError
from backend.formats.blocks import BLOCKS_SUFFIX
from backend.imports.service import Uploads
from backend.imports.unit_logs import Collect, Download
from backend.store import Store, open_store
from backend.units.inspection import Inspection
from backend.units.service import Devices
from sim_device.lockstep import LockstepUnit
from tests.fakes.server import eventually
from tests.fakes.simulated_unit import LockstepAsUnit
from tests.fakes.unit_link import UnitOpener
from tests.fakes.uploading import read_here

URL = "socket://unit:1"
RIDE_S = 120.0


@cache
def memory_of_a_ride() -> tuple[bytes, bytes]:
    """Both flashes of a unit that was ridden for two minutes and has stood since."""
    unit = LockstepUnit(seed=5)
    unit.rider("legs", 25.0, 80.0)
    unit.advance(RIDE_S)
    unit.rider("off")
    unit.brake(True)
    unit.advance(40.0)
    return unit.unit.flash(), unit.unit.log()


class Cable(LockstepAsUnit):
    """The unit behind a cable that breaks once, after so many bytes to the host."""

    def __init__(self, unit: LockstepUnit) -> None:
        super().__init__(unit)
        self.carried = 0
        self.breaks_after: int | None = None
        self.broke = threading.Event()
        self.opener: UnitOpener

    def transmit(self) -> bytes:
        data = super().transmit()
        self.carried += len(data)
        if self.breaks_after is not None and self.carried > self.breaks_after:
            self.breaks_after = None
            self.opener.unplug()
            self.broke.set()
        return data


@dataclass
class Shop:
    """One unit, its cable, and everything a download needs."""

    cable: Cable
    devices: Devices
    store: Store
    collect: Collect
    folder: Path
    device: str

    @property
    def serial_number(self) -> str:
        """The unit's own, which files of its logs are called by."""
        return self.devices.unit_key(self.device).removeprefix("ebl:")

    def fetch(self, log_id: int = 1) -> Download:
        """Fetch a log to its end."""
        self.collect.start(self.device, log_id)
        return self.over(log_id)

    def over(self, log_id: int = 1) -> Download:
        return eventually(
            lambda: self.collect.get(self.device, log_id),
            lambda download: download.state in ("done", "failed"),
        )


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    flash, log = memory_of_a_ride()
    cable = Cable(LockstepUnit(seed=5, flash=flash, log=log, boot_id=2))
    cable.opener = UnitOpener(cable, URL)
    devices = Devices(streaming=False, opener=lambda url: cable.opener)
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        folder = tmp_path / "collecting"
        collect = Collect(devices, Uploads(store, reader=read_here), folder)
        device = devices.add(URL).id
        yield Shop(cable, devices, store, collect, folder, device)
        collect.close()
        devices.close()


def flash_bytes(shop: Shop) -> bytes:
    """The log as it lies in the flash, the unit's own words blanked."""
    return flash_bytes_of(shop.collect.logs(shop.device).items[0].length)


def flash_bytes_of(length: int) -> bytes:
    data = bytearray(memory_of_a_ride()[1][:length])
    for at in range(508, length, 512):
        data[at : at + 4] = b"\xff" * 4
    return bytes(data)


def part_of(shop: Shop) -> Path:
    """Where the beginning of the log is kept while it is fetched."""
    (log,) = shop.collect.logs(shop.device).items
    shop.folder.mkdir(exist_ok=True)
    return shop.folder / f"{shop.serial_number}-00000001-{log.log_id}-{log.generation:08x}.part"


def original(shop: Shop, download: Download) -> bytes:
    assert download.upload_id is not None
    key = shop.store.uploads.get(download.upload_id).object_key
    assert key is not None
    return shop.store.objects.local_path(key).read_bytes()


def full_disk(*_: object, **__: object) -> None:
    raise OSError(28, "No space left on device")


@pytest.mark.slow
def test_a_log_becomes_a_ride_and_is_confirmed(shop: Shop) -> None:
    (log,) = shop.collect.logs(shop.device).items
    assert (log.state, log.confirmed, log.started_at) == ("closed", False, None)

    done = shop.fetch()

    assert (done.state, done.confirmed, done.duplicate_of) == ("done", True, None)
    assert original(shop, done) == flash_bytes(shop)
    assert done.ride_id is not None
    ride = shop.store.rides.get(done.ride_id)
    assert ride.context.device_serial == shop.serial_number
    assert ride.context.unit_key == f"ebl:{shop.serial_number}"
    assert ride.row_count == pytest.approx(10 * log.duration_s, abs=11)
    assert shop.collect.logs(shop.device).items[0].confirmed
    assert list(shop.folder.iterdir()) == []


@pytest.mark.slow
def test_a_cable_pulled_in_the_middle_costs_no_byte_twice_over(shop: Shop) -> None:
    whole = flash_bytes(shop)
    begun = shop.cable.carried
    shop.cable.breaks_after = begun + len(whole) // 2
    shop.collect.start(shop.device, 1)
    assert shop.cable.broke.wait(20.0)
    eventually(lambda: shop.collect.get(shop.device, 1).detail)

    shop.cable.opener.plug_in()
    done = shop.over()

    assert done.state == "done", done
    assert original(shop, done) == whole
    # What was under way when it broke, and the handshake: not the first half again.
    assert shop.cable.carried - begun < 1.3 * len(whole) + 40_000


@pytest.mark.slow
def test_a_beginning_that_is_here_is_gone_on_from(shop: Shop) -> None:
    whole = flash_bytes(shop)
    part_of(shop).write_bytes(whole[: len(whole) * 3 // 4])
    begun = shop.cable.carried

    done = shop.fetch()

    assert original(shop, done) == whole
    assert shop.cable.carried - begun < len(whole) // 2


@pytest.mark.parametrize(
    "found",
    [b"not of this log at all" * 500, b"x", b"\xff" * (1 << 20)],
    ids=["other", "x", "long"],
)
@pytest.mark.slow
def test_what_is_no_beginning_of_the_log_is_thrown_away(shop: Shop, found: bytes) -> None:
    part_of(shop).write_bytes(found)

    done = shop.fetch()

    assert original(shop, done) == flash_bytes(shop)


@pytest.mark.slow
def test_the_unit_is_not_told_before_the_ride_is_stored(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(shop.store.objects, "publish", full_disk)
        failed = shop.fetch()
    assert failed.state == "failed"
    assert "No space left" in str(failed.detail)
    assert not shop.collect.logs(shop.device).items[0].confirmed

    assert shop.fetch().confirmed


@pytest.mark.slow
def test_a_log_fetched_again_is_the_ride_that_is_here(shop: Shop) -> None:
    first = shop.fetch()

    again = shop.fetch()

    assert again.duplicate_of == first.ride_id
    assert len(shop.store.rides.list().items) == 1


def test_a_log_is_erased_only_after_it_is_safe_here(shop: Shop) -> None:
    with pytest.raises(Conflict, match="would lose the ride"):
        shop.collect.erase(shop.device, 1)
    done = shop.fetch()

    erased = shop.collect.erase(shop.device, 1)

    assert (erased.log_id, erased.erases > 0) == (1, True)
    assert shop.collect.logs(shop.device).items == ()
    assert done.ride_id is not None
    assert shop.store.rides.get(done.ride_id).state == "done"
    with pytest.raises(NotFound):
        shop.collect.erase(shop.device, 1)


@pytest.mark.slow
def test_closing_in_the_middle_keeps_what_has_come(shop: Shop) -> None:
    part = part_of(shop)
    shop.cable.breaks_after = shop.cable.carried + 20_000
    shop.collect.start(shop.device, 1)
    assert shop.cable.broke.wait(20.0)
    eventually(lambda: shop.collect.get(shop.device, 1).detail)

    shop.collect.close()

    size = part.stat().st_size
    assert size > 0
    assert part.read_bytes() == flash_bytes_of(size)
    with pytest.raises(SpindleError):
        shop.collect.start(shop.device, 1)


@pytest.mark.slow
def test_what_is_not_there_or_not_finished_is_refused(shop: Shop) -> None:
    with pytest.raises(NotFound, match="4711"):
        shop.collect.start(shop.device, 4711)
    with pytest.raises(NotFound):
        shop.collect.get(shop.device, 1)
    with pytest.raises(NotFound):
        shop.collect.logs("nobody")
    Inspection(shop.devices).simulate(
        shop.device, {"brake": False, "rider": {"kind": "legs", "torque_nm": 30.0}}
    )
    eventually(lambda: len(shop.collect.logs(shop.device).items) == 2)

    with pytest.raises(Conflict, match="still being written"):
        shop.collect.start(shop.device, 2)


@pytest.mark.parametrize("suffix", [".part", BLOCKS_SUFFIX])
@pytest.mark.slow
def test_what_was_fetched_of_a_log_that_is_gone_becomes_a_ride(shop: Shop, suffix: str) -> None:
    whole = flash_bytes(shop)
    (log,) = shop.collect.logs(shop.device).items
    gone = part_of(shop).with_name(f"{shop.serial_number}-00000001-9-0badcafe{suffix}")
    # Half a log, and a piece of a page, as a lost supply leaves it.
    gone.write_bytes(whole[: len(whole) // 1024 * 512 + 100])
    stranger = gone.with_name(f"{'0' * 24}-00000001-9-0badcafe.part")
    stranger.write_bytes(b"of another unit")

    with pytest.raises(NotFound):
        shop.collect.start(shop.device, 9)
    (ride,) = eventually(lambda: shop.store.rides.list().items)

    eventually(lambda: not gone.exists())
    assert ride.state == "done"
    assert ride.row_count == pytest.approx(5 * log.duration_s, abs=60)
    assert stranger.exists()
    assert shop.collect.logs(shop.device).items == (log,)


@pytest.mark.slow
def test_a_beginning_the_store_refuses_stays_on_the_disk(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = part_of(shop).with_name(f"{shop.serial_number}-00000001-9-0badcafe.part")
    gone.write_bytes(flash_bytes(shop))
    with monkeypatch.context() as patched:
        patched.setattr(shop.store.objects, "publish", full_disk)
        assert shop.fetch().state == "failed"
    assert gone.exists()

    assert shop.fetch().confirmed

    assert not gone.exists()
    assert len(shop.store.rides.list().items) == 1
