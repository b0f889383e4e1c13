"""What a list of rides and a rider's totals take once there are 10,000 rides.

With SQLite in processor time: the database is a file in memory's cache, and what else runs is not
ours. With PostgreSQL, where there is a server to be had, in time that passes: most of the work is
another process's.
"""

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from sqlalchemy import Connection, insert, select

from backend.core.channels import ChannelSpec
from backend.core.ride import Ride, RideContext, RideRows
from backend.rides.logbook.cards import RideCards
from backend.rides.logbook.home import RiderHomeService
from backend.rides.service import Rides
from backend.store import Store, open_store
from backend.store.sql import tables as t
from firmware_protocol._generated import CHANNELS
from tests.fakes import postgres
from tools.bench.figures import Figure

RIDES = 10_000
RUNS = 15
AT_MOST_MS = 20.0
NOW_US = 1_780_000_000_000_000
# Two years and a half with eleven rides a day: a year holds nearly half of them.
APART_US = 8_000_000_000
ROWS = 600


def run() -> list[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        with open_store(f"sqlite:///{root}/spindle.db", f"file://{root}/objects") as store:
            fill(store)
            figures = measure(store)
        return figures + on_postgresql(f"file://{root}/beside")


def on_postgresql(objects_url: str) -> list[Figure]:
    """The same on a server of its own, fresh and with statistics; nothing where there is none."""
    if (why := postgres.missing()) is not None:
        return [Figure(f"{RIDES:,} rides on PostgreSQL: {why}", "not measured", "", None)]
    server = postgres.Postgres()
    try:
        with open_store(server.new_database(), objects_url) as store:
            fill(store)
            store.database.write(lambda c: c.exec_driver_sql("ANALYZE"))
            return [
                Figure(
                    f"{RIDES:,} rides on PostgreSQL: {name}",
                    f"{1e3 * median_s(ask, time.perf_counter):.1f} ms",
                    "",
                    None,
                    f"{1e3 * median_s(ask, time.process_time):.1f} ms in Spindle's own process",
                )
                for name, ask in questions(store)
            ]
    finally:
        server.stop()


def measure(store: Store) -> list[Figure]:
    figures = []
    for name, ask in questions(store):
        took_ms = 1e3 * median_s(ask, time.process_time)
        figures.append(
            Figure(f"{RIDES:,} rides: {name}", f"{took_ms:.1f} ms", f"<= {AT_MOST_MS:.0f} ms",
                   took_ms <= AT_MOST_MS)
        )  # fmt: skip
    return figures


def questions(store: Store) -> list[tuple[str, Callable[[], object]]]:
    """What is asked for, in words and as a call."""
    rides, home = Rides(store), RiderHomeService(store, lambda: NOW_US)
    middle = NOW_US - RIDES // 2 * APART_US
    return [
        ("50 rides, newest first", lambda: rides.list()),
        ("50 rides from the middle of the list", lambda: rides.list(cursor=f"{middle}.0")),
        ("50 rides over 10 km with motor data", lambda: rides.list(longer_km=10, with_motor=True)),
        ("50 rides of one bike", lambda: rides.list(bike_id=1)),
        ("50 rides with a tag", lambda: rides.list(tag="winter")),
        ("a search that finds one ride", lambda: rides.list(words="number 4711")),
        ("a search that finds nothing", lambda: rides.list(words="nowhere")),
        ("weeks, months, bikes, records, faults and tags", lambda: home("Europe/Dublin")),
        ("the same of one bike", lambda: home("Europe/Dublin", bike_id=1)),
    ]


def median_s(work: Callable[[], object], clock_s: Callable[[], float]) -> float:
    """Median time of a call, s, by a clock."""
    work()
    taken = []
    for _ in range(RUNS):
        start = clock_s()
        work()
        taken.append(clock_s() - start)
    return statistics.median(taken)


def fill(store: Store) -> None:
    """One ride as a unit tells it, and its rows of SQL again and again with other figures."""
    channels = tuple(ChannelSpec(c.name, c.unit, c.scale) for c in CHANNELS[:20])
    rng = np.random.default_rng(1)
    counts = {c.name: rng.integers(0, 2000, ROWS).astype(np.int16) for c in channels}
    for name in counts.keys() & {"fault_flags", "assist_mode"}:
        counts[name] = np.repeat([1, 2, 1], ROWS // 3).astype(np.int16)
    times_us = np.arange(ROWS, dtype=np.int64) * 100_000
    context = RideContext("u1", "SP-1", unit_key="ebl:SP-1", gear_ratio=40.0)
    ride = Ride(0, "live", "recorded", "", "", 0, ROWS, 100_000, channels, (), context)
    first = store.rides.add(ride, RideRows(channels, times_us, counts)).id
    RideCards(store).tick()
    store.database.write(lambda c: repeat(c, first, rng))


def repeat(connection: Connection, first: int, rng: np.random.Generator) -> None:
    """RIDES rides of the one that is there."""
    bodies = {
        table.name: dict(
            connection.execute(
                select(table).where(table.c["id" if table is t.ride else "ride_id"] == first)
            )
            .one()
            ._mapping
        )
        for table in (t.ride, t.ride_summary, t.ride_card)
    }
    there = set(connection.execute(select(t.bike.c.id)).scalars())
    bikes = [{"id": n, "name": f"Bike {n}", "created_us": 0} for n in {1, 2, 3} - there]
    connection.execute(insert(t.bike), bikes)
    numbers = range(first + 1, first + RIDES)
    km = rng.gamma(3.0, 6.0, RIDES + first + 1)
    connection.execute(
        insert(t.ride),
        [
            bodies["ride"] | {"id": n, "started_us": NOW_US - n * APART_US, "bike_id": 1 + n % 3}
            for n in numbers
        ],
    )
    connection.execute(
        insert(t.ride_summary),
        [
            bodies["ride_summary"]
            | {"ride_id": n, "distance_km": km[n], "motor_wh": km[n] * 4 if n % 2 else None}
            for n in numbers
        ],
    )
    connection.execute(
        insert(t.ride_card),
        [
            bodies["ride_card"]
            | {
                "ride_id": n,
                "ascent_m": km[n] * 9,
                "power_w_best_60s": km[n] + 200,
                "words": f"\nnumber {n}\nafter the rain, along the canal and home\ndublin\n"
                + ("#winter\n" if n % 5 == 0 else ""),
            }
            for n in numbers
        ],
    )
    connection.execute(
        insert(t.ride_tag), [{"ride_id": n, "tag": "Winter"} for n in numbers if n % 5 == 0]
    )
