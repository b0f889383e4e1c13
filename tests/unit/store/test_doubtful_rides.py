"""Goal: a doubtful ride is in no record until somebody accepts it, and that is never forgotten;
figures of an older version become those of today's.

Method: the real store with rides whose figures follow from their making.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from sqlalchemy import update

from backend.core.channels import ChannelSpec
from backend.core.ride import Ride, RideContext, RideRows
from backend.errors import SpindleError
from backend.imports.service import Uploads
from backend.rebuild import rebuild_store
from backend.rides.logbook.cards import RideCards, RideFigures
from backend.store import Store, open_store
from backend.store.sql import tables as t
from tests.fakes.fit_file import START_S, commute, fit_file
from tests.unit.imports.test_a_table_is_asked_about_once import reader

SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
CHARGE = ChannelSpec("battery_soc_pct", "%", 1.0)
MINUTES = 30


def added(store: Store, kmh: float, day: int = 1, charge: np.ndarray | None = None) -> int:
    """A ride of half an hour at one speed, with its card."""
    rows = MINUTES * 60 + 1
    columns = {SPEED: np.full(rows, kmh)}
    if charge is not None:
        columns[CHARGE] = charge
    counts = {channel.name: channel.to_counts(values) for channel, values in columns.items()}
    times_us = np.arange(rows, dtype=np.int64) * 1_000_000
    started_us = (1_751_000_000 + 86_400 * day) * 1_000_000
    channels = tuple(columns)
    ride = Ride(0, "live", "imported", "", "", started_us, rows, None, channels, (), RideContext())
    ride_id = store.rides.add(ride, RideRows(channels, times_us, counts)).id
    settled(store)
    return ride_id


def settled(store: Store) -> None:
    """All that is due in the background is done."""
    for due in (RideFigures(store), RideCards(store)):
        while due.tick():
            pass


def longest(store: Store) -> int | None:
    """The ride that holds the record of distance."""
    records = {one.kind: one.ride_id for one in store.logbook.home([]).records}
    return records.get("distance_km")


def test_a_doubtful_ride_is_in_no_record_until_somebody_accepts_it(store: Store) -> None:
    ridden = added(store, 20.0)
    driven = added(store, 90.0, day=2)
    assert longest(store) == ridden
    (doubt,) = store.rides.get(driven).doubts
    assert (doubt.code, round(doubt.figure)) == ("mean_speed", 90)

    store.rides.patch(driven, doubts_accepted=True)
    assert longest(store) == driven
    assert store.rides.get(driven).as_json()["doubts"][0]["accepted"] is True  # type: ignore[index]

    store.rides.patch(driven, doubts_accepted=False)
    assert longest(store) == ridden


def test_what_was_accepted_stays_so_when_the_card_is_made_anew_and_in_a_rebuilt_store(
    tmp_path: Path,
) -> None:
    urls = f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects"
    with open_store(*urls) as store:
        driven = added(store, 90.0)
        store.rides.patch(driven, doubts_accepted=True)
        store.database.write(lambda c: c.execute(update(t.ride_card).values(method=0)))
        settled(store)
        assert longest(store) == driven
    (tmp_path / "spindle.db").unlink()
    rebuild_store(*urls)

    with open_store(*urls) as store:
        settled(store)
        (ride,) = store.rides.list().items
        assert ride.accepted_doubts == ("mean_speed",)
        assert longest(store) == ride.id


def test_figures_of_an_older_version_become_those_of_today(store: Store) -> None:
    """It had 85 to 64 % as 21 % used, where the battery was changed on the way."""
    half = MINUTES * 30
    charge = np.concatenate((np.linspace(85, 12, half + 1).round(), np.linspace(100, 64, half)))
    ride_id = added(store, 20.0, charge=charge.round())

    def as_it_was() -> None:
        old = {"battery_soc_pct_used": 21.0, "distance_source": None, "method": 0}
        store.database.write(lambda c: c.execute(update(t.ride_summary).values(old)))

    as_it_was()
    settled(store)

    summary = store.rides.get(ride_id).summary
    assert summary is not None
    assert summary.battery_soc_pct_used == pytest.approx(109.0)
    assert summary.distance_source == "speed"
    assert store.rides.outdated(9) == []


def test_a_ride_that_cannot_be_read_keeps_its_figures_and_stops_no_other(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    bad, sound = added(store, 20.0), added(store, 25.0, day=2)
    store.database.write(
        lambda c: c.execute(update(t.ride_summary).values(method=0, distance_km=1.0))
    )
    whole = store.rides.digest_anew

    def unless_bad(ride: Ride) -> object:
        if ride.id == bad:
            raise SpindleError("Its samples are damaged.")
        return whole(ride)

    monkeypatch.setattr(store.rides, "digest_anew", unless_bad)
    settled(store)

    kept, anew = (store.rides.get(one).summary for one in (bad, sound))
    assert kept is not None
    assert anew is not None
    assert kept.distance_km == 1.0
    assert anew.distance_km == pytest.approx(12.5, rel=1e-3)
    assert store.rides.outdated(9) == []


def test_of_two_recordings_of_one_ride_the_better_counts_and_the_other_when_it_is_gone(
    store: Store,
) -> None:
    """A phone in a pocket, and later the bike's head unit that knows the power, too."""
    uploads = Uploads(store, reader=reader, judge=RideCards(store).make)
    phone = [{"position_lat": row["position_lat"] + 3e-5, "position_long": row["position_long"],
              "timestamp": row["timestamp"]} for row in commute(600)]  # fmt: skip
    (worse,) = uploads.receive_file("phone.fit", fit_file(phone)).ride_ids
    (better,) = uploads.receive_file("bike.fit", fit_file(commute(600))).ride_ids
    uploads.close()

    assert [store.rides.get(one).outdone for one in (worse, better)] == [True, False]
    assert [bike.ride_id for bike in store.logbook.home([]).records] != []
    assert longest(store) == better
    settled(store)
    assert longest(store) == better
    store.rides.delete(better)
    assert not store.rides.get(worse).outdone
    assert longest(store) == worse


def test_an_import_counts_its_doubtful_rides(store: Store) -> None:
    uploads = Uploads(store, reader=reader, judge=RideCards(store).make)
    fast = [dict(row) | {"speed": 25.0, "distance": None} for row in commute(600, START_S + 86_400)]

    sound = uploads.receive_file("ridden.fit", fit_file(commute(600)))
    doubtful = uploads.receive_file("driven.fit", fit_file(fast))

    assert (sound.doubtful_rides, doubtful.doubtful_rides) == (0, 1)
    store.rides.patch(doubtful.ride_ids[0], doubts_accepted=True)
    assert uploads.get(doubtful.id).doubtful_rides == 0
    uploads.close()
