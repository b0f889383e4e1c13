"""Goal: what was captured is kept whatever happens: one open job of a unit, numbers that are never
used again, a closed job that is a file, in the check, the backup and the rebuild.

Method: a real store in a folder; the disk fails once between file and database.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import pytest

from backend.calibration.records import CalibrationStore
from backend.errors import Conflict, NotFound, ObjectDamaged, StoreError
from backend.rebuild import rebuild_store
from backend.store import Store, backup_of, open_store
from backend.store.discard import calibration_key
from backend.store.objects import Disk
from backend.store.upkeep.check import check_store
from backend.units.records import UnitStore
from tests.fakes.failing_disk import FailingDisk
from tests.unit.conftest import OpenStore, urls
from tests.unit.store.test_a_backup_is_a_store import unpacked

UNIT = "ebl:SP-1"


def same(body: Any) -> Any:
    return body


def captured(store: Store, job_id: int, count: int = 3) -> None:
    for mean in range(count):
        CalibrationStore(store).capture(
            job_id, lambda n, body, mean=mean: ({"number": n, "mean_counts": mean}, body)
        )


def closed(store: Store, unit: str = UNIT) -> int:
    """A job of three captures, the second struck, closed with a certificate of the others."""
    job, _ = CalibrationStore(store).open(unit, "SP mid", {"setup": None}, "Ada")
    captured(store, job.id)
    CalibrationStore(store).strike(job.id, 2, {"reason": "it swung"}, same)
    counted = [
        dict(one.body) for one in CalibrationStore(store).captures(job.id) if one.struck is None
    ]
    CalibrationStore(store).close(
        job.id, lambda body: {**body, "verdict": "pass"}, {"document": {"captures": counted}}
    )
    return job.id


def test_a_unit_has_one_open_job_and_another_unit_its_own(store: Store) -> None:
    first, was_new = CalibrationStore(store).open(UNIT, "SP mid", {"setup": None}, "Ada")
    again, is_new = CalibrationStore(store).open(UNIT, "SP mid", {"setup": 1}, "Ben")
    other, _ = CalibrationStore(store).open("ebl:SP-2", "SP mid", {}, "")

    assert (was_new, is_new) == (True, False)
    assert again == first
    assert (first.author, first.author_proof, other.author_proof) == ("Ada", "stated", None)
    assert first.bike_id == UnitStore(store.database).bike_of(UNIT) or first.bike_id is not None
    assert [job.id for job in CalibrationStore(store).list(model="SP mid")] == [other.id, first.id]
    assert [job.id for job in CalibrationStore(store).list(unit_key=UNIT)] == [first.id]


def test_a_struck_capture_stays_and_its_number_is_not_used_again(
    store: Store, reopen: OpenStore
) -> None:
    job, _ = CalibrationStore(store).open(UNIT, None, {"fit": 1}, "")
    captured(store, job.id)

    CalibrationStore(store).strike(job.id, 3, {"reason": "wrong mass"}, lambda body: {"fit": None})
    CalibrationStore(store).strike(job.id, 3, {"reason": "again"}, same)
    captured(store, job.id, 1)
    store.close()

    kept = CalibrationStore(reopen())
    assert [(one.number, one.struck) for one in kept.captures(job.id)] == [
        (1, None),
        (2, None),
        (3, {"reason": "wrong mass"}),
        (4, None),
    ]
    assert kept.get(job.id).body == {"fit": None}
    with pytest.raises(NotFound):
        kept.strike(job.id, 9, {"reason": ""}, same)


def test_what_a_change_refuses_changes_nothing(store: Store) -> None:
    job, _ = CalibrationStore(store).open(UNIT, None, {"fit": 1}, "")

    def refuse(body: Any) -> Any:
        raise Conflict("not now")

    with pytest.raises(Conflict):
        CalibrationStore(store).change(job.id, refuse)
    with pytest.raises(Conflict):
        CalibrationStore(store).capture(job.id, lambda n, body: refuse(body))

    assert CalibrationStore(store).get(job.id).body == {"fit": 1}
    assert CalibrationStore(store).captures(job.id) == ()


def test_a_closed_job_is_a_file_named_by_its_bytes_and_changes_no_more(store: Store) -> None:
    job_id = closed(store)

    job = CalibrationStore(store).get(job_id)
    data = CalibrationStore(store).file(job)

    assert hashlib.sha256(data).hexdigest() == job.sha256
    document = json.loads(data)
    assert [one["number"] for one in document["document"]["captures"]] == [1, 3]
    assert [one["number"] for one in document["job"]["captures"]] == [2]
    assert document["job"]["body"]["verdict"] == job.body["verdict"] == "pass"
    for refused in (
        lambda: captured(store, job_id),
        lambda: CalibrationStore(store).strike(job_id, 1, {}, same),
        lambda: CalibrationStore(store).close(job_id, same, None),
    ):
        with pytest.raises(Conflict, match="closed"):
            refused()
    # The unit may be calibrated again.
    assert CalibrationStore(store).open(UNIT, None, {}, "")[1]


def test_a_disk_that_fails_while_closing_leaves_the_job_open(
    reopen: OpenStore, tmp_path: Path
) -> None:
    disk = FailingDisk(steps=("flush_folder",))
    store = reopen(disk)
    job, _ = CalibrationStore(store).open(UNIT, None, {}, "")
    captured(store, job.id)
    disk.left = 1
    with pytest.raises(StoreError):
        CalibrationStore(store).close(job.id, same, None)
    store.close()

    again = reopen()
    assert CalibrationStore(again).get(job.id).closed_us is None
    # What the crash left is nobody's and was put aside.
    assert list((tmp_path / "objects" / "calibrations").rglob("*.json")) == []
    CalibrationStore(again).close(job.id, same, None)
    again.close()
    assert check_store(*urls(tmp_path)).is_fine


def test_check_backup_and_rebuild_know_it(store: Store, tmp_path: Path) -> None:
    job_id = closed(store)
    job, captures = CalibrationStore(store).get(job_id), CalibrationStore(store).captures(job_id)
    assert job.sha256 is not None
    file = tmp_path / "objects" / calibration_key(job.sha256)

    with open_store(*unpacked(b"".join(backup_of(store, "1")), tmp_path / "other")) as other:
        assert (
            CalibrationStore(other).file(CalibrationStore(other).get(job_id)) == file.read_bytes()
        )
    store.close()
    assert check_store(*urls(tmp_path)).is_fine

    (tmp_path / "spindle.db").unlink()
    report = rebuild_store(*urls(tmp_path))
    again = rebuild_store(*urls(tmp_path))

    assert (report.calibrations, again.calibrations, report.not_taken) == (1, 0, {})
    with open_store(*urls(tmp_path)) as rebuilt:
        (found,) = CalibrationStore(rebuilt).list()
        assert (found.body, found.author, found.sha256) == (job.body, "Ada", job.sha256)
        assert (found.opened_us, found.closed_us) == (job.opened_us, job.closed_us)
        assert sorted(
            CalibrationStore(rebuilt).captures(found.id), key=lambda one: one.number
        ) == list(captures)
    assert check_store(*urls(tmp_path)).is_fine


def test_a_rebuild_keeps_an_open_job_with_its_captures(store: Store, tmp_path: Path) -> None:
    closed(store)
    job, _ = CalibrationStore(store).open(UNIT, "SP mid", {"setup": None}, "Ada")
    captured(store, job.id)
    CalibrationStore(store).strike(job.id, 2, {"reason": "it swung"}, same)
    CalibrationStore(store).change(job.id, lambda body: {**body, "setup": {"arm_m": 0.17}})
    kept = CalibrationStore(store).get(job.id)
    captures = CalibrationStore(store).captures(job.id)
    store.close()
    assert check_store(*urls(tmp_path)).is_fine

    # The header of the database is overwritten.
    with (tmp_path / "spindle.db").open("r+b") as database:
        database.write(bytes(100))
    report = rebuild_store(*urls(tmp_path))
    again = rebuild_store(*urls(tmp_path))

    assert (report.calibrations, report.calibrations_open, again.calibrations_open) == (
        1,
        1,
        0,
    )
    with open_store(*urls(tmp_path)) as rebuilt:
        found, is_new = CalibrationStore(rebuilt).open(UNIT, None, {}, "Ben")
        assert not is_new
        assert (found.body, found.author, found.opened_us) == (kept.body, "Ada", kept.opened_us)
        assert CalibrationStore(rebuilt).captures(found.id) == captures
        captured(rebuilt, found.id, 1)
        assert CalibrationStore(rebuilt).captures(found.id)[-1].number == 4
        CalibrationStore(rebuilt).close(found.id, same, None)
    assert list((tmp_path / "objects" / "calibrating").iterdir()) == []


def test_a_job_closed_before_its_open_file_went_is_not_open_again(
    reopen: OpenStore, tmp_path: Path
) -> None:
    class Keeping(Disk):
        def remove(self, path: Path) -> None:
            raise OSError("it stays")

    store = reopen(Keeping())
    closed(store)
    store.close()
    (left,) = (tmp_path / "objects" / "calibrating").iterdir()

    (tmp_path / "spindle.db").unlink()
    report = rebuild_store(*urls(tmp_path))

    assert left.is_file()
    assert (report.calibrations, report.calibrations_open, report.stay) == (1, 0, {})


def test_an_open_file_that_cannot_be_read_is_named_and_stays(store: Store, tmp_path: Path) -> None:
    CalibrationStore(store).open(UNIT, None, {}, "")
    store.close()
    (file,) = (tmp_path / "objects" / "calibrating").iterdir()
    file.write_text(file.read_text()[:40])

    (tmp_path / "spindle.db").unlink()
    report = rebuild_store(*urls(tmp_path))

    assert list(report.stay) == [f"calibrating/{file.name}"]
    assert file.is_file()


def test_a_capture_that_cannot_be_written_beside_sql_is_refused_and_not_there(
    reopen: OpenStore,
) -> None:
    disk = FailingDisk(steps=("flush_file",))
    store = reopen(disk)
    job, _ = CalibrationStore(store).open(UNIT, None, {}, "")
    disk.left = 1
    with pytest.raises(StoreError):
        captured(store, job.id, 1)

    assert CalibrationStore(store).captures(job.id) == ()


def test_a_flipped_bit_is_found_and_nothing_of_it_is_sent(store: Store, tmp_path: Path) -> None:
    job = CalibrationStore(store).get(closed(store))
    assert job.sha256 is not None
    file = tmp_path / "objects" / calibration_key(job.sha256)
    data = bytearray(file.read_bytes())
    data[20] ^= 1
    file.write_bytes(data)

    with pytest.raises(ObjectDamaged, match="Restore it"):
        CalibrationStore(store).file(job)
    store.scrub(10**18)

    assert list(store.soundness.damaged) == [calibration_key(job.sha256)]
    assert [one.key for one in check_store(*urls(tmp_path)).damaged] == [
        calibration_key(job.sha256)
    ]
