"""Names of people are compared without width, too: a full-width `rider` is `rider`."""

from unicodedata import normalize

import sqlalchemy as sa
from alembic import op

revision = "0021"
down_revision = "0020"
branch_labels = None
depends_on = None

account = sa.table(
    "account", sa.column("id", sa.Integer), sa.column("name"), sa.column("folded", sa.String)
)


def folded(name: str) -> str:
    """As `core.person.folded` compares names."""
    compared = normalize("NFKC", normalize("NFKC", name).casefold())
    return compared if len(compared) <= 128 else name.casefold()


def upgrade() -> None:
    """Of two that are one now the older keeps the name, the other gets a number behind it."""
    connection = op.get_bind()
    taken: set[str] = set()
    rows = connection.execute(sa.select(account.c.id, account.c.name).order_by(account.c.id)).all()
    renamed = []
    for number, name in rows:
        own, counted = name, 1
        while folded(own) in taken:
            counted += 1
            own = f"{name[:56]} ({counted})"
        taken.add(folded(own))
        renamed.append((number, own))
    for number, _ in renamed:
        # Out of the way of one another first: the column is unique.
        free = sa.update(account).where(account.c.id == number).values(folded=f"#{number}")
        connection.execute(free)
    for number, own in renamed:
        values = {"name": own, "folded": folded(own)}
        connection.execute(sa.update(account).where(account.c.id == number).values(**values))


def downgrade() -> None:
    """Names stay; they are compared by case alone."""
    connection = op.get_bind()
    rows = connection.execute(sa.select(account.c.id, account.c.name)).all()
    for number, name in rows:
        values = {"folded": name.casefold()}
        connection.execute(sa.update(account).where(account.c.id == number).values(**values))
