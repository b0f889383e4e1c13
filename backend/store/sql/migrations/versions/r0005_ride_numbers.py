"""The last number a ride was given, so that no number comes back."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """A table of one row, which counts on from the rides that are here."""
    op.create_table("ride_number", sa.Column("last", KEY, nullable=False))
    op.execute("INSERT INTO ride_number (last) SELECT coalesce(max(id), 0) FROM ride")


def downgrade() -> None:
    """Without it; PostgreSQL's own count goes on from here."""
    if op.get_bind().dialect.name == "postgresql":
        op.execute(
            "SELECT setval(pg_get_serial_sequence('ride', 'id'), greatest(last, 1)) "
            "FROM ride_number"
        )
    op.drop_table("ride_number")
