"""Which rides an original lives with, and from when on a file that was given up may go."""

import time

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
# What a person has to look at files that were refused before this rule was there.
GRACE_US = 7 * 86_400 * 1_000_000
JUDGED = "state IN ('complete', 'partial', 'rejected')"


def upgrade() -> None:
    """A table, links for what is here, and an end for uploads that no ride keeps."""
    op.create_table(
        "ride_source",
        sa.Column("id", KEY, primary_key=True, autoincrement=True),
        sa.Column("ride_id", KEY, sa.ForeignKey("ride.id"), nullable=False),
        sa.Column("upload_id", KEY, sa.ForeignKey("upload.id"), nullable=False),
        sa.Column("part", sa.String(8), nullable=False),
        sa.UniqueConstraint("ride_id", "upload_id"),
    )
    op.create_index("ix_ride_source_upload_id", "ride_source", ["upload_id"])
    with op.batch_alter_table("discarded_object") as discarded:
        discarded.add_column(sa.Column("ride_id", KEY))
        discarded.add_column(
            sa.Column("due_us", sa.BigInteger(), nullable=False, server_default="0")
        )
    link_what_is_here()


def link_what_is_here() -> None:
    """A ride's own upload made it; another file of a known ride filled it or is beside it."""
    op.execute(
        "INSERT INTO ride_source (ride_id, upload_id, part) "
        "SELECT id, upload_id, 'made' FROM ride WHERE upload_id IS NOT NULL"
    )
    # A copy of bytes that made a ride keeps nothing; it only says that they are here.
    op.execute(
        "INSERT INTO ride_source (ride_id, upload_id, part) "
        "SELECT ride.id, upload.id, CASE upload.code WHEN 'filled' THEN 'filled' ELSE 'beside' END "
        "FROM upload JOIN ride ON ride.id = upload.duplicate_of "
        "WHERE upload.state IN ('complete', 'partial') AND upload.code IN ('filled', 'duplicate') "
        "AND NOT EXISTS (SELECT 1 FROM ride_source WHERE ride_source.upload_id = upload.id) "
        "AND NOT EXISTS (SELECT 1 FROM upload AS twin JOIN ride AS made "
        "ON made.upload_id = twin.id WHERE twin.object_key = upload.object_key)"
    )
    op.execute(
        f"UPDATE upload SET expires_us = NULL WHERE {JUDGED} "
        "AND id IN (SELECT upload_id FROM ride_source)"
    )
    over_us = time.time_ns() // 1000 + GRACE_US
    op.execute(
        f"UPDATE upload SET expires_us = {over_us} WHERE {JUDGED} "
        "AND id NOT IN (SELECT upload_id FROM ride_source)"
    )


def downgrade() -> None:
    """Without them."""
    with op.batch_alter_table("discarded_object") as discarded:
        for name in ("ride_id", "due_us"):
            discarded.drop_column(name)
    op.drop_table("ride_source")
