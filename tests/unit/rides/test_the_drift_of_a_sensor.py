"""Goal: from a unit's rides alone the drift of its sensor is told, with calibrations as steps; what
is kept of a ride goes with it and is made anew.

Method: rides of the simulated bike, weeks apart in a real store, whose sensor's zero walks by a
planted amount a month and a kelvin; the trend has to hold both inside its own uncertainty.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.revision import Revision
from backend.rebuild import rebuild_store
from backend.rides.diagnosis.sensor_drift import SensorDriftService, calibrations_of
from backend.rides.diagnosis.service import RideZeros
from backend.store import Store, open_store
from tests.fakes.kept_rides import recorded_ride
from tests.fakes.simulated_ride import GAIN_NM_PER_COUNT, LOOK_S, simulated_ride

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

RECORDED = ("rider_torque_raw", "rider_torque_nm", "cadence_rpm", "speed_kmh")
TEMPERATURE = "sensor_temperature_degc"
UNIT = "ebl:SP-1"
START_US = 1_700_000_000_000_000
DAY_US = 86_400_000_000
MONTH_DAYS = 365.25 / 12.0
PER_MONTH_NM, PER_K_NM, BEGIN_NM = 0.2, 0.015, 0.3
LEGS = {"kind": "legs", "torque_nm": 30.0, "cadence_rpm_max": 90.0}


@cache
def ridden() -> dict[str, Values]:
    """A ride that coasts twice, by a sensor whose zero is 0."""
    ride = ({"rider": LEGS, "brake": False, "assist_mode": 3}, {"rider": {"kind": "off"}})
    return simulated_ride([(12.0, ride[0]), (12.0, ride[1])] * 2)


class Workshop:
    """A store of one unit's rides, days apart, and the unit's history."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.store: Store = self.opened()
        self.history = [revision(1, START_US, 0.0)]
        self.day = 0.0

    def opened(self) -> Store:
        return open_store(f"sqlite:///{self.folder}/db", f"file://{self.folder}/objects")

    def told(self) -> dict[str, Any]:
        drift = SensorDriftService(
            self.store,
            lambda device_id: UNIT,
            lambda device_id: self.history,
            lambda: START_US + round(self.day * DAY_US),
        )
        return drift("dev1")

    def ride(self, zero_nm: float, degc: float | None = 20.0, unit: str = UNIT) -> int:
        """A ride by a sensor with this zero; degc: None for one without a thermometer."""
        offset_nm = GAIN_NM_PER_COUNT * self.history[0].parameters["sensor_offset_counts"]
        values = {name: ridden()[name].copy() for name in RECORDED}
        values["rider_torque_raw"] += zero_nm / GAIN_NM_PER_COUNT
        values["rider_torque_nm"] += zero_nm - offset_nm
        if degc is not None:
            values[TEMPERATURE] = np.full(len(values["speed_kmh"]), degc)
        began_us = START_US + round(self.day * DAY_US)
        return recorded_ride(self.store, values, round(LOOK_S * 1e6), began_us, unit_key=unit)

    def months(self, days: float, rides: int, seed: int = 1) -> list[int]:
        """Rides in all weathers, spread over some days; the zero walks as planted."""
        random = np.random.default_rng(seed)
        made = []
        for _ in range(rides):
            self.day += days / rides
            degc = float(np.round(random.normal(12.0, 7.0)))
            age_nm = PER_MONTH_NM * self.day / MONTH_DAYS
            made.append(self.ride(BEGIN_NM + age_nm + PER_K_NM * (degc - 20.0), degc))
        return made

    def calibrate(self, offset_counts: float, **more: float) -> None:
        """A new offset is written now."""
        self.day += 0.1
        now_us = START_US + round(self.day * DAY_US)
        self.history.insert(0, revision(len(self.history) + 1, now_us, offset_counts, **more))

    def made(self) -> None:
        zeros = RideZeros(self.store)
        while zeros.tick():
            pass


def revision(seq: int, at_us: int, offset_counts: float, **more: float) -> Revision:
    scale = {"sensor_offset_counts": offset_counts, "sensor_gain_nm_per_count": 0.01}
    state = "verified"
    return Revision(seq, at_us, "Ada", "", state, seq, seq, (), {**scale, **more}, UNIT)


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    opened = Workshop(tmp_path)
    yield opened
    opened.store.close()


def holds(share: dict[str, float], truth: float) -> bool:
    return share["low"] <= truth <= share["high"]


def test_a_planted_drift_is_told_with_its_day(workshop: Workshop) -> None:
    rides = workshop.months(180.0, 16)
    other = workshop.ride(2.9, unit="ebl:SP-2")
    workshop.made()

    told = workshop.told()

    assert [ride["ride_id"] for ride in told["rides"]] == rides[::-1]
    assert other not in rides
    assert (told["level"], told["no_trend"], told["trend"]["rides"]) == ("watch", None, 16)
    assert holds(told["trend"]["per_month_nm"], PER_MONTH_NM)
    assert holds(told["trend"]["per_kelvin_nm"], PER_K_NM)
    act = told["trend"]["crossings"]["act"]
    typical_nm = BEGIN_NM + PER_K_NM * (told["trend"]["typical_degc"] - 20.0)
    day = (3.0 - typical_nm) / PER_MONTH_NM * MONTH_DAYS
    expected = np.datetime64(START_US + round(day * DAY_US), "us")
    assert act["state"] == "expected"
    assert abs(np.datetime64(act["at"][:19]) - expected) < np.timedelta64(5, "D")
    assert act["earliest_at"] < act["at"] < act["latest_at"]
    assert told["trend"]["crossings"]["watch"]["state"] == "over"


