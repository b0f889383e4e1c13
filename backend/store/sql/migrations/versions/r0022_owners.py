"""Bikes have a frame, a battery, a counter and owners; rides and uploads are somebody's."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0022"
down_revision = "0021"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer, "sqlite")
ADDED: dict[str, dict[str, Any]] = {
    "bike": {
        "model": sa.Text,
        "frame_number": sa.Text,
        "battery": sa.Text,
        "mileage_km": sa.Float,
        "mileage_us": sa.BigInteger,
        "lost_us": sa.BigInteger,
    },
    "upload": {"owner_id": KEY, "answer": sa.JSON},
    "ride": {"owner_id": KEY},
}
RIDES = "ix_ride_owner_id_started_us_id"
UPLOADS = "ix_upload_owner_id"


def number(name: str) -> sa.Column[int]:
    return sa.Column(name, sa.BigInteger, nullable=False)


def of_bike(table: str) -> tuple[sa.Column[int], sa.ForeignKeyConstraint]:
    """The column, and what it points to."""
    name = f"fk_{table}_bike_id_bike"
    return sa.Column("bike_id", KEY, nullable=False), sa.ForeignKeyConstraint(
        ["bike_id"], ["bike.id"], name=name
    )


def upgrade() -> None:
    for table, columns in ADDED.items():
        for name, kind in columns.items():
            op.add_column(table, sa.Column(name, kind))
    op.create_index(RIDES, "ride", ["owner_id", "started_us", "id"])
    op.create_index(UPLOADS, "upload", ["owner_id"])
    op.create_table(
        "bike_owner",
        sa.Column("id", KEY, autoincrement=True),
        *of_bike("bike_owner"),
        sa.Column("account_id", KEY),
        sa.Column("name", sa.String(64), nullable=False),
        number("from_us"),
        sa.Column("to_us", sa.BigInteger),
        sa.PrimaryKeyConstraint("id", name="pk_bike_owner"),
    )
    for name in ("bike_id", "account_id"):
        op.create_index(f"ix_bike_owner_{name}", "bike_owner", [name])
    op.create_table(
        "pairing",
        sa.Column("id", KEY, autoincrement=True),
        *of_bike("pairing"),
        sa.Column("code_sha256", sa.String(64), nullable=False),
        sa.Column("owned_from_us", sa.BigInteger),
        number("created_us"),
        number("expires_us"),
        sa.PrimaryKeyConstraint("id", name="pk_pairing"),
        sa.UniqueConstraint("code_sha256", name="uq_pairing_code_sha256"),
    )
    op.create_index("ix_pairing_bike_id", "pairing", ["bike_id"])


def downgrade() -> None:
    op.drop_table("pairing")
    op.drop_table("bike_owner")
    op.drop_index(RIDES, "ride")
    op.drop_index(UPLOADS, "upload")
    for table, columns in reversed(ADDED.items()):
        for name in reversed(columns):
            op.drop_column(table, name)
