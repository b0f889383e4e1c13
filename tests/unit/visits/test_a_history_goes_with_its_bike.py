"""Goal: a bike's history comes to another server as it was, without names; a file that somebody
made up adds nothing and leaves nothing.

Method: two stores and the files between them; hostile files made of a sound one.
"""

from __future__ import annotations

import io
import json
import struct
import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from backend.errors import Conflict, InvalidRequest, NotFound, SpindleError, StoreError
from backend.store import Store, open_store
from backend.store.wall_clock import now_us
from backend.visits.history import DIRECTORY_BYTES_MAX, MANIFEST
from backend.visits.photos import drawn_anew
from backend.visits.service import Visits
from backend.visits.types import HistoryAdded, Visit, VisitIn
from tests.fakes.failing_disk import FailingDisk
from tests.fakes.zip_file import zipped
from tests.unit.conftest import OpenStore, urls
from tests.unit.visits.kept_visits import (
    a_bike,
    a_closed_visit,
    files_of_visits,
    picture,
    visits_on,
)

Body = dict[str, Any]
DAY_US = 86_400_000_000


@pytest.fixture
def other(tmp_path: Path) -> Iterator[Store]:
    """Another server's store."""
    with open_store(*urls(tmp_path / "other")) as store:
        yield store


def written(visits: Visits, bike_id: int) -> bytes:
    file = io.BytesIO()
    visits.write_history(bike_id, file)
    return file.getvalue()


def brought(visits: Visits, bike_id: int, data: bytes) -> HistoryAdded:
    return visits.read_history(bike_id, io.BytesIO(data))


def body_of(data: bytes) -> Body:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        body: Body = json.loads(archive.read(MANIFEST))
    return body


