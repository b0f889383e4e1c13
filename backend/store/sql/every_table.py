"""What every table has: one place that knows them all, names for what is changed later, a key."""

from __future__ import annotations

from sqlalchemy import BigInteger, Column, Integer, MetaData

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


def key() -> Column[int]:
    return Column("id", KEY, primary_key=True, autoincrement=True)
