"""What every table has: one place that knows them all, names for what is changed later, a key."""

from __future__ import annotations

from typing import Any

from sqlalchemy import BigInteger, Column, Integer, MetaData, String, Table, update

# Alembic can only change what has a name, on SQLite too.
NAMING = {
    "ix": "ix_%(table_name)s_%(column_0_N_name)s",
    "uq": "uq_%(table_name)s_%(column_0_N_name)s",
    "ck": "ck_%(table_name)s_%(constraint_name)s",
    "fk": "fk_%(table_name)s_%(column_0_N_name)s_%(referred_table_name)s",
    "pk": "pk_%(table_name)s",
}
metadata = MetaData(naming_convention=NAMING)

KEY = BigInteger().with_variant(Integer, "sqlite")

# Of each table with a `lasting_key` the last number a row was given.
last_number = Table(
    "last_number",
    metadata,
    Column("name", String(32), primary_key=True),
    Column("last", KEY, nullable=False),
)


def key() -> Column[int]:
    return Column("id", KEY, primary_key=True, autoincrement=True)


def lasting_key(table: str) -> Column[int]:
    """A key of rows whose number is known elsewhere and outlives them: to a bookmark, an audit, a
    live socket. SQLite by itself would give the highest one again after its row was deleted."""

    def next_number(context: Any) -> int:
        mine = update(last_number).where(last_number.c.name == table)
        count = mine.values(last=last_number.c.last + 1).returning(last_number.c.last)
        return int(context.connection.execute(count).scalar_one())

    return Column("id", KEY, primary_key=True, default=next_number)
