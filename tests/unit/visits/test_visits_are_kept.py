"""Goal: a visit is kept whatever happens: in SQL and as a file, as it was before a step or as it is
after, never half of it; a backup has it and a rebuild brings it back.

Method: a real store in a folder; the disk fails at every step in turn, then the store is opened
again; the database is destroyed and rebuilt from the folder.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select, update

from backend.calibration.types import JobSummary
from backend.errors import Conflict, NotFound, ObjectDamaged, SpindleError, StoreError
from backend.rebuild import rebuild_store
from backend.store import Store, backup_of, open_store
from backend.store.objects import Disk
from backend.store.sql import tables as t
from backend.store.upkeep.check import check_store
from backend.tuning.records import RevisionStore
from backend.visits.records import VisitStore
from backend.visits.service import Visits
from backend.visits.types import VISITS_MAX, Visit, VisitChangeIn, VisitIn
from tests.fakes.failing_disk import EVERY_STEP, FailingDisk
from tests.unit.conftest import OpenStore, urls
from tests.unit.store.test_a_backup_is_a_store import unpacked
from tests.unit.visits.kept_visits import (
    UNIT,
    a_bike,
    a_closed_visit,
    bike_with_unit,
    calibration,
    files_of_visits,
    picture,
    signed,
    visits_on,
)

Step = Callable[[Visits, int], object]


def file_of_visit(folder: Path, visit: Visit) -> dict[str, Any]:
    file = folder / "objects" / "visits" / f"{visit.token}.json"
    body: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return body


def test_what_is_in_sql_is_in_the_file_after_each_step(store: Store, tmp_path: Path) -> None:
    visits, bike = visits_on(store), a_bike(store)

    def seen(visit: Visit) -> dict[str, Any]:
        file = file_of_visit(tmp_path, visit)
        kept = VisitStore(store).get(visit.id)
        assert (file["version"], file["closed_us"]) == (kept.version, kept.closed_us)
        content: dict[str, Any] = file["content"]
        assert content["complaint"] == visit.content.complaint
        assert [one["sha256"] for one in content["photos"]] == [
            one.sha256 for one in visit.content.photos
        ]
        assert (file["consent"] is None) == (visit.consent is None)
        return file

    visit = visits.open(bike, VisitIn(complaint="it bucks"), "Ben")
    assert seen(visit)["bike"] == {"name": "Blue", "model": None, "frame_number": None}
    seen(visits.change(visit.id, VisitChangeIn(version=1, complaint="it bucks uphill")))
    with_photo = visits.add_photo(visit.id, "a.jpg", picture())
    seen(with_photo)
    seen(visits.remove_photo(visit.id, with_photo.content.photos[0].sha256))
    seen(visits.add_photo(visit.id, "b.jpg", picture(1)))
    assert len(files_of_visits(tmp_path / "objects")) == 2
    seen(signed(visits, visit.id))
    seen(visits.close(visit.id))


def test_a_photograph_goes_with_its_visit_and_alone(store: Store, tmp_path: Path) -> None:
    visits, bike, objects = visits_on(store), a_bike(store), tmp_path / "objects"
    visit = visits.open(bike, VisitIn(), "Ben")
    first = visits.add_photo(visit.id, "a.jpg", picture()).content.photos[0]
    again = visits.add_photo(visit.id, "the same.jpg", picture())
    assert [one.name for one in again.content.photos] == ["a.jpg"]
    visits.add_photo(visit.id, "b.jpg", picture(1))

    visits.remove_photo(visit.id, first.sha256)

    with pytest.raises(NotFound):
        visits.photo(visit.id, first.sha256)
    with pytest.raises(NotFound):
        visits.remove_photo(visit.id, first.sha256)
    assert len(files_of_visits(objects)) == 2
    visits.remove(visit.id)
    assert files_of_visits(objects) == []
    with pytest.raises(NotFound):
        visits.get(visit.id)


def test_a_picture_that_is_not_taken_leaves_no_file(store: Store, tmp_path: Path) -> None:
    visits, bike = visits_on(store), a_bike(store)
    visit = visits.open(bike, VisitIn(), "Ben")
    for number in range(20):
        visits.add_photo(visit.id, f"{number}.jpg", picture(10 * number))

    with pytest.raises(Conflict) as full:
        visits.add_photo(visit.id, "more.jpg", picture(255))
    closed = visits.close(visit.id)
    with pytest.raises(Conflict) as over:
        visits.add_photo(visit.id, "late.jpg", picture(254))

    assert (full.value.code, over.value.code) == ("photos_full", "visit_closed")
    assert len(closed.content.photos) == 20
    assert len(files_of_visits(tmp_path / "objects")) == 21


def test_of_a_bike_so_many_visits_are_kept(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("backend.visits.records.VISITS_MAX", 2)
    visits, bike = visits_on(store), a_bike(store)
    for _ in range(2):
        a_closed_visit(visits, bike, photos=0)

    with pytest.raises(Conflict) as full:
        visits.open(bike, VisitIn(), "Ben")

    assert (full.value.code, VISITS_MAX) == ("visits_full", 1_000)
    visits.open(a_bike(store, "Red"), VisitIn(), "Ben")


def test_calibrations_closed_during_a_visit_are_of_it(store: Store) -> None:
    bike = bike_with_unit(store)
    RevisionStore(store.database).append(UNIT, {"pedal_stop_ms": 400})
    jobs: list[JobSummary] = []
    visits = visits_on(store, jobs)
    visit = visits.open(bike, VisitIn(), "Ben")
    opened_us = VisitStore(store).get(visit.id).opened_us
    jobs += [
        calibration(1, opened_us - 1),
        calibration(2, opened_us + 5),
        calibration(3, None),
        calibration(4, opened_us + 6, sha256=None),
    ]

    assert [one.id for one in visits.get(visit.id).content.calibrations] == [2]
    closed = visits.close(visit.id)
    jobs.append(calibration(5, opened_us + 10**12))
    assert visits.get(visit.id).content == closed.content
    [kept] = closed.content.calibrations
    assert (kept.id, kept.sha256, kept.verdict, kept.expanded_nm) == (2, "c" * 64, "pass", 0.76)
    assert (kept.linearity_pct, kept.hysteresis_pct) == (0.25, 0.13)


def opened(visits: Visits, bike_id: int) -> Visit:
    """An open visit with a word and a photograph."""
    visit = visits.open(bike_id, VisitIn(complaint="before", customer="Frau Müller"), "Ben")
    return visits.add_photo(visit.id, "a.jpg", picture())


STEPS: dict[str, Step] = {
    "change": lambda visits, number: visits.change(
        number, VisitChangeIn(version=1, complaint="after", customer="Herr Meier")
    ),
    "close": lambda visits, number: visits.close(number),
    "photo": lambda visits, number: visits.add_photo(number, "b.jpg", picture(1)),
    "remove photo": lambda visits, number: visits.remove_photo(
        number, visits.get(number).content.photos[0].sha256
    ),
    "consent": signed,
    "remove": lambda visits, number: visits.remove(number),
    "open another": lambda visits, number: visits.open(
        visits.get(number).bike_id + 1, VisitIn(complaint="other"), "Ben"
    ),
}
# How many of the disk's steps each may take; the sweep below ends when none is left.
DISK_STEPS_MAX = 12


class Dying(FailingDisk):
    """Nothing reaches the disk any more from its failing step on, as in a power cut."""

    def _step(self, step: str) -> None:
        super()._step(step)
        if self.left < 0 and self.dead:
            raise OSError("no power")

    dead = False

    def remove(self, path: Path) -> None:
        if self.left <= 0 and self.dead:
            raise OSError("no power")
        super().remove(path)


def state_of(store: Store) -> list[Any]:
    """What a store says of all visits."""
    visits = visits_on(store)
    rows = store.database.read(lambda c: c.execute(select(t.visit.c.id)).scalars().all())
    return [
        (one.content.complaint, one.content.customer, one.state, len(one.content.photos),
         one.consent is not None)
        for one in map(visits.get, rows)
    ]  # fmt: skip


@pytest.mark.parametrize("dead", [False, True], ids=["refused once", "power cut"])
@pytest.mark.parametrize("name", STEPS)
def test_a_step_that_fails_leaves_what_was_or_what_is(
    tmp_path: Path, name: str, dead: bool
) -> None:
    """Every photograph that a visit names is there, and no file is left that none names; what a
    rebuild brings is a visit as it was or as it is, with its photographs."""
    failed = 0
    for number in range(1, DISK_STEPS_MAX):
        folder = tmp_path / str(number)
        disk = Dying(steps=EVERY_STEP)
        store = open_store(*urls(folder), disk=disk)
        bike = a_bike(store)
        a_bike(store, "Red")
        visit = opened(visits_on(store), bike)
        before = state_of(store)
        disk.left, disk.dead = number, dead
        try:
            STEPS[name](visits_on(store), visit.id)
        except SpindleError:
            failed += 1
        # A step that was not reached: nothing failed.
        through = disk.left > 0
        store.close()

        disk.left = disk.dead = 0
        with open_store(*urls(folder)) as again:
            after = state_of(again)
            assert_whole(again, folder)
        assert check_store(*urls(folder)).is_fine
        (folder / "spindle.db").unlink()
        rebuild_store(*urls(folder))
        with open_store(*urls(folder)) as rebuilt:
            assert_whole(rebuilt, folder, rebuilt=True)
            brought = state_of(rebuilt)
        if through:
            assert after != before
            break
        complete = done(name, before)
        assert after in (before, complete), (name, number)
        assert brought in (before, complete), (name, number)
    else:
        raise AssertionError("its steps did not end")
    assert failed or name in ("remove", "remove photo")


def done(name: str, before: list[Any]) -> list[Any]:
    """What is known of the visits after a step."""
    [(complaint, customer, state, photos, consented)] = before
    after = {
        "change": [("after", "Herr Meier", state, photos, consented)],
        "close": [(complaint, customer, "closed", photos, consented)],
        "photo": [(complaint, customer, state, 2, consented)],
        "remove photo": [(complaint, customer, state, 0, consented)],
        "consent": [(complaint, customer, state, photos, True)],
        "remove": [],
        "open another": [*before, ("other", "", "open", 0, False)],
    }
    return after[name]


def assert_whole(store: Store, folder: Path, rebuilt: bool = False) -> None:
    """The files of visits are those that visits name; a rebuild removes none of the others."""
    visits = visits_on(store)
    rows = store.database.read(lambda c: c.execute(select(t.visit.c.id)).scalars().all())
    named = []
    for visit in map(visits.get, rows):
        named.append(f"{visit.token}.json")
        for photo in visit.content.photos:
            assert visits.photo(visit.id, photo.sha256)
            named.append(f"{visit.token}-{photo.sha256}.jpg")
    left = store.database.read(lambda c: c.execute(select(t.discarded_object.c.key)).all())
    files = files_of_visits(folder / "objects")
    assert left == []
    assert set(named) <= set(files) if rebuilt else sorted(named) == files


def test_a_file_that_cannot_go_with_its_visit_goes_later(reopen: OpenStore, tmp_path: Path) -> None:
    class Keeping(Disk):
        keeps = True

        def remove(self, path: Path) -> None:
            if self.keeps:
                raise OSError("it stays")
            super().remove(path)

    disk = Keeping()
    store = reopen(disk)
    visits = visits_on(store)
    visit = opened(visits, a_bike(store))
    visits.remove(visit.id)
    assert len(files_of_visits(tmp_path / "objects")) == 2

    disk.keeps = False
    store.sweep(10**18)

    assert files_of_visits(tmp_path / "objects") == []


def test_neither_check_nor_start_takes_the_files_of_visits_for_lost(
    store: Store, reopen: OpenStore, tmp_path: Path
) -> None:
    a_closed_visit(visits_on(store), a_bike(store))
    opened(visits_on(store), a_bike(store, "Red"))
    files = files_of_visits(tmp_path / "objects")
    store.close()

    check = check_store(*urls(tmp_path))
    reopen()

    assert check.is_fine
    assert (check.unknown, check.damaged) == ((), ())
    assert files_of_visits(tmp_path / "objects") == files
    assert not (tmp_path / "objects" / "lost+found").exists()


def test_a_backup_has_visits_and_photographs(store: Store, tmp_path: Path) -> None:
    visits = visits_on(store)
    closed = a_closed_visit(visits, a_bike(store))
    still_open = opened(visits, a_bike(store, "Red"))

    with open_store(*unpacked(b"".join(backup_of(store, "1")), tmp_path / "other")) as other:
        there = visits_on(other)
        for visit in (closed, visits.get(still_open.id)):
            assert there.get(visit.id) == visit
            for photo in visit.content.photos:
                assert there.photo(visit.id, photo.sha256) == visits.photo(visit.id, photo.sha256)


def rebuilt(folder: Path) -> Any:
    (folder / "spindle.db").unlink()
    report = rebuild_store(*urls(folder))
    again = rebuild_store(*urls(folder))
    assert again.visits == 0
    return report


def test_a_rebuild_brings_back_open_and_closed_visits_with_consent_and_photographs(
    store: Store, tmp_path: Path
) -> None:
    visits = visits_on(store)
    blue, red = a_bike(store, frame_number="WBK1"), a_bike(store, "Red")
    a_closed_visit(visits, blue)
    signed(visits, opened(visits, blue).id)
    opened(visits, red)
    before = {one.token: one for bike in (blue, red) for one in visits.list(bike)}
    store.close()

    report = rebuilt(tmp_path)

    assert (report.visits, report.stay, report.not_taken) == (3, {}, {})
    with open_store(*urls(tmp_path)) as there:
        rows = there.database.read(lambda c: c.execute(select(t.visit.c.id)).scalars().all())
        found = {one.token: one for one in map(visits_on(there).get, rows)}
        assert found.keys() == before.keys()
        for token, visit in before.items():
            kept = found[token]
            assert kept.content == visit.content
            assert (kept.consent, kept.consent_holds) == (visit.consent, visit.consent_holds)
            assert (kept.state, kept.bike_name, kept.opened_by) == (
                visit.state,
                visit.bike_name,
                "Ben",
            )
            for photo in kept.content.photos:
                assert visits_on(there).photo(kept.id, photo.sha256)


def test_bikes_of_a_fleet_are_told_apart_by_a_rebuild(store: Store, tmp_path: Path) -> None:
    visits = visits_on(store)
    for number in range(2):
        bike = a_bike(store, "City", f"WBK{number}")
        a_closed_visit(visits, bike, photos=0)
        visits.open(bike, VisitIn(), "Ben")
        # Of these nobody wrote down the frame.
        visits.open(a_bike(store, "Cargo"), VisitIn(), "Ben")
    store.close()

    assert rebuilt(tmp_path).visits == 6

    with open_store(*urls(tmp_path)) as there:
        query = select(t.bike.c.name, t.bike.c.frame_number).order_by(t.bike.c.id)
        bikes = sorted(map(str, there.database.read(lambda c: c.execute(query).all())))
        assert bikes == [
            "('Cargo', None)",
            "('Cargo', None)",
            "('City', 'WBK0')",
            "('City', 'WBK1')",
        ]


def test_changes_after_a_rebuild_are_of_an_open_visit(store: Store, tmp_path: Path) -> None:
    """Configurations are numbered from 1 again."""
    bike = bike_with_unit(store)
    log = RevisionStore(store.database)
    for value in range(5):
        log.append(UNIT, {"pedal_stop_ms": 400 + value})
    assert visits_on(store).open(bike, VisitIn(), "Ben").content.revision_seq == 5
    store.close()

    rebuilt(tmp_path)

    with open_store(*urls(tmp_path)) as there:
        [number] = there.database.read(lambda c: c.execute(select(t.visit.c.id)).scalars().all())
        log = RevisionStore(there.database)
        log.append(UNIT, {"pedal_stop_ms": 404}, state="found")
        changed = [{"name": "pedal_stop_ms", "old": 404, "new": 420}]
        log.append(UNIT, {"pedal_stop_ms": 420}, changed=changed)
        [change] = visits_on(there).close(number).content.changes
        assert (change.old, change.new) == (404, 420)


@pytest.mark.parametrize(
    "change",
    [
        {"content": {}},
        {"content": {"counter_km": "far"}},
        {"content": {"changes": 5}},
        {"consent": {"by": "nobody"}},
        {"token": "../../up"},
        {"opened_us": "1e3"},
        {"opened_us": 10**30},
        {"version": 10**30},
        {"opened_by": "\x00"},
        {"bike": "Blue"},
        {"bike": {"name": 7, "frame_number": ["x"]}},
    ],
    ids=str,
)
def test_a_file_that_somebody_changed_stops_no_rebuild(
    store: Store, tmp_path: Path, change: dict[str, Any]
) -> None:
    visits = visits_on(store)
    spoilt, sound = (a_closed_visit(visits, a_bike(store, name)) for name in ("Blue", "Red"))
    store.close()
    file = tmp_path / "objects" / "visits" / f"{spoilt.token}.json"
    file.write_text(json.dumps(json.loads(file.read_text()) | change))

    report = rebuilt(tmp_path)

    # Without a bike's name it is of a bike without one.
    taken = "bike" in change or change == {"content": {}}
    assert (report.visits, len(report.stay)) == ((2, 0) if taken else (1, 1))
    assert file.is_file()
    assert sound.token


@pytest.mark.parametrize("text", ["", "[]", "{", "[" * 100_000], ids=["", "a list", "cut", "deep"])
def test_a_file_that_is_no_json_is_named_and_stays(store: Store, tmp_path: Path, text: str) -> None:
    visit = a_closed_visit(visits_on(store), a_bike(store))
    store.close()
    file = tmp_path / "objects" / "visits" / f"{visit.token}.json"
    file.write_text(text)

    report = rebuilt(tmp_path)

    assert list(report.stay) == [f"visits/{file.name}"]
    assert file.is_file()


def test_a_flipped_bit_of_a_photograph_is_found_and_nothing_of_it_is_sent(
    store: Store, tmp_path: Path
) -> None:
    visits = visits_on(store)
    visit = a_closed_visit(visits, a_bike(store), photos=1)
    [photo] = visit.content.photos
    file = tmp_path / "objects" / "visits" / f"{visit.token}-{photo.sha256}.jpg"
    data = bytearray(file.read_bytes())
    data[200] ^= 1
    file.write_bytes(data)

    with pytest.raises(ObjectDamaged, match="Restore it"):
        visits.photo(visit.id, photo.sha256)
    file.unlink()
    with pytest.raises(StoreError, match="missing"):
        visits.photo(visit.id, photo.sha256)


def test_a_damaged_row_says_so(store: Store) -> None:
    visits = visits_on(store)
    visit = a_closed_visit(visits, a_bike(store), photos=0)
    spoilt = update(t.visit).values(body={"counter_km": "far"})
    store.database.write(lambda connection: connection.execute(spoilt))

    with pytest.raises(StoreError, match=f"visit {visit.id} is damaged"):
        visits.get(visit.id)
