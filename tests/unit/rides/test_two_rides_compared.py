"""Goal: two stored rides are compared by what they are: windows, motor torque, settings, crank.

Method: rides made row by row in a real store, the second one the first with a known change; the
figures of a whole ride are those of its own summary.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from backend.core.ride import Ride
from backend.errors import InvalidRequest, NotFound
from backend.law import law_defaults
from backend.rides.comparison.service import RideComparison
from backend.rides.rows import Window
from backend.store import Store
from tests.unit.rides.test_why_a_moment_was_as_it_was import ROWS, config_of, kept

PUSH = np.full(ROWS, 20.0)


def figures_of(told: dict[str, Any], part: str) -> dict[str, Any]:
    return {
        one["name"]: one["difference"] if part == "difference" else one[part]["value"]
        for one in told["figures"]
    }


def test_the_figures_of_a_whole_ride_are_those_of_its_summary(store: Store) -> None:
    a, b = kept(store, rider_torque_nm=PUSH), kept(store, rider_torque_nm=1.5 * PUSH)

    told = RideComparison(store, config_of)(Window(a), Window(b))

    summary = store.rides.get(a).summary
    assert summary is not None
    one = figures_of(told, "a")
    for name in ("duration_s", "moving_s", "distance_km", "rider_wh", "motor_wh", "battery_wh"):
        assert one[name] == pytest.approx(getattr(summary, name), rel=1e-3), name
    assert one["rider_wh"] is not None
    apart = figures_of(told, "difference")
    assert apart["rider_wh"] == pytest.approx(0.5 * one["rider_wh"], rel=1e-3)
    assert apart["motor_wh"] == apart["distance_km"] == 0.0
    ratio = one["motor_per_rider"]
    assert apart["motor_per_rider"] == pytest.approx(ratio / 1.5 - ratio, rel=1e-3)
    assert (told["route_overlap"], told["no_route"]) == (None, "neither")


def test_two_windows_of_a_ride_are_laid_from_their_own_starts(store: Store) -> None:
    speed = np.repeat([10.0, 20.0], ROWS // 2)
    ride = kept(store, speed_kmh=speed)
    windows = Window(ride, 0.0, 4.99), Window(ride, 5.0)
    compare = RideComparison(store, config_of)

    figures = figures_of(compare(*windows), "difference")
    by_time = compare.series(*windows, "time", ["speed_kmh"], pixels=50)
    by_way = compare.series(*windows, "distance", ["speed_kmh"], pixels=100)

    assert figures["speed_kmh_mean"] == pytest.approx(10.0)
    assert figures["distance_km"] == pytest.approx(10.0 * 5.0 / 3600.0, rel=1e-3)
    assert by_time["end_x"] == pytest.approx(5.0)
    assert by_time["channels"][0]["difference"] == [10.0] * 50
    # 5 s at 10 km/h are half of the way that 5 s at 20 km/h are: no difference behind it.
    assert by_way["end_x"] == pytest.approx(5.0 * 20.0 / 3.6)
    assert by_way["channels"][0]["difference"] == [10.0] * 50 + [None] * 50
    assert by_way["channels"][0]["a"]["max"] == [10.0] * 50 + [None] * 50


def test_a_part_of_the_axis_is_drawn_finer(store: Store) -> None:
    wave = 20.0 + 5.0 * np.sin(np.arange(ROWS))
    other = 30.0 + 2.0 * np.cos(np.arange(ROWS) / 7.0)
    a, b = kept(store, rider_torque_nm=wave), kept(store, rider_torque_nm=other)
    series = RideComparison(store, config_of).series

    told = series(Window(a), Window(b), "time", ["rider_torque_nm"], (2.0, 3.0), 100)

    (channel,) = told["channels"]
    assert (told["x"][0], told["x"][-1]) == (2.0, 3.0)
    assert channel["a"]["min"] == channel["a"]["max"] == pytest.approx(wave[200:300], abs=0.01)
    apart = other[200:300] - wave[200:300]
    assert channel["difference"] == pytest.approx(apart, abs=0.02)


def test_what_was_asked_is_never_laid_beside_what_was_given(store: Store) -> None:
    given = kept(store)
    asked = kept(store, motor_torque_nm=np.full(ROWS, 0.9), motor_torque_demanded_nm=None)
    compare = RideComparison(store, config_of)

    told = compare(Window(given), Window(asked))
    series = compare.series(
        Window(given), Window(asked), "time", ["motor_torque_nm", "motor_torque_demanded_nm"]
    )

    assert told["motor_torque"] == "apart"
    has = {one["name"]: (one["a"], one["b"]) for one in told["channels"]}
    assert has["motor_torque_nm"] == (True, False)
    assert has["motor_torque_demanded_nm"] == (True, True)
    gave, was_asked = series["channels"]
    assert (gave["b"], gave["difference"]) == (None, None)
    assert was_asked["difference"][500] == pytest.approx(0.9 - 0.6, abs=0.01)
    motor = next(one for one in told["figures"] if one["name"] == "motor_wh")
    assert (motor["b"]["missing"], motor["difference"]) == ("only_asked", None)


def test_settings_differ_by_name_and_by_cell(store: Store) -> None:
    a, b = kept(store, rider_torque_nm=PUSH), kept(store, rider_torque_nm=1.5 * PUSH)
    rules = [list(row) for row in law_defaults()["fuzzy_rules"]]
    was, rules[1][2] = rules[1][2], "PB"
    changed = law_defaults() | {"fuzzy_rules": rules, "wheel_circumference_m": 2.2}

    def of(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
        return (law_defaults() if ride.id == a else changed), "ride"

    told = RideComparison(store, of)(Window(a), Window(b))["settings"]

    assert {one.name for one in told["differences"]} == {"fuzzy_rules", "wheel_circumference_m"}
    (table,) = told["tables"]
    (cell,) = table["cells"]
    assert table["which"] == "first"
    assert (cell.row, cell.column, cell.left, cell.right) == (1, 2, was, "PB")


def test_settings_that_nobody_kept_are_not_compared(store: Store) -> None:
    a, b = kept(store, rider_torque_nm=PUSH), kept(store, rider_torque_nm=1.5 * PUSH)

    def nobody(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
        return law_defaults(), "defaults" if ride.id == b else "ride"

    told = RideComparison(store, nobody)(Window(a), Window(b))["settings"]

    assert (told["a"]["is_known"], told["b"]["is_known"], told["b"]["why"]) == (
        True,
        False,
        "imported",
    )
    assert (told["differences"], told["tables"]) == (None, [])


def test_torque_round_the_crank_is_apart_by_what_the_rider_pushed_harder(store: Store) -> None:
    # 25 turns in ten seconds.
    cadence = np.full(ROWS, 150.0)
    angle = np.mod(np.arange(ROWS) * 6.0 * 150.0 / 100.0, 360.0)
    push = 20.0 + 10.0 * np.cos(np.radians(2.0 * angle))
    turning = {"cadence_rpm": cadence, "crank_angle_deg": angle}
    a = kept(store, rider_torque_nm=push, **turning)
    b = kept(store, rider_torque_nm=push + 5.0, **turning)
    compare = RideComparison(store, config_of)

    told = compare.crank(Window(a), Window(b))
    few = compare.crank(Window(a, 0.0, 2.0), Window(b))

    assert told["difference"]["rider_nm"] == pytest.approx([5.0] * 36, abs=0.02)
    assert told["a"]["turns"] == pytest.approx(25.0)
    assert (few["a"], few["a_refused"], few["difference"]["rider_nm"]) == (None, "few_turns", None)


def test_what_cannot_be_compared_is_refused_by_its_field(store: Store) -> None:
    ride = kept(store)
    compare = RideComparison(store, config_of)

    with pytest.raises(NotFound):
        compare(Window(ride), Window(99))
    with pytest.raises(InvalidRequest) as empty:
        compare(Window(ride), Window(ride, 50.0))
    with pytest.raises(InvalidRequest) as unknown:
        compare.series(Window(ride), Window(ride), "time", ["gain_of_yesterday"])

    assert empty.value.fields[0].field.startswith("b_")
    assert unknown.value.fields[0].code == "unknown_channel"
