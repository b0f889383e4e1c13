"""What was proven of configurations; derived, so that nothing of before is missed."""

import sqlalchemy as sa
from alembic import op

revision = "0009"
down_revision = "0008"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """An empty table: a certificate is worked out when it is asked for."""
    op.create_table(
        "certificate",
        sa.Column("config_sha256", sa.String(64), nullable=False),
        sa.Column("method", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("firmware_version", sa.String(32), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint(
            "config_sha256", "method", "firmware_version", name="pk_certificate"
        ),
    )


def downgrade() -> None:
    """Without it."""
    op.drop_table("certificate")
