"""Units that were seen, and the bikes they are on. Which unit is which: backend/core/unit_key.py.

A unit that is seen for the first time is on a bike of its own from then on. One that only its url
is known of is on none: nobody can say which bike that is.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import Connection, Table, insert, select, update
from sqlalchemy.dialects import postgresql, sqlite

from backend.core.ride import RideContext
from backend.core.unit_key import bike_name, tells_unit
from backend.domain.sighting import Sighting
from backend.store.sql import tables as t
from backend.store.sql.database import Database


@dataclass(frozen=True)
class SeenUnit:
    """A unit as it says it is. name: its owner's, None where nobody gave it one."""

    key: str
    serial_number: str | None = None
    name: str | None = None
    model: str | None = None
    firmware_version: str | None = None


class UnitStore:
    """Every unit there was, and its bike."""

    def __init__(self, database: Database) -> None:
        self._database = database
        # What those who must not wait are told: this server alone changes it.
        self._bikes = database.read(bikes_now)

    def seen(self, unit: SeenUnit) -> None:
        """Note that a unit is there now; a name once given stays. Raises StoreError."""

        def work(connection: Connection) -> int | None:
            now_us = time.time_ns() // 1000
            bike_id = known_unit(connection, unit.key, unit, now_us)
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

    def bike_of(self, key: str) -> int | None:
        """The bike a unit is on now; None for one that is on none or was not seen. Never waits."""
        return self._bikes.get(key)


def bike_of_ride(connection: Connection, context: RideContext, started_us: int) -> int | None:
    """The bike a ride was made with, made like its unit where they are not known.

    None where nobody knows which unit it was. What is older than a unit's first bike is its too.
    """
    key = context.unit_key
    if key is None:
        return None
    unit = SeenUnit(key, context.device_serial, None, context.device_model)
    known_unit(connection, key, unit, started_us)
    columns = (t.bike_unit.c.bike_id, t.bike_unit.c.from_us, t.bike_unit.c.to_us)
    mine = select(*columns).where(t.bike_unit.c.unit_key == key)
    rows = connection.execute(mine.order_by(t.bike_unit.c.from_us)).all()
    begun = [row for row in rows if row.from_us <= started_us] or rows[:1]
    if not begun or (begun[-1].to_us is not None and begun[-1].to_us <= started_us):
        return None
    return int(begun[-1].bike_id)


def known_unit(
    connection: Connection, key: str, unit: SeenUnit | None = None, now_us: int | None = None
) -> int | None:
    """Add a unit that is new, on a bike of its own; returns the bike it is on now."""
    unit = unit or SeenUnit(key)
    now_us = time.time_ns() // 1000 if now_us is None else now_us
    values = {
        "key": key,
        "serial_number": unit.serial_number,
        "name": unit.name,
        "model": unit.model,
        "created_us": now_us,
        "last_seen_us": now_us,
    }
    if is_inserted(connection, t.unit, values) and tells_unit(key):
        name = bike_name(key, unit.name, unit.model)
        made = insert(t.bike).values(name=name, created_us=now_us).returning(t.bike.c.id)
        bike_id = int(connection.execute(made).scalar_one())
        on_it = insert(t.bike_unit).values(bike_id=bike_id, unit_key=key, from_us=now_us)
        connection.execute(on_it)
    on_now = select(t.bike_unit.c.bike_id).where(
        t.bike_unit.c.unit_key == key, t.bike_unit.c.to_us.is_(None)
    )
    return connection.execute(on_now).scalar()


def is_inserted(connection: Connection, table: Table, values: Mapping[str, object]) -> bool:
    """Whether a row was added: False where one with its key is there, whoever is adding it now."""
    added: sqlite.Insert | postgresql.Insert
    added = (
        sqlite.insert(table) if connection.dialect.name == "sqlite" else postgresql.insert(table)
    )
    return connection.execute(added.values(values).on_conflict_do_nothing()).rowcount == 1


def bikes_now(connection: Connection) -> dict[str, int]:
    """The bike of every unit that is on one."""
    columns = (t.bike_unit.c.unit_key, t.bike_unit.c.bike_id)
    rows = connection.execute(select(*columns).where(t.bike_unit.c.to_us.is_(None)))
    return {row.unit_key: int(row.bike_id) for row in rows}
