"""Goal: clutches pass torque forwards only, the motor stays inside its limits, energy is kept.

Method: physics alone, driven by hand. Limits are those of thesis_checks I-4, I-5 and A13.
"""

import math
import random
from itertools import pairwise

import pytest
from sim_device.firmware.python._native import ffi, lib

from tests.fakes.bike import RIDER_LEGS, RIDER_OFF, Bike

RPM_PER_RAD_S = 30 / math.pi
LOAD_DYNO = 1


def test_nothing_is_regenerated_when_the_bike_rolls_downhill() -> None:
    bike = Bike(20.0)
    bike.command.road.grade_deg = -8.0

    for _ in range(200):
        bike.advance(0.05)
        assert bike.state.battery.current_a == 0.0

    assert bike.speed_kmh > 40.0
    assert bike.state.battery.soc_pct == bike.config.battery.soc_pct_start
    assert not bike.state.motor_engaged


def test_the_motor_spins_down_by_its_own_friction_while_the_bike_rolls_on() -> None:
    bike = Bike(20.0)
    start_rad_s = bike.state.motor_speed_rad_s

    bike.advance(1.0)

    # J dw/dt = -B w: the motor alone, whatever the bike does.
    decay_s = bike.config.motor.inertia_kg_m2 / bike.config.motor.friction_nm_s
    expected_rad_s = start_rad_s * math.exp(-1.0 / decay_s)
    assert bike.state.motor_speed_rad_s == pytest.approx(expected_rad_s, rel=0.01)
    assert bike.speed_kmh > 19.0


def test_pedalling_backwards_moves_nothing_but_the_cranks() -> None:
    pedalling, coasting = Bike(20.0), Bike(20.0)
    coasting.rider(0.0, RIDER_OFF)
    pedalling.rider(-30.0)
    pedalling.command.rider.cadence_rpm_max = 60.0

    pedalling.advance(3.0)
    coasting.advance(3.0)

    assert pedalling.state.crank_speed_rad_s * RPM_PER_RAD_S == pytest.approx(-60.0, abs=5.0)
    assert pedalling.speed_kmh == coasting.speed_kmh
    assert pedalling.state.spindle_torque_nm == 0.0
    assert abs(pedalling.state.sensor.counts) <= 1


def test_a_motor_asked_for_torque_catches_up_within_a_twentieth_of_a_second() -> None:
    bike = Bike(0.0)
    bike.rider(60.0)
    bike.advance(4.0)
    assert bike.state.motor_speed_rad_s == 0.0

    bike.advance(0.05, 0.8)

    # J w / T is some 30 ms here (thesis_checks 6).
    assert bike.state.motor_engaged
    chainring_rad_s = bike.state.crank_speed_rad_s
    assert bike.state.motor_speed_rad_s == pytest.approx(40.34 * chainring_rad_s)


def test_a_rider_on_the_pedals_does_not_move_a_bike_held_by_its_friction() -> None:
    bike = Bike(0.0)
    bike.rider(25.0)
    bike.command.road.grade_deg = 15.0

    bike.advance(5.0)

    assert bike.speed_kmh == 0.0
    assert bike.state.spindle_torque_nm == pytest.approx(25.0)


def test_the_motor_keeps_every_limit_under_random_demands() -> None:
    demands = random.Random(13)
    bike = Bike(0.0)
    bike.rider(40.0, RIDER_LEGS)

    for _ in range(3000):
        bike.command.road.grade_deg = demands.uniform(-6.0, 6.0)
        bike.advance(0.02, demands.uniform(-1.0, 4.0))
        state = bike.state
        assert 0.0 <= state.motor_shaft_nm <= 2.0 + 1e-9
        assert state.battery.current_a >= 0.0
        if state.motor_speed_rad_s * RPM_PER_RAD_S > 3010.0:
            assert state.motor_shaft_nm == 0.0
    assert bike.balance_error_pct <= 1.0


def test_at_25_kmh_1_41_nm_take_432_w_and_a_bridge_gives_more_if_asked() -> None:
    taken_w = {}
    for demand_nm in (1.41, 2.0):
        bike = Bike(25.0)
        bike.rider(0.0, RIDER_OFF)
        bike.advance(0.02, demand_nm)
        assert bike.state.motor_shaft_nm == pytest.approx(demand_nm)
        taken_w[demand_nm] = bike.state.battery.voltage_v * bike.state.battery.current_a

    # thesis_checks I-5. What holds it is the firmware: test_battery_power.py.
    assert taken_w[1.41] == pytest.approx(432.0, rel=0.01)
    assert taken_w[2.0] > 600.0


