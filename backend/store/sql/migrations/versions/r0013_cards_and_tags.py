"""Tags, and cards of rides: derived, so that the server makes those of old rides by itself."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"
branch_labels = None
depends_on = None

RECORDS = (
    "ascent_m",
    "power_w_best_5s",
    "power_w_best_60s",
    "power_w_best_300s",
    "power_w_best_1200s",
)
KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Two tables that begin empty, and indexes for lists, totals and records."""
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
    for name in ("distance_km", "speed_kmh_mean"):
        op.create_index(f"ix_ride_summary_{name}", "ride_summary", [name])
    op.drop_index("ix_ride_started_us", "ride")
    op.create_index("ix_ride_started_us_id_bike_id", "ride", ["started_us", "id", "bike_id"])


def downgrade() -> None:
    """Without them."""
    op.drop_index("ix_ride_started_us_id_bike_id", "ride")
    op.create_index("ix_ride_started_us", "ride", ["started_us"])
    for name in ("distance_km", "speed_kmh_mean"):
        op.drop_index(f"ix_ride_summary_{name}", "ride_summary")
    op.drop_table("ride_card")
    op.drop_table("ride_tag")
