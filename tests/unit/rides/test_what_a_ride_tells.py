"""Goal: a stored ride tells energy, effort and faults of its samples, and why where it cannot.

Method: rides row by row in a real store, whose modes, powers and charge are known; the sums of the
parts are the ride's own summary.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.law import law_defaults
from backend.rides.questions import Insight
from backend.store import Store
from tests.fakes.kept_rides import config_of as nobody_kept
from tests.unit.rides.test_why_a_moment_was_as_it_was import PUSHING, ROWS, config_of, kept

RIDER_W = 20.0 * PUSHING["cadence_rpm"] * 2.0 * np.pi / 60.0
PUSH = np.full(ROWS, 20.0)


def test_the_modes_come_to_the_whole_ride(store: Store) -> None:
    mode = np.where(np.arange(ROWS) < 700, 3.0, 1.0)
    ride_id = kept(store, assist_mode=mode, rider_torque_nm=PUSH)

    told = Insight(store, config_of).energy(ride_id)
    summary = store.rides.get(ride_id).summary

    assert summary is not None
    assert [(one["mode"], one["name"]) for one in told["modes"]] == [(1, "eco"), (3, "sport")]
    assert [one["seconds"] for one in told["modes"]] == pytest.approx([3.0, 7.0])
    for figure in ("rider_wh", "motor_wh", "battery_wh", "distance_km"):
        assert told["total"][figure] == pytest.approx(getattr(summary, figure), rel=1e-3)
        assert sum(one[figure] for one in told["modes"]) == pytest.approx(told["total"][figure])
    assert told["total"]["rider_wh"] == pytest.approx(RIDER_W * 10.0 / 3600.0, rel=1e-3)
    assert told["battery_wh_per_km"] == pytest.approx(72.0 / 12.0, rel=1e-3), "36 V, 2 A, 12 km/h"
    assert (told["gradients"], told["climb"], told["range_refused"]) == (None, None, "no_charge")


def test_a_mode_has_no_name_that_nobody_kept(store: Store) -> None:
    asked_only = kept(store, motor_torque_demanded_nm=None)
    told = Insight(store, nobody_kept).energy(asked_only)

    assert [one["name"] for one in told["modes"]] == [None]
    assert (told["total"]["motor_wh"], told["total"]["motor_per_rider"]) == (None, None)
    assert told["total"]["rider_wh"] is None, "it has the sensor's counts, and no torque"


def test_zones_need_the_riders_threshold(store: Store) -> None:
    effort = Insight(store, config_of).effort
    ride_id = kept(store, rider_torque_nm=PUSH)

    bare, told = effort(ride_id), effort(ride_id, threshold_power_w=130.0)

    assert (bare["power"]["zones"], told["power"]["zones"]) == (False, True)
    in_zone = [band["seconds"] for band in told["power"]["bands"]]
    assert in_zone == pytest.approx([0, 0, 0, 10, 0, 0, 0]), "125.7 W lie within 117 and 136.5 W"
    assert told["torque"]["bands"][0]["seconds"] == pytest.approx(10.0)
    assert told["power_curve"][-1]["power_w"] == pytest.approx(RIDER_W, rel=1e-3)
    assert told["heart_rate"] is None


def test_the_diagnosis_uses_the_rides_own_limits(store: Store) -> None:
    sagging = np.where(np.arange(ROWS) < 800, 36.0, 26.0)
    ride_id = kept(store, battery_voltage_v=sagging, rider_torque_nm=PUSH)

    told = Insight(store, config_of).diagnosis(ride_id)
    unknown = Insight(store, nobody_kept).diagnosis(ride_id)

    by_name = {check["name"]: check for check in told["checks"]}
    (finding,) = by_name["brown_out"]["findings"]
    assert (finding["from_s"], finding["to_s"]) == pytest.approx((8.0, 10.0))
    assert (told["worst"], told["method"]) == ("serious", 1)
    assert (unknown["worst"], unknown["checks"][3]["state"]) == (None, "impossible")


def test_pedalling_needs_an_angle_and_the_gain_its_rows(store: Store) -> None:
    gain = np.full(ROWS, 0.3)
    angle = np.mod(np.arange(ROWS) * 6.0 * PUSHING["cadence_rpm"] / 100.0, 360.0)
    pedalling = Insight(store, config_of).pedalling

    bare = pedalling(kept(store))
    told = pedalling(kept(store, crank_angle_deg=angle, rider_torque_nm=PUSH, fuzzy_gain=gain))

    assert (bare["crank"], bare["crank_refused"], bare["gain"]) == (None, "no_angle", None)
    assert told["crank_refused"] == "few_turns", "ten seconds at 60 rpm"
    assert np.sum(told["gain"]["seconds"]) == pytest.approx(10.0)
    assert sum(told["gain"]["seconds"][6]) == pytest.approx(10.0), "12 to 14 km/h"
    assert told["speed_points_kmh"] == law_defaults()["fuzzy_speed_points_kmh"]
