"""Goal: motor and battery settle in one instant: no voltage of an earlier step is in a later one.

Method: the closed form, written down here once more: U i = (K w + R I) I and U = E - R_b i, and at
full duty I = (E - K w) / (R + R_b). Bikes on flywheels that keep their speed, packs that sag.
"""

import math
from itertools import pairwise
from typing import Any

import pytest

from sim_device.lockstep import LockstepUnit
from tests.fakes.bike import RIDER_OFF, Bike

LOAD_DYNO, MOTOR_FOC = 1, 1
K, R, FRICTION = 0.112, 0.25, 1.2e-4
RAD_S_PER_RPM = math.pi / 30


def worn(rpm: float, **changes: float) -> Bike:
    """A motor held at this speed by a flywheel, on a pack that is worn out."""
    bike = Bike()
    bike.config.road.source = LOAD_DYNO
    bike.config.road.dyno_mass_kg = 1e9
    bike.config.battery.resistance_ohm = 0.38
    bike.config.battery.polarisation_ohm = 0.0
    bike.config.battery.soc_pct_start = 9.0
    bike.config.motor.resistance_share_per_k = 0.0
    for name, value in changes.items():
        setattr(bike.config.motor, name, value)
    bike.place(rpm * RAD_S_PER_RPM / 40.34 * 44 / 14 * 0.33 * 3.6)
    bike.rider(0.0, RIDER_OFF)
    return bike


def steady(bike: Bike, demand_nm: float, steps: int = 400) -> list[Any]:
    """Battery volts and amperes of every millisecond, once the first twenty are over."""
    seen = []
    for _ in range(steps):
        bike.advance(0.001, demand_nm)
        seen.append((bike.state.battery.voltage_v, bike.state.battery.current_a))
    return seen[20:]


@pytest.mark.parametrize("model", [0, MOTOR_FOC], ids=["average", "foc"])
@pytest.mark.parametrize("rpm", [800.0, 2000.0, 2600.0])
@pytest.mark.parametrize("demand_nm", [0.4, 1.2, 2.0])
def test_nothing_swings_from_one_millisecond_to_the_next(
    model: int, rpm: float, demand_nm: float
) -> None:
    seen = steady(worn(rpm, model=model), demand_nm)

    assert max(abs(after[1] - before[1]) for before, after in pairwise(seen)) < 0.01
    assert max(abs(after[0] - before[0]) for before, after in pairwise(seen)) < 0.01


def test_at_full_duty_current_and_sag_are_those_of_one_circuit() -> None:
    rpm = 2300.0
    bike = worn(rpm)
    volts, amperes = steady(bike, 2.0)[0]

    # 34.2 V at 9 %, and 0.38 ohm times 1 + 6/15 below 15 %.
    open_v, pack_ohm = 10 * (3.30 + 4 / 5 * 0.15), 0.38 * (1 + 6 / 15)
    expected_a = (open_v - K * rpm * RAD_S_PER_RPM) / (R + pack_ohm)
    assert amperes == pytest.approx(expected_a, rel=0.005)
    assert volts == pytest.approx(open_v - pack_ohm * expected_a, rel=0.002)
    assert bike.state.motor_current_a == pytest.approx(amperes, rel=1e-3)


def test_below_full_duty_the_terminals_give_what_winding_and_shaft_take() -> None:
    rpm, demand_nm = 1200.0, 0.8
    rad_s = rpm * RAD_S_PER_RPM
    volts, amperes = steady(worn(rpm), demand_nm)[0]

    winding_a = (demand_nm + FRICTION * rad_s) / K
    taken_w = (K * rad_s + R * winding_a) * winding_a
    assert volts * amperes == pytest.approx(taken_w, rel=1e-3)
    assert volts > K * rad_s + R * winding_a


