"""Goal: a scenario file loads the bench phase by phase, and a hand on the dynamometer wins.

Method: a bike that coasts on rollers without friction. Its speed then says the load: F = M / r,
a = F / m, here 10 Nm on a roller of 0.1 m before 100 kg, which is 1 m/s^2.
"""

from pathlib import Path

import pytest

from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import parse

KMH_PER_MS = 3.6
BENCH = """
doc = "Coasting on the bench."
seed = 1
speed_kmh = 36

[bike.road]
source = 1
dyno_mass_kg = 100
flywheel_kg_m2 = 0
rollers_kg_m2 = 0
wheel_inertia_kg_m2 = 0
roller_coefficient = 0
dyno_roller_radius_m = 0.1

[[phases]]
seconds = 2

[[phases]]
seconds = 2
dyno_nm = 10

[[phases]]
seconds = 2
dyno_nm = 20
"""


def on_the_bench() -> LockstepUnit:
    return LockstepUnit(scenario=parse("bench.toml", BENCH))


def speed_ms(unit: LockstepUnit) -> float:
    return float(unit.observe()["speed_kmh"]) / KMH_PER_MS


def test_each_phase_brakes_with_its_own_torque() -> None:
    unit = on_the_bench()
    speeds, loads = [], []

    for _ in range(3):
        unit.advance(1.9)
        loads.append(unit.simulation_get()["dyno_nm"])
        unit.advance(0.1)
        speeds.append(speed_ms(unit))

    assert loads == [0.0, 10.0, 20.0]
    assert speeds == pytest.approx([10.0, 8.0, 4.0], abs=0.02)


def test_time_that_a_host_grants_loads_it_the_same() -> None:
    unit = on_the_bench()

    unit.simulation_set({"clock": "virtual"})
    unit.simulation_set({"advance_s": 4.0})
    while unit.owed_us:
        unit.pay(70_000)

    assert speed_ms(unit) == pytest.approx(8.0, abs=0.02)


def test_a_hand_on_the_dynamometer_wins_until_another_scenario_starts() -> None:
    unit = on_the_bench()

    unit.simulation_set({"dyno_nm": 5.0})
    unit.advance(6.0)
    by_hand = unit.simulation_get()
    unit.simulation_set({"scenario": "bench.toml"})
    unit.advance(3.0)

    assert (by_hand["dyno_nm"], by_hand["scenario"]) == (5.0, "bench.toml")
    assert unit.simulation_get()["dyno_nm"] == 10.0


def test_what_a_scenario_loaded_is_off_again_with_the_next_and_what_a_hand_loaded_stays() -> None:
    unit = LockstepUnit(bike={"road.source": 1.0})
    unit.simulation_set({"dyno_nm": 7.0})
    loaded = LockstepUnit(scenario=parse("bench.toml", BENCH))
    loaded.advance(3.0)

    for each in (unit, loaded):
        each.simulation_set({"scenario": "commute"})
        each.advance(1.0)

    assert (unit.simulation_get()["load_source"], unit.simulation_get()["dyno_nm"]) == ("dyno", 7.0)
    assert loaded.simulation_get()["load_source"] == "road"
    assert loaded.simulation_get()["dyno_nm"] == 0.0


def test_a_unit_started_with_a_file_can_be_sent_on_it_again(tmp_path: Path) -> None:
    path = tmp_path / "bench.toml"
    path.write_text(BENCH)
    unit = LockstepUnit(scenario=str(path))

    unit.advance(7.0)
    ended = unit.simulation_get()
    unit.simulation_set({"scenario": ended["scenario"]})

    assert (ended["scenario"], ended["running"]) == ("bench.toml", False)
    assert unit.simulation_get()["running"] is True
    assert unit.observe()["speed_kmh"] == pytest.approx(36.0)
