"""Goal: the law turns a reading into torque by the calibration and the sensor's temperature.

Method: the formula of SPEC 2.3 with a pencil, for whoever asks the law, and a simulated bike whose
sensor as drawn is as warm as the air (thesis_checks 6: zero 0.02 Nm/K, span 0.02 %/K).
"""

from typing import Any

import numpy as np
import pytest

from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import LawRefused, assist_run, rider_torque_nm
from sim_device.lockstep import LockstepUnit

CALIBRATED = {
    "sensor_offset_counts": 100.0,
    "sensor_gain_nm_per_count": 0.01,
    "sensor_offset_counts_per_k": 2.0,
    "sensor_gain_share_per_k": -5e-4,
    "sensor_reference_degc": 20.0,
}


@pytest.mark.parametrize(
    ("changes", "degc", "torque_nm"),
    [
        ({}, 20.0, 40.0),
        # 10 K warmer: 20 counts off, then half a per cent less for each of the others.
        ({}, 30.0, (4000 - 20) * 0.01 * 0.995),
        ({}, -10.0, (4000 + 60) * 0.01 * 1.015),
        ({"sensor_offset_counts_per_k": None}, 30.0, 4000 * 0.01 * 0.995),
        ({"sensor_gain_share_per_k": None}, 30.0, (4000 - 20) * 0.01),
        ({"sensor_reference_degc": None}, 30.0, 40.0),
        ({}, np.nan, 40.0),
        # A thermometer that says so is broken.
        ({}, 221.0, 40.0),
        ({}, np.inf, 40.0),
    ],
)
def test_a_reading_is_corrected_by_what_is_known(
    changes: dict[str, Any], degc: float, torque_nm: float
) -> None:
    config = {**default_config(), **CALIBRATED, **changes}

    (alone,) = rider_torque_nm(config, [4100.0], degc)
    ridden = assist_run(
        config,
        {
            "torque_raw_counts": [4100.0],
            "sensor_temperature_degc": degc,
            "speed_kmh": 10.0,
            "cadence_rpm": 60.0,
            "motor_speed_rpm": 2420.0,
            "battery_voltage_v": 36.0,
            "mode": 1,
            "brake": 0,
        },
    )["rider_torque_nm"]

    assert alone == pytest.approx(torque_nm, rel=1e-6)
    assert ridden[0] == alone


def test_a_correction_that_could_turn_the_torque_round_is_refused() -> None:
    config = {**default_config(), **CALIBRATED, "sensor_gain_share_per_k": 0.006}

    with pytest.raises(LawRefused):
        rider_torque_nm(config, [4100.0], 20.0)


@pytest.mark.parametrize("ambient_degc", [-5.0, 40.0])
def test_a_new_unit_knows_how_its_sensor_drifts(ambient_degc: float) -> None:
    unit = LockstepUnit(3, bike={"sensor.ambient_degc": ambient_degc})
    # The standing leg holds the pedal down, and the brake the bike.
    unit.brake(True)
    unit.rider("constant", 40.0)
    unit.advance(1.0)

    seen = unit.observe()

    warmer_k = ambient_degc - 20.0
    as_it_came = 4000 * (1 + 2e-4 * warmer_k) + 2 * warmer_k
    assert seen["torque_raw_counts"] == pytest.approx(as_it_came, abs=2.0)
    assert seen["rider_torque_nm"] == pytest.approx(40.0, abs=0.03)
