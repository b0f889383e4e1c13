"""Goal: a bike with a cassette is pedalled at its rider's cadence, and a shift makes no energy.

Method: physics alone and whole units; a shift's momentum and heat are those of bodies that meet,
computed here once more. Without a cassette nothing of it exists.
"""

import math
import random
from typing import Any

import pytest
from sim_device.firmware.python._native import lib

from sim_device.lockstep import LockstepUnit
from sim_device.scenario import run
from sim_device.scenario_file import ScenarioError, load, parse
from tests.fakes.bike import RIDER_LEGS, RIDER_OFF, Bike

CASSETTE = (11, 13, 15, 17, 19, 21, 24, 28, 32, 37, 42)
BIKE = {f"gears.cog_teeth_{n}": float(teeth) for n, teeth in enumerate(CASSETTE, start=1)}
RPM_PER_RAD_S = 30 / math.pi
GEAR, CRANK_KG_M2, MOTOR_KG_M2, RADIUS_M = 40.34, 0.02, 1.4e-4, 0.33
MOVING_KG = 100.0 + 0.24 / RADIUS_M**2


def geared(speed_kmh: float = 0.0) -> Bike:
    bike = Bike()
    for number, teeth in enumerate(CASSETTE):
        bike.config.gears.cog_teeth[number] = teeth
    bike.place(speed_kmh)
    return bike


def cog(bike: Bike) -> float:
    return float(lib.physics_cog_teeth(bike.config, bike.state))


def kinetic_j(state: Any) -> float:
    return 0.5 * (
        MOVING_KG * state.speed_ms**2
        + CRANK_KG_M2 * state.crank_speed_rad_s**2
        + MOTOR_KG_M2 * state.motor_speed_rad_s**2
    )


def test_a_standing_bike_is_in_its_lowest_gear_and_a_rolling_one_in_the_one_that_suits() -> None:
    assert cog(geared()) == 42

    # 20 km/h turn the wheel at 160.8 r/min: 65 of the crank want 44 / 17.8.
    assert cog(geared(20.0)) == 17


def test_the_cadence_stays_near_the_wished_one_from_a_start_to_25_kmh() -> None:
    bike = geared()
    bike.rider(45.0, RIDER_LEGS)
    seen = []
    for _ in range(250):
        bike.advance(0.1, 0.6)
        seen.append((bike.speed_kmh, bike.state.crank_speed_rad_s * RPM_PER_RAD_S))

    riding = [rpm for kmh, rpm in seen if kmh > 8.0]
    assert seen[-1][0] > 25.0
    # The hysteresis of 8 and what a shift of 0.4 s lets go by.
    assert min(riding) > 50.0
    assert max(riding) < 85.0


def test_a_rider_on_an_even_hill_does_not_hunt_between_two_cogs() -> None:
    bike = geared(12.0)
    bike.rider(40.0, RIDER_LEGS)
    bike.command.road.grade_deg = 3.0
    bike.advance(60.0, 0.5)
    cogs = []

    for _ in range(600):
        bike.advance(0.1, 0.5)
        cogs.append(cog(bike))

    assert len(set(cogs)) == 1


def one_shift(bike: Bike) -> tuple[Any, Any, float]:
    """Speeds right before and after the chain moved, and the heat of the clutches meanwhile."""
    before_teeth = cog(bike)
    for _ in range(30_000):
        before = {
            name: getattr(bike.state, name)
            for name in ("speed_ms", "crank_speed_rad_s", "motor_speed_rad_s")
        }
        heat_j = bike.state.ledger.clutch_j
        bike.advance(0.001)
        if cog(bike) != before_teeth:
            return before, bike.state, bike.state.ledger.clutch_j - heat_j
    raise AssertionError("nobody shifted")


def test_a_shift_up_keeps_the_momentum_and_turns_the_rest_into_heat() -> None:
    bike = geared(24.0)
    bike.config.road.drag_area_m2 = bike.config.road.rolling_coefficient = 0.0
    bike.config.motor.friction_nm_s = 0.0
    bike.rider(0.0)
    # The rider likes it slower from now on: the chain goes on to a smaller cog.
    bike.config.gears.cadence_rpm = 50.0

    before, after, heat_j = one_shift(bike)

    # Wheel, cranks and rotor referred to the new chainring: an inelastic impact.
    reach_m = RADIUS_M * 44 / cog(bike)
    wheel, rotor = MOVING_KG * reach_m**2, MOTOR_KG_M2 * GEAR**2
    slow, fast = before["speed_ms"] / reach_m, before["crank_speed_rad_s"]
    turning = CRANK_KG_M2 + rotor
    together = (wheel * slow + turning * fast) / (wheel + turning)
    lost_j = 0.5 * wheel * turning / (wheel + turning) * (fast - slow) ** 2
    assert after.speed_ms / reach_m == pytest.approx(together, rel=1e-9)
    assert after.crank_speed_rad_s == pytest.approx(together, rel=1e-9)
    assert heat_j == pytest.approx(lost_j, rel=1e-6)
    assert 0.01 < heat_j < 0.5


