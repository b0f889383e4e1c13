"""A container is one upload, and each file within it is one of its own."""

import sqlalchemy as sa
from alembic import op

revision = "0014"
down_revision = "0013"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """No upload of before came from within another."""
    with op.batch_alter_table("upload") as table:
        table.add_column(sa.Column("part_of", sa.BigInteger().with_variant(sa.Integer, "sqlite")))
        table.create_index("ix_upload_part_of", ["part_of"])


def downgrade() -> None:
    """Without it."""
    with op.batch_alter_table("upload") as table:
        table.drop_index("ix_upload_part_of")
        table.drop_column("part_of")
