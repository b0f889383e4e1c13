"""Items of the library with all their versions; how the author of a configuration is known."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Empty tables; no configuration of before has an author."""
    op.create_table(
        "library_item",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("name", sa.Text()),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_library_item"),
        sa.UniqueConstraint("name", name="uq_library_item_name"),
    )
    op.create_table(
        "library_version",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("item_id", KEY, nullable=False),
        sa.Column("seq", sa.Integer(), nullable=False),
        sa.Column("deleted", sa.Boolean(), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.Column("author", sa.String(128), nullable=False),
        sa.Column("author_proof", sa.String(16)),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(
            ["item_id"], ["library_item.id"], name="fk_library_version_item_id_library_item"
        ),
        sa.PrimaryKeyConstraint("id", name="pk_library_version"),
        sa.UniqueConstraint("item_id", "seq", name="uq_library_version_item_id_seq"),
    )
    with op.batch_alter_table("revision") as table:
        table.add_column(sa.Column("author_proof", sa.String(16)))


def downgrade() -> None:
    """Without them: what is in the library is given up."""
    with op.batch_alter_table("revision") as table:
        table.drop_column("author_proof")
    op.drop_table("library_version")
    op.drop_table("library_item")