def test_a_shift_down_leaves_cranks_and_rotor_behind() -> None:
    bike = geared(20.0)
    bike.config.road.drag_area_m2 = bike.config.road.rolling_coefficient = 0.0
    bike.config.motor.friction_nm_s = 0.0
    bike.rider(0.0)
    bike.config.gears.cadence_rpm = 90.0

    before, after, heat_j = one_shift(bike)

    assert heat_j == 0.0
    assert not after.crank_engaged
    assert after.crank_speed_rad_s == before["crank_speed_rad_s"]
    assert after.motor_speed_rad_s == before["motor_speed_rad_s"]
    assert after.speed_ms == before["speed_ms"]


@pytest.mark.parametrize("seed", range(12))
def test_the_books_close_and_no_shift_makes_energy(seed: int) -> None:
    wishes = random.Random(seed)
    bike = geared(wishes.uniform(0.0, 25.0))
    bike.config.road.grip = wishes.choice([0.0, 0.15, 0.8])
    shifts = 0

    for _ in range(30):
        bike.command.road.grade_deg = wishes.uniform(-5.0, 7.0)
        bike.command.road.brake = int(wishes.random() < 0.15)
        bike.rider(wishes.uniform(0.0, 90.0), wishes.choice([RIDER_OFF, RIDER_LEGS]))
        bike.command.motor_torque_nm = wishes.choice([0.0, 0.6, 1.6])
        for _ in range(1000):
            teeth, stored_j = cog(bike), kinetic_j(bike.state)
            bike.advance(0.001)
            if cog(bike) != teeth:
                shifts += 1
                # 230 Nm of legs and motor on a chainring of 8 rad/s are 1.9 J a millisecond.
                assert kinetic_j(bike.state) < stored_j + 2.5

    assert shifts >= 10
    assert bike.balance_error_pct < 1e-6


def test_the_rider_eases_his_push_while_he_shifts() -> None:
    bike = geared()
    bike.config.rider.stroke_ripple = 0.0
    bike.rider(30.0, RIDER_LEGS)
    bike.advance(4.0, 0.6)
    pushes = []
    for _ in range(3000):
        bike.advance(0.001, 0.6)
        pushes.append(round(bike.state.spindle_torque_nm, 1))

    eased = sum(push < 0.65 * 30.0 for push in pushes) / 1000
    assert max(pushes) == pytest.approx(30.0, rel=0.02)
    # Half of each shift of 0.4 s: down to 0.3 and up again.
    assert 0.2 <= eased <= 1.4


def test_without_a_cassette_the_rider_s_wishes_change_nothing() -> None:
    rides = []
    for cadence_rpm in (65.0, 30.0):
        bike = Bike(10.0)
        bike.config.gears.cadence_rpm = cadence_rpm
        bike.rider(40.0, RIDER_LEGS)
        bike.advance(20.0, 0.7)
        rides.append((bike.state.distance_m, bike.state.ledger.rider_work_j, cog(bike)))

    assert rides[0] == rides[1]
    assert rides[0][2] == 14


@pytest.mark.parametrize(("torque_nm", "grade_deg"), [(49.0, 5.0), (60.0, 6.5), (80.0, 8.0)])
def test_a_rider_who_stands_on_the_hill_in_44_14_starts_with_a_cassette(
    torque_nm: float, grade_deg: float
) -> None:
    reached = []
    for bike in ({}, BIKE):
        unit = LockstepUnit(3, bike=dict(bike))
        unit.select_mode(3)
        unit.road(grade_deg=grade_deg)
        unit.rider("legs", torque_nm)
        unit.advance(15.0)
        reached.append(unit.observe())
    single, cassette = reached

    assert (single["speed_kmh"], single["distance_m"]) == (0.0, 0.0)
    assert cassette["speed_kmh"] > 8.0
    assert cassette["fault_flags"] == 0


