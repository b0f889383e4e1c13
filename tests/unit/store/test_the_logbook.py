"""Goal: rides are found by all a list offers, sums tell what they lack, tags outlast a rebuild.

Method: the real store with imported rides whose figures follow from their making; cards are made by
the service that makes them.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from zoneinfo import ZoneInfo

import numpy as np
import pytest
from sqlalchemy import Connection

from backend.core.calendar import last_months, last_weeks
from backend.core.channels import ChannelSpec
from backend.core.ride import Ride, RideContext, RideRows
from backend.core.ride_card import RideCard
from backend.errors import InvalidRequest, NotFound
from backend.rebuild import rebuild_store
from backend.rides.logbook.cards import RideCards, card_of
from backend.rides.rows import RideColumns
from backend.store import Sought, Store
from backend.store.logbook.totals import Whose

pytestmark = pytest.mark.slow

SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
POWER = ChannelSpec("rider_power_w", "W", 1.0)
MOTOR = ChannelSpec("motor_power_w", "W", 1.0)
LATITUDE = ChannelSpec("latitude_deg", "deg", 180 / 2**31, wide=True)
LONGITUDE = ChannelSpec("longitude_deg", "deg", 180 / 2**31, wide=True)
DUBLIN = ZoneInfo("Europe/Dublin")
NOW_US = int(datetime(2026, 7, 15, 12, tzinfo=UTC).timestamp()) * 1_000_000


def us(text: str) -> int:
    return int(datetime.fromisoformat(text).timestamp()) * 1_000_000


def added(
    store: Store,
    began: str,
    name: str = "",
    kmh: float = 20.0,
    minutes: int = 30,
    rider_w: int | None = None,
    motor_w: int | None = None,
    at: tuple[float, float] | None = None,
    unit: str | None = None,
) -> int:
    """Adds a ride at one speed and power; its id."""
    rows = minutes * 60 + 1
    columns = {SPEED: np.full(rows, kmh)}
    if rider_w is not None:
        columns[POWER] = np.full(rows, float(rider_w))
    if motor_w is not None:
        columns[MOTOR] = np.full(rows, float(motor_w))
    if at is not None:
        columns |= {LATITUDE: np.full(rows, at[0]), LONGITUDE: np.full(rows, at[1])}
    counts = {channel.name: channel.to_counts(values) for channel, values in columns.items()}
    channels = tuple(columns)
    times_us = np.arange(rows, dtype=np.int64) * 1_000_000
    context = RideContext(unit_key=unit, device_serial=unit and unit.split(":")[1])
    ride = Ride(0, "live", "imported", name, "", us(began), rows, 1_000_000, channels, (), context)
    return store.rides.add(ride, RideRows(channels, times_us, counts)).id


def made(store: Store) -> None:
    """Every card that is due is made."""
    cards = RideCards(store)
    while cards.tick():
        pass


def found(store: Store, **what: object) -> list[int]:
    """Ids of the rides that are sought, over pages of one; the count must agree."""
    sought = Sought(**what)  # type: ignore[arg-type]
    ids: list[int] = []
    cursor = None
    while True:
        page = store.rides.list(sought, 1, cursor)
        ids += [ride.id for ride in page.items]
        cursor = page.next
        if cursor is None:
            assert store.logbook.count(sought) == len(ids)
            return ids


def test_rides_are_found_by_all_that_a_list_offers(store: Store) -> None:
    short = added(store, "2026-07-01T08:00+00:00", "To WORK", minutes=12, motor_w=90, unit="ebl:A")
    far = added(store, "2026-07-02T08:00+00:00", "Canal", minutes=60, at=(53.346, -6.262))
    store.rides.patch(far, notes="100 % rain", tags=["Winter", "wet road"])
    made(store)

    assert found(store) == [far, short]
    assert found(store, longer_km=10.0) == [far]
    assert found(store, with_motor=True) == [short]
    assert found(store, with_events=True) == []
    assert found(store, from_us=us("2026-07-02T00:00+00:00")) == [far]
    assert found(store, tag="winter") == [far]
    assert found(store, tag="wint") == []
    assert found(store, words="work") == [short]
    assert found(store, words="rain canal") == [far]
    assert found(store, words="road") == [far]
    assert found(store, words="dublin") == [far]
    assert found(store, words="100 %") == [far]
    assert found(store, words="_") == found(store, words="canal to") == []
    bike_id = store.rides.get(short).bike_id
    assert found(store, bike_id=bike_id) == [short]


def test_umlauts_and_chinese_are_found_whatever_their_case(store: Store) -> None:
    ride_id = added(store, "2026-07-01T08:00+00:00", "Über den Fluß 晨骑")
    made(store)

    assert found(store, words="ÜBER") == found(store, words="fluss") == [ride_id]
    assert found(store, words="晨骑") == [ride_id]


def test_what_is_renamed_is_found_by_its_new_name_only(store: Store) -> None:
    ride_id = added(store, "2026-07-01T08:00+00:00", "old name")
    made(store)

    store.rides.patch(ride_id, name="new one")

    assert found(store, words="new") == [ride_id]
    assert found(store, words="old") == []


def test_a_ride_knows_its_town_its_zone_and_its_line(store: Store) -> None:
    ride_id = added(store, "2026-07-01T08:00+00:00", at=(53.346, -6.262), kmh=18.0)
    assert store.rides.get(ride_id).place is None
    made(store)

    ride = store.rides.get(ride_id)
    assert ride.place is not None
    assert (ride.place.name, ride.place.zone) == ("Dublin", "Europe/Dublin")
    assert ride.speed_line_kmh == (18.0,) * 64


def test_a_ride_of_which_no_card_can_be_made_stops_no_other(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    bad, good = added(store, "2026-07-14T08:00Z"), added(store, "2026-07-13T08:00Z")

    def unless_bad(rows: RideColumns) -> RideCard:
        if rows.ride.id == bad:
            raise MemoryError
        return card_of(rows)

    monkeypatch.setattr("backend.rides.logbook.cards.card_of", unless_bad)
    made(store)

    assert [store.rides.get(ride).speed_line_kmh != () for ride in (bad, good)] == [False, True]
    assert store.cards.due(9) == []


def test_cards_are_made_once(store: Store) -> None:
    added(store, "2026-07-01T08:00+00:00")
    cards = RideCards(store)

    assert cards.tick() == 1
    assert cards.tick() == 0
    assert store.cards.due(9) == []


def test_sums_say_how_many_rides_they_are_of(store: Store) -> None:
    added(store, "2026-07-13T08:00+00:00", minutes=60, rider_w=100, motor_w=50)
    added(store, "2026-07-14T08:00+00:00", minutes=30, rider_w=200)
    # Sunday at half past eleven in Dublin, already Monday in Berlin.
    added(store, "2026-07-12T22:30+00:00", minutes=60)

    home = store.logbook.home([last_weeks(NOW_US, DUBLIN), last_months(NOW_US, DUBLIN)])

    *_, last, this = home.by_period[0]
    assert (this.rides, this.with_rider, this.with_motor) == (2, 2, 1)
    assert this.distance_km == pytest.approx(30.0, rel=1e-3)
    assert this.rider_wh == pytest.approx(200.0, rel=1e-3)
    assert this.motor_wh == pytest.approx(50.0, rel=1e-3)
    assert (last.rides, last.with_motor, last.motor_wh) == (1, 0, None)
    assert home.by_period[1][-1].rides == 3
    berlin = store.logbook.home([last_weeks(NOW_US, ZoneInfo("Europe/Berlin"))]).by_period[0]
    assert berlin[-1].rides == 3


def test_records_are_the_rider_s_own_and_of_one_bike_where_asked(store: Store) -> None:
    long = added(store, "2026-07-01T08:00+00:00", minutes=120, kmh=15, rider_w=90)
    fast = added(store, "2026-07-02T08:00+00:00", minutes=30, kmh=30, motor_w=900, unit="ebl:A")
    added(store, "2026-07-03T08:00+00:00", minutes=1, kmh=45)
    made(store)

    best = {best.kind: best for best in store.logbook.home([]).records}
    assert best["distance_km"].ride_id == long
    assert best["speed_kmh_mean"].ride_id == fast
    assert best["power_w_best_1200s"].ride_id == long
    assert best["power_w_best_1200s"].value == pytest.approx(90.0)
    assert "ascent_m" not in best
    bike_id = store.rides.get(fast).bike_id
    own = {best.kind: best.ride_id for best in store.logbook.home([], Whose(bike_id)).records}
    assert own == {"distance_km": fast, "speed_kmh_mean": fast}
    assert [bike.rides for bike in store.logbook.home([]).bikes] == [1]


def test_many_rides_are_tagged_all_or_none(store: Store) -> None:
    one = added(store, "2026-07-01T08:00+00:00")
    two = added(store, "2026-07-02T08:00+00:00")
    store.logbook.tag([one, two], ["Rain ", "holiday"], [])
    store.logbook.tag([two], [], ["RAIN"])

    assert store.rides.get(one).tags == ("Rain", "holiday")
    assert store.rides.get(two).tags == ("holiday",)
    assert store.logbook.home([]).tags == (("holiday", 2), ("Rain", 1))
    with pytest.raises(NotFound):
        store.logbook.tag([one, 999], ["never"], [])
    assert store.rides.get(one).tags == ("Rain", "holiday")
    with pytest.raises(InvalidRequest):
        store.rides.patch(one, tags=["x" * 41])


def test_while_many_rides_are_tagged_others_write(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    rides = [added(store, f"2026-07-{day:02}T08:00+00:00", minutes=1) for day in range(1, 6)]
    monkeypatch.setattr("backend.store.logbook.book.RIDES_AT_ONCE", 2)
    write, held = store.database.write, []

    def counted(work: Callable[[Connection], None]) -> None:
        held.append(work)
        write(work)

    monkeypatch.setattr(store.database, "write", counted)
    store.logbook.tag(rides, ["Rain"], [])

    assert len(held) == 3
    assert {store.rides.get(ride).tags for ride in rides} == {("Rain",)}


def test_tags_outlast_the_database(reopen: Callable[..., Store], tmp_path: Path) -> None:
    store = reopen()
    ride_id = added(store, "2026-07-01T08:00+00:00")
    store.logbook.tag([ride_id], ["Rain", "旅行"], [])
    store.close()
    for file in tmp_path.glob("spindle.db*"):
        file.unlink()

    rebuild_store(f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects")

    again = reopen()
    (ride,) = again.rides.list().items
    assert set(ride.tags) == {"Rain", "旅行"}
    made(again)
    assert found(again, tag="旅行") == [ride.id]
