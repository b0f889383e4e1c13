"""Goal: of the rides of a unit those are counted that tell where in a table they were, each moment
under the table its mode ran by, and of the others it is said why they are not.

Method: short rides whose every moment is at one known place, kept in a real store. A second at
10 km/h and torque rate 0 is a second of cell [1][0] of the thesis' table.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.core.filled import Filled
from backend.core.fuzzy_table import THESIS_TABLE
from backend.core.ride import Ride
from backend.errors import InvalidRequest, NotFound
from backend.law import law_defaults
from backend.rides.insight.table_use import RIDES_MAX, UseOfTable
from backend.store import RideReader, Store, open_store
from backend.store.reader import LiveRows
from tests.fakes.kept_rides import begun_ride

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

PERIOD_US = 10_000
SECOND = 100  # rows
SPORT, BOOST = 3.0, 4.0
AT_TEN = {
    "speed_kmh": 10.0,
    "torque_rate": 0.0,
    "assist_mode": SPORT,
    "cadence_rpm": 60.0,
    "motor_torque_nm": 0.9,
    "motor_torque_demanded_nm": 1.0,
    "motor_speed_rpm": 2400.0,
    "fuzzy_gain": 0.3,
}
"""Sport runs by a fuzzy table; 0.9 Nm at 2400 r/min are 226.2 W."""
WATTS = 0.9 * 2400 * 2 * np.pi / 60
POINTS = {
    "speed_points_kmh": THESIS_TABLE.speed_points_kmh,
    "torque_rate_points": THESIS_TABLE.torque_rate_points,
}


class Shop:
    """A store of rides, and the configuration that is known of all of them."""

    def __init__(self, folder: Path) -> None:
        self.store: Store = open_store(f"sqlite:///{folder}/db", f"file://{folder}/objects")
        self.config: dict[str, Any] = law_defaults()
        self.source = "ride"
        self.started_us = 1_700_000_000_000_000
        self.use = UseOfTable(
            self.store, lambda ride, t_s=0: (self.config, self.source), self.unit_at
        )

    @staticmethod
    def unit_at(device_id: str) -> str | None:
        return {"dev1": "ebl:SP-1"}.get(device_id)

    def begin(self, *stretches: dict[str, float], unit: str = "ebl:SP-1") -> int:
        """A ride of stretches of a second each, newer than all before; it is going on."""
        columns = {
            name: np.repeat([stretch[name] for stretch in stretches], SECOND)
            for name in stretches[0]
        }
        self.started_us += 3_600_000_000
        return begun_ride(self.store, columns, PERIOD_US, self.started_us, unit_key=unit)

    def ride(self, *stretches: dict[str, float], unit: str = "ebl:SP-1") -> int:
        ride_id = self.begin(*stretches, unit=unit)
        self.store.rides.finish(ride_id)
        return ride_id

    def asked(self, **question: Any) -> dict[str, Any]:
        return self.use(**{**POINTS, **question})


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    opened = Shop(tmp_path)
    yield opened
    opened.store.close()


def test_rides_add_up_in_the_cells_they_were_in(shop: Shop) -> None:
    older = shop.ride(AT_TEN, {**AT_TEN, "torque_rate": 0.1125})
    newer = shop.ride({**AT_TEN, "speed_kmh": 30.0})

    answer = shop.asked(device="dev1")

    assert answer["rides"] == [newer, older]
    assert answer["rides_without"] == []
    assert not answer["more"]
    assert answer["assisted_s"] == pytest.approx(3.0)
    # 0.1125 is half way to the second point; 30 km/h is beyond the last.
    seconds = np.array(answer["cells"]["seconds"])
    assert seconds[1, 0] == pytest.approx(1.5, abs=1e-3)
    assert seconds[1, 1] == pytest.approx(0.5, abs=1e-3)
    assert seconds[4, 0] == pytest.approx(1.0)
    shares = [column["share"] for column in answer["columns"]]
    assert shares == pytest.approx([2.5 / 3, 0.5 / 3, 0, 0, 0], abs=1e-3)
    assert [row["seconds"] for row in answer["rows"]] == pytest.approx([0, 2, 0, 0, 1])
    wh = np.array(answer["cells"]["motor_wh"])
    assert wh == pytest.approx(seconds * WATTS / 3600, rel=1e-3)
    assert answer["motor_excluded_s"] == 0.0


def test_the_points_are_those_of_the_table_that_is_edited(shop: Shop) -> None:
    shop.ride({**AT_TEN, "torque_rate": 0.05})

    answer = shop.asked(torque_rate_points=[0.0, 0.05, 0.1, 0.15, 0.2])

    assert answer["cells"]["seconds"][1][1] == pytest.approx(1.0)
    assert [column["point"] for column in answer["columns"]] == [0.0, 0.05, 0.1, 0.15, 0.2]


def test_a_moment_belongs_to_the_table_its_mode_ran_by(shop: Shop) -> None:
    shop.config["mode_tables"] = [0, 0, 0, 0, 1]
    fixed = {**AT_TEN, "assist_mode": 2.0}
    ride_id = shop.ride(AT_TEN, {**AT_TEN, "assist_mode": BOOST, "speed_kmh": 20.0}, fixed)

    first, second = shop.asked(), shop.asked(table="second")

    assert first["rides"] == second["rides"] == [ride_id]
    assert [row["seconds"] for row in first["rows"]] == pytest.approx([0, 1, 0, 0, 0])
    assert [row["seconds"] for row in second["rows"]] == pytest.approx([0, 0, 0, 1, 0])


def test_of_a_ride_that_says_nothing_it_is_told_why(shop: Shop) -> None:
    unassisted = shop.ride({**AT_TEN, "assist_mode": 1.0})
    head_unit = shop.ride({"speed_kmh": 20.0, "cadence_rpm": 60.0})

    answer = shop.asked()

    reasons = {one["id"]: one["code"] for one in answer["rides_without"]}
    assert reasons == {head_unit: "missing_channel", unassisted: "not_assisted"}
    assert "torque_rate" in answer["rides_without"][0]["message"]
    assert answer["rides"] == []
    assert answer["since"] is None
    assert answer["assisted_s"] == 0.0
    assert [column["share"] for column in answer["columns"]] == [None] * 5
    assert answer["cells"]["motor_wh"] is None


def test_a_damaged_ride_is_told_and_the_others_are_counted(shop: Shop) -> None:
    whole = shop.ride(AT_TEN)
    damaged = shop.ride({**AT_TEN, "speed_kmh": 20.0})
    key = shop.store.rides.get(damaged).object_key
    assert key is not None
    shop.store.objects.local_path(key).write_bytes(b"")

    answer = shop.asked()

    assert answer["rides"] == [whole]
    assert [(one["id"], one["code"]) for one in answer["rides_without"]] == [
        (damaged, "object_damaged")
    ]


def test_torque_that_was_only_asked_for_has_no_energy(shop: Shop) -> None:
    older_unit = {name: x for name, x in AT_TEN.items() if name != "motor_torque_demanded_nm"}
    shop.ride(older_unit)

    answer = shop.asked()

    assert answer["assisted_s"] == pytest.approx(1.0)
    assert answer["cells"]["motor_wh"] is None
    assert answer["columns"][0]["motor_wh"] is None
    assert answer["motor_excluded_s"] == pytest.approx(1.0)


def test_a_ride_by_the_law_s_defaults_is_named(shop: Shop) -> None:
    shop.source = "defaults"
    ride_id = shop.ride(AT_TEN)

    assert shop.asked()["rides_by_defaults"] == [ride_id]


def test_the_latest_rides_of_one_unit_are_looked_at_and_the_one_going_on_is_not(
    shop: Shop,
) -> None:
    shop.ride(AT_TEN)
    mine = [shop.ride(AT_TEN) for _ in range(RIDES_MAX)]
    shop.ride(AT_TEN, unit="ebl:SP-2")
    shop.begin(AT_TEN)

    answer = shop.asked(device="ebl:SP-1")

    assert answer["rides"] == mine[::-1]
    assert answer["more"]
    # The second ride of all began two hours after 22:13:20.
    assert answer["since"] == "2023-11-15T00:13:20.000Z"


def test_rides_can_be_named(shop: Shop) -> None:
    first, _, third = (shop.ride(AT_TEN) for _ in range(3))

    assert shop.asked(ride_ids=[first, third, first])["rides"] == [third, first]
    with pytest.raises(NotFound):
        shop.asked(ride_ids=[first, 999])
    with pytest.raises(InvalidRequest):
        shop.asked(ride_ids=[first], device="dev1")


def test_points_that_no_table_may_have_are_refused_one_by_one(shop: Shop) -> None:
    with pytest.raises(InvalidRequest) as refused:
        shop.asked(
            speed_points_kmh=[5, 5, 15, 20, 99], torque_rate_points=[0, 0.1, float("nan"), 0.3, 0.4]
        )

    assert [(fault.field, fault.code) for fault in refused.value.fields] == [
        ("speed_points_kmh[1]", "not_increasing"),
        ("speed_points_kmh[4]", "out_of_range"),
        ("torque_rate_points[2]", "not_finite"),
    ]


def test_a_sample_from_the_unit_s_log_holds_until_the_next(shop: Shop) -> None:
    ride: Ride = shop.store.rides.get(shop.ride(AT_TEN))
    rows = np.full((SECOND, len(ride.channels)), 1000, np.int16)
    rows[50:70] = -32768
    rows[[50, 60]] = 1000  # every tenth row, from a log
    filled = replace(ride, filled=(Filled(0.5, 0.7, 20, 2, 100_000),))
    reader = RideReader(filled, LiveRows(filled, rows), lambda ride_id, step: None)

    seconds = reader.row_seconds()

    assert seconds[[49, 50, 51, 60, 70]] == pytest.approx([0.01, 0.1, 0.0, 0.1, 0.01])
    assert seconds.sum() == pytest.approx(1.0)
