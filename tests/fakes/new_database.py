"""A new SQLite database as a copy of one that the migrations made, once in each test process.

Hundreds of tests open a store of their own; making the tables for each takes longer than most of
them. Databases that are not new, and those of other engines, are migrated as ever.
"""

from __future__ import annotations

import sqlite3
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from sqlalchemy import Engine

from backend.store.sql import database

migrate = database.migrate


@cache
def template() -> sqlite3.Connection:
    """What the migrations make of an empty file, in memory."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "template.db"
        database.Database(f"sqlite:///{file}").close()
        made = sqlite3.connect(":memory:", check_same_thread=False)
        with sqlite3.connect(file) as source:
            source.backup(made)
        source.close()
    return made


def copied(engine: Engine, url: str) -> None:
    """In the place of backend.store.sql.database.migrate."""
    if engine.dialect.name != "sqlite" or database.current_revision(engine) is not None:
        migrate(engine, url)
        return
    connection = engine.raw_connection()
    try:
        target = connection.driver_connection
        assert isinstance(target, sqlite3.Connection)
        template().backup(target)
    finally:
        connection.close()


@pytest.fixture(scope="session", autouse=True)
def new_databases_are_copied() -> Iterator[None]:
    """For every store that a test opens in its own process."""
    # While the migrations still are what makes it.
    template()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(database, "migrate", copied)
        yield
