"""Goal: a bike changes hands by a code, once; a ride stays with whom it was ridden by.

Method: the register over a real store, with rides on days that are written out.
"""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from sqlalchemy import update

from backend.bikes.codes import ALPHABET, new_code, plain_code
from backend.bikes.records import BikeStore, PairingStore
from backend.bikes.service import FREE_TRIES, VALID_US, Bikes
from backend.bikes.types import BikeChange, BikeIn
from backend.core.channels import ChannelSpec
from backend.core.person import Person
from backend.core.ride import Ride, RideContext, RideRows
from backend.errors import Conflict, InvalidRequest, NotAllowed, NotFound, TooManyTries
from backend.people.service import PeopleService
from backend.store import Sought, Store, open_store
from backend.store.sql import tables as t
from backend.store.wall_clock import now_us
from tests.fakes.house import PASSWORD

SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
HERE = "http://workshop.example/"
DAY = timedelta(days=1)
TODAY = datetime.now(UTC).replace(microsecond=0)


class Register:
    """The register over a store, at a clock of its own for the wait between codes."""

    def __init__(self, store: Store) -> None:
        self.store = store
        self.now_s = 0.0
        self.people = PeopleService(store.database)
        pairings = PairingStore(store.database)
        self.bikes = Bikes(
            BikeStore(store.database), pairings, self.people, now_s=lambda: self.now_s
        )

    def rider(self, name: str) -> Person:
        return self.people.accounts.add(name, "rider", PASSWORD)

    def bike(self, name: str = "City 7") -> int:
        return self.bikes.add(BikeIn(name=name)).bike.id

    def code(self, bike_id: int, since: datetime | None = None) -> str:
        return self.bikes.pair(bike_id, since, HERE).code

    def hand_over(self, bike_id: int, person: Person, since: datetime | None = None) -> None:
        self.bikes.take(self.code(bike_id, since), person, "here")

    def ride(self, day: datetime, unit: str = "ebl:A") -> int:
        """A ride of a unit that began at that moment; its id."""
        rows = RideRows(
            (SPEED,), np.arange(60, dtype=np.int64) * 1_000_000, {"speed_kmh": np.full(60, 2000)}
        )
        started_us = int(day.timestamp() * 1e6)
        context = RideContext(unit_key=unit, device_serial=unit.split(":")[1])
        ride = Ride(0, "live", "imported", "", "", started_us, 60, 1_000_000, (SPEED,), (), context)
        return self.store.rides.add(ride, rows).id

    def rides_of(self, person: Person) -> list[int]:
        page = self.store.rides.list(Sought(owner_id=person.id), 50, None)
        return sorted(ride.id for ride in page.items)


@pytest.fixture
def register(tmp_path: Path) -> Iterator[Register]:
    with open_store(f"sqlite:///{tmp_path}/s.db", (tmp_path / "o").as_uri()) as store:
        yield Register(store)


def test_a_ride_keeps_the_owner_it_had_when_it_began(register: Register) -> None:
    before = register.ride(TODAY - 9 * DAY)
    [bike] = register.bikes.list()
    rita, olaf = register.rider("Rita"), register.rider("Olaf")

    register.hand_over(bike.id, rita, since=TODAY - 5 * DAY)
    hers = register.ride(TODAY - 3 * DAY)
    register.hand_over(bike.id, olaf)
    his = register.ride(TODAY + DAY)
    hers_that_came_late = register.ride(TODAY - 2 * DAY)

    assert register.rides_of(rita) == [hers, hers_that_came_late]
    assert register.rides_of(olaf) == [his]
    assert register.store.rides.get(before).owner_id is None
    owners = [owner.name for owner in register.bikes.get(bike.id).owners]
    assert owners == ["Olaf", "Rita"]


def test_rides_of_before_become_an_owner_s_who_had_the_bike_then(register: Register) -> None:
    too_early, theirs = register.ride(TODAY - 5 * DAY), register.ride(TODAY - DAY)
    [bike] = register.bikes.list()
    rita = register.rider("Rita")

    register.hand_over(bike.id, rita, since=TODAY - 2 * DAY)

    assert register.rides_of(rita) == [theirs]
    assert register.store.rides.get(too_early).owner_id is None
    # A log of those days that comes late is hers as well.
    late = register.ride(TODAY - DAY / 2)
    assert register.rides_of(rita) == [theirs, late]


