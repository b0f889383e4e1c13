"""The first tables: devices and their configurations, uploads, rides."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
FIGURES = (
    "moving_s",
    "distance_km",
    "rider_wh",
    "rider_excluded_s",
    "motor_wh",
    "motor_excluded_s",
    "battery_wh",
    "battery_excluded_s",
    "speed_kmh_mean",
    "speed_kmh_max",
    "cadence_rpm_mean",
    "cadence_rpm_max",
    "rider_torque_nm_mean",
    "rider_torque_nm_max",
    "rider_power_w_mean",
    "rider_power_w_max",
    "motor_torque_nm_max",
    "motor_power_w_mean",
    "motor_power_w_max",
    "battery_soc_pct_used",
    "motor_temperature_degc_max",
)


def upgrade() -> None:
    """Create every table."""
    create_devices()
    create_uploads()
    create_rides()
    create_ride_parts()


def downgrade() -> None:
    """Drop every table, the dependent ones first."""
    for name in (
        "ride_tail",
        "ride_summary",
        "ride_lod",
        "ride",
        "config_revision",
        "upload",
        "device",
    ):
        op.drop_table(name)


def create_devices() -> None:
    op.create_table(
        "device",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("serial", sa.String(64), nullable=False),
        sa.Column("model", sa.String(64)),
        sa.Column("firmware_version", sa.String(32)),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("last_seen_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_device"),
        sa.UniqueConstraint("serial", name="uq_device_serial"),
    )
    op.create_table(
        "config_revision",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("device_id", KEY, nullable=False),
        sa.Column("parent_id", KEY),
        sa.Column("seq", sa.Integer(), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.Column("generation", sa.BigInteger()),
        sa.Column("crc32", sa.BigInteger()),
        sa.Column("changed", sa.JSON(), nullable=False),
        sa.Column("author", sa.String(128), nullable=False),
        sa.Column("reason", sa.Text(), nullable=False),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(
            ["device_id"], ["device.id"], name="fk_config_revision_device_id_device"
        ),
        sa.ForeignKeyConstraint(
            ["parent_id"],
            ["config_revision.id"],
            name="fk_config_revision_parent_id_config_revision",
        ),
        sa.PrimaryKeyConstraint("id", name="pk_config_revision"),
        sa.UniqueConstraint("device_id", "seq", name="uq_config_revision_device_id_seq"),
    )


def create_uploads() -> None:
    op.create_table(
        "upload",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("token", sa.String(32), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("length", sa.BigInteger(), nullable=False),
        sa.Column("received", sa.BigInteger(), nullable=False),
        sa.Column("declared_sha256", sa.String(64)),
        sa.Column("sha256", sa.String(64)),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("code", sa.String(40)),
        sa.Column("detail", sa.Text()),
        sa.Column("completeness", sa.Float()),
        sa.Column("duplicate_of", KEY),
        sa.Column("object_key", sa.String(128)),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("expires_us", sa.BigInteger()),
        sa.PrimaryKeyConstraint("id", name="pk_upload"),
        sa.UniqueConstraint("token", name="uq_upload_token"),
    )
    op.create_index("ix_upload_sha256", "upload", ["sha256"])


def create_rides() -> None:
    op.create_table(
        "ride",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("state", sa.String(8), nullable=False),
        sa.Column("origin", sa.String(16), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("notes", sa.Text(), nullable=False),
        sa.Column("device_serial", sa.String(64)),
        sa.Column("started_us", sa.BigInteger(), nullable=False),
        sa.Column("row_count", sa.BigInteger(), nullable=False),
        sa.Column("period_us", sa.BigInteger()),
        sa.Column("channels", sa.JSON(), nullable=False),
        sa.Column("context", sa.JSON(), nullable=False),
        sa.Column("gaps", sa.JSON(), nullable=False),
        sa.Column("completeness", sa.Float()),
        sa.Column("upload_id", KEY),
        sa.Column("object_key", sa.String(128)),
        sa.Column("object_sha256", sa.String(64)),
        sa.Column("object_bytes", sa.BigInteger()),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["upload_id"], ["upload.id"], name="fk_ride_upload_id_upload"),
        sa.PrimaryKeyConstraint("id", name="pk_ride"),
    )
    for column in ("device_serial", "object_key", "started_us", "state", "upload_id"):
        op.create_index(f"ix_ride_{column}", "ride", [column])


def create_ride_parts() -> None:
    op.create_table(
        "ride_summary",
        sa.Column("ride_id", KEY, nullable=False),
        sa.Column("duration_s", sa.Float(), nullable=False),
        *(sa.Column(name, sa.Float()) for name in FIGURES),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_summary_ride_id_ride"),
        sa.PrimaryKeyConstraint("ride_id", name="pk_ride_summary"),
    )
    op.create_table(
        "ride_tail",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("ride_id", KEY, nullable=False),
        sa.Column("row_start", sa.BigInteger(), nullable=False),
        sa.Column("row_count", sa.Integer(), nullable=False),
        sa.Column("payload", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_tail_ride_id_ride"),
        sa.PrimaryKeyConstraint("id", name="pk_ride_tail"),
        sa.UniqueConstraint("ride_id", "row_start", name="uq_ride_tail_ride_id_row_start"),
    )
    op.create_table(
        "ride_lod",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("ride_id", KEY, nullable=False),
        sa.Column("step", sa.Integer(), nullable=False),
        sa.Column("payload", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_lod_ride_id_ride"),
        sa.PrimaryKeyConstraint("id", name="pk_ride_lod"),
        sa.UniqueConstraint("ride_id", "step", name="uq_ride_lod_ride_id_step"),
    )