def test_a_free_motor_rises_to_its_last_speed_and_stays_there() -> None:
    bike = Bike(12.0)
    bike.rider(0.0, RIDER_OFF)
    # 0 Nm to begin with, and no chain that turns as fast as this motor can: it is held by nothing.
    bike.config.drivetrain.gear_ratio = 1000.0
    bike.advance(0.5, 1.0)

    seen = []
    for _ in range(200):
        bike.advance(0.001, 1.0)
        seen.append((bike.state.motor_speed_rad_s, bike.state.motor_current_a))

    # What friction takes at 3,000 r/min, at the end of a regulator that gives 2 Nm 100 r/min below.
    held_nm = FRICTION * 3000 * RAD_S_PER_RPM
    expected_rpm = 3000.0 - 100.0 * held_nm / 2.0
    assert [speed / RAD_S_PER_RPM for speed, _ in seen] == pytest.approx(
        [expected_rpm] * len(seen), rel=1e-3
    )
    assert [amperes for _, amperes in seen] == pytest.approx([held_nm / K] * len(seen), rel=0.01)


def test_the_worn_battery_s_ride_has_no_limit_cycle() -> None:
    unit = LockstepUnit(24, scenario="worn_battery")
    unit.advance(30.0)
    swings, before_a = 0, unit.observe()["battery_current_a"]

    for _ in range(60_000):
        unit.advance(0.001)
        now_a = unit.unit.observe(("battery_current_a",))["battery_current_a"]
        swings += abs(now_a - before_a) > 5.0
        before_a = now_a

    # The law sets a new torque every ten milliseconds: what it takes away at once is no swing.
    assert swings <= 5


@pytest.mark.parametrize("model", [0, MOTOR_FOC], ids=["average", "foc"])
def test_standby_and_switching_are_taken_at_the_terminals_and_booked(model: int) -> None:
    rpm, standby_a, share = 1800.0, 0.1, 0.01
    bike = worn(rpm, model=model, switching_share=share, standby_current_a=standby_a)
    idle_v, idle_a = steady(bike, 0.0, 40)[-1]
    before = {name: getattr(bike.state.ledger, name) for name in ("switching_j", "standby_j")}
    volts, amperes = steady(bike, 0.8, 1020)[-1]
    booked = bike.state.ledger

    # Electronics alone draw what they draw; 1.02 s under load are booked with both.
    assert idle_a == pytest.approx(standby_a)
    assert idle_v > volts
    phase_a = bike.state.motor_current_a
    assert booked.standby_j - before["standby_j"] == pytest.approx(
        volts * standby_a * 1.02, rel=0.01
    )
    switched_j = booked.switching_j - before["switching_j"]
    assert switched_j == pytest.approx(share * volts * phase_a * 1.02, rel=0.01)
    rad_s = rpm * RAD_S_PER_RPM
    winding_w = (K * rad_s + R * phase_a) * phase_a
    beside_w = volts * (standby_a + share * phase_a)
    assert volts * amperes == pytest.approx(winding_w + beside_w, rel=2e-3)


def test_at_full_duty_what_is_taken_beside_the_winding_sags_the_pack_as_well() -> None:
    rpm, standby_a, share = 2300.0, 0.5, 0.02
    bike = worn(rpm, switching_share=share, standby_current_a=standby_a)
    volts, amperes = steady(bike, 2.0)[0]

    # U = E - R_b (i_0 + (1 + s) I) and U = K w + R I.
    open_v, pack_ohm = 10 * (3.30 + 4 / 5 * 0.15), 0.38 * (1 + 6 / 15)
    back_emf_v = K * rpm * RAD_S_PER_RPM
    phase_a = (open_v - pack_ohm * standby_a - back_emf_v) / (R + (1 + share) * pack_ohm)
    assert bike.state.motor_current_a == pytest.approx(phase_a, rel=0.005)
    assert volts == pytest.approx(back_emf_v + R * phase_a, rel=0.002)
    assert amperes == pytest.approx(standby_a + (1 + share) * phase_a, rel=0.005)


def test_switching_warms_the_bridge() -> None:
    bikes = [worn(1800.0), worn(1800.0, switching_share=0.02)]
    for bike in bikes:
        bike.advance(20.0, 0.8)

    # 2 % of 33 V times some 7 A into 40 J/K for 20 s, little of which has left.
    cooler, warmer = (bike.state.heat.bridge_degc for bike in bikes)
    expected_k = 0.02 * 33.0 * bikes[1].state.motor_current_a * 20 / 40
    assert warmer - cooler == pytest.approx(expected_k, rel=0.15)
