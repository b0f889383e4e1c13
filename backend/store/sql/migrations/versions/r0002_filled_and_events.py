"""Rides say which stretches came from the unit's log, and what happened on them."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None

COLUMNS = ("filled", "events")


def upgrade() -> None:
    """Two lists for each ride, empty for those that are here."""
    with op.batch_alter_table("ride") as ride:
        for name in COLUMNS:
            ride.add_column(sa.Column(name, sa.JSON(), nullable=False, server_default="[]"))


def downgrade() -> None:
    """Without them."""
    with op.batch_alter_table("ride") as ride:
        for name in COLUMNS:
            ride.drop_column(name)
