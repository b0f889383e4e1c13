"""The zero of the torque sensor on each ride: derived, made by the server of old rides, too."""

import sqlalchemy as sa
from alembic import op

revision = "0018"
down_revision = "0017"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
FIGURES = ("zero_nm", "uncertainty_nm", "zero_counts", "temperature_degc")


def upgrade() -> None:
    """A table that begins empty."""
    op.create_table(
        "ride_zero",
        sa.Column("ride_id", KEY, autoincrement=False, nullable=False),
        sa.Column("method", sa.Integer(), nullable=False),
        sa.Column("object_key", sa.String(128), nullable=False),
        *(sa.Column(name, sa.Float()) for name in FIGURES),
        sa.Column("pieces", sa.Integer(), nullable=False),
        sa.Column("reason", sa.String(16)),
        sa.ForeignKeyConstraint(["ride_id"], ["ride.id"], name="fk_ride_zero_ride_id_ride"),
        sa.PrimaryKeyConstraint("ride_id", name="pk_ride_zero"),
    )


def downgrade() -> None:
    """Without it."""
    op.drop_table("ride_zero")
