"""Which rides are shown: by time, bike, unit, distance, data, tag and words; newest first.

The ids are found in narrow tables and indexes; only the rides of one page are read whole.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sqlalchemy import Connection, Select, func, select

from backend.core.ride import Ride
from backend.errors import InvalidRequest
from backend.store.ride_table import cursor_parts, rides_by_ids
from backend.store.sql import tables as t

PAGE_MAX = 500
# Characters that LIKE takes for more than themselves.
ESCAPE = "\\"


@dataclass(frozen=True)
class RidePage:
    """One page of a list; next: the cursor of the following page, None at the end."""

    items: tuple[Ride, ...]
    next: str | None


@dataclass(frozen=True)
class Sought:
    """What rides are looked for; None for whatever.

    owner_id: the account whose rides. device: a unit's key or serial number. from_us, to_us: when
    they began. longer_km: at least so far. with_motor: the motor's energy is known. with_events:
    faults or marks. words: all of them in name, notes, tags or place. tag: whatever its case.
    """

    from_us: int | None = None
    to_us: int | None = None
    device: str | None = None
    bike_id: int | None = None
    owner_id: int | None = None
    longer_km: float | None = None
    with_motor: bool = False
    with_events: bool = False
    tag: str | None = None
    words: str | None = None


def page_of(connection: Connection, sought: Sought, limit: int, cursor: str | None) -> RidePage:
    """One page of rides. Raises InvalidRequest for a limit or cursor that is none."""
    if not 1 <= limit <= PAGE_MAX:
        raise InvalidRequest(f"limit is {limit}: it must be from 1 to {PAGE_MAX}.")
    query = narrowed(select(t.ride.c.id, t.ride.c.started_us), sought)
    query = query.order_by(t.ride.c.started_us.desc(), t.ride.c.id.desc())
    if cursor is not None:
        started_us, ride_id = cursor_parts(cursor)
        query = query.where(
            (t.ride.c.started_us < started_us)
            | ((t.ride.c.started_us == started_us) & (t.ride.c.id < ride_id))
        )
    rows = connection.execute(query.limit(limit + 1)).all()
    last = rows[limit - 1] if len(rows) > limit else None
    items = rides_by_ids(connection, [row.id for row in rows[:limit]])
    return RidePage(items, None if last is None else f"{last.started_us}.{last.id}")


def count_of(connection: Connection, sought: Sought) -> int:
    """How many rides there are of these."""
    query = narrowed(select(func.count()).select_from(t.ride), sought)
    return int(connection.execute(query).scalar_one())


def ids_of(connection: Connection, sought: Sought) -> list[int]:
    """Every one of these rides that is over, the oldest first."""
    query = narrowed(select(t.ride.c.id), sought).where(t.ride.c.state == "done")
    return list(connection.execute(query.order_by(t.ride.c.started_us, t.ride.c.id)).scalars())


def narrowed(query: Select[Any], sought: Sought) -> Select[Any]:
    """A query over rides, of those that are sought only."""
    ride = t.ride.c
    if sought.from_us is not None:
        query = query.where(ride.started_us >= sought.from_us)
    if sought.to_us is not None:
        query = query.where(ride.started_us < sought.to_us)
    if sought.device is not None:
        query = query.where(
            (ride.unit_key == sought.device) | (ride.device_serial == sought.device)
        )
    if sought.owner_id is not None:
        query = query.where(ride.owner_id == sought.owner_id)
    # As sums bike and distance are no terms of an index: SQLite would gather thousands of rides by
    # them and sort these, instead of reading from the newest on until the page is full.
    if sought.bike_id is not None:
        query = query.where(ride.bike_id + 0 == sought.bike_id)
    if sought.longer_km is not None or sought.with_motor:
        query = query.join(t.ride_summary, t.ride_summary.c.ride_id == ride.id)
        if sought.longer_km is not None:
            query = query.where(t.ride_summary.c.distance_km + 0 >= sought.longer_km)
        if sought.with_motor:
            query = query.where(t.ride_summary.c.motor_wh.is_not(None))
    texts = [f"\n#{sought.tag.strip().casefold()}\n"] if sought.tag else []
    texts += (sought.words or "").casefold().split()
    if texts or sought.with_events:
        query = query.join(t.ride_card, t.ride_card.c.ride_id == ride.id)
        for text in texts:
            query = query.where(t.ride_card.c.words.like(f"%{plain(text)}%", escape=ESCAPE))
        if sought.with_events:
            query = query.where(t.ride_card.c.notable > 0)
    return query


def plain(text: str) -> str:
    """Text in which LIKE sees itself only."""
    for special in (ESCAPE, "%", "_"):
        text = text.replace(special, ESCAPE + special)
    return text
