"""Goal: legs tire, tyres slip and the bench's lift loads, each by its own law, books closed.

Method: physics alone; numbers from thesis_checks 4.6 and 6.
"""

import math
from itertools import pairwise

import pytest
from sim_device.firmware.python._native import lib

from sim_device.lockstep import LockstepUnit
from tests.fakes.bike import RIDER_LEGS, RIDER_OFF, Bike

LOAD_DYNO, DYNO_THESIS = 1, 1
G = 9.80665


def on_a_bench(**road: float) -> Bike:
    bike = Bike()
    bike.config.road.source = LOAD_DYNO
    for name, value in road.items():
        setattr(bike.config.road, name, value)
    bike.place(0.0)
    return bike


def cranks_turn_at(bike: Bike, rpm: float) -> None:
    """A flywheel that nothing slows keeps the cranks at this speed."""
    bike.config.road.source = LOAD_DYNO
    bike.config.road.dyno_mass_kg = 1e9
    bike.place(rpm * 0.33 * 44 / 14 * 2 * math.pi / 60 * 3.6)


def torque_over_a_turn(bike: Bike) -> list[float]:
    turn_s = 2 * math.pi / bike.state.crank_speed_rad_s
    torques = []
    for _ in range(round(turn_s / 0.001)):
        bike.advance(0.001)
        torques.append(bike.state.spindle_torque_nm)
    return torques


