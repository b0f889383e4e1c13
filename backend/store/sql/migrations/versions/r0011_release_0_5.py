"""The tables of release 0.5, the oldest whose folder is opened."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = None
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
FIGURES = (
    *("moving_s", "distance_km", "rider_wh", "rider_excluded_s", "motor_wh", "motor_excluded_s"),
    *("battery_wh", "battery_excluded_s", "speed_kmh_mean", "speed_kmh_max", "cadence_rpm_mean"),
    *("cadence_rpm_max", "rider_torque_nm_mean", "rider_torque_nm_max", "rider_power_w_mean"),
    *("rider_power_w_max", "motor_torque_nm_max", "motor_power_w_mean", "motor_power_w_max"),
    *("battery_soc_pct_used", "motor_temperature_degc_max"),
)
INDEXES = {
    "bike_unit": ("bike_id", "unit_key"),
    "upload": ("sha256",),
    "ride": (
        *("device_serial", "object_key", "started_us", "state", "upload_id"),
        *("unit_key", "bike_id"),
    ),
    "ride_source": ("upload_id",),
}
TABLES = (
    *("store_identity", "discarded_object", "ride_number", "unit", "bike", "bike_unit"),
    *("revision", "library_item", "library_version", "certificate", "upload", "ride"),
    *("ride_source", "ride_summary", "ride_tail", "ride_lod"),
)


def upgrade() -> None:
    """Create every table; no ride has a number yet."""
    create_store()
    create_units()
    create_library()
    create_uploads()
    create_rides()
    create_ride_parts()
    for table, columns in INDEXES.items():
        for column in columns:
            op.create_index(f"ix_{table}_{column}", table, [column])
    op.execute("INSERT INTO ride_number (last) VALUES (0)")


def downgrade() -> None:
    """Drop every table, the dependent ones first."""
    for name in reversed(TABLES):
        op.drop_table(name)


def number() -> "sa.Column[Any]":
    return sa.Column("id", KEY, autoincrement=True, nullable=False)


def must(name: str, kind: Any) -> "sa.Column[Any]":
    return sa.Column(name, kind, nullable=False)


def link(table: str, column: str, other: str, key: str = "id") -> sa.ForeignKeyConstraint:
    name = f"fk_{table}_{column}_{other}"
    return sa.ForeignKeyConstraint([column], [f"{other}.{key}"], name=name)


def primary(table: str, *columns: str) -> sa.PrimaryKeyConstraint:
    return sa.PrimaryKeyConstraint(*(columns or ("id",)), name=f"pk_{table}")


def unique(table: str, *columns: str) -> sa.UniqueConstraint:
    return sa.UniqueConstraint(*columns, name=f"uq_{table}_{'_'.join(columns)}")


def create_store() -> None:
    op.create_table(
        "store_identity",
        must("store_id", sa.String(32)),
        must("rebuilding", sa.Boolean()),
        sa.Column("server_id", sa.String(32)),
        must("created_us", sa.BigInteger()),
        primary("store_identity", "store_id"),
    )
    op.create_table(
        "discarded_object",
        must("key", sa.String(160)),
        sa.Column("ride_id", KEY),
        sa.Column("due_us", sa.BigInteger(), nullable=False, server_default="0"),
        primary("discarded_object", "key"),
    )
    op.create_table("ride_number", must("last", KEY))


def create_units() -> None:
    op.create_table(
        "unit",
        must("key", sa.Text()),
        *(sa.Column(n, sa.Text()) for n in ("serial_number", "name", "model", "firmware_version")),
        must("created_us", sa.BigInteger()),
        must("last_seen_us", sa.BigInteger()),
        sa.Column("last_url", sa.Text()),
        primary("unit", "key"),
    )
    op.create_table(
        "bike",
        number(),
        must("name", sa.Text()),
        must("created_us", sa.BigInteger()),
        primary("bike"),
    )
    op.create_table(
        "bike_unit",
        number(),
        must("bike_id", KEY),
        must("unit_key", sa.Text()),
        must("from_us", sa.BigInteger()),
        sa.Column("to_us", sa.BigInteger()),
        link("bike_unit", "bike_id", "bike"),
        link("bike_unit", "unit_key", "unit", "key"),
        primary("bike_unit"),
    )
    op.create_table(
        "revision",
        number(),
        must("unit_key", sa.Text()),
        sa.Column("parent_id", KEY),
        must("seq", sa.Integer()),
        must("body", sa.JSON()),
        must("sha256", sa.String(64)),
        sa.Column("generation", sa.BigInteger()),
        sa.Column("crc32", sa.BigInteger()),
        must("changed", sa.JSON()),
        must("author", sa.String(128)),
        sa.Column("author_proof", sa.String(16)),
        must("reason", sa.Text()),
        must("state", sa.String(16)),
        must("created_us", sa.BigInteger()),
        link("revision", "unit_key", "unit", "key"),
        link("revision", "parent_id", "revision"),
        primary("revision"),
        unique("revision", "unit_key", "seq"),
    )


def create_library() -> None:
    op.create_table(
        "library_item",
        number(),
        sa.Column("name", sa.Text()),
        must("created_us", sa.BigInteger()),
        primary("library_item"),
        unique("library_item", "name"),
    )
    op.create_table(
        "library_version",
        number(),
        must("item_id", KEY),
        must("seq", sa.Integer()),
        must("deleted", sa.Boolean()),
        must("body", sa.JSON()),
        must("sha256", sa.String(64)),
        must("author", sa.String(128)),
        sa.Column("author_proof", sa.String(16)),
        must("created_us", sa.BigInteger()),
        link("library_version", "item_id", "library_item"),
        primary("library_version"),
        unique("library_version", "item_id", "seq"),
    )
    op.create_table(
        "certificate",
        must("config_sha256", sa.String(64)),
        sa.Column("method", sa.Integer(), autoincrement=False, nullable=False),
        must("firmware_version", sa.String(32)),
        must("sha256", sa.String(64)),
        must("body", sa.JSON()),
        must("created_us", sa.BigInteger()),
        primary("certificate", "config_sha256", "method", "firmware_version"),
    )


def create_uploads() -> None:
    op.create_table(
        "upload",
        number(),
        must("token", sa.String(32)),
        must("name", sa.Text()),
        must("length", sa.BigInteger()),
        must("received", sa.BigInteger()),
        sa.Column("declared_sha256", sa.String(64)),
        sa.Column("sha256", sa.String(64)),
        must("state", sa.String(16)),
        sa.Column("code", sa.String(40)),
        sa.Column("detail", sa.Text()),
        sa.Column("completeness", sa.Float()),
        sa.Column("duplicate_of", KEY),
        sa.Column("object_key", sa.String(128)),
        must("created_us", sa.BigInteger()),
        sa.Column("expires_us", sa.BigInteger()),
        primary("upload"),
        unique("upload", "token"),
    )


def create_rides() -> None:
    op.create_table(
        "ride",
        number(),
        must("state", sa.String(8)),
        must("origin", sa.String(16)),
        must("name", sa.Text()),
        must("notes", sa.Text()),
        sa.Column("device_serial", sa.String(64)),
        must("started_us", sa.BigInteger()),
        must("row_count", sa.BigInteger()),
        sa.Column("period_us", sa.BigInteger()),
        *(must(name, sa.JSON()) for name in ("channels", "context", "gaps")),
        sa.Column("completeness", sa.Float()),
        sa.Column("upload_id", KEY),
        sa.Column("object_key", sa.String(128)),
        sa.Column("object_sha256", sa.String(64)),
        sa.Column("object_bytes", sa.BigInteger()),
        must("created_us", sa.BigInteger()),
        sa.Column("filled", sa.JSON(), nullable=False, server_default="[]"),
        sa.Column("events", sa.JSON(), nullable=False, server_default="[]"),
        sa.Column("server_id", sa.String(32)),
        sa.Column("heartbeat_us", sa.BigInteger()),
        sa.Column("cut_short", sa.Boolean()),
        sa.Column("unit_key", sa.Text()),
        sa.Column("bike_id", KEY),
        sa.Column("sport", sa.String(32)),
        sa.Column("intake", sa.JSON()),
        link("ride", "upload_id", "upload"),
        link("ride", "bike_id", "bike"),
        primary("ride"),
    )


def create_ride_parts() -> None:
    op.create_table(
        "ride_source",
        number(),
        must("ride_id", KEY),
        must("upload_id", KEY),
        must("part", sa.String(8)),
        link("ride_source", "ride_id", "ride"),
        link("ride_source", "upload_id", "upload"),
        primary("ride_source"),
        unique("ride_source", "ride_id", "upload_id"),
    )
    op.create_table(
        "ride_summary",
        must("ride_id", KEY),
        must("duration_s", sa.Float()),
        *(sa.Column(name, sa.Float()) for name in FIGURES),
        link("ride_summary", "ride_id", "ride"),
        primary("ride_summary", "ride_id"),
    )
    op.create_table(
        "ride_tail",
        number(),
        must("ride_id", KEY),
        must("row_start", sa.BigInteger()),
        must("row_count", sa.Integer()),
        must("payload", sa.LargeBinary()),
        link("ride_tail", "ride_id", "ride"),
        primary("ride_tail"),
        unique("ride_tail", "ride_id", "row_start"),
    )
    op.create_table(
        "ride_lod",
        number(),
        must("ride_id", KEY),
        must("step", sa.Integer()),
        must("payload", sa.LargeBinary()),
        link("ride_lod", "ride_id", "ride"),
        primary("ride_lod"),
        unique("ride_lod", "ride_id", "step"),
    )
