"""Over which connection a unit was last seen, so that what was known of it is found there again."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Nobody noted it before: known from the unit's next sight on."""
    with op.batch_alter_table("unit") as table:
        table.add_column(sa.Column("last_url", sa.Text()))


def downgrade() -> None:
    """Without it."""
    with op.batch_alter_table("unit") as table:
        table.drop_column("last_url")
