"""Goal: whatever happens to the database, its rides come back from their own files.

Method: a hundred rides, recorded and imported, with gaps, events, fills and words people wrote; the
database destroyed in each way; after the rebuild every ride is compared with what it was. What only
SQL knew is named in docs/life-of-a-ride.md: the rides' numbers, the uploads' ids, and a ride that
was being recorded.
"""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend import rebuild
from backend.cli import main
from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.filled import Filled
from backend.core.ride import Ride, RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.errors import StoreError
from backend.rebuild import Rebuilt, rebuild_store
from backend.store import Store, Verdict, open_store
from backend.store.filling import Filling
from backend.store.objects import IDENTITY, sidecar_key
from backend.store.upkeep.check import check_store
from tests.unit.conftest import urls
from tests.unit.store.ride_data import STARTED_US

pytestmark = pytest.mark.slow

FLAGS = ChannelSpec("fault_flags", "", 1.0)
CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
    FLAGS,
)
ALTITUDE = ChannelSpec("altitude_m", "m", 0.1, wide=True)
HOUR_US = 3_600_000_000
ROWS = 400


def add_recorded(store: Store, number: int, rows: int = ROWS) -> Ride:
    """A recorded ride with a gap, a fault that came and went, and a unit that knows itself."""
    rng = np.random.default_rng(number)
    counts = rng.integers(0, 3000, (rows, 4)).astype(np.int16)
    counts[:, 3] = 0
    counts[50:70, 3] = 4
    counts[100 : 100 + number % 50] = MISSING_INT16
    context = RideContext(
        "u1",
        f"SP-{number % 3}",
        "mid",
        "1.2",
        7,
        0xFFFF,
        40.34,
        boot_id=number,
        unit_t0_us=5_000,
        unit_key=f"ebl:SP-{number % 3}",
    )
    ride_id = store.rides.start_live(CHANNELS, 10_000, STARTED_US + number * HOUR_US, context)
    store.rides.append_tail(ride_id, 0, counts).result()
    ride = store.rides.finish(ride_id)
    assert ride is not None
    return ride


def add_imported(store: Store, number: int) -> Ride:
    """A ride of a head unit: irregular rows, wide counts, an event that only the log told."""
    data = f"file {number}".encode()
    upload = store.uploads.create(f"evening {number}.fit", len(data), None, 3600)
    store.uploads.append(upload.id, 0, data)
    store.uploads.store_original(upload.id)
    times_us = np.cumsum(np.where(np.arange(ROWS) == 200, 900_000_000, 1_000_000)).astype(np.int64)
    counts = {
        "speed_kmh": np.full(ROWS, number + 100, np.int16),
        "altitude_m": np.arange(ROWS, dtype=np.int32) * 100_000,
    }
    rows = RideRows((CHANNELS[0], ALTITUDE), times_us - times_us[0], counts)
    ride = Ride(
        id=0,
        state="live",
        origin="imported",
        name=f"evening {number}",
        notes="the clock was wrong",
        started_us=STARTED_US + number * HOUR_US,
        row_count=ROWS,
        period_us=None,
        channels=rows.channels,
        derived=(),
        context=RideContext(device_model="Edge"),
        completeness=0.75,
        events=(RideEvent(3.5, "assist_mode", 2),),
    )
    added = store.rides.add(ride, rows, upload.id)
    store.uploads.conclude(upload.id, Verdict("partial", completeness=0.75))
    return added


def fill_some(store: Store, ride: Ride, number: int) -> None:
    """A log gives a ride two rows of its gap."""
    data = f"log {number}".encode()
    upload = store.uploads.create(f"log {number}", len(data), None, 3600)
    store.uploads.append(upload.id, 0, data)
    store.uploads.store_original(upload.id)
    filling = Filling(
        rows_before=10,
        rows_after=0,
        places=np.array([112, 114]),
        counts={"speed_kmh": np.array([500, 600], np.int16)},
        filled=(Filled(1.1, 1.2, 10, 2, 20_000),),
        events=(*ride.events, RideEvent(2.0, "assist_mode", 1)),
    )
    store.rides.fill(ride, filling, upload.id)
    store.uploads.conclude(upload.id, Verdict("complete", "filled", duplicate_of=ride.id))


