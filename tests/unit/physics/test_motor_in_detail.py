"""Goal: the motor's detailed model and its average one are one machine; heat raises resistance.

Method: both in the same instant and on the same ride; closed forms of thesis_checks 6.
"""

import math
from typing import Any

import pytest
from sim_device.firmware.python._native import ffi, lib

from tests.fakes.bike import Bike

RAD_S_PER_RPM = math.pi / 30
STEP_S = 0.001
MOTOR_FOC = 1


def stiff(voltage_v: float) -> dict[str, float]:
    """A source that does not sag."""
    return {"open_v": voltage_v, "resistance_ohm": 0.0}


def turning(rad_s: float) -> dict[str, float]:
    """A rotor that the bike's inertia keeps at its speed."""
    return {"speed_rad_s": rad_s, "gain_rad_s_per_nm": 0.0}


def motor() -> Any:
    bike = ffi.new("physics_config *")
    lib.physics_default(bike)
    return ffi.new("motor_config *", bike.motor)


def settled(config: Any, demand_nm: float, rpm: float, voltage_v: float = 38.0) -> Any:
    """The detailed model after 50 ms at one speed."""
    state = ffi.new("motor_foc_state *")
    for _ in range(50):
        drive = lib.motor_foc_drive(
            config,
            state,
            demand_nm,
            turning(rpm * RAD_S_PER_RPM),
            stiff(voltage_v),
            20.0,
            STEP_S,
        )
    return drive


def test_clarke_and_park_there_and_back_give_the_same_currents() -> None:
    phases = {"a": 3.0, "b": -1.0, "c": -2.0}

    for angle_rad in (0.0, 0.7, 2.9, 6.0):
        rotor = lib.motor_foc_to_rotor(phases, angle_rad)
        back = lib.motor_foc_to_phases(rotor, angle_rad)
        assert (back.a, back.b, back.c) == pytest.approx((3.0, -1.0, -2.0))


def test_a_current_along_phase_a_is_all_d_at_angle_zero_and_all_q_a_quarter_later() -> None:
    along_a = {"a": 1.0, "b": -0.5, "c": -0.5}

    still = lib.motor_foc_to_rotor(along_a, 0.0)
    quarter = lib.motor_foc_to_rotor(along_a, -math.pi / 2)

    assert (still.d, still.q) == pytest.approx((1.0, 0.0))
    assert (quarter.d, quarter.q) == pytest.approx((0.0, 1.0), abs=1e-12)


@pytest.mark.parametrize("rpm", [100.0, 1000.0, 2000.0, 2579.3])
@pytest.mark.parametrize("demand_nm", [0.2, 0.6, 1.2])
def test_both_models_give_the_same_torque_for_the_same_losses(rpm: float, demand_nm: float) -> None:
    config = motor()

    average = lib.motor_drive_at(config, demand_nm, turning(rpm * RAD_S_PER_RPM), stiff(38.0), 20.0)
    detailed = settled(config, demand_nm, rpm)

    assert detailed.shaft_torque_nm == pytest.approx(average.shaft_torque_nm, rel=0.005)
    assert detailed.copper_loss_w == pytest.approx(average.copper_loss_w, rel=0.01)
    assert detailed.magnetic_w == pytest.approx(0.0, abs=0.05)


def test_the_torque_follows_a_step_within_a_few_milliseconds() -> None:
    config = motor()
    state = ffi.new("motor_foc_state *")
    torques = [
        lib.motor_foc_drive(
            config, state, 1.0, turning(100.0), stiff(38.0), 20.0, STEP_S
        ).shaft_torque_nm
        for _ in range(5)
    ]

    # 500 Hz of bandwidth: time constant 0.32 ms.
    assert 0.5 < torques[0] < 0.9
    assert torques[2] == pytest.approx(1.0, abs=0.02)


def test_the_voltage_circle_costs_the_detailed_model_some_torque_near_no_load_speed() -> None:
    config = motor()

    average = lib.motor_drive_at(config, 2.0, turning(2950 * RAD_S_PER_RPM), stiff(36.0), 20.0)
    detailed = settled(config, 2.0, 2950, voltage_v=36.0)

    # The inductance takes its part of the circle, which the average model does not know.
    assert 0.0 < detailed.electromagnetic_torque_nm <= average.electromagnetic_torque_nm
    assert detailed.electromagnetic_torque_nm == pytest.approx(
        average.electromagnetic_torque_nm, rel=0.25
    )


@pytest.mark.parametrize("rpm", [500.0, 1517.0, 2579.3])
@pytest.mark.parametrize("demand_nm", [0.3, 1.4])
def test_a_motor_that_is_switched_off_lets_go_within_a_millisecond_and_never_brakes(
    rpm: float, demand_nm: float
) -> None:
    config, state = motor(), ffi.new("motor_foc_state *")
    rad_s = rpm * RAD_S_PER_RPM
    for _ in range(50):
        lib.motor_foc_drive(config, state, demand_nm, turning(rad_s), stiff(38.0), 20.0, STEP_S)

    tail = [
        lib.motor_foc_drive(config, state, 0.0, turning(rad_s), stiff(38.0), 20.0, STEP_S)
        for _ in range(20)
    ]

    # 38 V / sqrt 3 against 0.15 mH: 14.6 A a period of 50 us, out of 15 A.
    assert 0.0 <= tail[0].electromagnetic_torque_nm < 0.05 * demand_nm
    assert all(drive.electromagnetic_torque_nm == 0.0 for drive in tail[1:])


