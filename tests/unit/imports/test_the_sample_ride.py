"""Goal: who has no ride yet gets one that says that it is simulated, once, and can delete it.

Method: the real store, simulator and readers; the distance is compared with the scenario's own
metres.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from backend.imports.sample import NAME, NOTES, sample_ride
from backend.imports.service import Uploads
from backend.store import Store

pytestmark = pytest.mark.slow

SCENARIO = Path(__file__).resolve().parents[3] / "sim_device/scenarios/commute.toml"


def test_it_is_one_whole_ride_that_says_what_it_is(store: Store) -> None:
    ride = store.rides.get(sample_ride(store, Uploads(store)))

    assert (ride.name, ride.notes, ride.state) == (NAME, NOTES, "done")
    assert ride.completeness == 1.0
    phases = tomllib.loads(SCENARIO.read_text(encoding="utf-8"))["phases"]
    metres = sum(phase.get("metres", 0.0) for phase in phases)
    assert ride.summary is not None
    assert ride.summary.distance_km is not None
    # Phases in seconds roll a little, too.
    assert metres / 1000 < ride.summary.distance_km < 1.1 * metres / 1000
    assert ride.summary.rider_wh
    assert ride.summary.motor_wh
    chosen = [event.value for event in ride.events if event.kind == "assist_mode"]
    assert set(chosen) == {1, 2, 3}


def test_it_is_made_once_and_anew_after_it_was_deleted(store: Store) -> None:
    uploads = Uploads(store)
    first = sample_ride(store, uploads)
    store.rides.patch(first, name="mine now")

    assert sample_ride(store, uploads) == first
    assert store.rides.get(first).name == "mine now"
    store.rides.delete(first)

    anew = sample_ride(store, uploads)
    assert store.rides.get(anew).name == NAME
    assert [ride.id for ride in store.rides.list().items] == [anew]