def test_no_torque_comes_from_a_motor_above_3000_rpm() -> None:
    speed_kmh = 3100.0 / 2579.3 * 25.0
    bike = Bike(speed_kmh)

    motor = ffi.addressof(bike.config, "motor")
    rotor = {"speed_rad_s": bike.state.motor_speed_rad_s, "gain_rad_s_per_nm": 0.0}
    source = {"open_v": bike.state.battery.voltage_v, "resistance_ohm": 0.0}
    drive = lib.motor_drive_at(motor, 2.0, rotor, source, 20.0)

    assert drive.electromagnetic_torque_nm == 0.0


def test_the_books_close_through_clutches_brakes_and_hills() -> None:
    bike = Bike(0.0)

    bike.rider(40.0, RIDER_LEGS)
    bike.advance(10.0, 1.0)
    bike.command.road.grade_deg = -4.0
    bike.rider(0.0, RIDER_OFF)
    bike.advance(10.0, 0.0)
    bike.command.road.brake = 1
    bike.advance(10.0)

    ledger = bike.state.ledger
    assert bike.speed_kmh == 0.0
    assert ledger.clutch_j > 0.0
    assert ledger.brake_j > 1000.0
    assert bike.balance_error_pct <= 1.0


def test_a_leak_in_the_books_would_show() -> None:
    bike = Bike(0.0)
    bike.rider(40.0)
    bike.advance(10.0, 1.0)

    bike.state.ledger.air_j += 0.05 * bike.state.ledger.rider_work_j

    assert bike.balance_error_pct > 1.0


def on_a_flywheel(speed_kmh: float) -> Bike:
    """A bench whose flywheel keeps the speed whatever happens."""
    bike = Bike()
    bike.config.road.source = LOAD_DYNO
    bike.config.road.dyno_mass_kg = 1e9
    bike.place(speed_kmh)
    return bike


def test_two_strokes_a_turn_average_to_the_rider_torque() -> None:
    bike = on_a_flywheel(20.0)
    bike.rider(30.0, RIDER_LEGS)
    turn_s = 2 * math.pi / bike.state.crank_speed_rad_s
    torques = []

    for _ in range(round(turn_s / 0.001)):
        bike.advance(0.001)
        torques.append(bike.state.spindle_torque_nm)

    assert sum(torques) / len(torques) == pytest.approx(30.0, rel=0.01)
    assert max(torques) == pytest.approx(54.0, rel=0.01)
    assert min(torques) == pytest.approx(6.0, rel=0.01)
    # Left leg and right leg: two pushes in one turn.
    peaks = sum(1 for a, b in pairwise(torques) if a < 30.0 <= b)
    assert peaks == 2


def test_the_battery_sags_under_load_and_counts_its_charge() -> None:
    bike = on_a_flywheel(20.0)
    rest_v = bike.state.battery.voltage_v
    bike.rider(40.0)

    bike.advance(20.0, 1.0)

    battery = bike.state.battery
    sag_v = battery.current_a * bike.config.battery.resistance_ohm
    assert battery.current_a > 1.0
    # The RC pair of 40 s has come to 1 - exp(-20/40) of its voltage (thesis_checks 6).
    slow_v = battery.current_a * bike.config.battery.polarisation_ohm * (1 - math.exp(-0.5))
    assert battery.voltage_v == pytest.approx(rest_v - sag_v - slow_v, abs=0.06)
    drawn_wh = bike.state.ledger.motor_electric_j / 3600
    share_pct = 100 * drawn_wh / (bike.config.battery.capacity_ah * battery.voltage_v)
    fallen_pct = bike.config.battery.soc_pct_start - battery.soc_pct
    assert fallen_pct == pytest.approx(share_pct, rel=0.05)


def test_the_sensor_gives_hundredths_and_keeps_to_sixteen_bits() -> None:
    bike = Bike(0.0)
    bike.command.road.brake = 1

    for torque_nm, counts in ((24.484, 2448), (24.486, 2449), (500.0, 32767)):
        bike.rider(torque_nm)
        bike.config.road.brake_force_n = 1e6
        bike.advance(0.002)
        assert bike.state.sensor.counts == pytest.approx(counts, abs=1)
