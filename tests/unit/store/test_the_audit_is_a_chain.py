"""Goal: an event of the audit that is changed, removed, moved or put in is found, and named.

Method: a chain in a real store; then the file is written to by the database's own library, with the
triggers taken away, as somebody with the folder could. The hash is made once more here, by what the
store's docstring says of its bytes. A process is killed in the middle of its changes.
"""

from __future__ import annotations

import hashlib
import json
import signal
import sqlite3
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import Connection, insert, select

from backend.core.actor import Actor, acting
from backend.core.audit import Action, AuditEntry, differing
from backend.errors import NotFound, StoreError
from backend.store import Store
from backend.store.audit import GENESIS, VALUE_LENGTH_MAX, AuditLog, append
from backend.store.sql import tables as t
from backend.store.upkeep.audit import ChainCheck, verify_audit
from tests.fakes.command import spindle

ROOT = Path(__file__).resolve().parents[3]
ANNA = Actor("person", "Anna", 1)
EVENTS = 5
TRIGGERS = ("no_update", "no_delete", "no_replace")

Tampering = Callable[[sqlite3.Connection], None]


def entry(number: int) -> AuditEntry:
    before, after = differing({"motor_torque_nm_max": 80.0}, {"motor_torque_nm_max": 60 + number})
    return AuditEntry(Action.CONFIGURATION_WRITTEN, number, "Blue", before, after, "it bucked")


def url_of(store: Store) -> str:
    return store.database.engine.url.render_as_string(hide_password=False)


def fill(store: Store, count: int = EVENTS) -> None:
    with acting(ANNA):
        for number in range(1, count + 1):
            AuditLog(store.database).note(entry(number))


def rows_of(store: Store) -> list[dict[str, Any]]:
    query = select(t.audit_event).order_by(t.audit_event.c.id)
    return store.database.read(lambda c: [dict(row._mapping) for row in c.execute(query)])


def tampered(store: Store, work: Tampering) -> ChainCheck:
    """What a check finds after somebody wrote to the file past the triggers."""
    path = str(store.database.engine.url.database)
    with sqlite3.connect(path) as file:
        for name in TRIGGERS:
            file.execute(f"DROP TRIGGER audit_event_{name}")
        work(file)
    file.close()
    return verify_audit(url_of(store))


def test_a_chain_of_which_nothing_was_changed_fits(store: Store) -> None:
    fill(store)

    rows = rows_of(store)
    check = verify_audit(url_of(store), rows[2]["sha256"])

    assert (check.events, check.misfit, check.expected_id) == (EVENTS, None, 3)
    assert check.head_sha256 == rows[-1]["sha256"]
    assert [row["id"] for row in rows] == [1, 2, 3, 4, 5]
    assert {(row["actor_kind"], row["actor_name"], row["actor_id"]) for row in rows} == {
        ("person", "Anna", 1)
    }


def test_the_hash_is_of_the_bytes_that_are_described(store: Store) -> None:
    with acting(Actor("key", "Zoë", 7, "torque 日")):
        AuditLog(store.database).note(entry(1))

    [row] = rows_of(store)
    stated = row.pop("sha256")
    plain = json.dumps(row, sort_keys=True, separators=(",", ":"), ensure_ascii=True)

    assert hashlib.sha256(plain.encode("ascii")).hexdigest() == stated
    assert '"actor_name":"Zo\\u00eb"' in plain
    assert row["previous_sha256"] == GENESIS
    assert row["before"] == '{"motor_torque_nm_max":80.0}'
    assert all(isinstance(value, int | str | None) for value in row.values())


def test_an_empty_chain_fits_too(store: Store) -> None:
    assert verify_audit(url_of(store)) == ChainCheck(0, GENESIS, None, None)


def set_column(name: str, value: object) -> Tampering:
    return lambda file: file.execute(f"UPDATE audit_event SET {name} = ? WHERE id = 3", (value,))


@pytest.mark.parametrize("name", [c.name for c in t.audit_event.columns if c.name != "id"])
def test_a_changed_member_is_found_at_its_event(store: Store, name: str) -> None:
    fill(store)
    is_number = name in ("at_us", "actor_id", "bike_id")

    check = tampered(store, set_column(name, 4711 if is_number else "x"))

    assert check.misfit is not None
    assert (check.misfit.event_id, check.events) == (3, 2)


