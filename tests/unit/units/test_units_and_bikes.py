"""Goal: a unit, not its cable, is what rides and configurations belong to, and each unit has a bike
without anybody making one; a database of before knows both after its migration.

Method: units by key in a store of their own; an older database is made by the older migrations and
filled by hand, with figures and tails hanging on its rides.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from sqlalchemy import insert, update

import backend.store
from backend.core.ride import Ride, RideContext
from backend.core.unit_key import bike_name, ebl_key, identifies_unit, unit_key
from backend.rebuild import rebuild_store
from backend.store import Sought, Store, UnitSighting, open_store
from backend.store.sql import tables as t
from backend.units.records import UnitStore
from tests.unit.conftest import OpenStore
from tests.unit.store.ride_data import CHANNELS, PERIOD_US, STARTED_US, honest_ride

MIGRATIONS = Path(backend.store.__file__).parent / "sql" / "migrations"
HOUR_US = 3_600_000_000
MINE = RideContext("dev-ttyusb0", "SP-1", "mid drive", unit_key="ebl:SP-1")


def ridden(store: Store, context: RideContext, started_us: int = STARTED_US) -> Ride:
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, started_us, context)
    store.rides.append_tail(ride_id, 0, honest_ride(300)).result()
    ride = store.rides.finish(ride_id)
    assert ride is not None
    return ride


@pytest.mark.parametrize(
    ("serial_number", "name", "key", "tells"),
    [
        ("0042", None, "ebl:0042", True),
        ("0042", "Commuter", "ebl:0042", True),
        ("url", None, "ebl:url", True),
        (None, "Commuter", "ebl:name:Commuter", True),
        (None, "url:", "ebl:name:url:", True),
        (None, None, "ebl:url:socket://shed:1", False),
    ],
)
def test_a_key_is_of_the_serial_number_else_of_the_name_else_of_the_url(
    serial_number: str | None, name: str | None, key: str, tells: bool
) -> None:
    assert unit_key("ebl", serial_number, name, "socket://shed:1") == key
    assert identifies_unit(key) is tells


def test_what_is_older_than_keys_is_a_unit_of_our_own_protocol() -> None:
    assert ebl_key("0042") == "ebl:0042"
    assert ebl_key(None) is None


def test_a_bike_is_called_what_its_owner_calls_the_unit_else_model_and_number() -> None:
    assert bike_name("ebl:0123456789", None, "mid drive") == "mid drive 456789"
    assert bike_name("ebl:0123456789", "Commuter", "mid drive") == "Commuter"
    assert bike_name("bafang:name:My Commuter", None, "hub motor") == "My Commuter"


def test_a_unit_that_is_seen_is_on_a_bike_of_its_own_and_stays_on_it(reopen: OpenStore) -> None:
    store = reopen()
    units = UnitStore(store.database)
    units.note_unit(UnitSighting("ebl:SP-1", "SP-1", None, "mid drive", "1.2.0"))
    units.note_unit(UnitSighting("ebl:SP-2", "SP-2", "Tandem", "mid drive", "1.2.0"))
    first, second = (
        units.bike_of("ebl:SP-1"),
        units.bike_of("ebl:SP-2"),
    )
    units.note_unit(UnitSighting("ebl:SP-1", "SP-1", "Commuter", "mid drive", "1.3.0"))
    store.close()

    again = reopen()

    assert None not in (first, second)
    assert first != second
    assert UnitStore(again.database).bike_of("ebl:SP-1") == first
    with again.database.engine.connect() as connection:
        bikes = connection.execute(t.bike.select().order_by(t.bike.c.id)).all()
        unit = connection.execute(t.unit.select().where(t.unit.c.key == "ebl:SP-1")).one()
    assert [bike.name for bike in bikes] == ["mid drive SP-1", "Tandem"]
    assert (unit.name, unit.firmware_version, unit.serial_number) == ("Commuter", "1.3.0", "SP-1")


def test_a_unit_that_only_its_url_is_known_of_is_on_no_bike(store: Store) -> None:
    key = "bafang:url:/dev/ttyUSB0"
    UnitStore(store.database).note_unit(UnitSighting(key, model="hub motor"))

    ride = ridden(store, RideContext("dev-ttyusb0", unit_key=key))

    assert UnitStore(store.database).bike_of(key) is None
    assert (ride.context.unit_key, ride.bike_id) == (key, None)
    assert store.rides.list(Sought(device=key)).items == (ride,)


def test_a_ride_is_of_the_bike_its_unit_is_on_and_found_by_key_and_by_number(store: Store) -> None:
    UnitStore(store.database).note_unit(UnitSighting("ebl:SP-1", "SP-1"))
    ride = ridden(store, replace(MINE, device_id="socket-shed-1"))
    ridden(store, replace(MINE, unit_key="ebl:SP-2", device_serial="SP-2"))

    assert ride.bike_id == UnitStore(store.database).bike_of("ebl:SP-1")
    assert store.rides.list(Sought(device="ebl:SP-1")).items == (ride,)
    assert store.rides.list(Sought(device="SP-1")).items == (ride,)


def test_a_ride_of_a_unit_nobody_saw_makes_its_bike(store: Store) -> None:
    first, later = ridden(store, MINE), ridden(store, MINE, STARTED_US + HOUR_US)
    nobody = ridden(store, RideContext())

    assert first.bike_id is not None
    assert later.bike_id == first.bike_id
    assert nobody.bike_id is None


def test_a_unit_that_tells_itself_late_takes_the_ride_to_its_bike(store: Store) -> None:
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext("dev-ttyusb0"))
    store.rides.append_tail(ride_id, 0, honest_ride(300)).result()

    store.rides.set_context(ride_id, MINE)

    ride = store.rides.get(ride_id)
    assert (ride.context, ride.bike_id) == (MINE, 1)


def test_a_unit_moved_to_another_bike_leaves_its_old_rides_where_they_were(store: Store) -> None:
    before = ridden(store, MINE)
    moved_us = STARTED_US + HOUR_US
    with store.database.engine.begin() as connection:
        connection.execute(update(t.bike_unit).values(to_us=moved_us))
        connection.execute(insert(t.bike).values(id=7, name="new frame", created_us=moved_us))
        on_it = {"bike_id": 7, "unit_key": "ebl:SP-1", "from_us": moved_us + HOUR_US}
        connection.execute(insert(t.bike_unit).values(on_it))

    older = ridden(store, MINE, STARTED_US - HOUR_US)
    between = ridden(store, MINE, moved_us + 1)
    after = ridden(store, MINE, moved_us + 2 * HOUR_US)

    assert (older.bike_id, between.bike_id, after.bike_id) == (before.bike_id, None, 7)


@pytest.mark.slow
def test_a_rebuilt_store_has_its_rides_on_their_units_and_bikes(tmp_path: Path) -> None:
    urls = (f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())
    named = RideContext("dev-ttyusb0", unit_key="bafang:name:Commuter")
    with open_store(*urls) as store:
        for hour, context in enumerate((MINE, named, RideContext(), MINE)):
            ridden(store, context, STARTED_US + hour * HOUR_US)
        before = [(ride.context.unit_key, ride.bike_id) for ride in store.rides.list().items]
    (tmp_path / "spindle.db").unlink()

    rebuild_store(*urls)

    with open_store(*urls) as store:
        after = [(ride.context.unit_key, ride.bike_id) for ride in store.rides.list().items]
        assert UnitStore(store.database).bike_of("bafang:name:Commuter") == 2
    assert after == before == [("ebl:SP-1", 1), (None, None), (named.unit_key, 2), ("ebl:SP-1", 1)]
