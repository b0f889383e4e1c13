"""Service visits of bikes."""

import sqlalchemy as sa
from alembic import op

revision = "0025"
down_revision = "0024"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer, "sqlite")


def upgrade() -> None:
    op.create_table(
        "visit",
        sa.Column("id", KEY, autoincrement=True),
        sa.Column("token", sa.String(32), nullable=False),
        sa.Column("bike_id", KEY, nullable=False),
        sa.Column("open_for", KEY),
        sa.Column("opened_us", sa.BigInteger, nullable=False),
        sa.Column("opened_by", sa.String(128), nullable=False),
        sa.Column("closed_us", sa.BigInteger),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("imported", sa.Integer, nullable=False),
        sa.Column("body", sa.JSON, nullable=False),
        sa.Column("consent", sa.JSON),
        sa.PrimaryKeyConstraint("id", name="pk_visit"),
        sa.ForeignKeyConstraint(["bike_id"], ["bike.id"], name="fk_visit_bike_id_bike"),
        sa.UniqueConstraint("token", name="uq_visit_token"),
        sa.UniqueConstraint("open_for", name="uq_visit_open_for"),
    )
    op.create_index("ix_visit_bike_id", "visit", ["bike_id"])


def downgrade() -> None:
    """The files of visits stay among the objects."""
    op.drop_table("visit")