def test_a_calibration_is_a_step_and_the_zero_is_judged_from_there(workshop: Workshop) -> None:
    workshop.months(150.0, 12)
    workshop.calibrate(120.0)
    workshop.made()
    assert (workshop.told()["level"], workshop.told()["no_trend"]) == (
        None,
        "none_since_calibration",
    )
    workshop.months(60.0, 6, seed=2)
    workshop.made()

    told = workshop.told()

    (calibration,) = told["calibrations"]
    assert calibration["changed"] == [{"name": "sensor_offset_counts", "old": 0.0, "new": 120.0}]
    assert holds(told["trend"]["per_month_nm"], PER_MONTH_NM)
    assert len(told["trend"]["bands"]) == 2
    assert told["level"] == "ok"
    before, after = told["trend"]["bands"]
    assert before[-1]["zero_nm"] - after[0]["zero_nm"] == pytest.approx(1.2, abs=0.1)


def test_one_ride_apart_is_a_foot_and_two_are_a_sensor_that_jumped(workshop: Workshop) -> None:
    workshop.months(120.0, 12)
    held = workshop.day
    foot = workshop.ride(5.0)
    workshop.made()
    told = workshop.told()
    assert (told["rides"][0]["ride_id"], told["rides"][0]["left_out"]) == (foot, "apart")
    assert told["level"] == "watch"
    assert told["latest"]["zero_nm"] == pytest.approx(told["trend"]["today"]["zero_nm"], abs=0.3)

    workshop.day = held + 1.0
    jumped = workshop.ride(5.1)
    workshop.made()

    assert (workshop.told()["level"], workshop.told()["latest"]["ride_id"]) == ("act", jumped)


def test_the_drift_goes_with_the_unit_to_another_bike(workshop: Workshop) -> None:
    workshop.months(90.0, 8)
    with sqlite3.connect(workshop.folder / "db") as database:
        now_us = START_US + round(workshop.day * DAY_US)
        database.execute("UPDATE bike_unit SET to_us = ?", (now_us,))
        database.execute("INSERT INTO bike (name, created_us) VALUES ('another', ?)", (now_us,))
        database.execute(
            "INSERT INTO bike_unit (bike_id, unit_key, from_us) SELECT max(id), ?, ? FROM bike",
            (UNIT, now_us),
        )
    database.close()
    workshop.day += 1.0
    workshop.months(90.0, 8, seed=2)
    workshop.made()
    bikes = {workshop.store.rides.get(ride["ride_id"]).bike_id for ride in workshop.told()["rides"]}

    trend = workshop.told()["trend"]

    assert len(bikes) == 2
    assert trend["rides"] == 16
    assert holds(trend["per_month_nm"], PER_MONTH_NM)


def test_rides_under_another_compensation_are_shown_and_not_counted(workshop: Workshop) -> None:
    old = workshop.months(60.0, 5)
    workshop.calibrate(0.0, sensor_offset_counts_per_k=1.0)
    workshop.made()

    told = workshop.told()

    assert {ride["ride_id"]: ride["left_out"] for ride in told["rides"]} == dict.fromkeys(
        old, "other_compensation"
    )
    assert told["no_trend"] == "few_rides"


def test_one_ride_tells_its_zero_and_no_trend(workshop: Workshop) -> None:
    assert workshop.told()["rides"] == []
    assert workshop.told()["no_trend"] == "few_rides"
    workshop.ride(0.6, degc=None)
    workshop.made()

    told = workshop.told()

    assert told["latest"]["zero_nm"] == pytest.approx(0.6, abs=0.1)
    assert told["latest"]["temperature_degc"] is None
    assert (told["level"], told["trend"], told["no_trend"]) == ("ok", None, "few_rides")


def test_a_tried_offset_is_no_calibration() -> None:
    def tried(seq: int, offset: float, state: str) -> Revision:
        made = revision(seq, seq, offset)
        return Revision(
            *(made.seq, made.created_us, "", "", state, seq, seq, (), made.parameters, UNIT)
        )

    steps = [(1, 0.0, "verified"), (2, 5.0, "provisional"), (3, 0.0, "verified")]
    assert calibrations_of([tried(*step) for step in reversed(steps)]) == []


def test_what_is_kept_goes_with_its_ride_and_is_made_anew(workshop: Workshop) -> None:
    kept, gone = workshop.ride(0.5), workshop.ride(0.7)
    workshop.made()
    (second, first) = workshop.told()["rides"]
    assert {first["ride_id"], second["ride_id"]} == {kept, gone}
    workshop.store.rides.delete(gone)

    (left,) = workshop.told()["rides"]
    assert left["ride_id"] == kept
    workshop.store.close()
    (workshop.folder / "db").unlink()
    rebuild_store(f"sqlite:///{workshop.folder}/db", f"file://{workshop.folder}/objects")
    workshop.store = workshop.opened()
    assert workshop.told()["rides"] == []
    workshop.made()
    (anew,) = workshop.told()["rides"]
    assert anew["zero_nm"] == left["zero_nm"]
