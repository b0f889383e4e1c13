"""Sources and methods of figures, doubts of rides, and which of two recordings of one counts."""

import sqlalchemy as sa
from alembic import op

revision = "0020"
down_revision = "0019"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """What is here has figures and cards by an older method: both are worked out anew."""
    with op.batch_alter_table("ride_summary") as changed:
        changed.add_column(sa.Column("distance_source", sa.String(16)))
        changed.add_column(sa.Column("method", sa.Integer(), nullable=False, server_default="0"))
        changed.add_column(sa.Column("outdone", sa.Integer(), nullable=False, server_default="0"))
    with op.batch_alter_table("ride_card") as changed:
        changed.add_column(sa.Column("doubts", sa.JSON(), nullable=False, server_default="[]"))
        changed.add_column(
            sa.Column("open_doubts", sa.Integer(), nullable=False, server_default="0")
        )
    with op.batch_alter_table("ride") as changed:
        changed.add_column(
            sa.Column("accepted_doubts", sa.JSON(), nullable=False, server_default="[]")
        )


def downgrade() -> None:
    """Without them."""
    with op.batch_alter_table("ride") as changed:
        changed.drop_column("accepted_doubts")
    with op.batch_alter_table("ride_card") as changed:
        changed.drop_column("open_doubts")
        changed.drop_column("doubts")
    with op.batch_alter_table("ride_summary") as changed:
        changed.drop_column("outdone")
        changed.drop_column("method")
        changed.drop_column("distance_source")
