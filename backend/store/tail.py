"""The rows of a ride that has no object yet, read back from SQL."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any

import numpy as np
from sqlalchemy import Connection, Select, select

from backend.core.channels import MISSING_INT16
from backend.core.ride import Ride, RideRows
from backend.errors import StoreError
from backend.store.sql import tables as t
from backend.store.sql.blobs import Rows16, decode_tail
from backend.store.sql.database import Database

# A minute or so.
TAILS_AT_ONCE = 64


def tail_blocks(database: Database, ride: Ride) -> Iterator[Rows16]:
    """A live ride's rows, in order, without holes: what is lost or damaged is missing."""
    missing = np.int16(MISSING_INT16)
    width = len(ride.channels)
    at = 0
    for row_start, row_count, payload in tails(database, ride.id):
        if row_start > at:
            yield np.full((row_start - at, width), missing)
        try:
            block = decode_tail(payload, width)
        except StoreError:
            block = np.full((row_count, width), missing)
        yield block[max(0, at - row_start) :]
        at = max(at, row_start + len(block))


def tail_chunks(database: Database, ride: Ride) -> Iterable[RideRows]:
    """As `tail_blocks`, with times and by channel."""
    start = 0
    for block in tail_blocks(database, ride):
        times_us = np.arange(start, start + len(block), dtype=np.int64) * (ride.period_us or 1)
        counts = {
            channel.name: np.ascontiguousarray(block[:, index])
            for index, channel in enumerate(ride.channels)
        }
        yield RideRows(ride.channels, times_us, counts)
        start += len(block)


def tails(database: Database, ride_id: int) -> Iterator[tuple[int, int, bytes]]:
    """First row, rows and payload of each tail."""
    columns = (t.ride_tail.c.row_start, t.ride_tail.c.row_count, t.ride_tail.c.payload)
    mine = select(*columns).where(t.ride_tail.c.ride_id == ride_id)
    ordered = mine.order_by(t.ride_tail.c.row_start).limit(TAILS_AT_ONCE)
    next_start = 0
    while True:
        query = ordered.where(t.ride_tail.c.row_start >= next_start)
        rows = database.read(partial(fetched, query))
        yield from rows
        if len(rows) < TAILS_AT_ONCE:
            return
        next_start = rows[-1][0] + 1


def fetched(query: Select[Any], connection: Connection) -> list[tuple[int, int, bytes]]:
    """Rows of a query as plain tuples."""
    return [(row[0], row[1], row[2]) for row in connection.execute(query)]
