"""Goal: a simulated bike can have a worn or broken torque sensor, and it shows as such a one does.

Method: a servo pushes on cranks that the brake holds, for a unit made of each state; figures are
the states' own (scenarios/calibration.toml), the pedal's place is the physics' angle.
"""

from math import pi

import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol._generated import FaultFlags
from sim_device import sensor_state
from sim_device.lockstep import LockstepUnit

WORD_S = 0.002
LEFT_FORWARD_RAD, RIGHT_FORWARD_RAD = pi / 2, 3 * pi / 2


class Sensor:
    """The physics' sensor alone, without noise."""

    def __init__(self, state: str) -> None:
        bike = ffi.new("physics_config *")
        lib.physics_default(bike)
        self.config = bike.sensor
        self._bike = bike
        for path, value in sensor_state.state_of(state).bike.items():
            setattr(self.config, path.removeprefix("sensor."), value)
        self.config.noise_nm = 0.0
        self.state = ffi.new("torque_sensor_state *")
        lib.torque_sensor_reset(ffi.addressof(self._bike, "sensor"), self.state)

    def counts(self, torque_nm: float, angle_rad: float, after_s: float = WORD_S) -> int:
        config = ffi.addressof(self._bike, "sensor")
        return int(lib.torque_sensor_read(config, self.state, torque_nm, angle_rad, 0, after_s))


def pushed(state: str, torque_nm: float, seconds: float = 2.0) -> LockstepUnit:
    unit = LockstepUnit(5, sensor=state)
    unit.brake(True)
    unit.rider("constant", torque_nm)
    unit.advance(seconds)
    return unit


def test_the_left_pedal_of_an_asymmetric_sensor_is_felt_six_per_cent_more() -> None:
    left = Sensor("asymmetric").counts(50.0, LEFT_FORWARD_RAD)
    right = Sensor("asymmetric").counts(50.0, RIGHT_FORWARD_RAD)

    assert (left, right) == (pytest.approx(5150, abs=1), pytest.approx(4850, abs=1))


def test_a_bent_spindle_shows_where_the_crank_is_not_level() -> None:
    level, above, below = (
        Sensor("bent").counts(50.0, LEFT_FORWARD_RAD + turn) for turn in (0.0, -pi / 6, pi / 6)
    )

    assert level == pytest.approx(5000, abs=1)
    # 6 % of 50 Nm, times the sine of 30 degrees.
    assert (above, below) == (pytest.approx(5150, abs=1), pytest.approx(4850, abs=1))


def test_a_sticky_sensor_creeps_and_does_not_come_back_at_once() -> None:
    sensor = Sensor("sticky")
    at_once = sensor.counts(80.0, LEFT_FORWARD_RAD)
    for _ in range(60):
        later = sensor.counts(80.0, LEFT_FORWARD_RAD, 5.0)
    unloaded = sensor.counts(0.0, LEFT_FORWARD_RAD)

    assert later - at_once == pytest.approx(0.03 * 8000, rel=0.05)
    assert unloaded > 100


def test_a_drifted_sensor_has_another_zero_and_another_gain() -> None:
    sensor = Sensor("drifted")

    zero = sensor.counts(0.0, LEFT_FORWARD_RAD)
    pushed_counts = sensor.counts(50.0, LEFT_FORWARD_RAD)

    assert (zero, pushed_counts) == (180, pytest.approx(180 + 0.94 * 5000, abs=1))


@pytest.mark.parametrize("state", sensor_state.names())
def test_every_state_is_one_of_a_unit(state: str) -> None:
    unit = pushed(state, 40.0)

    seen = unit.observe()

    if state == "open_arm":
        assert seen["fault_flags"] & FaultFlags.TORQUE_SENSOR
    elif state == "stuck_bridge":
        assert seen["torque_raw_counts"] == 0
    else:
        assert seen["torque_raw_counts"] == pytest.approx(4000, abs=400)


def test_a_worn_sensor_stays_worn_in_another_scenario() -> None:
    unit = LockstepUnit(5, sensor="drifted", scenario="commute")
    unit.simulation_set({"scenario": "hill_start", "running": False})
    unit.simulation_set({"rider": {"kind": "off"}, "brake": True})

    unit.advance(2.0)

    assert unit.observe()["torque_raw_counts"] == pytest.approx(180, abs=30)
