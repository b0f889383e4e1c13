"""Numbers of accounts, sessions, keys, passkeys, bikes and visits are given once, as of rides."""

import sqlalchemy as sa
from alembic import op

revision = "0027"
down_revision = "0026"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer, "sqlite")
TABLES = ("account", "session", "api_key", "passkey", "bike", "visit")


def upgrade() -> None:
    """Each goes on behind the highest that is known."""
    op.create_table(
        "last_number",
        sa.Column("name", sa.String(32), nullable=False),
        sa.Column("last", KEY, nullable=False),
        sa.PrimaryKeyConstraint("name", name="pk_last_number"),
    )
    op.execute("INSERT INTO last_number (name, last) SELECT 'ride', last FROM ride_number")
    op.drop_table("ride_number")
    # PostgreSQL knows what it gave to rows that are deleted.
    on_postgresql = op.get_bind().dialect.name == "postgresql"
    for table in TABLES:
        highest = (
            f"last_value FROM {table}_id_seq"
            if on_postgresql
            else f"COALESCE(MAX(id), 0) FROM {table}"
        )
        op.execute(f"INSERT INTO last_number (name, last) SELECT '{table}', {highest}")


def downgrade() -> None:
    """Those of rides stay as they are."""
    op.create_table("ride_number", sa.Column("last", KEY, nullable=False))
    op.execute("INSERT INTO ride_number (last) SELECT last FROM last_number WHERE name = 'ride'")
    op.drop_table("last_number")
