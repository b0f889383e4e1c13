"""Goal: on PostgreSQL the store keeps, refuses and comes back as it does on SQLite.

Method: a real server, in a cluster of its own, of what `make test` has installed. Connections are
ended from outside, as a restart of the database or a broken line does.
"""

from __future__ import annotations

import logging
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from sqlalchemy import create_engine

import backend.store
from backend.core.actor import Actor, acting
from backend.core.audit import Action, AuditEntry
from backend.errors import StoreError
from backend.rebuild import rebuild_store
from backend.store import open_store
from backend.store.audit import AuditLog, append
from backend.store.sql import advisory
from backend.store.sql.advisory import AdvisoryLock, lock_engine
from backend.store.sql.tables import metadata
from backend.store.upkeep.audit import verify_audit
from backend.store.upkeep.check import check_store
from tests.fakes.postgres import Postgres
from tests.unit.store.ride_data import honest_ride, recording

pytestmark = pytest.mark.slow
ROWS = 300
# Tests look at the lock themselves, so that nothing has to be waited for.
NEVER_S = 3600.0


@pytest.fixture(scope="module")
def cluster() -> Iterator[Postgres]:
    running = Postgres()
    yield running
    running.stop()


@pytest.fixture
def url(cluster: Postgres) -> str:
    return cluster.new_database()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.setattr(advisory, "CHECK_EVERY_S", NEVER_S)
    return (tmp_path / "objects").as_uri()


def lose_lock_connection(cluster: Postgres, url: str) -> None:
    """Ends the session that holds the lock of a database, as a restart does."""
    name = url.rsplit("/", 1)[-1]
    ended = cluster.execute(
        "SELECT pg_terminate_backend(l.pid, 5000) FROM pg_locks l JOIN pg_database d "
        f"ON d.oid = l.database WHERE l.locktype = 'advisory' AND d.datname = '{name}'"
    )
    assert ended == [(True,)]


def test_migrations_and_tables_agree_both_ways(url: str) -> None:
    config = Config()
    folder = Path(backend.store.__file__).parent / "sql" / "migrations"
    config.set_main_option("script_location", str(folder))
    engine = create_engine(url)

    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
        command.downgrade(config, "base")
        command.upgrade(config, "head")
        differences = compare_metadata(MigrationContext.configure(connection), metadata)

    engine.dispose()
    assert differences == []


@pytest.mark.parametrize("encoding", ["SQL_ASCII", "LATIN1"])
def test_a_database_that_cannot_keep_every_name_is_refused(
    cluster: Postgres, folder: str, encoding: str
) -> None:
    with pytest.raises(StoreError, match=f"encoding {encoding}.*ENCODING 'UTF8'"):
        open_store(cluster.new_database(encoding), folder)


def test_a_server_that_vanished_is_noticed_by_every_way_to_write_the_driver(url: str) -> None:
    for written in (url, url.replace("postgresql+psycopg", "postgresql")):
        with lock_engine(written).connect() as connection:
            driver = connection.connection.driver_connection
            assert driver is not None
            assert driver.info.get_parameters()["keepalives_idle"] == "10"


def test_a_ride_is_kept_and_comes_back_into_another_database(
    cluster: Postgres, url: str, folder: str
) -> None:
    with open_store(url, folder) as store:
        ride_id = recording(store)
        store.rides.finish(ride_id)
        kept = store.rides.patch(ride_id, name="Tour")
        rows = store.rides.reader(ride_id).counts(["rider_torque_nm"], 0, ROWS)
    other = cluster.new_database()
    with pytest.raises(StoreError, match="spindle store rebuild") as refusal:
        open_store(other, folder)

    report = rebuild_store(other, folder)

    assert "secret" not in refusal.value.message
    assert report.rides == 1
    assert check_store(other, folder).is_fine
    assert np.array_equal(rows["rider_torque_nm"], honest_ride(ROWS)[:, 2])
    with open_store(other, folder) as store:
        (back,) = store.rides.list().items
    assert replace(back, id=0) == replace(kept, id=0)


def test_a_second_server_is_refused_and_ends_no_ride(url: str, folder: str, tmp_path: Path) -> None:
    with open_store(url, folder) as first:
        ride_id = recording(first)

        with pytest.raises(StoreError, match="Another Spindle is using") as refusal:
            open_store(url, (tmp_path / "others").as_uri())

        first.rides.append_tail(ride_id, ROWS, honest_ride(ROWS)).result()
        ride = first.rides.finish(ride_id)
    assert "secret" not in refusal.value.message
    assert ride is not None
    assert (ride.row_count, ride.cut_short) == (2 * ROWS, False)