def test_nobody_becomes_the_owner_of_days_on_which_the_bike_was_somebody_s(
    register: Register,
) -> None:
    bike_id, rita, olaf = register.bike(), register.rider("Rita"), register.rider("Olaf")
    register.hand_over(bike_id, rita, since=TODAY - 9 * DAY)

    with pytest.raises(Conflict, match="from now on") as refused:
        register.code(bike_id, since=TODAY - DAY)
    assert refused.value.code == "was_owned"
    with pytest.raises(InvalidRequest, match="to come"):
        register.code(bike_id, since=TODAY + DAY)
    # Between making the code and taking it somebody else had it.
    register.bikes.leave(bike_id)
    since = datetime.now(UTC)
    code = register.code(bike_id, since=since)
    with register.store.database.engine.begin() as connection:
        values = {"bike_id": bike_id, "account_id": rita.id, "name": "Rita"}
        from_us = int(since.timestamp() * 1e6) + 1
        connection.execute(t.bike_owner.insert().values(**values, from_us=from_us))
    with pytest.raises(Conflict):
        register.bikes.take(code, olaf, "here")


def test_a_code_gives_a_bike_once(register: Register) -> None:
    bike_id, rita, olaf = register.bike(), register.rider("Rita"), register.rider("Olaf")
    code = register.code(bike_id)

    assert register.bikes.offer(code, "here").bike_name == "City 7"
    register.bikes.take(code, rita, "here")

    for _ in range(2):
        with pytest.raises(NotFound) as used:
            register.bikes.take(code, olaf, "here")
        assert used.value.code == "no_pairing"
    owner = register.bikes.get(bike_id).bike.owner
    assert owner is not None
    assert (owner.name, owner.until) == ("Rita", None)


def test_a_newer_code_and_a_week_end_a_code(register: Register) -> None:
    bike_id, rita = register.bike(), register.rider("Rita")
    first = register.code(bike_id)
    second = register.code(bike_id)
    with pytest.raises(NotFound):
        register.bikes.take(first, rita, "here")

    made_us = now_us()
    assert register.bikes.offer(second, "here").expires_at.timestamp() * 1e6 <= made_us + VALID_US
    with register.store.database.engine.begin() as connection:
        connection.execute(update(t.pairing).values(expires_us=made_us))
    with pytest.raises(NotFound):
        register.bikes.take(second, rita, "here")


def test_whose_a_bike_is_already_keeps_it_and_the_code(register: Register) -> None:
    bike_id, rita = register.bike(), register.rider("Rita")
    register.hand_over(bike_id, rita)
    code = register.code(bike_id)

    with pytest.raises(Conflict) as refused:
        register.bikes.take(code, rita, "here")

    assert refused.value.code == "yours_already"
    assert register.bikes.offer(code, "here").bike_name == "City 7"
    assert len(register.bikes.get(bike_id).owners) == 1


def test_a_code_is_read_however_it_is_typed() -> None:
    code = new_code()

    assert len(code) == 9
    assert set(code.replace("-", "")) <= set(ALPHABET)
    assert plain_code(f" {code.lower()} ") == plain_code(code.replace("-", " "))
    # What a hand writes as O, I and L.
    assert plain_code("oil0-1234") == "01101234"


def test_codes_are_not_guessed(register: Register) -> None:
    code = register.code(register.bike())
    for number in range(FREE_TRIES):
        with pytest.raises(NotFound):
            register.bikes.offer(f"WRNG-{number:04}", "there")

    with pytest.raises(TooManyTries, match="wait 1 s"):
        register.bikes.offer(code, "there")

    assert register.bikes.offer(code, "elsewhere").bike_name == "City 7"
    register.now_s += 1.5
    assert register.bikes.offer(code, "there").bike_name == "City 7"


def test_who_has_no_account_makes_one_with_the_code_or_neither(register: Register) -> None:
    bike_id = register.bike()
    register.rider("Rita")
    code = register.code(bike_id)
    with pytest.raises(Conflict, match="Rita"):
        register.bikes.join(code, "Rita", PASSWORD, "here")
    with pytest.raises(InvalidRequest):
        register.bikes.join(code, "Olaf", "12345678", "here")

    person, joined = register.bikes.join(code, "Olaf", PASSWORD, "here")

    assert (person.role, joined) == ("rider", bike_id)
    with pytest.raises(NotFound):
        register.bikes.join(code, "Eve", PASSWORD, "here")
    assert [one.name for one in register.people.accounts.list()] == ["Olaf", "Rita"]


def test_an_account_that_loses_the_race_for_a_code_is_not_made(register: Register) -> None:
    bike_id, rita = register.bike(), register.rider("Rita")
    code = register.code(bike_id)
    offer = register.bikes.offer

    def slower(code: str, address: str) -> object:
        seen = offer(code, address)
        register.bikes.take(code, rita, "there")
        return seen

    register.bikes.offer = slower  # type: ignore[method-assign,assignment]
    with pytest.raises(NotFound):
        register.bikes.join(code, "Olaf", PASSWORD, "here")

    assert [one.name for one in register.people.accounts.list()] == ["Rita"]


