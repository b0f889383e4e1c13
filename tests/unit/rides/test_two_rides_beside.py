"""Goal: two rides on one axis keep every extreme, open every gap, and differ by what they differ.

Method: rides on paper whose speed, work and way are known, one the other by a known factor; tracks
on a sphere a known distance apart; bins judged row by row in plain Python.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.energy import DELIVERED, DEMANDED
from backend.rides.comparison.figures import Figure, Stretch, compared
from backend.rides.comparison.grid import Laid, binned
from backend.rides.comparison.route_overlap import Positions, route_overlap

DEG_M = math.pi * 6_371_008.8 / 180.0
HOUR_S = 3600


def even(count: int, step: float = 1.0) -> Laid:
    """Rows a second apart that lie `step` apart on the axis."""
    at = np.arange(count) * step
    return Laid(at, at + step, np.ones(count))


def test_a_bin_has_the_extremes_and_the_mean_of_its_rows() -> None:
    rng = np.random.default_rng(7)
    at = np.sort(rng.uniform(0.0, 100.0, 5000))
    seconds, values = rng.uniform(0.1, 2.0, 5000), rng.normal(size=5000)
    values[rng.uniform(size=5000) < 0.2] = np.nan
    edges = np.linspace(0.0, 100.0, 41)

    told = binned(Laid(at, at, seconds), values, edges)

    for number in range(40):
        rows = [
            row
            for row in range(5000)
            if edges[number] <= at[row] < edges[number + 1] and not math.isnan(values[row])
        ]
        assert told.minimum[number] == min(values[row] for row in rows)
        assert told.maximum[number] == max(values[row] for row in rows)
        mean = math.fsum(values[row] * seconds[row] for row in rows)
        assert told.mean[number] == pytest.approx(mean / math.fsum(seconds[row] for row in rows))


def test_a_sample_holds_until_the_next_and_no_further_than_a_gap() -> None:
    # Rows at 0, 10 and 20 m; nobody knows what was between 15 m, where the recorder stopped, and
    # 20 m, nor behind 30 m.
    laid = Laid(np.array([0.0, 10.0, 20.0]), np.array([10.0, 15.0, 30.0]), np.ones(3))

    told = binned(laid, np.array([1.0, 2.0, 3.0]), np.linspace(0.0, 40.0, 17))

    held = [1.0] * 4 + [2.0, 2.0] + [math.nan] * 2 + [3.0] * 4 + [math.nan] * 4
    for column in (told.minimum, told.maximum, told.mean):
        assert column == pytest.approx(held, nan_ok=True)


def test_a_part_of_the_axis_is_the_same_as_the_part_of_the_whole() -> None:
    laid, values = even(1000), np.random.default_rng(2).normal(size=1000)
    whole = binned(laid, values, np.linspace(0.0, 1000.0, 2001))

    part = laid.part(300.5, 400.5)
    told = binned(laid.of(part), values[part], np.linspace(300.5, 400.5, 201))

    assert told.mean == pytest.approx(whole.mean[601:801])
    assert part.stop - part.start == 101, "no more is read than is shown"


def ridden(speed_kmh: float, factor: float = 1.0, meaning: str | None = DELIVERED) -> Stretch:
    """An hour at one speed: 100 W of the rider, 150 W of the motor, 200 W of the battery, each
    times `factor`; and up a climb of 2 %."""
    count = HOUR_S + 1
    values = {
        "speed_kmh": np.full(count, speed_kmh),
        "rider_power_w": np.full(count, 100.0 * factor),
        "battery_power_w": np.full(count, 200.0 * factor),
        "altitude_m": 100.0 + 0.02 * speed_kmh / 3.6 * np.arange(count),
    }
    if meaning == DELIVERED:
        values["motor_power_w"] = np.full(count, 150.0 * factor)
    times_us = np.arange(count, dtype=np.int64) * 1_000_000
    seconds = np.append(np.ones(HOUR_S), 0.0)
    return Stretch(values, times_us, None, seconds, meaning)


def by_name(figures: list[Figure]) -> dict[str, Figure]:
    return {figure.name: figure for figure in figures}


def test_the_same_ride_faster_and_harder_differs_by_its_factors() -> None:
    told = by_name(compared(ridden(18.0), ridden(27.0, 1.2)))

    expected = {
        "duration_s": (3600.0, 3600.0),
        "moving_s": (3600.0, 3600.0),
        "distance_km": (18.0, 27.0),
        "speed_kmh_mean": (18.0, 27.0),
        "rider_wh": (100.0, 120.0),
        "motor_wh": (150.0, 180.0),
        "battery_wh": (200.0, 240.0),
        "rider_wh_per_km": (100.0 / 18.0, 120.0 / 27.0),
        "motor_wh_per_km": (150.0 / 18.0, 180.0 / 27.0),
        "battery_wh_per_km": (200.0 / 18.0, 240.0 / 27.0),
        "motor_per_rider": (1.5, 1.5),
    }
    for name, (a, b) in expected.items():
        assert (told[name].a.value, told[name].b.value) == pytest.approx((a, b)), name
        assert told[name].difference == pytest.approx(b - a), name
    assert told["ascent_m"].difference == pytest.approx(0.02 * 9000.0, rel=0.01)
    assert told["rider_wh"].a.unknown_s == 0.0


def test_what_is_missing_says_why_and_is_no_zero() -> None:
    bare = ridden(18.0, meaning=DEMANDED)
    bare.values.pop("altitude_m")  # type: ignore[attr-defined]
    told = by_name(compared(bare, ridden(18.0)))

    for name, why in (
        ("motor_wh", "only_asked"),
        ("motor_wh_per_km", "only_asked"),
        ("motor_per_rider", "only_asked"),
        ("ascent_m", "no_height"),
    ):
        assert (told[name].a.value, told[name].a.missing) == (None, why)
        assert told[name].b.value is not None
        assert told[name].difference is None


def test_an_energy_tells_what_it_leaves_out() -> None:
    holed = ridden(18.0)
    holed.values["rider_power_w"][600:1200] = np.nan

    told = by_name(compared(ridden(18.0), holed))

    assert told["rider_wh"].b.unknown_s == 600.0
    assert told["rider_wh"].difference == pytest.approx(-100.0 * 600.0 / 3600.0)


def north(length_m: float, east_m: float = 0.0, longer: float = 1.0) -> Positions:
    """A straight road to the north at 60 degrees, a row every 5 m; `longer`: what its odometer
    counts for a metre."""
    way = np.arange(0.0, length_m, 5.0)
    east_deg = east_m / (DEG_M * math.cos(math.radians(60.0)))
    return Positions(
        60.0 + way / DEG_M,
        np.full(len(way), 10.0 + east_deg),
        way / 5.0,
        np.zeros(len(way) - 1, np.bool_),
        way * longer,
    )


def turned(there: Positions) -> Positions:
    """The other way round."""
    assert there.at_m is not None
    back = there.latitude_deg[::-1], there.longitude_deg[::-1]
    return Positions(*back, there.start_s, there.breaks, there.at_m)


def test_a_parallel_way_is_the_same_up_to_thirty_metres() -> None:
    lane, next_road = (route_overlap(north(2000.0), north(2000.0, off)) for off in (25.0, 40.0))

    assert lane is not None
    assert next_road is not None
    assert (lane.a_near_b, lane.b_near_a, lane.in_step) == (1.0, 1.0, 1.0)
    assert (next_road.a_near_b, next_road.b_near_a, next_road.in_step) == (0.0, 0.0, 0.0)


def test_a_longer_ride_has_the_shorter_one_in_it_and_not_the_other_way_round() -> None:
    told = route_overlap(north(1000.0), north(4000.0))

    assert told is not None
    assert told.a_near_b == 1.0
    assert told.b_near_a == pytest.approx(1030.0 / 4000.0, abs=0.01)
    assert told.in_step == 1.0


def test_the_same_road_lines_up_by_distance_only_in_the_same_direction_and_measure() -> None:
    there = north(2000.0)
    back, measured = (
        route_overlap(there, turned(there)),
        route_overlap(there, north(2000.0, longer=1.02)),
    )

    assert back is not None
    assert measured is not None
    assert (back.a_near_b, back.b_near_a) == (1.0, 1.0)
    assert back.in_step == pytest.approx(30.0 / 2000.0, abs=0.01), "only where they meet"
    # 2 % more on one odometer is 30 m after 1500 m.
    assert measured.in_step == pytest.approx(1500.0 / 2000.0, abs=0.02)


def test_nothing_is_walked_over_a_gap() -> None:
    whole, holed = north(3000.0), north(3000.0)
    holed.latitude_deg[200:400] = np.nan

    told = route_overlap(whole, holed)

    assert told is not None
    assert told.b_near_a == 1.0
    assert told.a_near_b == pytest.approx(1.0 - (1000.0 - 60.0) / 3000.0, abs=0.01)


def test_without_positions_nobody_knows() -> None:
    nowhere: Values = np.full(100, np.nan)
    lost = Positions(nowhere, nowhere, np.arange(100.0), np.zeros(99, np.bool_), None)

    assert route_overlap(lost, north(1000.0)) is None
    assert route_overlap(north(1000.0), lost) is None
