"""Goal: the estimate of a ride with another table is told with its band and its trust, and refused
with the reason where nobody should believe it.

Method: a simulated ride over a known road, kept in a real store; then the same ride, spoilt. How
near the estimate is to the truth: tests/acceptance/test_the_same_road_again.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.control import law_defaults
from backend.domain.assist_mode import AssistModes
from backend.domain.channels import ChannelSpec, Values
from backend.domain.ride import RideRows
from backend.domain.rider_and_bike import RiderAndBike
from backend.errors import InvalidRequest
from backend.ingest import ImportedRide, Outcome
from backend.services.imports.upload import Uploads
from backend.services.rides import ride_again
from backend.services.rides.replay import RideReplay
from backend.services.tuning.preview import Preview
from backend.store import Store, open_store
from firmware_protocol._generated import CHANNELS, InputFlags
from tests.fakes.known_roads import Ridden, road

pytestmark = pytest.mark.slow

PERIOD_US = 10_000
SPECS = {row.name: ChannelSpec(row.name, row.unit, float(row.scale)) for row in CHANNELS}
SPORT = 3


@cache
def sport() -> dict[str, Values]:
    """A ride in sport, as a unit records it."""
    columns = Ridden(road(601), SPORT).columns
    columns["input_flags"] = columns.pop("brake") * float(InputFlags.BRAKE)
    columns["motor_torque_demanded_nm"] = columns["motor_torque_nm"]
    del columns["distance_m"]
    return columns


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as opened:
        yield opened


def again(store: Store, columns: dict[str, Values], **changes: Any) -> dict[str, Any]:
    """The answer in closed loop for a ride of these channels, (n,) each."""
    specs = tuple(SPECS[name] for name in columns)
    counts = {spec.name: spec.to_counts(columns[spec.name]) for spec in specs}
    times_us = np.arange(len(columns["speed_kmh"]), dtype=np.int64) * PERIOD_US
    outcome = Outcome(
        "complete",
        (ImportedRide(1_700_000_000_000_000, PERIOD_US, RideRows(specs, times_us, counts)),),
    )
    uploads = Uploads(store, reader=lambda path, name: outcome)
    (ride_id,) = uploads.receive_file("a.csv", b"as it came").ride_ids
    uploads.close()
    question = {"fuzzy_table": None, "assist_modes": None, "told": RiderAndBike()} | changes
    replay = RideReplay(Preview(), lambda ride: (law_defaults(), "defaults"))
    answer: dict[str, Any] = replay(store.rides.reader(ride_id), **question)
    return answer


def modes_with_ratio(ratio: float) -> dict[str, Any]:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][SPORT] |= {"law": "fixed", "ratio": ratio, "taper": "none"}
    return modes


def test_without_a_change_there_is_no_difference_and_the_record_lies_in_the_band(
    store: Store,
) -> None:
    answer = again(store, sport())

    closed = answer["closed_loop"]
    assert answer["mode"] == "closed_loop"
    assert abs(closed["trust"]["no_change_error_pct"]) < 1.0
    assert abs(closed["trust"]["no_change_time_error_pct"]) < 3.0
    assert closed["trust"]["one_gear"]
    for name in ("wh_per_km", "motor_work_wh", "duration_s"):
        figure = closed[name]
        assert figure["difference"] == 0.0
        assert figure["low"] <= figure["recorded"] <= figure["high"]
    assert closed["motor_work_wh"]["recorded"] == pytest.approx(
        answer["motor_work_wh"]["recorded"], rel=1e-3
    )


def test_less_help_takes_less_work_and_longer(store: Store) -> None:
    closed = again(store, sport(), assist_modes=modes_with_ratio(0.4))["closed_loop"]

    for name in ("wh_per_km", "motor_work_wh"):
        assert closed[name]["difference"] < 0.0
        assert closed[name]["low"] <= closed[name]["replayed"] <= closed[name]["high"]
    assert closed["duration_s"]["difference"] > 0.0


def test_what_is_told_of_bike_and_rider_narrows_the_band(store: Store) -> None:
    def width(told: RiderAndBike) -> float:
        answer = again(store, sport(), assist_modes=modes_with_ratio(0.4), told=told)
        figure = answer["closed_loop"]["duration_s"]
        return float(figure["high"] - figure["low"])

    assert width(RiderAndBike(mass_kg=92.0, drag_area_m2=0.5)) < width(RiderAndBike())


def test_an_open_loop_has_no_estimate(store: Store) -> None:
    answer = again(store, sport(), told=None)

    assert answer["mode"] == "open_loop"
    assert answer["closed_loop"] is None


def asked_only(columns: dict[str, Values]) -> None:
    del columns["motor_torque_demanded_nm"]


def faulty(columns: dict[str, Values]) -> None:
    faults = np.zeros(len(columns["speed_kmh"]))
    faults[100] = 1.0
    columns["fault_flags"] = faults


def holed(columns: dict[str, Values]) -> None:
    columns["speed_kmh"][2000:3000] = np.nan


def of_another_motor(columns: dict[str, Values]) -> None:
    columns["motor_torque_nm"] *= 1.5


def pushed_by_hand(columns: dict[str, Values]) -> None:
    columns["speed_kmh"][2000:12_000] = 4.0


def never_pedalled(columns: dict[str, Values]) -> None:
    columns["rider_torque_raw"][:] = 0.0


@pytest.mark.parametrize(
    ("spoil", "code"),
    [
        (asked_only, "not_delivered"),
        (faulty, "faults"),
        (holed, "holes"),
        (of_another_motor, "twin_differs"),
        (pushed_by_hand, "too_slow_to_tell"),
        (never_pedalled, "no_pedalling"),
    ],
)
def test_what_cannot_be_trusted_is_refused_with_the_reason(
    store: Store, spoil: Any, code: str
) -> None:
    columns = {name: values.copy() for name, values in sport().items()}
    spoil(columns)

    with pytest.raises(InvalidRequest) as refused:
        again(store, columns)

    assert refused.value.code == code
    assert "cannot be ridden again" in str(refused.value)


def test_a_ride_of_half_a_day_is_refused_before_it_takes_a_thread(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ride_again, "LONGEST_S", len(sport()["speed_kmh"]) * 0.01 - 1.0)

    with pytest.raises(InvalidRequest) as refused:
        again(store, sport())

    assert refused.value.code == "ride_too_long"
