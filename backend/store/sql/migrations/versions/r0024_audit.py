"""Who changed what: a chain of events that the database itself refuses to change or remove.

A later change of this table that alembic makes by copying (`batch_alter_table`) has to make the
triggers anew.
"""

import sqlalchemy as sa
from alembic import op

revision = "0024"
down_revision = "0023"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer, "sqlite")
REFUSED = "audit_event is appended to and never changed"
ON_SQLITE = {
    "audit_event_no_update": "BEFORE UPDATE ON audit_event",
    "audit_event_no_delete": "BEFORE DELETE ON audit_event",
    # REPLACE removes the row that is there without asking the trigger for DELETE.
    "audit_event_no_replace": (
        "BEFORE INSERT ON audit_event WHEN EXISTS (SELECT 1 FROM audit_event WHERE id = NEW.id)"
    ),
    "audit_head_no_delete": "BEFORE DELETE ON audit_head",
}
ON_POSTGRESQL = {
    "audit_event_no_change": "BEFORE UPDATE OR DELETE ON audit_event FOR EACH ROW",
    "audit_event_no_truncate": "BEFORE TRUNCATE ON audit_event FOR EACH STATEMENT",
    "audit_head_no_delete": "BEFORE DELETE OR TRUNCATE ON audit_head FOR EACH STATEMENT",
}


def upgrade() -> None:
    """What was done before nobody wrote down: the chain begins empty."""
    op.create_table(
        "audit_event",
        sa.Column("id", KEY, autoincrement=False),
        sa.Column("at_us", sa.BigInteger, nullable=False),
        sa.Column("actor_kind", sa.String(16), nullable=False),
        sa.Column("actor_id", KEY),
        sa.Column("actor_name", sa.Text, nullable=False),
        sa.Column("actor_key", sa.Text),
        sa.Column("action", sa.String(40), nullable=False),
        sa.Column("object_kind", sa.String(16), nullable=False),
        sa.Column("object_id", sa.Text),
        sa.Column("object_name", sa.Text),
        sa.Column("unit_key", sa.Text),
        sa.Column("bike_id", KEY),
        sa.Column("before", sa.Text),
        sa.Column("after", sa.Text),
        sa.Column("reason", sa.Text),
        sa.Column("previous_sha256", sa.String(64), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_audit_event"),
    )
    for columns in (["at_us"], ["unit_key", "id"], ["bike_id", "id"]):
        op.create_index(f"ix_audit_event_{'_'.join(columns)}", "audit_event", columns)
    head = op.create_table(
        "audit_head",
        sa.Column("last_id", KEY, nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
    )
    op.bulk_insert(head, [{"last_id": 0, "sha256": "0" * 64}])
    if op.get_bind().dialect.name == "sqlite":
        for name, when in ON_SQLITE.items():
            op.execute(f"CREATE TRIGGER {name} {when} BEGIN SELECT RAISE(ABORT, '{REFUSED}'); END")
        return
    op.execute(
        "CREATE FUNCTION refuse_audit_change() RETURNS trigger LANGUAGE plpgsql AS "
        f"$$ BEGIN RAISE EXCEPTION '{REFUSED}'; END $$"
    )
    for name, when in ON_POSTGRESQL.items():
        op.execute(f"CREATE TRIGGER {name} {when} EXECUTE FUNCTION refuse_audit_change()")


def downgrade() -> None:
    """Without what was written down; its triggers go with the tables."""
    op.drop_table("audit_head")
    op.drop_table("audit_event")
    if op.get_bind().dialect.name != "sqlite":
        op.execute("DROP FUNCTION refuse_audit_change()")
