"""Laps, pauses and instruments that a ride's file tells."""

import sqlalchemy as sa
from alembic import op

revision = "0012"
down_revision = "0011"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Unknown for rides of before: their files are kept, and tell it when they are read again."""
    with op.batch_alter_table("ride") as table:
        table.add_column(sa.Column("noted", sa.JSON()))


def downgrade() -> None:
    """Without them."""
    with op.batch_alter_table("ride") as table:
        table.drop_column("noted")
