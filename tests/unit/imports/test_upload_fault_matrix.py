"""Goal: whatever befalls an upload, what the server keeps in the end is the file, byte for byte.

Method: a table of faults, each against the real application and store. A fault is something that a
client, a line, a disk or a crash does in the middle; afterwards the client does what tus says (ask
where the upload stands, go on from there), and the original is compared with what was sent. A
server that dies is a store that is left as it is and opened anew.
"""

from __future__ import annotations

import errno
import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest

from backend.imports.service import Uploads
from backend.store import open_store
from tests.fakes.failing_disk import FailingDisk
from tests.fakes.fit_file import commute, fit_file
from tests.fakes.uploading import TUS, UploadDesk, checksum, described, read_here

pytestmark = pytest.mark.slow

RIDE = fit_file(commute(1200))
HALF = len(RIDE) // 2


class Bench(UploadDesk):
    """The application over a folder; `die` and `start` are a crash and the next start."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.start()

    def start(self) -> None:
        folder = self.folder
        self.store = open_store(f"sqlite:///{folder}/db", f"file://{folder}/objects")
        super().__init__(Uploads(self.store, reader=read_here))

    def die(self) -> None:
        self.uploads.close()
        self.store.close()

    def begin(self, length: int = len(RIDE), **told: str) -> str:
        return super().begin(length, **({"filename": "ride.fit"} | told))

    def finish(self, address: str) -> dict[str, Any]:
        """What every tus client does after a break."""
        offset = self.stands(address)
        if offset < len(RIDE):
            assert self.send(address, offset, RIDE[offset:]) == 204
        return self.verdict(address)

    def spooled(self, address: str) -> Path:
        return self.store.objects.root / ".spool" / address.rsplit("/", 1)[-1]

    def kept(self) -> list[bytes]:
        originals = (self.store.objects.root / "originals").rglob("*")
        return [path.read_bytes() for path in originals if path.is_file()]


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    opened = Bench(tmp_path)
    yield opened
    opened.die()


def a_cut_within_a_part(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    with bench.spooled(address).open("ab") as file:
        file.write(RIDE[HALF : HALF + 777])


def a_server_that_dies_within_a_write(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    with bench.spooled(address).open("ab") as file:
        file.write(b"\xff" * 5000)
    bench.die()
    bench.start()


def a_part_that_is_sent_twice(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE[:HALF]) == 204
    assert bench.send(address, 0, RIDE[:HALF]) == 409


def an_offset_behind(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    assert bench.send(address, HALF - 1, RIDE[HALF - 1 :]) == 409


def an_offset_ahead(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    assert bench.send(address, HALF + 1, RIDE[HALF + 1 :]) == 409


def a_part_beyond_the_end(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    assert bench.send(address, HALF, RIDE[HALF:] + b"more") == 413


def a_wrong_checksum(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE[:HALF], **checksum(b"other")) == 460
    assert bench.stands(address) == 0
    assert bench.send(address, 0, RIDE[:HALF], **checksum(RIDE[:HALF])) == 204


def a_part_of_another_type(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE[:HALF], **{"content-type": "image/png"}) == 415
    assert bench.stands(address) == 0


def a_client_of_another_tus(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE[:HALF], **{"tus-resumable": "0.2.2"}) == 412
    assert bench.stands(address) == 0


def a_retry_after_success(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE) == 204
    assert bench.send(address, 0, RIDE) == 409
    assert bench.send(address, len(RIDE), b"") == 204


def two_clients_with_one_upload(bench: Bench, address: str) -> None:
    assert bench.send(address, 0, RIDE[:HALF]) == 204
    assert bench.send(address, HALF, RIDE[HALF : HALF + 100]) == 204
    assert bench.send(address, HALF, RIDE[HALF:]) == 409


def a_disk_that_is_full(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:HALF])
    full = OSError(errno.ENOSPC, "No space left on device")
    with patch("os.fsync", side_effect=full):
        assert bench.send(address, HALF, RIDE[HALF:]) == 507
    assert bench.stands(address) == HALF


def a_crash_before_the_file_is_moved(bench: Bench, address: str) -> None:
    bench.send(address, 0, RIDE[:-1])
    bench.die()
    bench.start()


FAULTS: tuple[Callable[[Bench, str], None], ...] = (
    a_cut_within_a_part,
    a_server_that_dies_within_a_write,
    a_part_that_is_sent_twice,
    an_offset_behind,
    an_offset_ahead,
    a_part_beyond_the_end,
    a_wrong_checksum,
    a_part_of_another_type,
    a_client_of_another_tus,
    a_retry_after_success,
    two_clients_with_one_upload,
    a_disk_that_is_full,
    a_crash_before_the_file_is_moved,
)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.__name__)
def test_after_any_fault_the_file_is_kept_byte_for_byte(
    bench: Bench, fault: Callable[[Bench, str], None]
) -> None:
    address = bench.begin()

    fault(bench, address)
    verdict = bench.finish(address)

    assert (verdict["state"], verdict["code"]) == ("complete", None)
    assert bench.kept() == [RIDE]
    assert len(bench.store.rides.list().items) == 1


@pytest.mark.parametrize("step", range(1, 11))
def test_a_disk_that_fails_on_the_way_from_file_to_ride_delays_it(bench: Bench, step: int) -> None:
    """The client, who was answered 507, may be gone; no new start is needed."""
    address = bench.begin()
    bench.store.objects.disk = failing = FailingDisk(step)
    assert bench.send(address, 0, RIDE) == 507
    assert failing.left == 0
    assert bench.verdict(address)["state"] in ("receiving", "queued")

    for reading in bench.uploads.retry_waiting(1):
        reading.result(30)

    assert bench.verdict(address)["state"] == "complete"
    assert bench.kept() == [RIDE]
    assert len(bench.store.rides.list().items) == 1


def test_cut_at_any_place_it_goes_on_there(bench: Bench) -> None:
    for number, cut in enumerate((1, 13, 14, 4095, 4096, 4097, HALF, len(RIDE) - 1)):
        own = RIDE[:-2] + bytes([number, number])
        address = bench.begin()
        assert bench.send(address, 0, own[:cut]) == 204
        assert bench.stands(address) == cut
        assert bench.send(address, cut, own[cut:]) == 204
        assert own in bench.kept()


def test_a_declared_hash_that_is_another_s_is_told_and_makes_no_ride(bench: Bench) -> None:
    address = bench.begin(sha256=hashlib.sha256(b"other").hexdigest())

    bench.send(address, 0, RIDE)

    verdict = bench.verdict(address)
    assert (verdict["state"], verdict["code"]) == ("rejected", "hash_mismatch")
    assert bench.store.rides.list().items == ()


def test_a_declared_hash_that_is_none_begins_nothing(bench: Bench) -> None:
    headers = TUS | {"upload-length": "1"} | described(sha256="abc")

    assert bench.client.post("/api/v1/uploads", headers=headers).status_code == 400


def test_the_same_bytes_under_eighteen_names_are_one_ride_and_one_file(bench: Bench) -> None:
    codes = []
    for number in range(18):
        address = bench.begin(filename=f"ride ({number}).FIT")
        bench.send(address, 0, RIDE)
        codes.append(bench.verdict(address)["code"])

    assert codes == [None] + ["duplicate"] * 17
    assert bench.kept() == [RIDE]
    assert len(bench.store.rides.list().items) == 1


def test_two_clients_that_send_one_file_side_by_side_make_one_ride(bench: Bench) -> None:
    one, other = bench.begin(), bench.begin(filename="copy.fit")
    for start in range(0, len(RIDE), 5000):
        for address in (one, other):
            assert bench.send(address, start, RIDE[start : start + 5000]) == 204

    codes = [bench.verdict(address)["code"] for address in (one, other)]
    assert codes == [None, "duplicate"]
    assert bench.kept() == [RIDE]


def test_a_size_that_lies_ends_with_the_size_and_is_told(bench: Bench) -> None:
    address = bench.begin(length=HALF)

    assert bench.send(address, 0, RIDE) == 413
    assert bench.send(address, 0, RIDE[:HALF]) == 204

    verdict = bench.verdict(address)
    assert (verdict["state"], verdict["code"]) == ("partial", "truncated")
    assert bench.kept() == [RIDE[:HALF]]


def test_what_expired_is_gone_and_says_so(bench: Bench) -> None:
    address = bench.begin()
    bench.send(address, 0, RIDE[:HALF])
    spooled = bench.spooled(address)
    week_us = 8 * 86_400 * 1_000_000

    bench.store.sweep(bench.uploads.get(address.rsplit("/", 1)[-1]).created_us + week_us)

    assert bench.send(address, HALF, RIDE[HALF:]) == 404
    assert not spooled.exists()


@pytest.mark.parametrize(
    ("name", "data", "code"),
    [
        ("empty.fit", b"", "empty_file"),
        ("page.fit", b"<html><body>502</body></html>", "unsupported_format"),
        ("photo.fit", b"\xff\xd8\xff\xe0" + bytes(200), "unsupported_format"),
        ("tool.fit", b"\x7fELF" + bytes(200), "unsupported_format"),
        ("noise", bytes(range(256)), "unknown_format"),
        ("words.fit", b"not a ride at all", "unknown_format"),
        ("zeros.fit", bytes(5000), "unknown_format"),
    ],
)
def test_what_is_no_ride_has_its_reason_and_no_ride_and_its_bytes_are_kept(
    bench: Bench, name: str, data: bytes, code: str
) -> None:
    address = bench.begin(length=len(data), filename=name)
    if data:
        bench.send(address, 0, data)

    verdict = bench.verdict(address)

    assert (verdict["state"], verdict["code"], verdict["ride_ids"]) == ("rejected", code, [])
    assert verdict["detail"]
    assert bench.kept() == [data]
