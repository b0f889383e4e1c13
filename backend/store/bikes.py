"""Units that were seen, and the bikes they are on. Which unit is which: backend/core/unit_key.py.

A unit that is seen for the first time is on a bike of its own from then on. One that only its url
is known of is on none: nobody can say which bike that is.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import Connection, Table, insert, select
from sqlalchemy.dialects import postgresql, sqlite

from backend.core.actor import SERVER
from backend.core.audit import Action, AuditEntry
from backend.core.person import ANYBODY, Sender
from backend.core.ride import RideContext
from backend.core.unit_key import bike_name, identifies_unit
from backend.store import audit
from backend.store.sql import tables as t


@dataclass(frozen=True)
class UnitSighting:
    """A unit as it says it is. name: its owner's, None where nobody gave it one."""

    key: str
    serial_number: str | None = None
    name: str | None = None
    model: str | None = None
    firmware_version: str | None = None


def bike_of_ride(connection: Connection, context: RideContext, started_us: int) -> int | None:
    """The bike a ride was made with, made like its unit where they are not known.

    None where the unit is unknown. What is older than a unit's first bike is its too.
    """
    key = context.unit_key
    if key is None:
        return None
    unit = UnitSighting(key, context.device_serial, None, context.device_model)
    bike_of_unit(connection, key, unit, started_us)
    return bike_at(connection, key, started_us)


def bike_at(connection: Connection, key: str, at_us: int) -> int | None:
    """The bike a unit was on then; None for one that was on none or was not seen."""
    columns = (t.bike_unit.c.bike_id, t.bike_unit.c.from_us, t.bike_unit.c.to_us)
    mine = select(*columns).where(t.bike_unit.c.unit_key == key)
    rows = connection.execute(mine.order_by(t.bike_unit.c.from_us)).all()
    begun = [row for row in rows if row.from_us <= at_us] or rows[:1]
    if not begun or (begun[-1].to_us is not None and begun[-1].to_us <= at_us):
        return None
    return int(begun[-1].bike_id)


def owner_at(connection: Connection, bike_id: int | None, at_us: int) -> int | None:
    """The account whose bike it was then."""
    owner = t.bike_owner.c
    query = select(owner.account_id).where(owner.bike_id == bike_id, owner.from_us <= at_us)
    query = query.where(owner.to_us.is_(None) | (owner.to_us > at_us))
    return connection.execute(query.order_by(owner.from_us.desc()).limit(1)).scalar()


def whose_ride(
    connection: Connection, context: RideContext, started_us: int, sender: Sender = ANYBODY
) -> dict[str, int | None]:
    """The columns that say with which bike a ride was made, and whose it is: the bike's owner's
    when it began.

    sender: of its file. What a rider sent is theirs, and of a bike only if that was theirs, too:
    nobody adds rides to another's bike. What a key of one bike sent is of that bike, unless its
    unit was on another one then: that one is not the key's, so the ride is of none.
    """
    if sender.owner_id is None and sender.bike_id is None:
        bike_id = bike_of_ride(connection, context, started_us)
        return {"bike_id": bike_id, "owner_id": owner_at(connection, bike_id, started_us)}
    key = context.unit_key
    on = None if key is None else bike_at(connection, key, started_us)
    bike_id = sender.bike_id if on is None else on
    owner_id = owner_at(connection, bike_id, started_us)
    if sender.bike_id not in (None, bike_id) or sender.owner_id not in (None, owner_id):
        bike_id = owner_id = None
    return {"bike_id": bike_id, "owner_id": sender.owner_id or owner_id}


def bike_of_unit(
    connection: Connection, key: str, unit: UnitSighting | None = None, now_us: int | None = None
) -> int | None:
    """Add a unit that is new, on a bike of its own; returns the bike it is on now."""
    unit = unit or UnitSighting(key)
    now_us = time.time_ns() // 1000 if now_us is None else now_us
    values = {
        "key": key,
        "serial_number": unit.serial_number,
        "name": unit.name,
        "model": unit.model,
        "created_us": now_us,
        "last_seen_us": now_us,
    }
    if is_inserted(connection, t.unit, values) and identifies_unit(key):
        name = bike_name(key, unit.name, unit.model)
        made = insert(t.bike).values(name=name, created_us=now_us).returning(t.bike.c.id)
        bike_id = int(connection.execute(made).scalar_one())
        on_it = insert(t.bike_unit).values(bike_id=bike_id, unit_key=key, from_us=now_us)
        connection.execute(on_it)
        facts = {"unit_key": key, "model": unit.model}
        entry = AuditEntry(Action.UNIT_FIRST_SEEN, key, name, None, facts, "", key, bike_id)
        audit.append(connection, entry, SERVER)
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
