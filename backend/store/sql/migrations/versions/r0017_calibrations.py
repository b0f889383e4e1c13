"""Calibrations of torque sensors, and their captures."""

import sqlalchemy as sa
from alembic import op

revision = "0017"
down_revision = "0016"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
INDEXED = ("unit_key", "bike_id", "model")


def upgrade() -> None:
    """Two tables that begin empty."""
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
    for name in INDEXED:
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


def downgrade() -> None:
    """Without them."""
    op.drop_table("calibration_capture")
    op.drop_table("calibration")
