"""Goal: when a unit was last there, and what it was set to, is known without it: while it is away,
and after the server started anew.

The unit is the small honest one behind a real thread; what was seen is kept in the real store.
"""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from backend.errors import NoAnswer, NotFound
from backend.store import Store, UnitSighting
from backend.tuning.records import RevisionStore
from backend.tuning.service import Tuning
from backend.units.last_seen import LastSeen
from backend.units.records import UnitStore
from backend.units.service import Devices
from tests.fakes.server import eventually
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

URL = "socket://bench:1"
KEY = f"ebl:{b'FAKE-UNIT-01'.hex()}"
NOON_US = 1_800_000_000_000_000
MINUTE_US = 60_000_000


def bench(opener: UnitOpener, last_seen: LastSeen) -> Devices:
    return Devices(opener=lambda url: opener, last_seen=last_seen.at)


def at(now_us: int) -> datetime:
    return datetime.fromtimestamp(now_us / 1e6, UTC)


def test_a_unit_that_is_away_after_a_restart_is_known_by_what_was_last_seen(store: Store) -> None:
    units = UnitStore(store.database)
    opener, last_seen = UnitOpener(FakeUnit(), URL), LastSeen(units)
    devices = bench(opener, last_seen)
    devices.add(URL)
    units.note_unit(UnitSighting(KEY, b"FAKE-UNIT-01".hex()))
    last_seen.update(devices.list(), NOON_US)
    last_seen.update(devices.list(), NOON_US + 20_000_000)
    tuning = Tuning(devices, RevisionStore(store.database))
    device = devices.list()[0].id
    tuning.write_config(device, {"pedal_stop_ms": 200}, "softer")
    tuning.write_config(device, {"pedal_stop_ms": 180}, "tried", confirm_s=30)
    devices.close()
    last_seen.close()

    opener.unplug()
    later = bench(opener, LastSeen(units))
    away = later.add(URL, wait_s=0.0)
    known = Tuning(later, RevisionStore(store.database)).last_known(away.id)

    assert away.state not in ("ready", "read_only")
    assert (away.last_seen_at, away.unit_key) == (at(NOON_US + 20_000_000), KEY)
    assert away.identity is not None
    assert away.identity.serial_number == b"FAKE-UNIT-01".hex()
    # What was on trial ends without us: it is not what the unit is known to have.
    assert next(p.value for p in known.parameters if p.name == "pedal_stop_ms") == 200
    assert known.seen_at == away.last_seen_at
    with pytest.raises(NoAnswer):
        Tuning(later, RevisionStore(store.database)).write_config(away.id, {"pedal_stop_ms": 150})
    later.close()


def test_it_is_written_twice_a_minute_and_when_the_unit_goes(store: Store) -> None:
    units = UnitStore(store.database)
    opener, last_seen = UnitOpener(FakeUnit(), URL), LastSeen(units)
    devices = bench(opener, last_seen)
    devices.add(URL)
    units.note_unit(UnitSighting(KEY))

    def kept(now_us: int) -> int:
        last_seen.update(devices.list(), now_us)
        return next(iter(units.sightings())).seen_us

    assert kept(NOON_US) == NOON_US
    assert kept(NOON_US + MINUTE_US // 4) == NOON_US
    assert kept(NOON_US + MINUTE_US) == NOON_US + MINUTE_US
    last_seen.update(devices.list(), NOON_US + MINUTE_US + 5_000_000)
    opener.unplug()
    eventually(lambda: devices.list()[0].state, lambda state: state not in ("ready", "read_only"))
    assert kept(NOON_US + 10 * MINUTE_US) == NOON_US + MINUTE_US + 5_000_000
    devices.close()


def test_a_unit_that_comes_and_goes_between_two_looks_was_seen(store: Store) -> None:
    units = UnitStore(store.database)
    opener, last_seen = UnitOpener(FakeUnit(), URL), LastSeen(units)
    devices = bench(opener, last_seen)
    devices.watch(last_seen.follower(devices.get))
    devices.add(URL)
    units.note_unit(UnitSighting(KEY))
    eventually(lambda: devices.list()[0].state, lambda state: state == "ready")

    opener.unplug()
    eventually(lambda: devices.list()[0].state, lambda state: state not in ("ready", "read_only"))

    assert devices.list()[0].last_seen_at is not None
    last_seen.close()
    assert [one.unit_key for one in units.sightings()] == [KEY]
    devices.close()


def test_a_connection_that_never_had_a_unit_knows_nothing(store: Store) -> None:
    opener = UnitOpener(FakeUnit(), URL)
    opener.unplug()
    devices = bench(opener, LastSeen(UnitStore(store.database)))
    device = devices.add(URL, wait_s=0.0)

    assert (device.last_seen_at, device.unit_key, device.identity) == (None, None, None)
    with pytest.raises((NoAnswer, NotFound)):
        Tuning(devices, RevisionStore(store.database)).last_known(device.id)
    devices.close()
