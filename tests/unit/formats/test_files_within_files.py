"""Goal: a file that holds files gives them up, whatever it is made of, and never more than it may.

Method: archives from Python's own zipfile and gzip, which Spindle's reader of gzip does not use;
hostile ones changed byte by byte.
"""

from __future__ import annotations

import gzip
import io
import json
import random
import struct
import tracemalloc
import zipfile
from pathlib import Path

import pytest

from backend.formats import COMPLETE, PARTIAL, REJECTED, BrokenArchive, Entry, Left, Readers
from backend.formats.containers import archive, gz
from backend.formats.formats import read_file, refused_by_head
from tests.fakes.fit_file import START_S, commute, fit_file
from tests.fakes.zip_file import zipped

RIDE = fit_file(commute(120))


def files_of(data: bytes) -> tuple[list[Entry], Left]:
    found = list(archive.entries(io.BytesIO(data)))
    left = found.pop()
    assert isinstance(left, Left)
    return [entry for entry in found if isinstance(entry, Entry)], left


def codes(data: bytes) -> dict[str, str | None]:
    return {entry.name: entry.code for entry in files_of(data)[0]}


def test_a_gzip_file_is_the_ride_within() -> None:
    for data in (gzip.compress(RIDE), gzip.compress(RIDE[:3000]) + gzip.compress(RIDE[3000:])):
        outcome = read_file("ride.fit.gz", data)

        assert (outcome.state, len(outcome.rides[0].rows.times_us)) == (COMPLETE, 120)


