"""No motor energy from what was only asked of the motor.

A ride's motor torque is what the motor gave only where its unit also told what it asked. The
figures of other rides were made of what was asked, unless a file told the motor's power itself.
"""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"
branch_labels = None
depends_on = None

MEASURED = {"motor_torque_demanded_nm", "motor_power_w"}
FIGURES = ("motor_wh", "motor_excluded_s", "motor_power_w_mean", "motor_power_w_max")

RIDE = sa.table("ride", sa.column("id", sa.BigInteger), sa.column("channels", sa.JSON))
SUMMARY = sa.table(
    "ride_summary",
    sa.column("ride_id", sa.BigInteger),
    *(sa.column(name, sa.Float) for name in FIGURES),
)


def upgrade() -> None:
    """Take out the motor's energy and power where they are of what was asked."""
    connection = op.get_bind()
    for ride in connection.execute(sa.select(RIDE.c.id, RIDE.c.channels)).all():
        if MEASURED.isdisjoint(channel["name"] for channel in ride.channels):
            connection.execute(
                sa.update(SUMMARY)
                .where(SUMMARY.c.ride_id == ride.id)
                .values(dict.fromkeys(FIGURES))
            )


def downgrade() -> None:
    """What was taken out stays out: a rebuild of the database makes it again from the rows."""
