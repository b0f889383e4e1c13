"""Goal: the torque sensor errs as a strain gauge on a steel spindle errs, and its word undoes most.

Method: the chain alone, against numbers worked out from thesis eq. 3.4 and thesis_checks 6.
"""

from typing import Any

import numpy as np
import pytest
from sim_device.firmware.python._native import ffi, lib

COUNTS_PER_NM = 100
OPEN_HIGH, STUCK, DRIFTING = 2, 1, 4
WORD_S = 0.002


class Sensor:
    def __init__(self, seed: int = 1, **changes: float) -> None:
        bike = ffi.new("physics_config *")
        lib.physics_default(bike)
        self.config: Any = ffi.new("torque_sensor_config *", bike.sensor)
        for name, value in changes.items():
            setattr(self.config, name, value)
        self.state: Any = ffi.new("torque_sensor_state *")
        lib.torque_sensor_reset(self.config, self.state)
        self.state.random = seed

    def read_nm(self, torque_nm: float, after_s: float = WORD_S, fault: int = 0) -> float:
        counts = lib.torque_sensor_read(self.config, self.state, torque_nm, 0.0, fault, after_s)
        return counts / COUNTS_PER_NM


def test_100_nm_strain_the_spindle_by_462_millionths() -> None:
    sensor = Sensor(poisson_ratio=0.3)

    v_per_nm = lib.torque_sensor_v_per_nm(sensor.config)

    # thesis_checks 6: D 20, d 12 mm, 3.05 mV at the bridge from 3.3 V.
    bridge_mv = 1e3 * 100 * v_per_nm / sensor.config.amplifier_gain
    assert bridge_mv == pytest.approx(3.05, rel=0.01)
    assert bridge_mv / 3.3 / 2.0 * 1000 == pytest.approx(462, rel=0.01)


@pytest.mark.parametrize(("bits", "step_nm"), [(12, 0.062), (16, 0.0039)])
def test_the_converter_sees_steps_of_its_width(bits: int, step_nm: float) -> None:
    sensor = Sensor(adc_bits=bits, nm_per_count=0.0005)

    readings = {
        lib.torque_sensor_read(sensor.config, sensor.state, torque_nm, 0.0, 0, WORD_S) * 0.0005
        for torque_nm in np.arange(5.0, 6.0, 0.0005)
    }

    assert np.diff(sorted(readings)).mean() == pytest.approx(step_nm, rel=0.02)


def test_at_the_temperature_of_its_calibration_a_sensor_as_drawn_is_true() -> None:
    sensor = Sensor()

    for torque_nm in (-5.0, 0.0, 24.48, 100.0, 220.0):
        assert sensor.read_nm(torque_nm) == pytest.approx(torque_nm, abs=0.011)


def test_a_gauge_factor_one_percent_high_is_one_percent_of_gain() -> None:
    assert Sensor(gauge_factor=2.02).read_nm(100.0) == pytest.approx(101.0, abs=0.02)


def test_50_kelvin_cost_one_newton_metre_of_zero_and_one_percent_of_span() -> None:
    sensor = Sensor(ambient_degc=70.0)

    assert sensor.read_nm(0.0) == pytest.approx(1.0, abs=0.02)
    assert sensor.read_nm(100.0) - sensor.read_nm(0.0) == pytest.approx(101.0, abs=0.03)


def test_the_gauges_follow_a_cold_morning_only_in_minutes() -> None:
    sensor = Sensor()
    sensor.config.ambient_degc = -5.0

    for _ in range(60):
        sensor.read_nm(0.0, after_s=1.0)
    lag_k = sensor.state.gauge_degc - sensor.state.board_degc
    for _ in range(1800):
        sensor.read_nm(0.0, after_s=1.0)

    assert lag_k > 10.0
    assert sensor.state.gauge_degc == pytest.approx(-5.0, abs=0.1)
    assert sensor.read_nm(0.0) == pytest.approx(-0.5, abs=0.02)


def test_noise_has_the_width_it_is_given_and_its_seed() -> None:
    noisy = [Sensor(7, noise_nm=0.06).read_nm(40.0) for _ in range(2)]
    readings = Sensor(7, noise_nm=0.06)

    values = np.array([readings.read_nm(40.0) for _ in range(5000)])

    assert noisy[0] == noisy[1]
    assert values.std() == pytest.approx(0.06, rel=0.05)
    assert values.mean() == pytest.approx(40.0, abs=0.01)


def test_unloading_reads_higher_than_loading_by_the_loop() -> None:
    sensor = Sensor(hysteresis_nm=0.2)

    up = [sensor.read_nm(torque_nm) for torque_nm in range(0, 101, 10)]
    down = [sensor.read_nm(torque_nm) for torque_nm in range(100, -1, -10)][::-1]

    loop_nm = np.array(down) - np.array(up)
    assert loop_nm.max() == pytest.approx(0.2, abs=0.02)
    assert (loop_nm[:-1] > 0.0).all()


def test_a_held_load_creeps_by_its_share() -> None:
    sensor = Sensor(creep_share=5e-4)

    first = sensor.read_nm(100.0)
    for _ in range(600):
        last = sensor.read_nm(100.0, after_s=1.0)

    assert last - first == pytest.approx(0.05, abs=0.011)


def test_a_broken_arm_a_stuck_word_and_a_drift_look_as_such() -> None:
    sensor = Sensor(fault_drift_nm_per_min=3.0)

    assert sensor.read_nm(20.0, fault=OPEN_HIGH) == 327.67
    sensor.read_nm(20.0)
    assert sensor.read_nm(60.0, fault=STUCK) == pytest.approx(20.0, abs=0.02)
    for _ in range(60):
        drifted = sensor.read_nm(20.0, after_s=1.0, fault=DRIFTING)
    assert drifted == pytest.approx(23.0, abs=0.1)


def test_a_converter_at_its_end_says_so_with_the_end_of_the_word() -> None:
    assert Sensor().read_nm(260.0) == 327.67
    assert Sensor().read_nm(-30.0) == -327.67
