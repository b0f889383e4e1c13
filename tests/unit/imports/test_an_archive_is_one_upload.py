"""Goal: an archive is one upload with a state for each file within, and each ride has its own file.

Method: the real store; files read here, in the threads of the lanes; archives by Python's zipfile.
"""

from __future__ import annotations

import gzip
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.errors import Conflict
from backend.formats import Entry, Left, ReadingStopped
from backend.formats.containers.archive import entries
from backend.imports.service import Uploads, UploadSettings
from backend.rebuild import rebuild_store
from backend.rides.service import Rides
from backend.store import Store, open_store
from backend.store.discard import named_keys
from tests.fakes.fit_file import START_S, commute, fit_file
from tests.fakes.uploading import read_here
from tests.fakes.zip_file import zipped

DAY_S = 86_400
FIRST, SECOND, THIRD = (fit_file(commute(120, START_S + day * DAY_S)) for day in range(3))
PAGE = b"<html>502</html>"


@pytest.fixture
def uploads(store: Store) -> Iterator[Uploads]:
    opened = Uploads(store, reader=read_here)
    yield opened
    opened.close()


def test_each_file_within_has_its_state_and_the_archive_one_summary(
    uploads: Uploads, store: Store
) -> None:
    uploads.receive_file("known.fit", SECOND)

    sent = uploads.receive_file(
        "rides.zip",
        zipped({"a.fit": FIRST, "b.fit.gz": gzip.compress(THIRD[:-400]), "c": PAGE, "d": SECOND}),
    )

    parts = {part.name: part for part in store.uploads.parts(sent.id)}
    assert {name: part.state for name, part in parts.items()} == {
        "a.fit": "complete",
        "b.fit.gz": "partial",
        "c": "rejected",
        "d": "complete",
    }
    assert parts["d"].code == "duplicate"
    assert sent.parts is not None
    assert (sent.parts.complete, sent.parts.here, sent.parts.rejected) == (1, 1, 1)
    assert (sent.state, sent.code) == ("partial", "part_unreadable")
    assert str(sent.detail).startswith("4 files: 1 read completely, 1 already here")


def test_the_list_shows_the_archive_and_what_is_within_on_request(uploads: Uploads) -> None:
    sent = uploads.receive_file("rides.zip", zipped({"a.fit": FIRST, "b.fit": SECOND}))

    listed = uploads.list()["items"]
    within = uploads.list(part_of=sent.id)["items"]

    assert [upload.id for upload in listed] == [sent.id]  # type: ignore[attr-defined]
    assert {part.part_of for part in within} == {sent.id}  # type: ignore[attr-defined]
    assert len(sent.ride_ids) == 2


def test_a_ride_s_original_is_its_own_file_and_the_archive_stays(
    uploads: Uploads, store: Store
) -> None:
    data = zipped({"trip/Morning.fit": FIRST, "b.fit": SECOND})
    sent = uploads.receive_file("rides.zip", data)
    rides = Rides(store)

    ride = next(ride for ride in store.rides.list().items if ride.name == "Morning")

    assert b"".join(rides.export(ride.id, "original").chunks) == FIRST
    assert store.objects.local_path(str(sent.object_key)).read_bytes() == data
    with pytest.raises(Conflict, match="came from upload"):
        uploads.remove(sent.id)


def test_with_the_last_ride_the_archive_goes_and_everything_within(
    uploads: Uploads, store: Store
) -> None:
    sent = uploads.receive_file("rides.zip", zipped({"a.fit": FIRST, "b.fit": SECOND, "c": PAGE}))
    first, second = sent.ride_ids
    key = str(sent.object_key)

    store.rides.delete(first)
    assert store.objects.local_path(key).exists()
    store.rides.delete(second)

    assert uploads.list()["items"] == ()
    assert store.database.read(named_keys) == set()
    assert not (store.objects.root / key).exists()


def test_an_archive_without_a_ride_is_refused_and_can_be_removed(
    uploads: Uploads, store: Store
) -> None:
    sent = uploads.receive_file("photos.zip", zipped({"a": PAGE, "b": PAGE}))

    assert (sent.state, sent.code) == ("rejected", "no_rides_inside")
    uploads.remove(sent.id)
    assert uploads.list()["items"] == ()
    assert store.database.read(named_keys) == set()


