"""Goal: a recorded ride, ridden again with another mode, comes to what really riding it comes to.

Method: simulated bikes ride roads of their own (seeds that nobody looked at while the twin was
made) in one mode, and then really in another, with three kinds of rider: one holds the torque, one
the power, one the speed of the ride before. The twin knows the first ride, and mass and posture
where somebody told them. What it has to reach was measured on a prototype before it was built.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from backend.control.recorded_ride import recorded
from backend.control.twin import RoadTwin
from backend.domain.rider_and_bike import RiderAndBike
from sim_device.firmware.python import law
from sim_device.firmware.python.twin import Rider
from tests import counts
from tests.fakes.known_roads import STEP_S, Columns, Outside, Ridden, configuration, road

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

SEEDS = range(801, 801 + counts.of(12, least=2))
CHANGES = ((1, 3), (3, 2))
"""Eco ridden again as sport, and sport as tour; the same slots in the configuration."""
RIDERS = {"torque": Rider(0.0, 0.0), "power": Rider(1.0, 0.0), "speed": Rider(0.0, 1.0)}


def outside(seed: int) -> Outside:
    random = np.random.default_rng(seed + 10_000)
    return Outside(random.uniform(82.0, 106.0), random.uniform(0.42, 0.6))


@cache
def ridden(seed: int, mode: int, rider: str = "torque", before: int | None = None) -> Columns:
    first = None if before is None else ridden(seed, before)
    ride = Ridden(road(seed), mode, rider=rider, before=first, outside=outside(seed))
    return ride.columns


@cache
def twin_of(seed: int, mode: int, told: bool = False) -> RoadTwin:
    """told: somebody weighed rider and bike, and knows how he sits."""
    truth = outside(seed)
    of_it = RiderAndBike(truth.mass_kg, truth.drag_area_m2) if told else RiderAndBike()
    return RoadTwin(recorded(ridden(seed, mode), configuration(), STEP_S), configuration(), of_it)


def in_mode(mode: int) -> dict[str, object]:
    """The configuration in which every slot is what this one is: the ride's buttons stay."""
    config = configuration()
    for name, value in config.items():
        if name.startswith("mode_") and isinstance(value, list | tuple) and len(value) == 5:
            config[name] = [value[mode]] * 5
    return config


def work_j(columns: Columns) -> float:
    rad_s = columns["motor_speed_rpm"] * np.pi / 30.0
    return float((columns["motor_torque_nm"] * rad_s).sum() * STEP_S)


def open_loop_j(columns: Columns, mode: int) -> float:
    names = ("speed_kmh", "cadence_rpm", "battery_voltage_v", "motor_speed_rpm", "brake")
    inputs = {name: columns[name] for name in names}
    answer = law.assist_run(
        configuration(), {**inputs, "torque_raw_counts": columns["rider_torque_raw"], "mode": mode}
    )
    rad_s = columns["motor_speed_rpm"] * np.pi / 30.0
    return float((answer["motor_torque_nm"] * rad_s).sum() * STEP_S)


@cache
def errors(rider: str, told: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Work and time of the twin, and work in open loop, each less the truth and over it."""
    found = []
    for seed in SEEDS:
        for before, after in CHANGES:
            truth = ridden(seed, after, rider, before)
            again, _ = twin_of(seed, before, told).ridden(in_mode(after), RIDERS[rider])
            assert not again.gave_up
            duration_s = len(truth["speed_kmh"]) * STEP_S
            open_j = open_loop_j(ridden(seed, before), after)
            found.append(
                (
                    again.motor_work_j / work_j(truth) - 1.0,
                    again.duration_s / duration_s - 1.0,
                    open_j / work_j(truth) - 1.0,
                )
            )
    work, time, open_work = np.abs(np.array(found)).T
    return work, time, open_work


def test_ridden_again_without_a_change_it_is_the_same_ride() -> None:
    for seed in SEEDS:
        for mode, _ in CHANGES:
            twin = twin_of(seed, mode)
            again = twin.self_replay
            assert again.motor_work_j == pytest.approx(twin.ride.motor_work_j, rel=0.01)
            assert again.duration_s == pytest.approx(twin.ride.duration_s, rel=0.03)


@pytest.mark.parametrize(
    ("rider", "told", "work", "share"),
    [
        ("power", True, 0.03, 0.9),
        ("power", True, 0.05, 0.97),
        ("torque", True, 0.05, 0.93),
        ("power", False, 0.05, 0.95),
        ("torque", False, 0.10, 1.0),
        ("speed", False, 0.10, 0.92),
    ],
)
def test_a_rider_whose_kind_is_known_uses_what_the_twin_says(
    rider: str, told: bool, work: float, share: float
) -> None:
    of_work, of_time, _ = errors(rider, told)

    assert np.mean(of_work <= work) >= share
    assert np.mean(of_time <= 0.03) >= 0.9


def test_an_open_loop_is_ten_times_as_far_off() -> None:
    of_work, _, open_work = errors("power", told=False)

    assert np.median(of_work) <= np.median(open_work) / 10.0


def test_the_band_holds_riders_nobody_knows() -> None:
    inside = []
    for seed in SEEDS:
        for before, after in CHANGES:
            band = twin_of(seed, before).band(in_mode(after))
            for rider in RIDERS:
                truth = ridden(seed, after, rider, before)
                duration_s = len(truth["speed_kmh"]) * STEP_S
                inside.append(
                    (
                        band.motor_work_j[0] <= work_j(truth) <= band.motor_work_j[1],
                        band.duration_s[0] <= duration_s <= band.duration_s[1],
                    )
                )
    work, time = np.mean(inside, axis=0)
    assert work >= 0.85
    assert time >= 0.85