def removed(file: sqlite3.Connection) -> None:
    file.execute("DELETE FROM audit_event WHERE id = 3")


def removed_and_closed_up(file: sqlite3.Connection) -> None:
    removed(file)
    for number in (4, 5):
        file.execute("UPDATE audit_event SET id = ? WHERE id = ?", (number - 1, number))


def swapped(file: sqlite3.Connection) -> None:
    for old, new in ((3, 99), (4, 3), (99, 4)):
        file.execute("UPDATE audit_event SET id = ? WHERE id = ?", (new, old))


def put_in(file: sqlite3.Connection) -> None:
    """Somebody else's event in place of the third, with a hash that is right by itself."""
    file.execute("UPDATE audit_event SET id = id + 100 WHERE id >= 3")
    file.execute("UPDATE audit_event SET id = id - 99 WHERE id >= 103")
    file.row_factory = sqlite3.Row
    made = dict(file.execute("SELECT * FROM audit_event WHERE id = 2").fetchone())
    made |= {"id": 3, "previous_sha256": made.pop("sha256"), "actor_name": "nobody"}
    plain = json.dumps(made, sort_keys=True, separators=(",", ":"))
    made["sha256"] = hashlib.sha256(plain.encode()).hexdigest()
    marks = ", ".join(f":{name}" for name in made)
    file.execute(f"INSERT INTO audit_event ({', '.join(made)}) VALUES ({marks})", made)


@pytest.mark.parametrize(
    ("work", "event_id"),
    [(removed, 3), (removed_and_closed_up, 3), (swapped, 3), (put_in, 4)],
)
def test_an_event_that_is_gone_moved_or_foreign_is_found(
    store: Store, work: Tampering, event_id: int
) -> None:
    fill(store)

    check = tampered(store, work)

    assert check.misfit is not None
    assert check.misfit.event_id == event_id


def cut(file: sqlite3.Connection) -> None:
    file.execute("DELETE FROM audit_event WHERE id > 3")


def cut_with_its_head(file: sqlite3.Connection) -> None:
    cut(file)
    file.execute(
        "UPDATE audit_head SET last_id = 3, sha256 = (SELECT sha256 FROM audit_event WHERE id = 3)"
    )


def test_a_cut_end_is_found_by_the_head_and_with_it_by_a_hash_that_was_noted(store: Store) -> None:
    fill(store)
    noted = rows_of(store)[-1]["sha256"]

    by_head = tampered(store, cut)
    with sqlite3.connect(str(store.database.engine.url.database)) as file:
        cut_with_its_head(file)
    file.close()
    alone = verify_audit(url_of(store))
    by_hash = verify_audit(url_of(store), noted)

    assert by_head.misfit is not None
    assert by_head.misfit.event_id == 4
    assert alone.misfit is None
    assert by_hash.expected_id is None


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE audit_event SET actor_name = 'nobody'",
        "DELETE FROM audit_event WHERE id = 5",
        "REPLACE INTO audit_event SELECT * FROM audit_event WHERE id = 2",
        "DELETE FROM audit_head",
    ],
)
def test_the_database_itself_refuses_to_change_an_event(store: Store, statement: str) -> None:
    fill(store)

    with pytest.raises(StoreError, match="appended to and never changed"):
        store.database.write(lambda c: c.exec_driver_sql(statement))

    assert verify_audit(url_of(store)).events == EVENTS


def test_a_change_and_its_event_are_both_or_neither(store: Store) -> None:
    fill(store, 1)
    bike = {"name": "Blue", "created_us": 0}

    def half(connection: Connection) -> None:
        connection.execute(insert(t.bike).values(bike))
        append(connection, entry(2))
        raise NotFound("The rest of it failed.")

    with pytest.raises(NotFound):
        store.database.write(half)
    fill(store, 1)

    assert store.database.read(lambda c: c.execute(select(t.bike)).all()) == []
    assert [row["id"] for row in rows_of(store)] == [1, 2]
    assert verify_audit(url_of(store)).misfit is None


