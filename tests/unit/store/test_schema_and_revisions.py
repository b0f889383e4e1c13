"""Goal: the migrations make exactly the tables the code uses, on SQLite and on PostgreSQL.

Method: alembic's own comparison after an upgrade, a downgrade and an upgrade; PostgreSQL's DDL is
compiled, not run.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, create_engine, insert, inspect, select
from sqlalchemy.dialects import postgresql
from sqlalchemy.schema import CreateTable

import backend.store
from backend.core.revision import Revision
from backend.errors import StoreError
from backend.store import Store, open_store
from backend.store.sql.database import HEAD_REVISION, OLDER_REVISIONS
from backend.store.sql.tables import account, metadata
from backend.tuning.records import RevisionStore
from tests.unit.store.test_numbers_are_given_once import LASTING

MIGRATIONS = Path(backend.store.__file__).parent / "sql" / "migrations"


def test_migrations_and_tables_agree_both_ways(tmp_path: Path) -> None:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    engine = create_engine(f"sqlite:///{tmp_path}/schema.db")

    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
        command.downgrade(config, "base")
        left = set(inspect(connection).get_table_names())
        command.upgrade(config, "head")
        differences = compare_metadata(MigrationContext.configure(connection), metadata)

    assert left == {"alembic_version"}
    assert differences == []
    scripts = ScriptDirectory.from_config(config)
    assert scripts.get_current_head() == HEAD_REVISION
    # Every earlier schema is opened, the newest of them too.
    earlier = {one.revision for one in scripts.walk_revisions()} - {HEAD_REVISION}
    assert earlier | {None} == set(OLDER_REVISIONS)


def test_names_that_differ_in_width_alone_are_told_apart_when_they_become_one(
    tmp_path: Path,
) -> None:
    engine = create_engine(f"sqlite:///{tmp_path}/schema.db")
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    rows = [(1, "ＲＩＤＥＲ", "ｒｉｄｅｒ"), (2, "rider", "rider"), (3, "Anna", "anna")]

    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "0020")
        for number, name, compared in rows:
            values = {"id": number, "name": name, "folded": compared, "role": "rider"}
            values |= {"enabled": True, "password": "x", "created_us": 0}
            connection.execute(insert(account).values(values))
        command.upgrade(config, "0021")
        found = connection.execute(select(account.c.name, account.c.folded).order_by(account.c.id))
        names = [tuple(row) for row in found]
        command.downgrade(config, "0020")
        command.upgrade(config, "0021")

    assert names == [("ＲＩＤＥＲ", "rider"), ("rider (2)", "rider (2)"), ("Anna", "anna")]


def test_a_schema_that_is_not_known_is_refused_and_left_as_it_is(tmp_path: Path) -> None:
    urls = (f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())
    open_store(*urls).close()
    with sqlite3.connect(tmp_path / "spindle.db") as database:
        database.execute("UPDATE alembic_version SET version_num = '0099'")
    database.close()
    before = (tmp_path / "spindle.db").read_bytes()

    with pytest.raises(StoreError, match=r"schema 0099.*Nothing was changed.*store rebuild"):
        open_store(*urls)

    assert (tmp_path / "spindle.db").read_bytes() == before


def test_every_table_can_be_made_on_postgresql() -> None:
    dialect = postgresql.dialect()  # type: ignore[no-untyped-call]

    texts = [str(CreateTable(table).compile(dialect=dialect)) for table in metadata.sorted_tables]

    keyed = {table.name for table in metadata.sorted_tables if "id" in table.c}
    serial = {
        table.name
        for table, made in zip(metadata.sorted_tables, texts, strict=True)
        if "BIGSERIAL" in made
    }
    assert len(texts) == 30
    # The audit's own head gives its events their numbers, `last_number` those that are given once.
    assert keyed - serial == {"audit_event", *LASTING}


def test_the_database_keeps_what_a_commit_acknowledged(store: Store) -> None:
    with store.database.engine.connect() as connection:
        found = {
            name: connection.exec_driver_sql(f"PRAGMA {name}").scalar()
            for name in ("journal_mode", "synchronous", "foreign_keys")
        }

    assert found == {"journal_mode": "wal", "synchronous": 2, "foreign_keys": 1}


def test_configurations_are_numbered_for_each_unit_and_newest_first(store: Store) -> None:
    log = RevisionStore(store.database)

    log.append("ebl:SP-1", {"gear_ratio": 40.34}, reason="found", crc32=0xFFFFFFFF, generation=1)
    log.append("ebl:SP-2", {"gear_ratio": 36.744})
    second = log.append(
        "ebl:SP-1",
        {"gear_ratio": 36.744},
        changed=[{"name": "gear_ratio", "old": 40.34, "new": 36.744}],
        reason="counted the teeth",
        author="workshop",
    )

    assert (second.seq, second.author, second.reason) == (2, "workshop", "counted the teeth")
    assert [revision.seq for revision in log.list("ebl:SP-1")] == [2, 1]
    assert [revision.author_proof for revision in log.list("ebl:SP-1")] == ["stated", None]
    assert log.list("ebl:SP-1")[1].crc32 == 0xFFFFFFFF
    assert log.list("ebl:SP-3") == ()


def test_each_gets_the_configuration_it_added_whoever_adds_another_at_once(store: Store) -> None:
    """The memory of units notes what it finds while somebody writes."""
    log, write = RevisionStore(store.database), store.database.write
    first: list[Revision] = []

    def write_with_another_behind(work: Callable[[Connection], Any]) -> Any:
        done = write(work)
        if not first:
            first.append(done)
            log.append("ebl:SP-1", {"gear_ratio": 36.744}, reason="another")
        return done

    store.database.write = write_with_another_behind  # type: ignore[method-assign]
    added = log.append("ebl:SP-1", {"gear_ratio": 40.34}, reason="mine")

    assert (added.seq, added.reason, added.parameters) == (1, "mine", {"gear_ratio": 40.34})
    assert [one.reason for one in log.list("ebl:SP-1")] == ["another", "mine"]


def test_what_two_find_in_a_unit_at_once_is_kept_once(store: Store) -> None:
    log = RevisionStore(store.database)
    found = log.append("ebl:SP-1", {"gear_ratio": 40.34}, crc32=7, only_if_changed=True)

    again = log.append("ebl:SP-1", {"gear_ratio": 40.34}, crc32=7, only_if_changed=True)
    other = log.append("ebl:SP-1", {"gear_ratio": 36.744}, crc32=8, only_if_changed=True)
    back = log.append("ebl:SP-1", {"gear_ratio": 40.34}, crc32=7, only_if_changed=True)

    assert again == found
    assert [found.seq, other.seq, back.seq] == [1, 2, 3]
