"""Units that were seen, and which bike each is on now. Which unit is which: core.unit_key."""

from __future__ import annotations

import time

from sqlalchemy import Connection, select, update

from backend.store.bikes import UnitSighting, bike_of_unit, bikes_now
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.units.types import Sighting


class UnitStore:
    """Every unit there was, and its bike."""

    def __init__(self, database: Database) -> None:
        self._database = database
        # For callers that must not wait: this server alone changes it.
        self._bikes = database.read(bikes_now)

    def note_unit(self, unit: UnitSighting) -> None:
        """Note that a unit is there now; a name once given stays. Raises StoreError."""

        def work(connection: Connection) -> int | None:
            now_us = time.time_ns() // 1000
            bike_id = bike_of_unit(connection, unit.key, unit, now_us)
            values = {
                "serial_number": unit.serial_number,
                "model": unit.model,
                "firmware_version": unit.firmware_version,
                "last_seen_us": now_us,
            }
            if unit.name is not None:
                values["name"] = unit.name
            mine = t.unit.c.key == unit.key
            connection.execute(update(t.unit).where(mine).values(values))
            return bike_id

        bike_id = self._database.write(work)
        if bike_id is not None:
            self._bikes = {**self._bikes, unit.key: bike_id}

    def sighted(self, sighting: Sighting) -> None:
        """Note when and over which connection a unit was last there. Raises StoreError."""
        values = {"last_seen_us": sighting.seen_us, "last_url": sighting.url}
        mine = t.unit.c.key == sighting.unit_key
        self._database.write(lambda c: c.execute(update(t.unit).where(mine).values(values)))

    def sightings(self) -> tuple[Sighting, ...]:
        """The last sight of every unit whose connection is known, oldest first."""
        query = select(t.unit).where(t.unit.c.last_url.is_not(None)).order_by(t.unit.c.last_seen_us)
        rows = self._database.read(lambda connection: connection.execute(query).all())
        return tuple(
            Sighting(
                url=row.last_url,
                unit_key=row.key,
                seen_us=row.last_seen_us,
                serial_number=row.serial_number,
                name=row.name,
                model=row.model,
                firmware_version=row.firmware_version,
            )
            for row in rows
        )

    def moved(self) -> None:
        """Look anew at which bike each unit is on. Raises StoreError."""
        self._bikes = self._database.read(bikes_now)

    def bike_of(self, key: str) -> int | None:
        """The bike a unit is on now; None for one that is on none or was not seen. Never waits."""
        return self._bikes.get(key)