def test_the_lock_dies_with_its_process_and_the_ride_is_closed_by_the_next(
    url: str, folder: str
) -> None:
    script = (
        "import sys; from backend.store import open_store\n"
        "from tests.unit.store.ride_data import recording\n"
        "store = open_store(*sys.argv[1:]); recording(store); print('in', flush=True)\n"
        "sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script, url, folder], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == b"in\n"
        with pytest.raises(StoreError, match="Another Spindle is using"):
            open_store(url, folder)
        child.kill()
        child.wait()
    lock = taken_again(url)
    lock.release()

    with open_store(url, folder) as store:
        (ride,) = store.rides.list().items
    assert (ride.state, ride.row_count, ride.cut_short) == ("done", ROWS, True)


def taken_again(url: str) -> AdvisoryLock:
    """The lock once the database has seen that its holder is dead."""
    for _ in range(10_000):
        try:
            return AdvisoryLock(url, NEVER_S)
        except StoreError:
            continue
    raise AssertionError("The lock of a dead process is still held.")


def test_a_lost_lock_is_taken_again_and_the_recording_goes_on(
    cluster: Postgres, url: str, caplog: pytest.LogCaptureFixture
) -> None:
    lock = AdvisoryLock(url, NEVER_S)
    lose_lock_connection(cluster, url)

    with caplog.at_level(logging.WARNING):
        lock.check()
        lock.check()

    with pytest.raises(StoreError, match="Another Spindle is using"):
        AdvisoryLock(url, NEVER_S)
    assert ["lost" in caplog.messages[0], "held again" in caplog.messages[1]] == [True, True]
    assert "secret" not in caplog.text
    lock.release()


def test_a_server_whose_lock_another_took_writes_nothing_any_more(
    cluster: Postgres, url: str, folder: str
) -> None:
    with open_store(url, folder) as first:
        ride_id = recording(first)
        lose_lock_connection(cluster, url)
        # As another server does when it has the lock, reaching the folder from another machine.
        with first.database.engine.begin() as connection:
            connection.exec_driver_sql("UPDATE store_identity SET server_id = 'another'")

        with pytest.raises(StoreError, match="Another Spindle has taken the database"):
            first.rides.append_tail(ride_id, ROWS, honest_ride(ROWS)).result()
        with pytest.raises(StoreError, match="Another Spindle has taken the database"):
            first.rides.finish(ride_id)
        assert first.rides.get(ride_id).row_count == ROWS


def test_many_append_to_one_chain_that_nobody_changes(url: str, folder: str) -> None:
    each, names = 20, ("Anna", "Ben", "Rita")
    with open_store(url, folder) as store:

        def work(name: str) -> None:
            with acting(Actor("person", name)):
                for number in range(each):
                    entry = AuditEntry(Action.BIKE_ADDED, number, after={"name": "Blü"})
                    store.database.write(lambda c, entry=entry: append(c, entry))

        threads = [threading.Thread(target=work, args=(name,)) for name in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for statement in (
            "UPDATE audit_event SET actor_name = 'nobody' WHERE id = 3",
            "DELETE FROM audit_event WHERE id = 3",
            "TRUNCATE audit_event",
            "DELETE FROM audit_head",
        ):
            with pytest.raises(StoreError, match="appended to and never changed"):
                store.database.write(lambda c, one=statement: c.exec_driver_sql(one))

        check = verify_audit(url)

    assert (check.events, check.misfit) == (len(names) * each, None)


def test_a_tampered_event_is_found(url: str, folder: str) -> None:
    with open_store(url, folder) as store:
        log = AuditLog(store.database)
        for number in range(5):
            log.note(AuditEntry(Action.BIKE_ADDED, number))
    engine = create_engine(url)
    with engine.begin() as connection:
        connection.exec_driver_sql("ALTER TABLE audit_event DISABLE TRIGGER ALL")
        connection.exec_driver_sql("UPDATE audit_event SET object_id = '7' WHERE id = 3")
    engine.dispose()

    misfit = verify_audit(url).misfit

    assert misfit is not None
    assert misfit.event_id == 3
