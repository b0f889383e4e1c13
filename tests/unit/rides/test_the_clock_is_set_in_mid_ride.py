"""Goal: a host that started in 2020 and is told the time in mid-ride dates that ride by the new
time, and says so on it.

Method: a host's clock made here, of the time since it was switched on and what Unix time is beside
that; rows as the device hands them over, read by that clock. The store is a real one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest
from sqlalchemy import Connection, insert, update

from backend.core.ride import Ride, RideContext
from backend.core.ride_events import CLOCK_SET, RideEvent
from backend.device.states import LinkState, StateChanged
from backend.errors import StoreError
from backend.rides.recording.recorder import Recorder
from backend.store import Store, open_store
from backend.store.sql import tables as t
from tests.unit.rides.test_recording import SETTINGS, blocks, riding

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

CONTEXT = RideContext("u1", "SP-1", gear_ratio=40.34, unit_key="ebl:SP-1")
CLOSED = StateChanged(LinkState.CLOSED, "removed")


def unix_us(text: str) -> int:
    return round(datetime.fromisoformat(text).timestamp() * 1e6)


WRONG_US = unix_us("2020-01-01T00:00:30Z")
RIGHT_US = unix_us("2026-11-27T09:00:00Z")
HALF_S = 60.0
SET_BY_MS = (RIGHT_US - WRONG_US) // 1000 - round(HALF_S * 1000)
"""Half a ride had passed when the clock, then a minute past `WRONG_US`, was set to `RIGHT_US`."""


class Host:
    """A bench of one unit on a host. on_us: since it was switched on; nobody sets that."""

    def __init__(self, store: Store) -> None:
        self.store = store
        self.on_us = 45_000_000
        self.offset_us = WRONG_US - self.on_us
        self.unit_us = 0
        self.recorder = Recorder(
            store.rides, lambda unit: CONTEXT, SETTINGS, offset_us=lambda: self.offset_us
        )

    @property
    def now_us(self) -> int:
        return self.on_us + self.offset_us

    def ride(self, seconds: float) -> None:
        """Rows come, each block read when its first row was taken."""
        for block in blocks(riding(seconds), t0_us=self.unit_us):
            wall_us = self.now_us + block.t0_us - self.unit_us
            self.recorder.watch("u1", replace(block, wall_us=wall_us))
        self.unit_us += round(seconds * 1e6)
        self.on_us += round(seconds * 1e6)

    def set_clock(self, now_us: int) -> None:
        self.offset_us = now_us - self.on_us

    def tick(self) -> None:
        self.recorder.tick(self.now_us)

    def live(self) -> Ride:
        (ride_id,) = self.store.rides.live_ids()
        return self.store.rides.get(ride_id)

    def finished(self) -> list[Ride]:
        """All rides, oldest first, once the unit is let go."""
        self.recorder.watch("u1", CLOSED)
        self.recorder.close()
        return sorted(self.store.rides.list().items, key=lambda ride: ride.id)


@pytest.fixture
def host(tmp_path: Path) -> Iterator[Host]:
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        yield Host(store)


def test_a_ride_begun_in_2020_is_dated_by_the_clock_it_ended_with(host: Host) -> None:
    host.ride(HALF_S)
    host.set_clock(RIGHT_US)
    host.ride(HALF_S)

    (ride,) = host.finished()
    assert host.now_us == RIGHT_US + 60_000_000
    assert ride.started_us == host.now_us - 120_000_000
    assert ride.row_count == 12_000
    assert ride.summary is not None
    assert ride.summary.duration_s == pytest.approx(120.0, abs=0.02)
    (told,) = ride.events
    assert (told.kind, told.value) == (CLOCK_SET, SET_BY_MS)


def test_the_ride_has_its_right_date_while_it_is_recorded(host: Host) -> None:
    host.ride(HALF_S)
    before = host.live()
    host.set_clock(RIGHT_US)
    host.tick()
    host.tick()

    after = host.live()
    assert before.started_us == WRONG_US
    assert after.started_us == RIGHT_US - 60_000_000
    assert after.events == (RideEvent(60.0, CLOCK_SET, SET_BY_MS),)
    host.ride(HALF_S)
    (ride,) = host.finished()
    assert (ride.started_us, ride.events) == (after.started_us, after.events)


def test_a_server_that_dies_after_the_clock_was_set_leaves_a_ride_of_the_right_date(
    host: Host, tmp_path: Path
) -> None:
    host.ride(HALF_S)
    host.set_clock(RIGHT_US)
    host.tick()
    host.store.close()

    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        again = Recorder(store.rides, settings=SETTINGS, unfinished=store.unfinished)
        again.tick(host.now_us)
        again.close()
        store.rides.close()
        (ride,) = store.rides.list().items
    assert (ride.state, ride.started_us) == ("done", RIGHT_US - 60_000_000)
    assert [event.kind for event in ride.events] == [CLOCK_SET]


def test_a_clock_that_is_set_back_dates_the_ride_too(host: Host) -> None:
    host.ride(HALF_S)
    host.set_clock(host.now_us - 3_600_000_000)
    host.ride(HALF_S)

    (ride,) = host.finished()
    assert ride.started_us == WRONG_US - 3_600_000_000
    assert [event.value for event in ride.events] == [-3_600_000]


def test_a_clock_that_is_only_adjusted_leaves_the_ride_as_it_is(host: Host) -> None:
    host.ride(HALF_S)
    host.set_clock(host.now_us + 59_000_000)
    host.tick()
    host.ride(HALF_S)

    (ride,) = host.finished()
    assert (ride.started_us, ride.events) == (WRONG_US, ())


def test_a_clock_that_is_set_twice_is_told_twice(host: Host) -> None:
    host.ride(HALF_S)
    host.set_clock(host.now_us + 7_200_000_000)
    host.tick()
    host.ride(HALF_S)
    host.set_clock(host.now_us - 3_600_000_000)
    host.tick()

    (ride,) = host.finished()
    assert ride.started_us == WRONG_US + 3_600_000_000
    assert [(event.t_s, event.value) for event in ride.events] == [
        (60.0, 7_200_000),
        (120.0, -3_600_000),
    ]


def test_time_that_is_granted_to_a_simulated_unit_sets_no_clock(host: Host) -> None:
    host.ride(HALF_S)
    host.on_us -= 50_000_000
    host.ride(600.0)
    host.on_us -= 590_000_000

    (ride,) = host.finished()
    assert (ride.started_us, ride.events) == (WRONG_US, ())


@pytest.mark.parametrize("by_s", [220_000_000, -7_200])
def test_a_clock_that_is_set_ends_no_ride_and_keeps_none_open(host: Host, by_s: int) -> None:
    host.ride(HALF_S)
    host.set_clock(host.now_us + by_s * 1_000_000)

    host.tick()
    assert host.recorder.status("u1") is not None
    host.on_us += 15_000_000
    host.tick()

    assert host.recorder.status("u1") is None


def test_a_store_that_refuses_is_asked_again(host: Host, monkeypatch: pytest.MonkeyPatch) -> None:
    host.ride(HALF_S)
    host.set_clock(RIGHT_US)

    def refuse(*told: object) -> None:
        raise StoreError("The disk is full.")

    with monkeypatch.context() as full:
        full.setattr(host.store.rides, "redate", refuse)
        host.tick()
        host.recorder.watch("u1", CLOSED)
        assert host.live().started_us == WRONG_US
    host.tick()

    (ride,) = host.finished()
    assert (ride.state, ride.started_us) == ("done", RIGHT_US - 60_000_000)
    assert len(ride.events) == 1


def test_the_ride_is_of_the_bike_the_unit_is_on_at_its_right_date(host: Host) -> None:
    in_2025_us = unix_us("2025-05-01T10:00:00Z")
    host.set_clock(in_2025_us - 86_400_000_000)
    host.ride(10.0)
    (first,) = host.finished()
    moved_to = host.store.database.write(lambda c: move_unit(c, "ebl:SP-1", in_2025_us))

    host.set_clock(WRONG_US)
    host.ride(HALF_S)
    begun_on = host.live().bike_id
    host.set_clock(RIGHT_US)
    *_, ride = host.finished()

    assert begun_on == first.bike_id != moved_to
    assert ride.bike_id == moved_to


def move_unit(connection: Connection, key: str, at_us: int) -> int:
    """Put a unit on another bike from then on."""
    made = insert(t.bike).values(name="Cargo", created_us=at_us).returning(t.bike.c.id)
    bike_id = int(connection.execute(made).scalar_one())
    mine = t.bike_unit.c.unit_key == key
    connection.execute(update(t.bike_unit).where(mine).values(to_us=at_us))
    on_it = {"bike_id": bike_id, "unit_key": key, "from_us": at_us}
    connection.execute(insert(t.bike_unit).values(on_it))
    return bike_id
