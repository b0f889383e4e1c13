"""Goal: what knows a row by its number (a bookmark, the audit, a live socket, a key) never meets
another row by it.

Method: rows as the tables have them, whose references nobody looks at, since nothing is committed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from alembic import command
from alembic.config import Config
from sqlalchemy import Connection, Table, create_engine, delete, insert, select, text

import backend.store
from backend.people.service import PeopleService
from backend.store import Store
from backend.store.sql.tables import last_number, metadata

MIGRATIONS = Path(backend.store.__file__).parent / "sql" / "migrations"
LASTING = ("account", "api_key", "bike", "passkey", "ride", "session", "visit")
# Rows of these are never deleted, or nobody outside the database knows their number.
KEPT_ON = {"calibration", "calibration_capture", "library_item", "library_version", "revision"}
UNKNOWN = {"bike_owner", "bike_unit", "pairing", "ride_lod", "ride_source", "ride_tail"}
# Known by its token.
UNKNOWN |= {"upload"}
# Its own head counts them.
COUNTED = {"audit_event"}
EXAMPLES: dict[type, object] = {str: "x", int: 1, bool: True, bytes: b"x", float: 1.0}


def example(table: Table) -> dict[str, Any]:
    """A row of a table with all that it must have but its number."""
    must = [one for one in table.c if not one.nullable and one.name != "id"]
    return {
        one.name: {} if one.type.__visit_name__ == "JSON" else EXAMPLES[one.type.python_type]
        for one in must
    }


def added(connection: Connection, table: Table) -> int:
    made = insert(table).values(example(table)).returning(table.c.id)
    return int(connection.execute(made).scalar_one())


@pytest.mark.parametrize("name", LASTING)
def test_the_number_of_a_deleted_row_is_not_given_again(store: Store, name: str) -> None:
    table = metadata.tables[name]
    with store.database.engine.connect() as connection:
        connection.execute(text("PRAGMA defer_foreign_keys=ON"))
        first = added(connection, table)
        connection.execute(delete(table).where(table.c.id == first))

        second = added(connection, table)

        connection.rollback()
    assert second == first + 1


def test_of_every_table_it_is_known_whether_its_numbers_last(store: Store) -> None:
    numbered = {name for name, table in metadata.tables.items() if "id" in table.c}
    assert numbered == {*LASTING} | KEPT_ON | UNKNOWN | COUNTED

    with store.database.engine.connect() as connection:
        counted = connection.execute(select(last_number.c.name)).scalars().all()
    assert {*counted} == {*LASTING}


def test_numbers_go_on_behind_what_an_older_spindle_gave(tmp_path: Path) -> None:
    engine = create_engine(f"sqlite:///{tmp_path}/schema.db")
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))

    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "0026")
        bike = metadata.tables["bike"]
        connection.execute(insert(bike).values(example(bike) | {"id": 7}))
        connection.execute(text("UPDATE ride_number SET last = 41"))
        command.upgrade(config, "0027")
        found = {name: added(connection, metadata.tables[name]) for name in ("bike", "ride")}
        command.downgrade(config, "0026")
        left = connection.execute(text("SELECT last FROM ride_number")).scalars().all()

    assert found == {"bike": 8, "ride": 42}
    assert left == [42]


def test_who_signs_in_next_is_not_taken_for_who_signed_out(store: Store) -> None:
    people = PeopleService(store.database)
    people.accounts.add("Anna", "admin", "correct horse battery")
    people.accounts.add("Ben", "rider", "another long password")
    gone = people.sign_in.of_token(
        people.sign_in.sign_in("Anna", "correct horse battery", "here")[0]
    )
    assert gone is not None

    people.sign_in.sign_out(gone, everywhere=False)
    people.sign_in.sign_in("Ben", "another long password", "here")

    assert people.renewed(gone) is None
