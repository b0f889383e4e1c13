"""A ride that two devices recorded: the one points to the other."""

import sqlalchemy as sa
from alembic import op

revision = "0015"
down_revision = "0014"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Unknown for rides of before."""
    kind = sa.BigInteger().with_variant(sa.Integer, "sqlite")
    with op.batch_alter_table("ride") as table:
        table.add_column(sa.Column("same_ride_as", kind))


def downgrade() -> None:
    """Without it."""
    with op.batch_alter_table("ride") as table:
        table.drop_column("same_ride_as")
