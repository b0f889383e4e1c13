"""Goal: on the workbench the sensor reads what physics says of a mass on a pedal, on either side
and at any angle; a mass that was just hung swings, and hangs still after some seconds.

Method: units in virtual time whose sensor obeys; torque m g l cos(angle) (thesis eq. 3.22), the
noise of a mean of n words is that of one over sqrt(n).
"""

from math import cos, pi, radians, sqrt

import numpy as np
import pytest

from sim_device.lockstep import LockstepUnit
from sim_device.scenario_phase import ScenarioError
from sim_device.workbench import Workbench, hung

GRAVITY_MS2 = 9.80665
ARM_M = 0.17
COUNTS_PER_NM = 100.0
NOISE_NM = 0.06
WORDS = 200
EXACT = {"mass_limit_share": 0.0, "arm_limit_m": 0.0, "angle_limit_deg": 0.0}
STILL_S = 30.0
SEED = 7


def on_the_bench(**sensor: float) -> LockstepUnit:
    bike = {f"sensor.{name}": value for name, value in ({"noise_nm": NOISE_NM} | sensor).items()}
    return LockstepUnit(SEED, bike=bike)


def readings(unit: LockstepUnit, words: int = WORDS) -> np.ndarray:
    """Raw counts, one in ten milliseconds."""
    found = []
    for _ in range(words):
        unit.advance(0.01)
        found.append(unit.observe()["torque_raw_counts"])
    return np.array(found)


def still(unit: LockstepUnit, mass_kg: float, side: str, **said: float) -> float:
    """The mean reading once what hangs hangs still."""
    unit.hang(mass_kg, side, **said)
    unit.advance(STILL_S)
    return float(readings(unit).mean())


def expected_nm(mass_kg: float, angle_deg: float, arm_m: float = ARM_M) -> float:
    return mass_kg * GRAVITY_MS2 * arm_m * cos(radians(angle_deg))


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("angle_deg", [-60.0, -30.0, 0.0, 45.0, 75.0])
def test_the_reading_is_what_physics_says_on_either_pedal_at_any_angle(
    side: str, angle_deg: float
) -> None:
    unit = on_the_bench()
    within = 5 * NOISE_NM * COUNTS_PER_NM / sqrt(WORDS) + 0.5

    for mass_kg in (0.0, 10.0, 40.0):
        counts = still(unit, mass_kg, side, crank_angle_deg=angle_deg, **EXACT)
        assert counts == pytest.approx(expected_nm(mass_kg, angle_deg) * COUNTS_PER_NM, abs=within)
    seen = unit.observe()
    level_deg = 90.0 if side == "left" else 270.0
    assert (seen["speed_kmh"], seen["cadence_rpm"]) == (0.0, 0.0)
    assert seen["crank_angle_deg"] == pytest.approx(level_deg + angle_deg)


def test_a_mass_that_was_just_hung_swings_and_then_hangs_still() -> None:
    unit = on_the_bench()
    unit.hang(40.0, "left", crank_angle_deg=30.0, **EXACT)

    at_first = readings(unit)
    unit.advance(STILL_S)
    later = readings(unit)

    own = readings(on_the_bench()).std()
    assert at_first.std() > 10 * own
    assert later.std() == pytest.approx(own, rel=0.2)
    # A pendulum of a quarter of a metre: T = 2 pi sqrt(l / g), twice in the two seconds.
    turns = np.abs(np.fft.rfft(at_first - at_first.mean()))
    assert turns.argmax() == round(2.0 / (2 * pi * sqrt(0.25 / GRAVITY_MS2)))


def test_what_hangs_already_does_not_swing_when_it_is_said_again() -> None:
    unit = on_the_bench()
    still(unit, 30.0, "right", crank_angle_deg=30.0)

    unit.simulation_set({"workbench": unit.simulation_get()["workbench"]})

    assert readings(unit).std() < 1.5 * NOISE_NM * COUNTS_PER_NM


