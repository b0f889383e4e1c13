"""Goal: a table that does not say its units and zone is read as its owner says, who says it once
for all files with its header; a database made anew still knows it.

Method: the real store and the real reader, in this process; tables written here.
"""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import pytest

from backend.core.person import Sender
from backend.errors import Conflict, InvalidRequest, NotFound
from backend.formats.outcome import Outcome
from backend.formats.questions import TableAnswer
from backend.imports.mapping import TableMapping
from backend.imports.service import Uploads
from backend.rebuild import rebuild_store
from backend.store import Store, Upload, open_store
from backend.store.upkeep.backup import backup_of
from tests.fakes.fit_file import commute, fit_file
from tests.unit.imports.conftest import reader

SAID = {"time_zone": "Europe/Dublin", "units": {"speed": "m/s"}, "rows_per_second": None}


def table(day: int) -> bytes:
    rows = "".join(f"2023-07-{day:02}T09:04:{s:02},5.0,{70 + s}\n" for s in range(30))
    return f"timestamp,speed,cadence\n{rows}".encode()


def test_an_answer_reads_every_file_that_waited_for_it_and_those_that_come(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    first, second = (uploads.receive_file(f"{day}.csv", table(day)) for day in (1, 2))
    assert (first.state, first.code, first.ride_ids) == ("rejected", "needs_mapping", ())
    asked = mapping.question(first.id)
    assert (asked["time_zone"], asked["answer"]) == (True, None)

    became = mapping.say(first.id, SAID)

    assert became.state == "complete"
    (ride_id,) = became.ride_ids
    ride = store.rides.get(ride_id)
    assert ride.summary is not None
    assert ride.summary.speed_kmh_max == pytest.approx(18.0)
    # 09:04 of a summer's day in Dublin.
    assert ride.started_us == 1_688_198_640 * 1_000_000
    assert ride.intake is not None
    assert ride.intake.taken_as == {"speed": "m/s", "time_zone": "Europe/Dublin"}
    uploads.recover()
    assert uploads.get(second.id).state == "complete"
    assert uploads.receive_file("3.csv", table(3)).state == "complete"


def test_an_answer_waits_for_no_other_file_and_leaves_other_tables_alone(store: Store) -> None:
    read: list[str] = []

    def read_and_note(path: Path, name: str, *, table_answer: TableAnswer | None = None) -> Outcome:
        read.append(name)
        if name == "broken.csv" and read.count(name) > 1:
            raise OSError("a disk that is gone")
        return reader(path, name, table_answer=table_answer)

    uploads = Uploads(store, reader=read_and_note)
    other = uploads.receive_file("other.csv", table(1).replace(b"cadence", b"power"))
    broken = uploads.receive_file("broken.csv", table(2))
    asked = uploads.receive_file("asked.csv", table(3))

    became = TableMapping(store, uploads).say(asked.id, SAID)
    uploads.close()

    assert (became.state, len(became.ride_ids)) == ("complete", 1)
    assert read.count("other.csv") == 1
    assert uploads.get(other.id).code == "needs_mapping"
    assert uploads.get(broken.id).state == "queued"


def test_an_answer_that_lacks_something_changes_nothing(
    uploads: Uploads, mapping: TableMapping
) -> None:
    upload = uploads.receive_file("1.csv", table(1))

    for wrong in ({}, {**SAID, "time_zone": "Mars/Base"}, {**SAID, "units": {"speed": "knots"}}):
        with pytest.raises(InvalidRequest) as refused:
            mapping.say(upload.id, wrong)
        assert refused.value.fields
    assert uploads.get(upload.id).code == "needs_mapping"
    assert mapping.answered_tables() == {"items": []}


def test_what_a_rider_says_is_for_the_files_they_send(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    hers, his = ((f"{day}.csv", table(day)) for day in (1, 2))
    rita, olaf = Sender(owner_id=4), Sender(owner_id=5)
    asked = [uploads.receive_file(*hers, rita), uploads.receive_file(*his, olaf)]
    asked.append(uploads.receive_file(*hers))

    became = mapping.say(asked[0].id, SAID)

    assert became.state == "complete"
    assert store.rides.get(became.ride_ids[0]).owner_id == rita.owner_id
    uploads.recover()
    assert [uploads.get(one.id).code for one in asked[1:]] == ["needs_mapping"] * 2
    assert uploads.receive_file("3.csv", table(3), rita).state == "complete"
    assert uploads.receive_file("3.csv", table(3), olaf).code == "needs_mapping"
    assert mapping.question(asked[1].id)["answer"] is None
    assert mapping.answered_tables() == {"items": []}
    # Another answer of hers reads her files anew, and still no other.
    mapping.say(asked[0].id, {**SAID, "time_zone": "Europe/Berlin"}, read_again=True)
    uploads.recover()
    assert store.rides.get(became.ride_ids[0]).started_us == 1_688_195_040 * 1_000_000
    assert [uploads.get(one.id).code for one in asked[1:]] == ["needs_mapping"] * 2


def test_only_a_file_that_is_asked_about_can_be_answered(
    uploads: Uploads, mapping: TableMapping
) -> None:
    other = uploads.receive_file("x.txt", b"no ride at all")

    with pytest.raises(Conflict):
        mapping.question(other.id)
    with pytest.raises(NotFound):
        mapping.say("0" * 32, SAID)


def test_what_was_said_can_be_forgotten_and_is_asked_again(
    uploads: Uploads, mapping: TableMapping
) -> None:
    mapping.say(uploads.receive_file("1.csv", table(1)).id, SAID)
    (known,) = mapping.answered_tables()["items"]  # type: ignore[misc]
    assert known["columns"] == ("timestamp", "speed", "cadence")

    mapping.forget(known["header_sha256"])

    assert uploads.receive_file("2.csv", table(2)).code == "needs_mapping"
    with pytest.raises(NotFound):
        mapping.forget(known["header_sha256"])
    with pytest.raises(NotFound):
        mapping.forget("../../spindle-store")


def test_a_database_made_anew_and_a_backup_still_know_it(tmp_path: Path) -> None:
    urls = f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects"
    with open_store(*urls) as store:
        uploads = Uploads(store, reader=reader)
        upload = uploads.receive_file("1.csv", table(1))
        TableMapping(store, uploads).say(upload.id, SAID)
        saved = b"".join(backup_of(store, "test"))
    (tmp_path / "db").unlink()

    rebuild_store(*urls)

    assert b"objects/tables/" in saved
    with open_store(*urls) as store:
        uploads = Uploads(store, reader=reader)
        assert uploads.receive_file("2.csv", table(2)).state == "complete"
        (ride,) = [
            r for r in store.rides.list(limit=9).items if r.started_us < 1_688_250_000 * 10**6
        ]
        assert ride.intake is not None
        assert ride.intake.taken_as["speed"] == "m/s"


def test_tables_within_an_archive_wait_and_are_asked_each_for_itself(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as made:
        made.writestr("ride.fit", fit_file(commute(60)))
        for day in (4, 5):
            made.writestr(f"{day}.csv", table(day))
        made.writestr("mph.csv", table(6).replace(b"speed", b"velocity"))

    sent = uploads.receive_file("season.zip", held.getvalue())

    assert (sent.state, sent.code) == ("partial", "part_asks")
    assert "3 waiting for what only their owner knows" in str(sent.detail)
    parts = {part.name: part for part in store.uploads.parts(sent.id)}
    assert mapping.question(parts["4.csv"].id)["time_zone"] is True

    mapping.say(parts["4.csv"].id, SAID)
    of_both = judged(uploads, sent.id)

    # Of one header both are read; the other is still asked about.
    assert len(of_both.ride_ids) == 3
    assert (of_both.state, of_both.code) == ("partial", "part_asks")
    mapping.say(parts["mph.csv"].id, {**SAID, "units": {"velocity": "mph"}})
    whole = judged(uploads, sent.id)
    assert (whole.state, whole.code) == ("complete", None)
    assert str(whole.detail) == "4 files: 4 read completely."
    assert len(whole.ride_ids) == 4


def test_an_archive_of_tables_alone_waits_too(uploads: Uploads, store: Store) -> None:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as made:
        made.writestr("1.csv", table(1))

    sent = uploads.receive_file("one.zip", held.getvalue())

    assert (sent.state, sent.code, sent.ride_ids) == ("rejected", "part_asks", ())


def judged(uploads: Uploads, upload_id: str) -> Upload:
    """An upload when nothing of it is read any more."""
    uploads.recover()
    return uploads.get(upload_id)