def test_a_cut_archive_gives_its_whole_files_and_says_so(uploads: Uploads) -> None:
    data = zipped({"a.fit": FIRST, "b.fit": SECOND})
    cut = data.index(b"b.fit") + 500

    sent = uploads.receive_file("cut.zip", data[:cut])
    nothing = uploads.receive_file("nothing.zip", data[:500])

    assert (sent.state, sent.code, len(sent.ride_ids)) == ("partial", "truncated", 1)
    assert "its list of files is gone" in str(sent.detail)
    assert (nothing.state, nothing.code) == ("rejected", "container_damaged")


def test_a_file_within_that_states_any_size_or_is_too_large_stops_no_archive(store: Store) -> None:
    data = bytearray(zipped({"locked.fit": FIRST, "large.fit": SECOND, "small.fit": THIRD[:2000]}))
    data[6] |= 1
    listed = data.index(b"PK\x01\x02")
    data[listed + 8] |= 1
    data[listed + 24 : listed + 28] = struct.pack("<I", 0xFFFFFFF0)
    uploads = Uploads(store, UploadSettings(length_max=len(SECOND) - 1), reader=read_here)

    sent = uploads.receive_file("rides.zip", bytes(data))
    uploads.close()

    codes = {part.name: part.code for part in store.uploads.parts(sent.id)}
    assert codes == {"locked.fit": "encrypted", "large.fit": "too_large", "small.fit": "truncated"}
    assert (sent.state, sent.code) == ("partial", "part_unreadable")


def test_an_export_s_names_become_the_rides_and_what_people_wrote_here_stays(
    uploads: Uploads, store: Store
) -> None:
    table = "Activity ID,Activity Date,Activity Name,Activity Description,Filename\n"
    table += "1,x,Canal,Wind,activities/1.fit.gz\n2,x,Hills,,activities/2.fit\n"
    export = zipped(
        {
            "activities.csv": table.encode(),
            "activities/1.fit.gz": gzip.compress(FIRST),
            "activities/2.fit": SECOND,
            "profile.csv": b"x",
        }
    )
    known = uploads.receive_file("2.fit", SECOND).ride_ids[0]
    store.rides.patch(known, name="Mine")

    sent = uploads.receive_file("export.zip", export)

    named = {ride.name: ride.notes for ride in store.rides.list().items}
    assert named == {"Canal": "Wind", "Mine": ""}
    assert "2 other files" in str(sent.detail)


def test_a_stop_in_the_middle_is_gone_on_with_and_makes_nothing_twice(store: Store) -> None:
    data = zipped({"a.fit": FIRST, "b.fit": SECOND})

    def cut(path: Path) -> Iterator[Entry | Left]:
        yield next(entries(path))
        raise ReadingStopped

    first = Uploads(store, reader=read_here, unpack=cut)
    sent = first.receive_file("rides.zip", data)
    first.close()
    assert sent.state == "queued"

    after = Uploads(store, reader=read_here)
    after.recover()

    assert after.get(sent.id).state == "complete"
    assert len(store.uploads.parts(sent.id)) == len(store.rides.list().items) == 2
    after.close()


def test_a_rebuilt_store_knows_the_archive_and_its_files(tmp_path: Path) -> None:
    objects, fresh = f"file://{tmp_path}/objects", f"sqlite:///{tmp_path}/new"
    with open_store(f"sqlite:///{tmp_path}/db", objects) as store:
        uploads = Uploads(store, reader=read_here)
        uploads.receive_file("rides.zip", zipped({"a.fit": FIRST, "b.fit": SECOND}))
        uploads.close()

    report = rebuild_store(fresh, objects)

    assert (report.rides, report.originals_without_ride, report.originals_missing) == (2, [], [])
    with open_store(fresh, objects) as store:
        (archive,) = store.uploads.list()
        assert (archive.name, len(archive.ride_ids)) == ("rides.zip", 2)
        assert {part.name for part in store.uploads.parts(archive.id)} == {"a.fit", "b.fit"}