def test_one_leg_can_be_stronger_and_dead_spots_lie_where_they_are_put() -> None:
    bike = Bike()
    bike.config.rider.asymmetry = 0.1
    bike.config.rider.dead_spot_deg = 20.0
    cranks_turn_at(bike, 60.0)
    bike.rider(30.0, RIDER_LEGS)

    torques = torque_over_a_turn(bike)

    first, second = torques[: len(torques) // 2], torques[len(torques) // 2 :]
    assert sum(torques) / len(torques) == pytest.approx(30.0, rel=0.01)
    assert max(first) > max(second) + 1.0
    quarter = len(torques) // 4
    dead_spot = quarter + torques[quarter:].index(min(torques[quarter:]))
    assert dead_spot == pytest.approx(len(torques) * 200 / 360, rel=0.05)


def test_strokes_differ_by_their_noise() -> None:
    bike = Bike()
    bike.config.rider.stroke_noise = 0.05
    cranks_turn_at(bike, 60.0)
    bike.rider(30.0, RIDER_LEGS)

    means = []
    for _ in range(20):
        torques = torque_over_a_turn(bike)
        half = len(torques) // 2
        means += [sum(torques[:half]) / half, sum(torques[half:]) / half]

    spread = math.sqrt(sum((mean - 30) ** 2 for mean in means) / len(means)) / 30
    assert 0.03 < spread < 0.075
    assert all(a != b for a, b in pairwise(means))


@pytest.mark.parametrize(("rpm", "most_nm"), [(50.0, 112.5), (100.0, 75.0), (180.0, 15.0)])
def test_legs_give_less_the_faster_they_turn(rpm: float, most_nm: float) -> None:
    bike = Bike()
    bike.config.rider.torque_nm_max = 150.0
    bike.config.rider.stroke_ripple = 0.0
    cranks_turn_at(bike, rpm)
    bike.rider(250.0, RIDER_LEGS)

    bike.advance(0.01)

    assert bike.state.spindle_torque_nm == pytest.approx(most_nm, rel=0.01)


def test_a_rider_above_the_critical_power_fades_to_it_as_the_reserve_goes() -> None:
    bike = Bike()
    rider = bike.config.rider
    rider.critical_power_w, rider.reserve_j, rider.stroke_ripple = 200.0, 2000.0, 0.0
    rider.peak_power_w = 900.0
    cranks_turn_at(bike, 60.0)
    bike.rider(400.0 / (2 * math.pi), RIDER_LEGS)

    # He can give 400 W while 200 / 700 of the reserve is left. 200 W too much take the rest of 2 kJ
    # in 7.14 s, and from there on the excess is as the reserve: it goes with 2000 J / 700 W.
    fades_s, time_constant_s = (2000 - 2000 * 200 / 700) / 200, 2000 / 700
    given_w = []
    for _ in range(200):
        bike.advance(0.1)
        given_w.append(bike.state.spindle_torque_nm * 2 * math.pi)
    for step, watts in enumerate(given_w, start=1):
        faded_s = max(0.1 * step - fades_s, 0.0)
        assert watts == pytest.approx(200 + 200 * math.exp(-faded_s / time_constant_s), rel=0.01)

    assert max(abs(after - now) for now, after in pairwise(given_w)) < 8.0


@pytest.mark.slow
def test_the_tired_rider_of_the_pass_does_not_jump() -> None:
    unit = LockstepUnit(21, scenario="alpine_climb")
    names = ("spindle_torque_nm", "rider_reserve_j", "t_s")
    seen = [unit.unit.observe(names)]
    while seen[-1]["t_s"] < 900.0:
        unit.advance(0.01)
        seen.append(unit.unit.observe(names))

    # A stroke of 55 Nm, 80 % up and down twice a turn, changes by up to 6 Nm in 10 ms.
    tired = [(now, after) for now, after in pairwise(seen) if after["t_s"] > 400.0]
    jumps = [abs(after["spindle_torque_nm"] - now["spindle_torque_nm"]) for now, after in tired]
    assert min(after["rider_reserve_j"] for _, after in tired) < 0.25 * 12_000
    assert sum(jump > 15.0 for jump in jumps) <= 2


def test_a_reserve_comes_back_below_the_critical_power() -> None:
    bike = Bike()
    rider = bike.config.rider
    rider.critical_power_w, rider.reserve_j = 200.0, 10_000.0
    bike.place(0.0)
    bike.state.rider.reserve_j = 5_000.0

    bike.rider(0.0, RIDER_LEGS)
    bike.advance(10.0)

    # (CP - P)(1 - W/W'): 200 W times one half to begin with.
    assert bike.state.rider.reserve_j == pytest.approx(5_000 + 10 * 100, rel=0.02)


def test_a_tyre_pushes_with_no_more_than_its_grip() -> None:
    bike = Bike()
    bike.config.road.grip = 0.1
    bike.config.motor.torque_nm_max = 2.0
    bike.rider(60.0)

    bike.advance(0.5, 2.0)

    pushed_n = 0.1 * 0.6 * 100 * G
    rolling_n = 0.00864 * 100 * G
    front_and_rider_kg = 100 + 0.12 / 0.33**2
    expected_ms = 0.5 * (pushed_n - rolling_n) / front_and_rider_kg
    assert bike.state.slipping
    assert bike.state.speed_ms == pytest.approx(expected_ms, rel=0.03)
    assert bike.state.wheel_speed_ms > 3 * bike.state.speed_ms


def test_a_slipping_wheel_grips_again_and_the_heat_is_booked() -> None:
    bike = Bike()
    bike.config.road.grip = 0.1
    bike.rider(60.0)
    bike.advance(0.5, 1.5)

    bike.rider(2.0)
    bike.advance(5.0, 0.0)

    assert not bike.state.slipping
    assert bike.state.wheel_speed_ms == bike.state.speed_ms
    assert bike.state.ledger.slip_j > 10.0
    assert bike.balance_error_pct <= 1.0


@pytest.mark.parametrize(("grip", "force_n"), [(0.0, 250.0), (0.8, 250.0), (0.16, 0.16 * 100 * G)])
def test_brakes_hold_with_no_more_than_both_tyres_do(grip: float, force_n: float) -> None:
    bike = Bike(20.0)
    bike.config.road.grip = grip
    bike.config.road.drag_area_m2 = bike.config.road.rolling_coefficient = 0.0
    bike.rider(0.0, RIDER_OFF)
    bike.command.road.brake = 1

    bike.advance(1.0)

    moving_kg = 100 + 0.24 / 0.33**2
    assert 20.0 / 3.6 - bike.state.speed_ms == pytest.approx(force_n / moving_kg, rel=0.005)
    assert bike.state.ledger.brake_j == pytest.approx(force_n * bike.state.distance_m)


def test_brakes_on_a_slope_hold_with_what_presses_on_it() -> None:
    bike = Bike(10.0)
    bike.config.road.grip = 0.2
    bike.command.road.brake = 1
    bike.command.road.grade_deg = -15.0
    bike.rider(0.0, RIDER_OFF)

    bike.advance(5.0)

    # tan 15 degrees is more than 0.2: it slides.
    assert bike.speed_kmh > 12.0


def test_a_dry_road_never_slips() -> None:
    gripping, ideal = Bike(), Bike()
    gripping.config.road.grip = 0.8

    for bike in (gripping, ideal):
        bike.rider(80.0)
        bike.advance(5.0, 2.0)

    assert gripping.state.speed_ms == ideal.state.speed_ms


def test_the_lift_of_15_degrees_loads_the_roller_as_the_hill_does() -> None:
    bench = on_a_bench()
    bench.command.road.grade_deg = 15.0
    needed_nm = 100 * G * math.sin(math.radians(15)) * 0.33 * 44 / 14 / 0.97

    bench.rider(needed_nm - 1.0)
    bench.advance(1.0)
    below = bench.speed_kmh
    bench.rider(needed_nm + 1.0)
    bench.advance(1.0)

    assert below == 0.0
    assert bench.speed_kmh > 0.0


def test_the_dynamometer_cannot_drive_a_descent() -> None:
    bench = on_a_bench()
    bench.command.road.grade_deg = -8.0

    bench.advance(5.0)

    assert bench.speed_kmh == 0.0


def test_flywheel_and_rollers_weigh_33_kg_at_the_tyre() -> None:
    bench = on_a_bench()
    bench.rider(30.0)

    bench.advance(2.0)

    # F = T eta / (i_1 r); wheels 0.24 kg m2, cranks and nothing else turn along.
    moving_kg = 33.3 + 0.24 / 0.33**2 + 0.97 * 0.02 / (0.33 * 44 / 14) ** 2
    expected_ms = 2.0 * 30.0 * 0.97 / (44 / 14 * 0.33) / moving_kg
    assert bench.state.speed_ms == pytest.approx(expected_ms, rel=0.01)


def test_drags_cost_their_torque_and_are_booked() -> None:
    plain, dragging = Bike(), Bike()
    dragging.config.drivetrain.gear_drag_nm = 0.015
    dragging.config.drivetrain.chain_drag_nm = 0.1
    dragging.config.motor.hysteresis_nm = 0.01

    for bike in (plain, dragging):
        bike.rider(24.48)
        bike.advance(10.0, 0.6)

    # 0.015 Nm through 40.34 and 92 %, and 0.1 Nm at the chainring, of some 47 Nm.
    lost = 1 - dragging.speed_kmh / plain.speed_kmh
    assert lost == pytest.approx((0.015 * 40.34 * 0.92 + 0.1 / 0.97) / 38.0, rel=0.35)
    assert dragging.balance_error_pct <= 1.0
    assert dragging.state.ledger.gear_j > plain.state.ledger.gear_j


def test_the_printed_equation_is_labelled_and_its_books_do_not_close() -> None:
    bike = Bike()
    bike.config.drivetrain.literal_4_14 = 1
    bike.rider(24.48)

    bike.advance(10.0, 0.6)

    assert not lib.physics_is_energy_consistent(bike.config)
    assert bike.balance_error_pct > 100.0
    assert lib.physics_is_energy_consistent(Bike().config)