def test_rides_that_nobody_owns_are_given_to_a_bike(register: Register) -> None:
    first, second = register.ride(TODAY - 3 * DAY, "ebl:A"), register.ride(TODAY - DAY, "ebl:B")
    bike_id, rita = register.bike(), register.rider("Rita")
    register.hand_over(bike_id, rita, since=TODAY - 2 * DAY)

    register.bikes.give_rides(bike_id, [first, second])

    assert register.rides_of(rita) == [second]
    assert {register.store.rides.get(one).bike_id for one in (first, second)} == {bike_id}
    others = register.bike("Cargo 1")
    register.hand_over(others, register.rider("Olaf"), since=TODAY - 9 * DAY)
    with pytest.raises(Conflict) as hers:
        register.bikes.give_rides(others, [first, second])
    assert hers.value.code == "somebody_elses"
    with pytest.raises(NotFound):
        register.bikes.give_rides(others, [first, 999])
    assert register.store.rides.get(first).bike_id == bike_id


def test_a_unit_moves_to_another_bike_and_the_rides_of_before_stay(register: Register) -> None:
    before = register.ride(TODAY - DAY)
    [old] = register.bikes.list()
    new = register.bike("Cargo 1")

    moved = register.bikes.change(new, BikeChange(unit_key="ebl:A"))
    after = register.ride(TODAY + DAY)

    assert moved.bike.unit is not None
    assert register.bikes.get(old.id).bike.unit is None
    bikes = [register.store.rides.get(one).bike_id for one in (before, after)]
    assert bikes == [old.id, new]
    bare = register.bikes.change(new, BikeChange(unit_key=None))
    assert (bare.bike.unit, register.bikes.get(new).bike.rides) == (None, 1)
    of_no_bike = register.ride(TODAY + 2 * DAY)
    assert register.store.rides.get(of_no_bike).bike_id is None
    with pytest.raises(NotFound, match="no unit"):
        register.bikes.change(new, BikeChange(unit_key="ebl:never seen"))


def test_a_bike_with_a_history_stays(register: Register) -> None:
    register.ride(TODAY)
    [used] = register.bikes.list()
    unused, owned = register.bike("unused"), register.bike("owned")
    register.hand_over(owned, register.rider("Rita"))

    register.code(unused)
    register.bikes.remove(unused)

    for bike_id in (used.id, owned):
        with pytest.raises(Conflict) as refused:
            register.bikes.remove(bike_id)
        assert refused.value.code == "bike_in_use"
    with pytest.raises(NotFound):
        register.bikes.get(unused)


def test_what_is_said_of_a_bike(register: Register) -> None:
    bike_id = register.bike("  City 7 ")

    said = BikeChange(model="Mid drive 28", mileage_km=1204.0, frame_number="WBK 1", battery=" ")
    bike = register.bikes.change(bike_id, said).bike
    lost = register.bikes.change(bike_id, BikeChange(lost=True)).bike
    found = register.bikes.change(bike_id, BikeChange(lost=False, mileage_km=None)).bike

    assert (bike.name, bike.model, bike.battery) == ("City 7", "Mid drive 28", None)
    assert (bike.mileage_km, bike.mileage_at is None) == (1204.0, False)
    assert (lost.lost_at is None, found.lost_at) == (False, None)
    assert (found.mileage_km, found.mileage_at, found.frame_number) == (None, None, "WBK 1")
    with pytest.raises(InvalidRequest, match="name"):
        register.bikes.change(bike_id, BikeChange(name="  "))
    with pytest.raises(NotAllowed, match="frame_number"):
        register.bikes.change(bike_id, BikeChange(frame_number="x", name="y"), owner_id=1)
    assert register.bikes.get(bike_id).bike.name == "City 7"


def test_what_an_account_had_is_nobody_s_once_it_is_removed(register: Register) -> None:
    bike_id, rita = register.bike(), register.rider("Rita")
    register.hand_over(bike_id, rita, since=TODAY - 9 * DAY)
    ride_id = register.ride(TODAY)
    register.bikes.give_rides(bike_id, [ride_id])

    register.people.accounts.remove(rita.id)

    detail = register.bikes.get(bike_id)
    assert detail.bike.owner is None
    assert [(one.name, one.person_id, one.until is None) for one in detail.owners] == [
        ("Rita", None, False)
    ]
    ride = register.store.rides.get(ride_id)
    assert (ride.bike_id, ride.owner_id) == (bike_id, None)
    # Nobody gets what was another's with their number.
    assert register.rides_of(register.rider("Olaf")) == []
