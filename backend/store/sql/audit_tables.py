"""The tables of the audit."""

from __future__ import annotations

from sqlalchemy import BigInteger, Column, Index, String, Table, Text

from backend.store.sql.every_table import KEY, metadata

# Who changed what: appended, and never changed or removed, which triggers refuse. id: counts from 1
# without a gap. actor_id: the account's number, whatever became of it. before, after: canonical
# JSON, as hashed. sha256: of all the other members; how: backend/store/audit.py.
audit_event = Table(
    "audit_event",
    metadata,
    Column("id", KEY, primary_key=True, autoincrement=False),
    Column("at_us", BigInteger, nullable=False, index=True),
    Column("actor_kind", String(16), nullable=False),
    Column("actor_id", KEY),
    Column("actor_name", Text, nullable=False),
    Column("actor_key", Text),
    Column("action", String(40), nullable=False),
    Column("object_kind", String(16), nullable=False),
    Column("object_id", Text),
    Column("object_name", Text),
    Column("unit_key", Text),
    Column("bike_id", KEY),
    Column("before", Text),
    Column("after", Text),
    Column("reason", Text),
    Column("previous_sha256", String(64), nullable=False),
    Column("sha256", String(64), nullable=False),
    Index(None, "unit_key", "id"),
    Index(None, "bike_id", "id"),
)

# One row, the number and hash of the last event: whoever appends holds it until the commit.
audit_head = Table(
    "audit_head",
    metadata,
    Column("last_id", KEY, nullable=False),
    Column("sha256", String(64), nullable=False),
)