def test_a_free_motor_above_the_voltage_does_not_brake_in_either_model() -> None:
    # 2900 r/min make 34 V between the phases of a motor on 31 V.
    for demand_nm in (0.0, 0.3):
        assert settled(motor(), demand_nm, 2900.0, voltage_v=31.0).electromagnetic_torque_nm == 0.0


def test_the_detailed_motor_s_shaft_shows_no_brake_at_a_cut_off() -> None:
    bike = Bike(22.0)
    bike.config.motor.model = MOTOR_FOC
    bike.rider(30.0)
    bike.advance(1.0, 0.05)

    shaft_nm = []
    for demand_nm in (0.05, 0.0):
        for _ in range(20):
            bike.advance(STEP_S, demand_nm)
            shaft_nm.append(bike.state.motor_shaft_nm)

    assert shaft_nm[19] == pytest.approx(0.05, abs=1e-3)
    assert min(shaft_nm) >= 0.0
    assert shaft_nm[21:] == [0.0] * 19


def test_the_books_of_a_ride_close_with_the_detailed_model_too() -> None:
    rides = []
    for model in (0, MOTOR_FOC):
        bike = Bike(0.0)
        bike.config.motor.model = model
        bike.rider(24.48)
        bike.advance(8.0, 0.6)
        bike.advance(1.0, 0.0)
        bike.advance(3.0, 0.9)
        rides.append(bike)
    average, detailed = rides

    assert detailed.balance_error_pct <= 1.0
    assert detailed.speed_kmh == pytest.approx(average.speed_kmh, rel=0.005)
    electric_j = average.state.ledger.motor_electric_j
    assert detailed.state.ledger.motor_electric_j == pytest.approx(electric_j, rel=0.01)


def test_a_hot_winding_has_the_resistance_of_hot_copper() -> None:
    config = motor()
    config.winding_share = 1.0

    assert lib.motor_resistance_ohm(config, 20.0) == pytest.approx(0.25)
    assert lib.motor_resistance_ohm(config, 120.0) == pytest.approx(0.25 * 1.393)


def test_two_newton_metres_held_warm_the_winding_as_two_nodes_do() -> None:
    config = motor()
    heat = ffi.new("motor_heat *")
    lib.motor_heat_reset(config, heat)

    for _ in range(95):
        lib.motor_heat_step(config, heat, 81.0 / 0.8, 0.0, 0.0, 1.0)

    # 80 J/K on 1.2 K/W and 700 J/K: the difference settles with 1.2 * 80 * 700 / 780 = 86 s.
    over_housing_k = heat.winding_degc - heat.housing_degc
    settled_k = 81.0 * 1.2 * 700 / 780
    assert over_housing_k == pytest.approx(settled_k * -math.expm1(-95 / 86), rel=0.03)
    for _ in range(20_000):
        lib.motor_heat_step(config, heat, 81.0 / 0.8, 0.0, 0.0, 1.0)
    assert heat.winding_degc == pytest.approx(20.0 + 81.0 * (1.2 + 1.8), rel=0.01)


@pytest.mark.parametrize(("rpm", "efficiency"), [(1517.0, 0.79), (2270.0, 0.866), (2569.0, 0.883)])
def test_the_loss_map_has_the_efficiencies_of_the_bus_limit(rpm: float, efficiency: float) -> None:
    rad_s, k, ohm = rpm * RAD_S_PER_RPM, 0.112, 0.25
    # i (i R + K w) = 432 W, less the friction's share.
    current_a = (math.sqrt((k * rad_s) ** 2 + 4 * ohm * 432.0) - k * rad_s) / (2 * ohm)
    demand_nm = min(k * current_a - 1.2e-4 * rad_s, 2.0)

    drive = lib.motor_drive_at(motor(), demand_nm, turning(rad_s), stiff(36.0), 20.0)

    # thesis_checks 6: replaces the thesis' constant 88 %.
    out_w = drive.shaft_torque_nm * rad_s
    in_w = drive.electromagnetic_torque_nm * rad_s + drive.copper_loss_w
    assert 400.0 < in_w <= 432.0 * 1.001
    assert out_w / in_w == pytest.approx(efficiency, abs=0.01)


def test_a_motor_without_its_hall_sensors_stands_still() -> None:
    bike = Bike(0.0)
    bike.rider(30.0)
    bike.command.faults.motor_hall = 1

    bike.advance(5.0, 1.0)

    assert bike.state.motor_shaft_nm == 0.0
    assert bike.state.ledger.motor_electric_j == 0.0
