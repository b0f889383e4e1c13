"""The sport a file tells, and what became of its rows and fields."""

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Unknown for rides of before: their files are kept, and tell it when they are read again."""
    with op.batch_alter_table("ride") as table:
        table.add_column(sa.Column("sport", sa.String(32)))
        table.add_column(sa.Column("intake", sa.JSON()))


def downgrade() -> None:
    """Without both."""
    with op.batch_alter_table("ride") as table:
        table.drop_column("intake")
        table.drop_column("sport")
