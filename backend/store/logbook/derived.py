"""What is worked out of each ride and kept beside it: which rides are due, and how it is kept.

Each such table has `ride_id`, the `method` that made its row, and the `object_key` of the ride's
rows that it was made of. Any row may be missing, and is made anew.
"""

from __future__ import annotations

from collections.abc import Mapping

from sqlalchemy import Connection, Table, delete, insert, or_, select

from backend.core.ride import Ride
from backend.store.sql import tables as t


def due_rides(connection: Connection, table: Table, method: int, limit: int) -> list[int]:
    """Finished rides without a row by this method and of their present rows, newest first."""
    row = table.c
    query = (
        select(t.ride.c.id)
        .outerjoin(table, row.ride_id == t.ride.c.id)
        .where(t.ride.c.state == "done")
        .where(
            or_(row.ride_id.is_(None), row.method < method, row.object_key != t.ride.c.object_key)
        )
        .order_by(t.ride.c.started_us.desc())
        .limit(limit)
    )
    return list(connection.execute(query).scalars())


def save_row(
    connection: Connection, table: Table, method: int, ride: Ride, values: Mapping[str, object]
) -> bool:
    """Keep what was worked out; False where the ride is gone or another meanwhile."""
    connection.execute(delete(table).where(table.c.ride_id == ride.id))
    mine = (t.ride.c.id == ride.id) & (t.ride.c.object_key == ride.object_key)
    if connection.execute(select(t.ride.c.id).where(mine)).first() is None:
        return False
    made = {"ride_id": ride.id, "method": method, "object_key": ride.object_key}
    connection.execute(insert(table).values(made | dict(values)))
    return True