@pytest.fixture(scope="module")
def hundred(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A closed store with a hundred rides."""
    folder = tmp_path_factory.mktemp("hundred")
    with open_store(*urls(folder)) as store:
        for number in range(100):
            ride = (add_imported if number % 3 == 0 else add_recorded)(store, number)
            if number % 5 == 0:
                store.rides.patch(ride.id, name=f"Hausrunde {number} \u7ebf")
            if number % 10 == 7 and ride.origin == "recorded":
                fill_some(store, ride, number)
            if number % 7 == 0:
                store.rides.patch(ride.id, notes="Gegenwind\nund Regen")
        store.rides.patch(store.rides.list().items[-1].id, name="")
    # The second opening removes what fills replaced.
    open_store(*urls(folder)).close()
    return folder


def all_rides(folder: Path, database: str = "spindle.db") -> list[Any]:
    """Every ride, the oldest first, with rows and overview, without what only SQL can know."""
    found = []
    with open_store(*urls(folder, database)) as store:
        page = store.rides.list(limit=500)
        for ride in reversed(page.items):
            reader = store.rides.reader(ride.id)
            level = reader.level(128)
            assert level is not None
            names = [channel.name for channel in ride.offered]
            counts = reader.counts(names, 0, reader.row_count)
            overview = {name: (level.minimum[name], level.maximum[name]) for name in names}
            rows = {name: column.tobytes() for name, column in counts.items()}
            cells = {name: (a.tobytes(), b.tobytes()) for name, (a, b) in overview.items()}
            upload = store.uploads.get(ride.upload_id) if ride.upload_id else None
            file = upload and (upload.sha256, upload.name, upload.object_key, upload.state)
            found.append((replace(ride, id=0, upload_id=None), rows, cells, file))
    return found


def copied(source: Path, target: Path) -> Path:
    """A copy of a closed store, by hard links where nobody writes."""
    for path in source.rglob("*"):
        if path.is_file():
            new = target / path.relative_to(source)
            new.parent.mkdir(parents=True, exist_ok=True)
            new.write_bytes(path.read_bytes())
    return target


@pytest.mark.parametrize("how", ["missing", "zero", "random", "torn"])
def test_a_hundred_rides_come_back_whatever_happened_to_the_database(
    hundred: Path, tmp_path: Path, how: str
) -> None:
    folder = copied(hundred, tmp_path)
    before = all_rides(folder)
    database = folder / "spindle.db"
    whole = database.read_bytes()
    rest = {"zero": b"", "random": os.urandom(50_000), "torn": whole[:5000] + os.urandom(90_000)}
    identity = json.loads((folder / "objects" / IDENTITY).read_text())["id"]
    if how == "missing":
        database.unlink()
    else:
        database.write_bytes(rest[how])

    report = rebuild_store(*urls(folder))

    assert (report.rides, report.lost_words, report.not_taken) == (100, {}, {})
    assert report.originals_without_ride == []
    assert report.store_id == identity
    assert check_store(*urls(folder)).is_fine
    assert all_rides(folder) == before
    assert check_store(*urls(folder)).is_fine
    assert len(before) == 100
    assert any(ride.filled for ride, *_ in before)
    if how in ("random", "torn"):
        assert Path(report.set_aside[0]).read_bytes() == rest[how]


def test_a_rebuild_is_repeated_without_harm(hundred: Path, tmp_path: Path) -> None:
    folder = copied(hundred, tmp_path)
    before = all_rides(folder)

    report = rebuild_store(*urls(folder))

    assert (report.rides, report.rides_before) == (0, 100)
    assert all_rides(folder) == before


def test_a_rebuild_that_was_interrupted_keeps_the_server_away_and_goes_on(
    hundred: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copied(hundred, tmp_path)
    before = all_rides(folder)
    (folder / "spindle.db").unlink()
    left = 40
    add_stored = rebuild.add_stored

    def torn(*arguments: Any) -> tuple[str, ...]:
        nonlocal left
        left -= 1
        if left == 0:
            raise KeyboardInterrupt
        return add_stored(*arguments)

    with monkeypatch.context() as cut:
        cut.setattr(rebuild, "add_stored", torn)
        with pytest.raises(KeyboardInterrupt):
            rebuild_store(*urls(folder))
    with pytest.raises(StoreError, match="spindle store rebuild"):
        open_store(*urls(folder))
    report = rebuild_store(*urls(folder))

    assert (report.rides_before, report.rides) == (39, 61)
    assert all_rides(folder) == before


def test_a_database_with_something_else_in_it_is_not_filled(hundred: Path, tmp_path: Path) -> None:
    folder = copied(hundred, tmp_path / "one")
    other = tmp_path / "two"
    other.mkdir()
    with open_store(*urls(other)) as store:
        add_recorded(store, 1)
    before = (other / "spindle.db").read_bytes()

    with pytest.raises(StoreError, match="not empty"):
        rebuild_store(f"sqlite:///{other}/spindle.db", urls(folder)[1])

    assert (other / "spindle.db").read_bytes() == before


def test_a_rebuild_beside_a_running_server_is_refused(tmp_path: Path) -> None:
    with open_store(*urls(tmp_path)), pytest.raises(StoreError, match="Another Spindle"):
        rebuild_store(*urls(tmp_path))


def test_damaged_rides_are_told_and_the_others_come_back(hundred: Path, tmp_path: Path) -> None:
    folder = copied(hundred, tmp_path)
    victim = sorted((folder / "objects" / "rides").rglob("*.parquet"))[0]
    data = bytearray(victim.read_bytes())
    data[len(data) // 2] ^= 1
    victim.write_bytes(bytes(data))
    (folder / "spindle.db").unlink()

    report = rebuild_store(*urls(folder))

    assert report.rides == 99
    assert list(report.not_taken) == [victim.relative_to(folder / "objects").as_posix()]


@pytest.mark.parametrize(
    "damage",
    [
        b"{",
        b'{"name": null}',
        b'{"notes": 5}',
        b'{"name": "\\ud800"}',
        b'{"name": "a\\u0000b"}',
        b'{"tags": ["%s"]}' % (b"x" * 41),
        json.dumps({"tags": [f"tag {number}" for number in range(21)]}).encode(),
    ],
)
def test_a_damaged_sidecar_costs_the_words_and_says_so(tmp_path: Path, damage: bytes) -> None:
    with open_store(*urls(tmp_path)) as store:
        ride = add_recorded(store, 1)
        store.rides.patch(ride.id, name="Alps")
    key = str(ride.object_key)
    (tmp_path / "objects" / sidecar_key(key)).write_bytes(damage)
    (tmp_path / "spindle.db").unlink()

    report: Rebuilt = rebuild_store(*urls(tmp_path))

    assert report.rides == 1
    assert sidecar_key(key) in report.lost_words[key]
    with open_store(*urls(tmp_path)) as store:
        assert store.rides.patch(1, name="Alps").name == "Alps"


def test_an_original_that_no_ride_names_is_listed(tmp_path: Path) -> None:
    with open_store(*urls(tmp_path)) as store:
        ride = add_imported(store, 1)
        upload = store.uploads.create("spam.bin", 4, None, 3600)
        store.uploads.append(upload.id, 0, b"spam")
        kept = store.uploads.store_original(upload.id)
        assert ride.upload_id is not None
        named = store.uploads.get(ride.upload_id).object_key
    (tmp_path / "spindle.db").unlink()
    (tmp_path / "objects" / str(named)).unlink()

    report = rebuild_store(*urls(tmp_path))

    assert report.originals_without_ride == [kept.object_key]
    assert report.originals_missing == [named]


def test_the_same_file_is_known_again_after_a_rebuild(tmp_path: Path) -> None:
    with open_store(*urls(tmp_path)) as store:
        ride = add_imported(store, 1)
        assert ride.upload_id is not None
        sha256 = str(store.uploads.get(ride.upload_id).sha256)
    (tmp_path / "spindle.db").unlink()
    rebuild_store(*urls(tmp_path))

    with open_store(*urls(tmp_path)) as store:
        first = store.uploads.first_with(sha256)
        (again,) = store.rides.list().items

    assert first is not None
    assert first.ride_ids == (again.id,)


def test_check_tells_what_is_wrong_and_changes_nothing(
    hundred: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = copied(hundred, tmp_path)
    rides = sorted((folder / "objects" / "rides").rglob("*.parquet"))
    missing, damaged = rides[0], rides[1]
    missing.unlink()
    damaged.write_bytes(b"PAR1")
    stranger = folder / "objects" / "originals" / "00" / ("0" * 64)
    stranger.parent.mkdir(exist_ok=True)
    stranger.write_bytes(b"?")
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    code = main(["store", "check", "--data", str(folder), "--json"])

    found = json.loads(capsys.readouterr().out)
    assert code == 1
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert found["belongs"]
    assert found["database"]["identity"] == found["folder"]["identity"]
    names = [path.relative_to(folder / "objects").as_posix() for path in (missing, damaged)]
    assert found["objects"]["missing"] == [names[0]]
    assert names[1] in [damage["key"] for damage in found["objects"]["damaged"]]
    assert stranger.relative_to(folder / "objects").as_posix() in found["objects"]["unknown"]


def test_check_works_with_a_destroyed_database_and_beside_a_running_server(tmp_path: Path) -> None:
    with open_store(*urls(tmp_path)) as store:
        add_recorded(store, 1)
        beside = check_store(*urls(tmp_path))
        live = store.rides.start_live(CHANNELS, 10_000, STARTED_US, RideContext())
        store.rides.append_tail(live, 0, np.zeros((100, 4), np.int16)).result()
        recording = check_store(*urls(tmp_path))
    (tmp_path / "spindle.db").write_bytes(b"x" * 5000)

    destroyed = check_store(*urls(tmp_path))

    assert beside.is_fine
    assert beside.database.rides == 1
    assert [each.row_count for each in recording.database.live] == [100]
    assert (destroyed.database.state, destroyed.is_fine) == ("damaged", False)
    assert len(destroyed.unknown) == 1


def test_the_command_rebuilds_and_says_what_it_did(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with open_store(*urls(tmp_path)) as store:
        add_recorded(store, 1)
    (tmp_path / "spindle.db").write_bytes(b"")

    code = main(["store", "rebuild", "--data", str(tmp_path)])

    assert code == 0
    assert "1 rides brought back" in capsys.readouterr().out
    assert main(["store", "check", "--data", str(tmp_path)]) == 0