def test_bending_is_felt_at_a_level_crank_and_tells_the_sides_apart() -> None:
    """0.06 of m g times 0.1 m, felt most 45 degrees after the crank's top."""
    bent = {"bending_share": 0.06, "bending_lever_m": 0.1, "bending_deg": 45.0}
    unit = on_the_bench(noise_nm=0.0, **bent)

    for side, level_deg in (("left", 90.0), ("right", 270.0)):
        for angle_deg in (-30.0, 0.0, 30.0):
            counts = still(unit, 40.0, side, crank_angle_deg=angle_deg, **EXACT)
            felt_nm = 0.06 * 40.0 * GRAVITY_MS2 * 0.1 * cos(radians(level_deg + angle_deg - 45.0))
            told_nm = expected_nm(40.0, angle_deg) + felt_nm
            assert counts == pytest.approx(told_nm * COUNTS_PER_NM, abs=1.5)


def test_a_sensor_that_feels_the_left_pedal_more_says_so_on_the_bench() -> None:
    unit = on_the_bench(noise_nm=0.0, side_share=0.06)

    left, right = (still(unit, 30.0, side, **EXACT) for side in ("left", "right"))

    assert (left - right) / expected_nm(30.0, 0.0) / COUNTS_PER_NM == pytest.approx(0.06, abs=1e-3)


def test_mass_and_arm_are_off_within_what_is_said_and_the_same_when_they_come_back() -> None:
    said = Workbench(mass_kg=20.0, mass_limit_share=0.01, arm_limit_m=0.001, angle_limit_deg=0.0)
    off = [hung(said, seed, 1) for seed in range(200)]

    shares = np.array([one["mass_kg"] / 20.0 - 1.0 for one in off])
    arms_m = np.array([one["arm_m"] - ARM_M for one in off])
    # Evenly within the limits: limit / sqrt(3) (GUM 4.3.7).
    assert np.abs(shares).max() <= 0.01
    assert shares.std() == pytest.approx(0.01 / sqrt(3.0), rel=0.15)
    assert np.abs(arms_m).max() <= 0.001
    assert arms_m.std() == pytest.approx(0.001 / sqrt(3.0), rel=0.15)
    assert hung(said, SEED, 5)["mass_kg"] == off[SEED]["mass_kg"]

    unit = on_the_bench()
    counts = still(unit, 20.0, "right", mass_limit_share=0.01, arm_limit_m=0.001, angle_limit_deg=0)
    true_nm = off[SEED]["mass_kg"] * GRAVITY_MS2 * off[SEED]["arm_m"]
    assert counts == pytest.approx(true_nm * COUNTS_PER_NM, abs=3.0)
    assert unit.simulation_get()["workbench"]["mass_kg"] == 20.0


def test_on_the_bench_nobody_rides_and_off_it_the_bike_rolls_again() -> None:
    unit = LockstepUnit(3, scenario="commute")
    unit.advance(30.0)
    unit.hang(10.0)
    unit.rider("legs", 40.0)
    unit.advance(5.0)
    held = unit.observe()

    unit.simulation_set({"workbench": None})
    unit.advance(10.0)

    assert held["speed_kmh"] == 0.0
    assert held["spindle_torque_nm"] == pytest.approx(expected_nm(10.0, 0.0), rel=0.02)
    assert unit.simulation_get()["workbench"] is None
    assert unit.observe()["speed_kmh"] > 5.0


def test_a_scenario_takes_the_bike_off_the_bench() -> None:
    unit = on_the_bench()
    unit.hang(10.0)

    unit.simulation_set({"scenario": "commute"})

    assert unit.simulation_get()["workbench"] is None


@pytest.mark.parametrize(
    ("said", "field"),
    [
        ({"side": "both"}, "workbench.side"),
        ({"crank_angle_deg": 90.0}, "workbench.crank_angle_deg"),
        ({"mass_kg": -1.0}, "workbench.mass_kg"),
        ({"weight": 1.0}, "workbench.weight"),
    ],
)
def test_what_no_bench_can_do_is_refused_by_name(said: dict[str, object], field: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        on_the_bench().simulation_set({"workbench": said})

    assert refused.value.field == field