def test_a_gzip_file_that_was_cut_gives_what_came_before_the_cut() -> None:
    data = gzip.compress(fit_file([*commute(3000)]))

    outcome = read_file("ride.fit.gz", data[: len(data) // 2])

    assert outcome.state == PARTIAL
    assert 500 < len(outcome.rides[0].rows.times_us) < 2500
    assert "ends too early" in str(outcome.detail)


def test_a_gzip_file_whose_checksum_is_wrong_is_no_complete_ride() -> None:
    data = bytearray(gzip.compress(RIDE))
    data[-8] ^= 1

    outcome = read_file("ride.fit.gz", bytes(data))

    assert (outcome.state, outcome.code) == (PARTIAL, "container_damaged")
    assert len(outcome.rides[0].rows.times_us) == 120


def test_a_gzip_bomb_is_refused_before_it_is_large() -> None:
    bomb = gzip.compress(b"\x0e" + bytes(gz.INFLATED_BYTES_MAX + 1), 9)

    assert read_file("ride.fit.gz", bomb).code == "expands_too_much"
    assert read_file("ride.gz", gzip.compress(gzip.compress(RIDE))).code == "nested_too_deep"


def test_the_head_of_a_gzip_file_tells_what_is_no_ride() -> None:
    refused = refused_by_head("ride.fit.gz", gzip.compress(b"<html>" + bytes(10_000))[:4096])

    assert refused is not None
    assert refused.code == "unsupported_format"
    assert refused_by_head("ride.fit.gz", gzip.compress(RIDE)[:4096]) is None


def test_a_head_of_nothing_is_refused_and_not_tripped_over() -> None:
    # As the beginning of a gzip file that holds no byte.
    refused = refused_by_head("ride.fit", b"")

    assert refused is not None
    assert refused.code == "unknown_format"


def test_names_from_an_archive_are_only_names(tmp_path: Path) -> None:
    names = ["../../etc/passwd.fit", "/absolute.fit", "C:\\rides\\a.fit", "深/深.fit", "a\x01b.fit"]
    data = zipped(dict.fromkeys(names, RIDE))

    entries, _ = files_of(data)

    assert [entry.data for entry in entries] == [RIDE] * 5
    assert list(tmp_path.iterdir()) == []


def test_two_files_of_one_name_stay_two_whatever_others_are_called() -> None:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as made:
        made.writestr("a.fit (2)", RIDE)
        made.writestr("a.fit", RIDE)
        with pytest.warns(UserWarning, match="Duplicate"):
            made.writestr("a.fit", RIDE[:-1])

    names = [entry.name for entry in files_of(held.getvalue())[0]]
    assert names == ["a.fit (2)", "a.fit", "a.fit (3)"]


def test_an_archive_within_and_its_file_are_each_held_once() -> None:
    size = 16 << 20
    inner = zipped({"a.fit": random.Random(3).randbytes(size)}, zipfile.ZIP_STORED)
    outer = io.BytesIO(zipped({"in.zip": inner}, zipfile.ZIP_STORED))

    tracemalloc.start()
    names = [told.name for told in archive.entries(outer) if isinstance(told, Entry)]
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert names == ["in.zip/a.fit"]
    assert most < 2.5 * size


def test_an_archive_within_is_opened_and_one_within_that_is_not() -> None:
    inner = zipped({"b.fit": RIDE, "c.zip": zipped({"d.fit": RIDE})})

    assert codes(zipped({"a.fit": RIDE, "in.zip": inner})) == {
        "a.fit": None,
        "in.zip/b.fit": None,
        "in.zip/c.zip": "nested_too_deep",
    }


def test_a_file_without_a_name_is_one_like_any_other() -> None:
    nul = zipped({"?.fit": RIDE, "b.fit": RIDE}).replace(b"?.fit", b"\0.fit")

    assert codes(nul) == {"unnamed": None, "b.fit": None}


def test_what_is_no_ride_is_told_file_by_file() -> None:
    data = zipped({"a.fit": RIDE, "b.jpg": b"\xff\xd8\xff\xe0", "c.txt": b"words", "d.fit": b""})

    assert codes(data) == {
        "a.fit": None,
        "b.jpg": "unsupported_format",
        "c.txt": "unknown_format",
        "d.fit": "empty_file",
    }


def test_a_file_with_a_password_is_told_and_the_next_is_read() -> None:
    data = bytearray(zipped({"a.fit": RIDE, "b.fit": RIDE}))
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1

    assert codes(bytes(data)) == {"a.fit": "encrypted", "b.fit": None}


def test_a_bomb_within_an_archive_is_told_and_the_next_is_read() -> None:
    bomb = bytes(40 * 1024 * 1024)

    assert codes(zipped({"a.fit": bomb, "b.fit": RIDE})) == {
        "a.fit": "expands_too_much",
        "b.fit": None,
    }


def test_sizes_that_an_archive_states_of_itself_are_not_believed() -> None:
    data = bytearray(zipped({"a.fit": RIDE, "b.fit": RIDE}))
    at = data.index(b"PK\x01\x02") + 24
    data[at : at + 4] = struct.pack("<I", 0xFFFFFFF0)

    assert codes(bytes(data)) == {"a.fit": "container_damaged", "b.fit": None} or codes(
        bytes(data)
    ) == {"a.fit": None, "b.fit": None}


def test_bounds_of_number_and_of_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    many = zipped({f"{n}.fit": RIDE for n in range(4)})
    monkeypatch.setattr(archive, "TOTAL_BYTES_MAX", 2 * len(RIDE))
    assert list(codes(many).values()) == [None, None, "too_large", "too_large"]

    monkeypatch.setattr(archive, "ENTRIES_MAX", 3)
    with pytest.raises(BrokenArchive, match="4 files"):
        files_of(many)


@pytest.mark.parametrize("streamed", [False, True])
@pytest.mark.parametrize("packing", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_every_whole_file_comes_out_of_an_archive_that_was_cut_anywhere(
    packing: int, streamed: bool
) -> None:
    files = {f"{n}.fit": RIDE[: 2000 + n] for n in range(3)}
    sound = zipped(files, packing, streamed)
    ends = [sound.index(f"{n}.fit".encode()) - 30 for n in (1, 2)] + [sound.index(b"PK\x01\x02")]

    for cut in range(40, len(sound), 97):
        whole = sum(end <= cut for end in ends)
        if not whole:
            with pytest.raises(BrokenArchive, match="no file is whole"):
                files_of(sound[:cut])
            continue
        entries, left = files_of(sound[:cut])

        assert {e.name: e.data for e in entries} == dict(list(files.items())[:whole])
        assert left.error is not None
        assert left.error.code == "truncated"


def test_a_cut_archive_within_gives_what_is_whole_in_it() -> None:
    inner = zipped({"a.fit": RIDE, "b.fit": RIDE})
    cut_outside = zipped({"in.zip": inner}, zipfile.ZIP_STORED)[: len(inner) - 200]

    assert codes(zipped({"in.zip": inner[:-60], "c.fit": RIDE})) == {
        "in.zip/a.fit": None,
        "in.zip/b.fit": None,
        "in.zip": "truncated",
        "c.fit": None,
    }
    assert [name.rpartition("/")[2] for name in codes(cut_outside)] == ["a.fit"]


def test_an_archive_of_which_nothing_is_whole_says_so() -> None:
    with pytest.raises(BrokenArchive) as broken:
        files_of(zipped({"a.fit": RIDE})[:1000])

    outcome = broken.value.outcome
    assert (outcome.state, outcome.code) == (REJECTED, "container_damaged")


def test_no_flipped_byte_makes_an_archive_raise_anything_else() -> None:
    sound = zipped({"a.fit": RIDE[:400], "activities.csv": b"x", "in.zip": zipped({"b": b"c"})})
    dice = random.Random(11)

    for _ in range(400):
        data = bytearray(sound[: dice.choice((len(sound), -30))])
        for _ in range(dice.randint(1, 4)):
            data[dice.randrange(len(data))] = dice.randrange(256)
        try:
            files_of(bytes(data))
        except BrokenArchive:
            continue


STRAVA = """Activity ID,Activity Date,Activity Name,Activity Type,Activity Description,Filename
7,"Nov 14, 2023, 10:13:20 PM","Canal, home",Ride,"Wind from the west,
and rain",activities/7.fit.gz
8,"Nov 15, 2023, 10:13:20 PM",Pool,Swim,,
"""
GERMAN = """Aktivitäts-ID,Aktivitätsdatum,Name der Aktivität,Aktivitätsart,Beschreibung,Dateiname
7,14.11.2023,Kanal,Radfahrt,Wind,activities/7.fit.gz
"""


@pytest.mark.parametrize(
    ("table", "told"),
    [
        (STRAVA, ("Canal, home", "Wind from the west,\nand rain")),
        (GERMAN, ("Kanal", "Wind")),
    ],
)
def test_strava_s_export_names_its_rides_and_leaves_photos_alone(
    table: str, told: tuple[str, str]
) -> None:
    data = zipped(
        {
            "export_1/activities.csv": table.encode(),
            "export_1/activities/7.fit.gz": gzip.compress(RIDE),
            "export_1/media/1.jpg": b"\xff\xd8\xff",
            "export_1/messages.json": b"{}",
        }
    )

    entries, left = files_of(data)

    assert [(entry.name, entry.code) for entry in entries] == [
        ("export_1/activities/7.fit.gz", None)
    ]
    assert left.titles.by_name == {"export_1/activities/7.fit.gz": told}
    assert left.left_alone == 3


def test_garmin_s_export_has_its_rides_in_an_inner_archive_and_names_beside() -> None:
    summary = [
        {
            "summarizedActivitiesExport": [
                {"activityId": 1, "name": "Evening", "beginTimestamp": START_S * 1000.0},
                {"activityId": 2, "name": None, "beginTimestamp": 1},
                "nonsense",
            ]
        }
    ]
    data = zipped(
        {
            "DI_CONNECT/DI-Connect-Fitness/a_0_summarizedActivities.json": json.dumps(
                summary
            ).encode(),
            "DI_CONNECT/DI-Connect-Uploaded-Files/UploadedFiles_0-_Part1.zip": zipped(
                {"a_1.fit": RIDE}
            ),
            "DI_CONNECT/DI-Connect-User/user.json": b"{}",
        }
    )

    entries, left = files_of(data)

    assert [entry.name.rsplit("/", 1)[-1] for entry in entries] == ["a_1.fit"]
    assert left.titles.by_start_us == ((START_S * 1_000_000, "Evening", ""),)
    assert left.left_alone == 2


@pytest.mark.slow
def test_the_child_gives_the_same_files_as_opening_it_here(tmp_path: Path) -> None:
    data = zipped({"a.fit": RIDE, "b.txt": b"words", "in.zip": zipped({"c.fit": RIDE})})
    path = tmp_path / "object"
    path.write_bytes(data)
    readers = Readers()

    there = list(readers.unpack(path))
    again = readers.read(path.with_name("object"), "x.fit")
    path.write_bytes(data[:-30])
    cut = list(readers.unpack(path))
    path.write_bytes(data[:60])
    with pytest.raises(BrokenArchive, match="is gone"):
        list(readers.unpack(path))
    readers.stop()

    assert there == list(archive.entries(io.BytesIO(data)))
    assert cut == list(archive.entries(io.BytesIO(data[:-30])))
    assert again.code == "unsupported_format"
    assert readers.begun == 1
