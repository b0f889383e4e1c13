"""Zeros of rides: which ones are due, what is kept of them, and those of one unit."""

from __future__ import annotations

from dataclasses import asdict, fields

from sqlalchemy import Connection, select

from backend.core.ride import Ride
from backend.core.ride_zero import METHOD, RideZero, ZeroOfRide
from backend.store.logbook.derived import due_rides, save_row
from backend.store.sql import tables as t
from backend.store.sql.database import Database

FIELDS = tuple(field.name for field in fields(RideZero))


class ZeroStore:
    """The zero of every ride, derived."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def due(self, limit: int) -> list[int]:
        """Finished rides without a zero by today's method and of their present rows."""
        return self._database.read(lambda c: due_rides(c, t.ride_zero, METHOD, limit))

    def save(self, ride: Ride, zero: RideZero) -> None:
        """Keep a ride's zero, unless the ride is gone or another meanwhile. Raises StoreError."""
        self._database.write(lambda c: save_row(c, t.ride_zero, METHOD, ride, asdict(zero)))

    def of_unit(self, unit_key: str, limit: int) -> tuple[ZeroOfRide, ...]:
        """The newest rides of a unit with their zeros, newest first; those not yet made are not
        among them."""

        def work(connection: Connection) -> tuple[ZeroOfRide, ...]:
            columns = (t.ride.c.started_us, t.ride.c.context, t.ride_zero.c.ride_id)
            query = (
                select(*columns, *(t.ride_zero.c[name] for name in FIELDS))
                .join(t.ride, t.ride.c.id == t.ride_zero.c.ride_id)
                .where(t.ride.c.unit_key == unit_key)
                .order_by(t.ride.c.started_us.desc(), t.ride.c.id.desc())
                .limit(limit)
            )
            return tuple(
                ZeroOfRide(
                    row.ride_id,
                    row.started_us,
                    RideZero(**{name: getattr(row, name) for name in FIELDS}),
                    row.context.get("config_generation"),
                    row.context.get("config_crc32"),
                )
                for row in connection.execute(query)
            )

        return self._database.read(work)
