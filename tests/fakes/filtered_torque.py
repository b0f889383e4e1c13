"""What the law makes of a rider's torque before it acts on it."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from sim_device.firmware.python.law import assist_run

Numbers = npt.NDArray[np.float64]


def filtered_nm(
    torque_nm: Numbers, cadence_rpm: npt.ArrayLike, config: Mapping[str, Any]
) -> Numbers:
    """The filtered torque in every control step, (n,).

    torque_nm: at the crank, (n,). cadence_rpm: (n,) or one. config: the unit's parameters.
    """
    ride = {
        "torque_raw_counts": torque_nm / config["sensor_gain_nm_per_count"],
        "speed_kmh": 12.0,
        "cadence_rpm": cadence_rpm,
        "motor_speed_rpm": 0.0,
        "battery_voltage_v": 36.0,
        "mode": 3,
        "brake": 0,
    }
    return np.asarray(assist_run(config, ride)["rider_torque_filtered_nm"], np.float64)
