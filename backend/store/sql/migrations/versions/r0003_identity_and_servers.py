"""A store knows its folder, what it gave up, and which server records a ride."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Two tables, and three columns that are empty for the rides that are here."""
    op.create_table(
        "store_identity",
        sa.Column("store_id", sa.String(32), nullable=False),
        sa.Column("rebuilding", sa.Boolean(), nullable=False),
        sa.Column("server_id", sa.String(32)),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("store_id", name="pk_store_identity"),
    )
    op.create_table(
        "discarded_object",
        sa.Column("key", sa.String(160), nullable=False),
        sa.PrimaryKeyConstraint("key", name="pk_discarded_object"),
    )
    with op.batch_alter_table("ride") as ride:
        ride.add_column(sa.Column("server_id", sa.String(32)))
        ride.add_column(sa.Column("heartbeat_us", sa.BigInteger()))
        ride.add_column(sa.Column("cut_short", sa.Boolean()))


def downgrade() -> None:
    """Without them."""
    with op.batch_alter_table("ride") as ride:
        for name in ("server_id", "heartbeat_us", "cut_short"):
            ride.drop_column(name)
    op.drop_table("discarded_object")
    op.drop_table("store_identity")
