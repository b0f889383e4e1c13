"""Goal: in a bucket the store keeps, refuses and comes back as it does in a folder; a bucket that
refuses, is slow, or is not there loses nothing and leaves nothing half.

Method: moto's S3 in a process of its own, behind a gate that answers itself where a test wants it.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from backend.core.ride import RideContext
from backend.errors import InvalidRequest, ObjectsAway, StoreError
from backend.rebuild import rebuild_store
from backend.store import Store, open_store
from backend.store.bucket import BucketObjects, bucket_place
from backend.store.objects import content_key
from backend.store.upkeep.backup import backup_of, place_of
from backend.store.upkeep.check import check_store
from tests.fakes.s3 import KEYS, Gate, S3Server, keys_in
from tests.unit.store.ride_data import CHANNELS, PERIOD_US, STARTED_US, honest_ride

pytestmark = pytest.mark.slow
ROWS = 3_000


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[S3Server]:
    running = S3Server(tmp_path_factory.mktemp("s3") / "log")
    yield running
    running.stop()


@pytest.fixture
def gate(server: S3Server, monkeypatch: pytest.MonkeyPatch) -> Iterator[Gate]:
    for name, value in KEYS.items():
        monkeypatch.setenv(name, value)
    opened = Gate(server)
    yield opened
    opened.close()


@pytest.fixture
def url(server: S3Server, gate: Gate) -> str:
    return f"s3://{server.new_bucket()}/shop?endpoint={gate.url}"


@pytest.fixture
def database(tmp_path: Path) -> str:
    return f"sqlite:///{tmp_path}/spindle.db"


def recorded(store: Store) -> int:
    rows = honest_ride(ROWS)
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext())
    for start in range(0, ROWS, 100):
        store.rides.append_tail(ride_id, start, rows[start : start + 100]).result()
    store.rides.end(ride_id, cut_short=False)
    return ride_id


def rows_of(store: Store, ride_id: int) -> np.ndarray:
    names = [channel.name for channel in CHANNELS]
    counts = store.rides.reader(ride_id).counts(names, 0, ROWS)
    return np.stack([counts[name] for name in names], axis=1)


def test_a_ride_is_in_the_bucket_before_its_row_says_so(
    server: S3Server, url: str, database: str, tmp_path: Path
) -> None:
    with open_store(database, url, tmp_path / "copies") as store:
        ride_id = recorded(store)
        ride = store.rides.finish(ride_id)
        assert ride is not None
        assert ride.object_key in keys_in(server, url)
        assert place_of(store).free_bytes is None
    # Another machine has no copies.
    with open_store(database, url, tmp_path / "others") as store:
        assert np.array_equal(rows_of(store, ride_id), honest_ride(ROWS))
    assert check_store(database, url, tmp_path / "others").is_fine


def test_a_lost_database_is_rebuilt_from_the_bucket(
    url: str, database: str, tmp_path: Path
) -> None:
    with open_store(database, url, tmp_path / "copies") as store:
        store.rides.finish(recorded(store))
    (tmp_path / "spindle.db").unlink()
    report = rebuild_store(database, url, tmp_path / "new")
    assert report.rides == 1
    with open_store(database, url, tmp_path / "new") as store:
        (ride,) = store.rides.list().items
        assert np.array_equal(rows_of(store, ride.id), honest_ride(ROWS))


def test_nothing_is_called_missing_while_the_bucket_does_not_answer(
    gate: Gate, url: str, database: str, tmp_path: Path
) -> None:
    with open_store(database, url, tmp_path / "copies") as store:
        store.rides.finish(recorded(store))
        ride_id = store.rides.list().items[0].id

    def away_for(word: str) -> Callable[[str, str], int | None]:
        return lambda method, path: 503 if word in path else None

    others = tmp_path / "others"
    with open_store(database, url, others) as store:
        gate.meddle = away_for("rides/")
        with pytest.raises(ObjectsAway):
            store.rides.reader(ride_id)
        with pytest.raises(ObjectsAway):
            list(backup_of(store, "0"))
    for word in ("rides/", "spindle-store.json"):
        gate.meddle = away_for(word)
        with pytest.raises(ObjectsAway):
            check_store(database, url, others)
    lost = f"sqlite:///{tmp_path}/lost.db"
    for word in ("spindle-store.json", ".parquet", "calibrations"):
        gate.meddle = away_for(word)
        with pytest.raises(ObjectsAway):
            rebuild_store(lost, url, others)
    gate.meddle = away_for("nothing")
    assert rebuild_store(lost, url, others).rides == 1
    assert check_store(lost, url, others).is_fine


@pytest.mark.parametrize("status", [500, 503])
def test_a_bucket_that_fails_loses_no_ride(
    server: S3Server, gate: Gate, url: str, database: str, tmp_path: Path, status: int
) -> None:
    with open_store(database, url, tmp_path / "copies") as store:
        ride_id = recorded(store)
        gate.meddle = lambda method, path: status if method in ("PUT", "POST") else None
        before = len(gate.requests)
        with pytest.raises(StoreError) as refused:
            store.rides.finish(ride_id)
        assert refused.value.code == "objects_unreachable"
        assert [fault.code for fault in store.watch.troubles] == ["objects_unreachable"]
        assert not any("rides/" in key for key in keys_in(server, url))
        tries = [one for one in gate.requests[before:] if one[0] in ("PUT", "POST")]
        assert 1 < len(tries) <= 12, "tried again, with a bound"
        gate.meddle = lambda method, path: None
        ride = store.rides.finish(ride_id)
        assert ride is not None
        assert ride.object_key in keys_in(server, url)
        assert np.array_equal(rows_of(store, ride_id), honest_ride(ROWS))


def test_one_failure_in_between_is_not_seen(
    gate: Gate, url: str, database: str, tmp_path: Path
) -> None:
    failed: set[tuple[str, str]] = set()

    def once(method: str, path: str) -> int | None:
        """Each request fails the first time."""
        if (method, path) in failed:
            return None
        failed.add((method, path))
        return 503

    gate.meddle = once
    with open_store(database, url, tmp_path / "copies") as store:
        assert store.rides.finish(recorded(store)) is not None
        assert store.watch.troubles == ()


def test_a_large_file_that_breaks_off_is_no_object(
    server: S3Server, gate: Gate, url: str, tmp_path: Path
) -> None:
    objects = BucketObjects(bucket_place(url), tmp_path / "copies")
    objects.prepare()
    staged = objects.stage()
    staged.write_bytes(bytes(20 << 20))
    parts = 0

    def third_part(method: str, path: str) -> int | None:
        nonlocal parts
        parts += "partNumber" in path
        return 500 if "partNumber" in path and parts > 1 else None

    gate.meddle = third_part
    key = content_key("originals", "ab" * 32)
    with pytest.raises(StoreError):
        objects.publish(staged, key)
    assert parts > 1
    assert staged.exists()
    assert key not in keys_in(server, url)
    gate.meddle = lambda method, path: None
    objects.publish(staged, key)
    assert key in keys_in(server, url)
    assert objects.local_path(key).stat().st_size == 20 << 20


def test_an_object_that_is_missing_is_told_from_a_bucket_that_does_not_answer(
    gate: Gate, url: str, tmp_path: Path
) -> None:
    objects = BucketObjects(bucket_place(url), tmp_path / "copies")
    objects.prepare()
    key = content_key("originals", "cd" * 32)
    assert objects.find(key) is None
    gate.meddle = lambda method, path: 503
    with pytest.raises(StoreError, match="does not answer"):
        objects.find(key)
    assert objects.here(key) is None


def test_a_server_that_is_gone_or_says_nothing_does_not_answer(
    gate: Gate, database: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.store.bucket.REQUEST_TIMEOUT_S", 0.3)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        for port in (1, silent.getsockname()[1]):
            with pytest.raises(ObjectsAway, match="does not answer") as away:
                open_store(database, f"s3://b?endpoint=http://127.0.0.1:{port}", tmp_path / "c")
            assert away.value.code == "objects_unreachable"


def test_copies_that_nobody_opened_lately_make_room(url: str, tmp_path: Path) -> None:
    objects = BucketObjects(bucket_place(url), tmp_path / "copies", cache_bytes=2_500)
    objects.prepare()
    keys = [content_key("originals", f"{number:02x}" * 32) for number in range(4)]
    for age_s, key in zip((4_000, 3_000, 2_000, 0), keys, strict=True):
        staged = objects.stage()
        staged.write_bytes(bytes(1_000))
        objects.publish(staged, key)
        path = objects.here(key)
        assert path is not None
        at_s = path.stat().st_mtime - age_s
        os.utime(path, (at_s, at_s))
    staged = objects.stage()
    staged.write_bytes(bytes(10))
    objects.publish(staged, content_key("originals", "ef" * 32))
    assert [objects.here(key) is not None for key in keys] == [False, False, True, True]
    # Only the copy went.
    assert objects.local_path(keys[0]).stat().st_size == 1_000


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ("s3://AKIA17:hunter2@bucket/prefix", "environment"),
        ("s3:///prefix", "names no bucket"),
        ("s3://bucket/?colour=red", "colour"),
        ("s3://bucket/?endpoint=shop", "no address"),
        ("ftp://bucket", "ftp"),
    ],
)
def test_a_url_that_is_none_is_refused_without_its_keys(
    database: str, tmp_path: Path, wrong: str, says: str
) -> None:
    with pytest.raises(InvalidRequest, match=says) as refused:
        open_store(database, wrong, tmp_path / "copies")
    assert "hunter2" not in refused.value.message


def test_a_bucket_that_is_not_there_is_named(gate: Gate, database: str, tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="no bucket nowhere"):
        open_store(database, f"s3://nowhere?endpoint={gate.url}", tmp_path / "copies")


def test_keys_that_are_refused_are_named_and_not_shown(
    gate: Gate, url: str, database: str, tmp_path: Path
) -> None:
    gate.meddle = lambda method, path: 403
    with pytest.raises(StoreError) as refused:
        open_store(database, url, tmp_path / "copies")
    assert refused.value.code == "objects_refused"
    assert not any(secret in refused.value.message for secret in KEYS.values())