def files_in(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_a_history_comes_as_it_was_and_once(store: Store, other: Store, tmp_path: Path) -> None:
    visits, there, bike = visits_on(store), visits_on(other), a_bike(store)
    sent = [a_closed_visit(visits, bike, photos=number) for number in (0, 3)]
    visits.open(bike, VisitIn(complaint="not over"), "Ben")
    data = written(visits, bike)
    target = a_bike(other, "Blue, too")

    first = brought(there, target, data)
    again = brought(there, a_bike(other, "Red"), data)

    assert (first.added, first.known, again.added, again.known) == (2, 0, 0, 2)
    found = there.list(target)
    assert [one.token for one in found] == [one.token for one in reversed(sent)]
    for was, is_now in zip(reversed(sent), found, strict=True):
        assert is_now.content_sha256 == was.content_sha256
        assert (is_now.imported, is_now.consent_holds) == (True, True)
        assert is_now.consent is not None
        assert was.consent is not None
        assert (is_now.consent.by, is_now.consent.at) == ("signature", was.consent.at)
        assert (is_now.consent.name, is_now.consent.strokes) == (None, ())
        assert (is_now.opened_at, is_now.closed_at) == (was.opened_at, was.closed_at)
        for photo in was.content.photos:
            assert there.photo(is_now.id, photo.sha256) == visits.photo(was.id, photo.sha256)
    # And on from there, the same.
    assert files_in(written(there, target)).keys() == files_in(data).keys()
    assert len(files_of_visits(tmp_path / "other" / "objects")) == 2 + 3


def test_no_name_is_in_the_file(store: Store) -> None:
    visits, bike = visits_on(store), a_bike(store)
    a_closed_visit(visits, bike)

    files = files_in(written(visits, bike))

    for data in files.values():
        for name in ("Müller", "M\\u00fcller", 'strokes": [['):
            assert name.encode() not in data
    assert set(files) == {MANIFEST, *(name for name in files if name.startswith("photos/"))}


def test_a_bike_without_visits_has_a_history_too(store: Store, other: Store) -> None:
    data = written(visits_on(store), a_bike(store))

    assert brought(visits_on(other), a_bike(other), data) == HistoryAdded(0, 0)
    with pytest.raises(NotFound):
        brought(visits_on(other), 99, b"not even looked at")
    with pytest.raises(NotFound):
        written(visits_on(store), 99)


def test_a_photograph_of_two_visits_is_in_the_file_once(store: Store, other: Store) -> None:
    visits, there, bike = visits_on(store), visits_on(other), a_bike(store)
    for _ in range(2):
        a_closed_visit(visits, bike, photos=1)

    data = written(visits, bike)
    target = a_bike(other)

    assert len(files_in(data)) == 2
    assert brought(there, target, data).added == 2
    for visit in there.list(target):
        assert there.photo(visit.id, visit.content.photos[0].sha256)


def sound_history(folder: Path) -> bytes:
    """Two visits, each with a photograph of its own."""
    with open_store(*urls(folder)) as store:
        visits, bike = visits_on(store), a_bike(store)
        a_closed_visit(visits, bike, photos=1)
        visit = visits.open(bike, VisitIn(customer="Frau Müller"), "Ben")
        visits.add_photo(visit.id, "b.jpg", picture(99))
        visits.close(visit.id)
        return written(visits, bike)


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return sound_history(tmp_path_factory.mktemp("sound"))


def refused(store: Store, folder: Path, data: bytes) -> SpindleError:
    """Why a file is not taken; nothing of it is left."""
    visits, bike = visits_on(store), a_bike(store)
    with pytest.raises((InvalidRequest, Conflict)) as error:
        brought(visits, bike, data)
    assert visits.list(bike) == ()
    assert files_of_visits(folder / "objects") == []
    return error.value


def with_other_visit(sound: bytes, change: Callable[[Body], object]) -> bytes:
    """The sound file with something else in its second visit, so that the first is whole."""
    files = files_in(sound)
    body = json.loads(files[MANIFEST])
    change(body["visits"][1])
    return zipped({**files, MANIFEST: json.dumps(body).encode()})


def in_content(**values: Any) -> Callable[[Body], object]:
    return lambda visit: visit["content"].update(values)


def in_visit(**values: Any) -> Callable[[Body], object]:
    return lambda visit: visit.update(values)


def in_photo(**values: Any) -> Callable[[Body], object]:
    return lambda visit: visit["content"]["photos"][0].update(values)


def nested(depth: int) -> Any:
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return value


def change_of(value: Any) -> list[Body]:
    at = "2026-05-01T12:00:00Z"
    one = {"parameter": "x", "old": 1, "new": value, "changed_at": at, "author": "", "reason": ""}
    return [one]


WRONG_VISITS: dict[str, Callable[[Body], object]] = {
    "open": in_visit(closed_us=None),
    "closed before it was opened": in_visit(closed_us=1),
    "in the future": in_visit(closed_us=now_us() + 2 * DAY_US),
    "at no time": in_visit(opened_us=0),
    "at a huge time": in_visit(opened_us=10**40, closed_us=10**40),
    "at a time beyond SQL": in_visit(opened_us=2**63, closed_us=2**63),
    "at a fraction of a time": in_visit(opened_us=1.5),
    "a truth for a time": in_visit(opened_us=True),
    "a text for a time": in_visit(closed_us="now"),
    "a huge version": in_visit(version=10**30),
    "no version": lambda visit: visit.pop("version"),
    "a token that leads elsewhere": in_visit(token="../../../../tmp/x"),
    "a token that is no text": in_visit(token=7),
    "a short token": in_visit(token="ab"),
    "a token and a line": in_visit(token="a" * 32 + "\n"),
    "an author of many words": in_visit(opened_by="x" * 5_000),
    "an author of control characters": in_visit(opened_by="\x00\x1b[2J"),
    "an author that is half a character": in_visit(opened_by="\ud800"),
    "no content": in_visit(content=None),
    "a list for a content": in_visit(content=[]),
    "a text for kilometres": in_content(counter_km="far"),
    "no number of kilometres": in_content(counter_km=float("nan")),
    "endless kilometres": in_content(counter_km=float("inf")),
    "kilometres that nobody rode": in_content(counter_km=-5.0),
    "a number for words": in_content(complaint=5),
    "a complaint that is a book": in_content(complaint="x" * 2_001),
    "half a character": in_content(notes="\ud800"),
    "parts of nothing": in_content(parts=[{"name": "", "number": None, "quantity": 1}]),
    "less than no part": in_content(parts=[{"name": "x", "number": None, "quantity": -1}]),
    "too many parts": in_content(parts=[{"name": "x", "number": None, "quantity": 1}] * 51),
    "faults that are none": in_content(faults=[{"name": 1}]),
    "a fault at a moment without a zone": in_content(
        faults=[{"name": "X", "count": 1, "seen_at": "2026-05-01T12:00:00", "over_at": None}]
    ),
    "a change at no moment": in_content(changes=[{**change_of(1)[0], "changed_at": "soon"}]),
    "a change that is no number": in_content(changes=change_of(float("nan"))),
    "a change that is half a character": in_content(changes=change_of("\ud800")),
    "a change in a change in a change": in_content(changes=change_of(nested(60))),
    "more than a visit has": in_content(changes=change_of("x" * 1_000_000)),
    "no list of photographs": in_content(photos=None),
    "too many photographs": lambda visit: in_content(photos=visit["content"]["photos"] * 21)(visit),
    "a photograph that leads elsewhere": in_photo(sha256="../" * 20 + "etcp"),
    "a photograph that is not there": in_photo(sha256="0" * 64),
    "a photograph of another size": in_photo(width_px=63),
    "a photograph of other bytes": in_photo(size_bytes=5),
    "a consent of nobody": in_visit(consent={"by": "nobody"}),
    "a consent that is a text": in_visit(consent="yes"),
}


@pytest.mark.parametrize("change", WRONG_VISITS.values(), ids=WRONG_VISITS)
def test_a_visit_that_is_none_is_refused_and_the_others_with_it(
    store: Store, tmp_path: Path, sound: bytes, change: Callable[[Body], object]
) -> None:
    error = refused(store, tmp_path, with_other_visit(sound, change))

    assert error.fields[0].code in ("no_history", "no_picture")


def manifest(body: Any) -> bytes:
    return zipped({MANIFEST: json.dumps(body).encode()})


BODY = {"format": "spindle-bike-history", "version": 1, "bike": {}, "visits": []}
WRONG_FILES = {
    "nothing": b"",
    "no ZIP": b"no ZIP at all",
    "almost a ZIP": b"PK\x05\x06" + bytes(10),
    "an end alone": b"PK\x05\x06" + bytes(4) + struct.pack("<HHIIH", 9, 9, 500, 0, 0),
    "no manifest": zipped({"readme.txt": b"hello"}),
    "names that lead out of a folder": zipped({f"../{MANIFEST}": b"{}", "/etc/x": b"x"}),
    "a manifest that is none": zipped({MANIFEST: b"\xff\xfe"}),
    "a list": manifest([]),
    "another format": manifest({**BODY, "format": "x"}),
    "no visits": manifest({**BODY, "visits": None}),
    "visits that are none": manifest({**BODY, "visits": [1, None, []]}),
    "deep": zipped({MANIFEST: b"[" * 200_000}),
    "deep in a visit": zipped(
        {MANIFEST: json.dumps(BODY).encode()[:-2] + b'[{"x":' + b"[" * 900 + b"]" * 900 + b"}]}"}
    ),
    "an endless number": zipped({MANIFEST: b'{"version": ' + b"9" * 9_000 + b"}"}),
    "a bomb": zipped({MANIFEST: bytes(40 * 1024 * 1024)}),
}


@pytest.mark.parametrize("data", WRONG_FILES.values(), ids=WRONG_FILES)
def test_a_file_that_is_no_history_is_refused(store: Store, tmp_path: Path, data: bytes) -> None:
    assert refused(store, tmp_path, data).code == "no_history"
    assert {path.name for path in tmp_path.iterdir()} == {"objects", "spindle.db"} | {
        path.name for path in tmp_path.glob("spindle.db*")
    }


def test_a_history_of_a_later_version_says_so(store: Store, tmp_path: Path) -> None:
    assert refused(store, tmp_path, manifest({**BODY, "version": 2})).code == "other_version"


def test_more_visits_than_a_bike_has_are_refused(store: Store, tmp_path: Path) -> None:
    full = manifest({**BODY, "visits": [{}] * 1_001})

    assert refused(store, tmp_path, full).code == "visits_full"


def test_a_visit_is_in_a_file_once(store: Store, tmp_path: Path, sound: bytes) -> None:
    first = body_of(sound)["visits"][0]

    twice = with_other_visit(sound, in_visit(token=first["token"]))

    assert refused(store, tmp_path, twice).code == "no_history"


def test_a_list_of_names_that_fills_the_memory_is_not_read(store: Store, tmp_path: Path) -> None:
    end = struct.pack("<HHIIH", 0xFFFF, 0xFFFF, DIRECTORY_BYTES_MAX + 1, 0, 0)
    long = bytes(100) + b"PK\x05\x06" + bytes(4) + end
    large = bytes(100) + b"PK\x06\x07" + bytes(16) + b"PK\x05\x06" + bytes(18)

    assert refused(store, tmp_path, long).code == "too_large"
    assert refused(store, tmp_path, large).code == "too_large"


def other_bytes(sound: bytes, make: Callable[[bytes], bytes]) -> bytes:
    """The sound file with other bytes for the photograph that is read last."""
    files = files_in(sound)
    last = body_of(sound)["visits"][1]["content"]["photos"][0]["sha256"]
    name = f"photos/{last}.jpg"
    return zipped({**files, name: make(files[name])})


def png(_: bytes) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (4, 4)).save(file, "PNG")
    return file.getvalue()


