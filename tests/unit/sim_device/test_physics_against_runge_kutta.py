"""Goal: the bike moves as the energy-consistent equation says, not as our C happens to.

Method: the equation of thesis_checks I-11, with both efficiencies on the drive terms, is written
here once more from the page, in plain numpy, and integrated by the classical fourth-order
Runge-Kutta method. Motor torque is torque at the shaft. The two engines share no code.
"""

from collections.abc import Callable

import numpy as np
import pytest

from tests.fakes.bike import Bike

MASS_KG, WHEELS_KG_M2, RADIUS_M = 100.0, 2 * 0.12, 0.33
ROLLING, DRAG_AREA_M2, AIR_KG_M3, GRAVITY_M_S2 = 0.00864, 0.40, 1.2, 9.80665
GEAR, CHAIN = 40.34, 44 / 14
GEAR_EFFICIENCY, CHAIN_EFFICIENCY = 0.92, 0.97
MOTOR_KG_M2, CRANK_KG_M2 = 1.4e-4, 0.02

Demand = Callable[[float], float]


def runge_kutta_kmh(
    rider_nm: float, demand: Demand, grade_deg: float, from_kmh: float, seconds: float
) -> float:
    """Speed after `seconds`; the motor is engaged wherever it is asked for torque."""
    slope = np.radians(grade_deg)
    hold_n = MASS_KG * GRAVITY_M_S2 * (np.sin(slope) + ROLLING * np.cos(slope))

    def acceleration(speed_ms: float) -> float:
        motor_nm = demand(speed_ms * 3.6)
        crank_nm = rider_nm + GEAR_EFFICIENCY * GEAR * motor_nm
        drive_n = CHAIN_EFFICIENCY * crank_nm / CHAIN / RADIUS_M
        air_n = 0.5 * AIR_KG_M3 * DRAG_AREA_M2 * speed_ms**2
        per_crank = CHAIN_EFFICIENCY * CRANK_KG_M2 / CHAIN**2
        per_motor = CHAIN_EFFICIENCY * GEAR_EFFICIENCY * MOTOR_KG_M2 * (GEAR / CHAIN) ** 2
        turning = WHEELS_KG_M2 + (rider_nm > 0) * per_crank + (motor_nm > 0) * per_motor
        return float((drive_n - hold_n - air_n) / (MASS_KG + turning / RADIUS_M**2))

    step_s, speed_ms = 0.01, from_kmh / 3.6
    for _ in range(round(seconds / step_s)):
        k1 = acceleration(speed_ms)
        k2 = acceleration(speed_ms + step_s / 2 * k1)
        k3 = acceleration(speed_ms + step_s / 2 * k2)
        k4 = acceleration(speed_ms + step_s * k3)
        speed_ms += step_s / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return speed_ms * 3.6


def tapered(rider_nm: float) -> Demand:
    """The fixed law of thesis 4.1 with the taper of I-13, as torque at the motor's shaft."""
    return lambda kmh: rider_nm / GEAR * min(1.0, max(0.0, (24.0 - kmh) / 9.0))


@pytest.mark.parametrize(
    ("rider_nm", "demand", "grade_deg", "from_kmh", "seconds"),
    [
        pytest.param(30.0, lambda _: 0.0, 0.0, 0.0, 20.0, id="rider alone from rest"),
        pytest.param(24.48, lambda _: 0.6, 0.0, 0.0, 15.0, id="constant motor torque"),
        pytest.param(24.48, tapered(24.48), 0.0, 0.0, 30.0, id="fixed law from rest"),
        pytest.param(49.17, tapered(49.17), 4.58, 25.0, 20.0, id="fixed law uphill"),
        pytest.param(0.0, lambda _: 0.0, -5.0, 10.0, 15.0, id="coasting downhill"),
    ],
)
def test_speed_agrees_with_an_independent_engine(
    rider_nm: float, demand: Demand, grade_deg: float, from_kmh: float, seconds: float
) -> None:
    bike = Bike(from_kmh)
    bike.rider(rider_nm)
    bike.command.road.grade_deg = grade_deg

    bike.advance(seconds, demand)

    expected_kmh = runge_kutta_kmh(rider_nm, demand, grade_deg, from_kmh, seconds)
    assert bike.speed_kmh == pytest.approx(expected_kmh, abs=0.02)


def test_wind_pushes_with_the_square_of_the_air_speed_and_its_sign() -> None:
    still, tail = Bike(18.0), Bike(18.0)
    tail.command.road.wind_ms = -10.0

    still.advance(1.0)
    tail.advance(1.0)

    # F = 1/2 rho C_w S v_r |v_r| (I-25): 5 m/s against still air, -5 m/s with 10 m/s from behind.
    difference_n = 2 * 0.5 * AIR_KG_M3 * DRAG_AREA_M2 * 5.0**2
    moving_kg = MASS_KG + WHEELS_KG_M2 / RADIUS_M**2
    gained_kmh = tail.speed_kmh - still.speed_kmh
    assert gained_kmh == pytest.approx(3.6 * difference_n / moving_kg, rel=0.03)
