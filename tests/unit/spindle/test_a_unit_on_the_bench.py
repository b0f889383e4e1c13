"""Goal: the bench unit of the test kit tells the truth about time, traces and power.

Numbers come from the wire's own rate (100 rows a second) and from a second, independent view: what
an observer beside the bike sees.
"""

from __future__ import annotations

import json

import numpy as np
import pytest

from backend.device.ebl.operations.simulation import simulation_set
from backend.errors import NotStandingStill
from sim_device.scenario_phase import ScenarioError
from spindle.testing import DriveUnit


def test_as_much_time_passes_as_was_asked_for() -> None:
    unit = DriveUnit(seed=1)
    before_s = unit.t_s

    unit.advance(1.234)

    assert unit.t_s - before_s == pytest.approx(1.234, abs=1e-6)


def test_a_trace_has_every_row_and_says_what_the_observer_sees() -> None:
    unit = DriveUnit(seed=1)
    unit.ride(seconds=30.0)

    trace = unit.trace("speed_kmh", "motor_torque_nm")

    assert np.diff(trace["t_s"]) == pytest.approx(0.01, abs=1e-9)
    # Up to two rows wait for their frame to be full.
    assert len(trace["t_s"]) >= 30 * 100 - 3
    assert trace["speed_kmh"][-1] == pytest.approx(unit.observe()["speed_kmh"], abs=0.3)


def test_the_same_seed_and_calls_give_the_same_rows() -> None:
    units = [DriveUnit(seed=8) for _ in range(2)]
    for unit in units:
        unit.ride(seconds=10.0)

    first, second = (unit.trace("rider_torque_raw", "motor_torque_nm") for unit in units)

    assert all(np.array_equal(first[name], second[name], equal_nan=True) for name in first)
    assert first["rider_torque_raw"].std() > 0.0


def test_a_channel_that_does_not_exist_is_an_error() -> None:
    unit = DriveUnit()
    unit.advance(0.2)

    with pytest.raises(KeyError, match="torque_of_the_moon"):
        unit.trace("torque_of_the_moon")


@pytest.mark.parametrize("bike", [{"road.colour": 1.0}, {"road.mass_kg": 0.0}])
def test_a_bike_that_cannot_be_is_refused_by_name(bike: dict[str, float]) -> None:
    with pytest.raises(ScenarioError, match=next(iter(bike))):
        DriveUnit(bike=bike)


def test_a_bike_that_moves_is_not_written_and_one_that_was_stopped_is() -> None:
    unit = DriveUnit(seed=2)
    unit.ride(seconds=8.0)
    with pytest.raises(NotStandingStill):
        unit.write(fuzzy_table_name="mine")

    unit.stand_still()

    assert unit.write(fuzzy_table_name="mine").parameters["fuzzy_table_name"] == "mine"


def test_the_battery_taken_out_keeps_the_flash_and_nothing_else() -> None:
    unit = DriveUnit(seed=2)
    unit.write(fuzzy_table_name="mine")
    unit.advance(20.0)

    unit.restart()

    assert unit.t_s < 1.0
    assert unit.config().parameters["fuzzy_table_name"] == "mine"
    assert unit.trace()["t_s"].max(initial=0.0) < 1.0


def test_a_wish_longer_than_a_frame_crosses_the_line() -> None:
    unit = DriveUnit(seed=2)
    everything = unit.unit.simulation_get() | {"dyno_nm": 12.345678901234567, "seed": 2**62}
    assert len(json.dumps(everything)) > 544

    told = unit.ask(simulation_set(everything))

    assert (told["dyno_nm"], told["seed"]) == (12.345678901234567, 2**62)
