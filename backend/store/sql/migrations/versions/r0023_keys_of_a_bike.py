"""Keys that only send files, of one bike or of all; uploads know the key they were sent with."""

import sqlalchemy as sa
from alembic import op

revision = "0023"
down_revision = "0022"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer, "sqlite")
SENT_WITH = "ix_upload_key_id"
OF_BIKE = "ix_api_key_bike_id"
KEYS = sa.table("api_key", sa.column("id", KEY), sa.column("scopes", sa.JSON))


def rename(scope: str, name: str) -> None:
    """What a key is for, by another name."""
    connection = op.get_bind()
    for row in connection.execute(sa.select(KEYS)).all():
        scopes = [name if one == scope else one for one in row.scopes]
        connection.execute(sa.update(KEYS).where(KEYS.c.id == row.id).values(scopes=scopes))


def upgrade() -> None:
    op.add_column("upload", sa.Column("key_id", KEY))
    op.add_column("upload", sa.Column("bike_id", KEY))
    op.add_column("api_key", sa.Column("bike_id", KEY))
    op.create_index(SENT_WITH, "upload", ["key_id"])
    op.create_index(OF_BIKE, "api_key", ["bike_id"])
    rename("upload", "upload_files")


def downgrade() -> None:
    rename("upload_files", "upload")
    op.drop_index(OF_BIKE, "api_key")
    op.drop_index(SENT_WITH, "upload")
    op.drop_column("api_key", "bike_id")
    op.drop_column("upload", "bike_id")
    op.drop_column("upload", "key_id")