def test_many_that_append_at_once_make_one_chain(store: Store) -> None:
    each = 25

    def work(name: str) -> None:
        with acting(Actor("person", name)):
            for number in range(each):
                store.database.write(lambda c, number=number: append(c, entry(number)))

    threads = [threading.Thread(target=work, args=(name,)) for name in ("Anna", "Ben", "Rita")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    check = verify_audit(url_of(store))
    assert (check.events, check.misfit) == (3 * each, None)
    names = [row["actor_name"] for row in rows_of(store)]
    assert {name: names.count(name) for name in names} == dict.fromkeys(
        ("Anna", "Ben", "Rita"), each
    )


def test_what_nobody_is_behind_is_the_server_s(store: Store) -> None:
    AuditLog(store.database).note(entry(1))

    assert rows_of(store)[0]["actor_kind"] == "server"


def test_what_is_too_long_is_told_by_its_hash(store: Store) -> None:
    samples = list(range(VALUE_LENGTH_MAX))
    many = {f"parameter_{number}": "x" * (VALUE_LENGTH_MAX - 100) for number in range(20)}
    log = AuditLog(store.database)
    log.note(AuditEntry(Action.LIBRARY_ITEM_ADDED, 1, after={"rows": samples, "name": "long"}))
    log.note(AuditEntry(Action.LIBRARY_ITEM_ADDED, 2, after=many))
    log.note(AuditEntry(Action.LIBRARY_ITEM_ADDED, "\0", "a\0b\ud800", reason="\0"))

    first, second, third = rows_of(store)
    kept = json.loads(first["after"])

    assert kept["name"] == "long"
    assert set(kept["rows"]) == set(json.loads(second["after"])) == {"sha256", "characters"}
    assert (third["object_id"], third["object_name"], third["reason"]) == (None, "ab?", None)
    assert verify_audit(url_of(store)).misfit is None


CHANGING = """
import sys
from backend.bikes.records import BikeStore
from backend.store import open_store

store = open_store(sys.argv[1], sys.argv[2])
bikes = BikeStore(store.database)
for number in range(100_000):
    print(bikes.add({"name": f"bike {number}"}), flush=True)
"""


@pytest.mark.slow
def test_a_process_killed_in_the_middle_of_changes_leaves_a_chain_that_fits(tmp_path: Path) -> None:
    urls = [f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects"]
    child = subprocess.Popen(
        [sys.executable, "-c", CHANGING, *urls], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    assert child.stdout is not None
    for _ in range(40):
        next(child.stdout)
    child.send_signal(signal.SIGKILL)
    acknowledged = 40 + sum(1 for line in child.stdout if line.strip())
    child.wait()

    check = verify_audit(urls[0])

    assert check.misfit is None
    # The last change may have been committed and not yet told.
    assert check.events in (acknowledged, acknowledged + 1)
    with sqlite3.connect(tmp_path / "spindle.db") as file:
        assert file.execute("SELECT count(*) FROM bike").fetchone() == (check.events,)
    file.close()


@pytest.mark.slow
def test_the_command_checks_a_folder_beside_its_server(store: Store, tmp_path: Path) -> None:
    fill(store)
    noted = rows_of(store)[1]["sha256"]

    verify = ("audit", "verify", "--data", tmp_path)

    fits = spindle(None, *verify, "--expect", noted)
    unknown = spindle(None, *verify, "--json", "--expect", "f" * 64)
    no_hash = spindle(None, *verify, "--expect", "x")
    tampered(store, removed)
    broken = spindle(None, *verify)

    assert fits.returncode == 0
    assert "5 events, and every one fits." in fits.stdout
    assert rows_of(store)[-1]["sha256"] in fits.stdout
    assert "event 2: up to there nothing was changed" in fits.stdout
    assert (unknown.returncode, json.loads(unknown.stdout)["ok"]) == (1, False)
    assert no_hash.returncode == 2
    assert broken.returncode == 1
    assert broken.stdout.startswith("Event 3 does not fit: it is not there.")


def test_a_database_without_an_audit_is_told_as_that(store: Store) -> None:
    url = url_of(store)
    store.close()
    with sqlite3.connect(str(store.database.engine.url.database)) as file:
        file.execute("DROP TABLE audit_event")
    file.close()

    with pytest.raises(NotFound, match="of a version without an audit"):
        verify_audit(url)