def test_there_is_no_torque_before_the_crank_has_moved() -> None:
    unit = LockstepUnit(5, bike=dict(BIKE))
    unit.select_mode(4)
    unit.road(grade_deg=20.0)
    unit.advance(0.5)  # with free pedals: no foot of the start
    unit.rider("legs", 60.0)
    for _ in range(300):
        unit.advance(0.01)
        seen = unit.observe()
        assert (seen["motor_demand_nm"], seen["motor_current_a"]) == (0.0, 0.0)
    assert seen["cadence_rpm"] == 0.0
    assert seen["torque_raw_counts"] == pytest.approx(6000, abs=30)
    assert seen["rider_torque_nm"] == pytest.approx(60.0, rel=0.01)

    unit.road(grade_deg=6.0)
    before_deg = seen["crank_angle_deg"]
    while unit.observe()["motor_demand_nm"] == 0.0:
        unit.advance(0.001)

    assert unit.observe()["crank_angle_deg"] > before_deg


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("hysteresis_rpm", [8.0, 25.0])
def test_no_gear_is_taken_for_a_fault(seed: int, hysteresis_rpm: float) -> None:
    """The firmware knows 44/14 only; the law and its watch see cadence, motor and wheel."""
    wishes = random.Random(seed)
    around = {
        "gears.cadence_rpm": wishes.uniform(40.0, 85.0),
        "gears.hysteresis_rpm": hysteresis_rpm,
        "wheel.jitter_share": wishes.choice([0.0, 0.01]),
        # One magnet is known to be too late at walking pace (docs/safety.md).
        "wheel.pulses_per_turn": wishes.choice([6.0, 36.0]),
    }
    unit = LockstepUnit(seed, bike=BIKE | around)
    unit.advance(0.5)  # with free pedals: no foot of the start
    used = set()

    for _ in range(25):
        unit.simulation_set(
            {
                "rider": {"kind": wishes.choice(["off", "legs", "legs"]),
                          "torque_nm": wishes.uniform(15.0, 90.0)},
                "road": {"grade_deg": wishes.uniform(-4.0, 8.0)},
                "assist_mode": wishes.randrange(5),
                "brake": wishes.random() < 0.1,
            }
        )  # fmt: skip
        for _ in range(16):
            unit.advance(0.25)
            seen = unit.observe()
            used.add(seen["cog_teeth"])
            assert seen["fault_flags"] == 0

    assert len(used) >= 2


def test_the_hill_start_is_ridden_to_its_end_and_without_its_cassette_is_not() -> None:
    ridden = run("hill_start")

    assert ridden["stalled_phases"] == []
    assert ridden["faults_seen"] == []
    assert ridden["energy_balance_error_pct"] < 1e-6
    scenario = load("hill_start")
    single = LockstepUnit(28, scenario=parse("single", (
        'doc = "The same in 44/14."\nseed = 28\n[[phases]]\nmetres = 120\nrider = "legs"\n'
        f"torque_nm = {scenario.phases[0].torque_nm}\ngrade_deg = 6.5\nassist_mode = 3\n"
    )))  # fmt: skip
    *_, seen = single.ride_once(10.0)
    assert single.stalled_phases == [1]
    assert seen["distance_m"] < 1.0


@pytest.mark.parametrize(
    ("cogs", "complaint"),
    [
        ("[]", "has 0 values; it can have 1 to 14"),
        ("[11, 11]", "its values rise from above 0"),
        ("[15, 13]", "its values rise from above 0"),
        ("[0, 13]", "its values rise from above 0"),
        ("[11, 99]", "cog_teeth is 99; it lies from 0.0 to 60.0"),
        ("['a']", "cog_teeth is 'a', not a number"),
        (str(list(range(11, 30))), "has 19 values; it can have 1 to 14"),
    ],
)
def test_a_cassette_rises_and_has_room(cogs: str, complaint: str) -> None:
    with pytest.raises(ScenarioError, match=complaint.replace("(", r"\(")):
        parse("ride", f'doc = "A."\nseed = 1\n[bike.gears]\ncog_teeth = {cogs}\n')


def test_a_scenario_s_cassette_is_gone_with_it() -> None:
    unit = LockstepUnit(scenario="hill_start")
    unit.advance(10.0)
    assert unit.observe()["cog_teeth"] > 14

    unit.simulation_set({"scenario": "slippery_start"})
    unit.advance(1.0)

    assert unit.observe()["cog_teeth"] == 14.0
