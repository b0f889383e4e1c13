"""What release 0.6 added: files within files, cards and tags, calibrations, zeros, people."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0019"
down_revision = "0011"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
RECORDS = (
    "ascent_m",
    "power_w_best_5s",
    "power_w_best_60s",
    "power_w_best_300s",
    "power_w_best_1200s",
)
ZERO = ("zero_nm", "uncertainty_nm", "zero_counts", "temperature_degc")
COLUMNS = {"ride": ("noted", "same_ride_as"), "upload": ("part_of", "asks_sha256")}
TABLES = (
    *("ride_tag", "ride_card", "ride_zero", "calibration", "calibration_capture"),
    *("account", "session", "api_key"),
)


def upgrade() -> None:
    """Columns that are unknown for what is here, and tables that begin empty."""
    kinds: dict[str, Any] = {"noted": sa.JSON(), "asks_sha256": sa.String(64)}
    for table, names in COLUMNS.items():
        with op.batch_alter_table(table) as changed:
            for name in names:
                changed.add_column(sa.Column(name, kinds.get(name, KEY)))
    op.create_index("ix_upload_part_of", "upload", ["part_of"])
    for name in ("distance_km", "speed_kmh_mean"):
        op.create_index(f"ix_ride_summary_{name}", "ride_summary", [name])
    op.drop_index("ix_ride_started_us", "ride")
    op.create_index("ix_ride_started_us_id_bike_id", "ride", ["started_us", "id", "bike_id"])
    create_of_rides()
    create_calibrations()
    create_people()


def downgrade() -> None:
    """Without them."""
    for name in reversed(TABLES):
        op.drop_table(name)
    op.drop_index("ix_ride_started_us_id_bike_id", "ride")
    op.create_index("ix_ride_started_us", "ride", ["started_us"])
    for name in ("distance_km", "speed_kmh_mean"):
        op.drop_index(f"ix_ride_summary_{name}", "ride_summary")
    op.drop_index("ix_upload_part_of", "upload")
    for table, names in COLUMNS.items():
        with op.batch_alter_table(table) as changed:
            for name in names:
                changed.drop_column(name)


def create_of_rides() -> None:
    op.create_table(
        "ride_tag",
        sa.Column("ride_id", KEY, autoincrement=False, nullable=False),
        sa.Column("tag", sa.String(40), nullable=False),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_tag_ride_id_ride"),
        sa.PrimaryKeyConstraint("ride_id", "tag", name="pk_ride_tag"),
    )
    op.create_index("ix_ride_tag_tag", "ride_tag", ["tag"])
    op.create_table(
        "ride_card",
        sa.Column("ride_id", KEY, autoincrement=False, nullable=False),
        sa.Column("method", sa.Integer(), nullable=False),
        sa.Column("object_key", sa.String(128), nullable=False),
        sa.Column("speed_line", sa.LargeBinary(), nullable=False),
        sa.Column("notable", sa.Integer(), nullable=False),
        *(sa.Column(name, sa.Float()) for name in RECORDS),
        sa.Column("place", sa.Text()),
        sa.Column("country", sa.String(2)),
        sa.Column("zone", sa.String(64)),
        sa.Column("is_loop", sa.Boolean()),
        sa.Column("words", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_card_ride_id_ride"),
        sa.PrimaryKeyConstraint("ride_id", name="pk_ride_card"),
    )
    for name in RECORDS:
        op.create_index(f"ix_ride_card_{name}", "ride_card", [name])
    op.create_table(
        "ride_zero",
        sa.Column("ride_id", KEY, autoincrement=False, nullable=False),
        sa.Column("method", sa.Integer(), nullable=False),
        sa.Column("object_key", sa.String(128), nullable=False),
        *(sa.Column(name, sa.Float()) for name in ZERO),
        sa.Column("pieces", sa.Integer(), nullable=False),
        sa.Column("reason", sa.String(16)),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_zero_ride_id_ride"),
        sa.PrimaryKeyConstraint("ride_id", name="pk_ride_zero"),
    )


def create_calibrations() -> None:
    op.create_table(
        "calibration",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("unit_key", sa.Text(), nullable=False),
        sa.Column("bike_id", KEY),
        sa.Column("model", sa.Text()),
        sa.Column("open_for", sa.Text()),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("author", sa.String(128), nullable=False),
        sa.Column("author_proof", sa.String(16)),
        sa.Column("opened_us", sa.BigInteger(), nullable=False),
        sa.Column("closed_us", sa.BigInteger()),
        sa.Column("sha256", sa.String(64)),
        sa.ForeignKeyConstraint(["unit_key"], ["unit.key"], name="fk_calibration_unit_key_unit"),
        sa.ForeignKeyConstraint(["bike_id"], ["bike.id"], name="fk_calibration_bike_id_bike"),
        sa.PrimaryKeyConstraint("id", name="pk_calibration"),
        sa.UniqueConstraint("open_for", name="uq_calibration_open_for"),
        sa.UniqueConstraint("sha256", name="uq_calibration_sha256"),
    )
    for name in ("unit_key", "bike_id", "model"):
        op.create_index(f"ix_calibration_{name}", "calibration", [name])
    op.create_table(
        "calibration_capture",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("calibration_id", KEY, nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("struck", sa.JSON()),
        sa.ForeignKeyConstraint(
            ["calibration_id"],
            ["calibration.id"],
            name="fk_calibration_capture_calibration_id_calibration",
        ),
        sa.PrimaryKeyConstraint("id", name="pk_calibration_capture"),
        sa.UniqueConstraint(
            "calibration_id", "number", name="uq_calibration_capture_calibration_id_number"
        ),
    )


def create_people() -> None:
    op.create_table(
        "account",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("name", sa.String(64), nullable=False),
        sa.Column("folded", sa.String(128), nullable=False),
        sa.Column("role", sa.String(16), nullable=False),
        sa.Column("enabled", sa.Boolean(), nullable=False),
        sa.Column("password", sa.Text(), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("signed_in_us", sa.BigInteger()),
        sa.PrimaryKeyConstraint("id", name="pk_account"),
        sa.UniqueConstraint("folded", name="uq_account_folded"),
    )
    op.create_table(
        "session",
        *of_an_account("session"),
        sa.Column("token_sha256", sa.String(64), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("used_us", sa.BigInteger(), nullable=False),
        sa.UniqueConstraint("token_sha256", name="uq_session_token_sha256"),
    )
    op.create_table(
        "api_key",
        *of_an_account("api_key"),
        sa.Column("name", sa.String(64), nullable=False),
        sa.Column("prefix", sa.String(16), nullable=False),
        sa.Column("secret_sha256", sa.String(64), nullable=False),
        sa.Column("scopes", sa.JSON(), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("expires_us", sa.BigInteger()),
        sa.Column("used_us", sa.BigInteger()),
        sa.Column("revoked_us", sa.BigInteger()),
        sa.UniqueConstraint("prefix", name="uq_api_key_prefix"),
    )
    for table in ("session", "api_key"):
        op.create_index(f"ix_{table}_account_id", table, ["account_id"])


def of_an_account(table: str) -> tuple[sa.schema.SchemaItem, ...]:
    """A number of its own, and whose it is."""
    name = f"fk_{table}_account_id_account"
    return (
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("account_id", KEY, nullable=False),
        sa.ForeignKeyConstraint(["account_id"], ["account.id"], name=name),
        sa.PrimaryKeyConstraint("id", name=f"pk_{table}"),
    )
