"""Of a table that is asked about, which header: one answer is for the files with the same."""

import sqlalchemy as sa
from alembic import op

revision = "0016"
down_revision = "0015"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Unknown for uploads of before."""
    with op.batch_alter_table("upload") as table:
        table.add_column(sa.Column("asks_sha256", sa.String(64)))


def downgrade() -> None:
    """Without it."""
    with op.batch_alter_table("upload") as table:
        table.drop_column("asks_sha256")