@pytest.mark.parametrize(
    "make",
    [
        lambda _: b"",
        lambda data: data + b"behind it",
        lambda _: drawn_anew(picture(1))[0],
        png,
        lambda _: bytes(5 * 1024 * 1024),
    ],
    ids=["nothing", "more", "another", "a PNG", "too large"],
)
def test_a_photograph_with_other_bytes_is_refused_and_leaves_no_file(
    store: Store, tmp_path: Path, sound: bytes, make: Callable[[bytes], bytes]
) -> None:
    refused(store, tmp_path, other_bytes(sound, make))


def test_flipped_bytes_of_a_history_are_a_fault_of_the_file(
    store: Store, tmp_path: Path, sound: bytes
) -> None:
    visits = visits_on(store)
    for at in range(0, len(sound), max(1, len(sound) // 150)):
        data = bytearray(sound)
        data[at] ^= 0x55
        bike = a_bike(store)
        try:
            brought(visits, bike, bytes(data))
        except (InvalidRequest, Conflict):
            assert visits.list(bike) == ()


def test_names_in_a_file_are_not_kept(store: Store, sound: bytes) -> None:
    """The number of somebody's account elsewhere is somebody else's here."""
    consent = {
        "by": "account",
        "name": "Frau Müller",
        "person_id": 3,
        "at": "2026-05-01T12:00:00Z",
        "content_sha256": "a" * 64,
        "strokes": [[0.1, 0.2]],
    }
    visits, bike = visits_on(store), a_bike(store)

    def named(visit: Body) -> None:
        visit.update(consent=consent)
        visit["content"].update(customer="Frau Müller")

    brought(visits, bike, with_other_visit(sound, named))

    [visit] = [one for one in visits.list(bike) if one.consent and one.consent.by == "account"]
    assert visit.consent is not None
    assert (visit.consent.name, visit.consent.person_id, visit.consent.strokes) == (None, None, ())
    assert (visit.content.customer, visit.consent_holds) == ("", False)


def test_what_is_here_already_is_not_overwritten(
    store: Store, tmp_path: Path, sound: bytes
) -> None:
    visits, bike = visits_on(store), a_bike(store)
    brought(visits, bike, sound)
    before = {one.token: one for one in visits.list(bike)}
    folder = tmp_path / "objects" / "visits"
    files = {path.name: path.read_bytes() for path in folder.iterdir()}

    again = brought(visits, bike, with_other_visit(sound, in_content(complaint="made up")))
    # Its photographs are not even looked for.
    lacking = brought(visits, bike, with_other_visit(sound, in_photo(sha256="0" * 64)))

    assert (again.added, lacking.added) == (0, 0)
    assert {one.token: one for one in visits.list(bike)} == before
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == files


def test_a_disk_that_fails_in_between_leaves_nothing_of_a_history(
    reopen: OpenStore, tmp_path: Path, sound: bytes
) -> None:
    disk = FailingDisk()
    store = reopen(disk)
    visits, bike = visits_on(store), a_bike(store)
    failed = 0
    for number in range(1, 40):
        disk.left = number
        try:
            brought(visits, bike, sound)
        except StoreError:
            failed += 1
            assert visits.list(bike) == ()
            assert files_of_visits(tmp_path / "objects") == []
        else:
            break
    # Two photographs and two visits, each flushed, renamed and its folder flushed.
    assert failed >= 12
    found: tuple[Visit, ...] = visits.list(bike)
    assert len(found) == 2


def test_a_bike_that_would_have_too_many_visits_gets_none(
    store: Store, tmp_path: Path, sound: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.visits.records.VISITS_MAX", 1)

    assert refused(store, tmp_path, sound).code == "visits_full"


def test_a_photograph_that_is_damaged_here_goes_into_no_history(
    store: Store, tmp_path: Path
) -> None:
    visits, bike = visits_on(store), a_bike(store)
    visit = a_closed_visit(visits, bike, photos=1)
    name = f"{visit.token}-{visit.content.photos[0].sha256}.jpg"
    (tmp_path / "objects" / "visits" / name).write_bytes(picture(5))

    with ExitStack() as closing:
        file = closing.enter_context(io.BytesIO())
        with pytest.raises(StoreError):
            visits.write_history(bike, file)
