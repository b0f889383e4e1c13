"""A two-hour ride at 100 Hz with one planted spike and one hole, written straight into a store."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext
from backend.store import open_store

ROWS = 720_000
SPIKE_ROW = 431_234  # one sample in two hours
SPIKE_NM = 95.0
HOLE_ROWS = slice(200_000, 230_000)  # five minutes without a sample
NAME = "Two hours with a spike"
STARTED_US = 1_760_000_000_000_000
CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("motor_torque_nm", "Nm", 0.0001),
    ChannelSpec("motor_speed_rpm", "rpm", 0.1),
    ChannelSpec("fuzzy_gain", "", 0.00005),
    ChannelSpec("motor_torque_demanded_nm", "Nm", 0.0001),
)


def rows() -> npt.NDArray[np.int16]:
    """Counts (ROWS, 7): legs on rolling ground, at most 60 Nm but for the spike."""
    t_s = np.arange(ROWS) / 100.0
    hills = np.sin(2 * np.pi * t_s / 900.0)
    cadence = 70.0 + 8.0 * np.sin(2 * np.pi * t_s / 240.0)
    mean_nm = 22.0 + 6.0 * hills
    torque = mean_nm * (1.0 - np.cos(4 * np.pi * np.cumsum(cadence) / 6000.0))
    values = {
        "speed_kmh": 21.0 - 4.0 * hills,
        "cadence_rpm": cadence,
        "rider_torque_nm": torque,
        "motor_torque_nm": 0.03 * mean_nm,
        "motor_speed_rpm": cadence * 40.34,
        "fuzzy_gain": 0.3 + 0.1 * hills,
        "motor_torque_demanded_nm": 0.033 * mean_nm,
    }
    counts = np.stack([np.rint(values[c.name] / c.scale) for c in CHANNELS], axis=1)
    counts = counts.astype(np.int16)
    counts[SPIKE_ROW, 2] = round(SPIKE_NM / 0.01)
    counts[HOLE_ROWS] = -32768
    return counts


def write_long_ride(data: Path) -> None:
    """Puts the ride on the shelf of a server that is not running yet."""
    counts = rows()
    with open_store(f"sqlite:///{data}/spindle.db", (data / "objects").as_uri()) as store:
        context = RideContext(gear_ratio=40.34)
        ride = store.rides.start_live(CHANNELS, 10_000, STARTED_US, context, NAME)
        for first in range(0, ROWS, 6000):
            store.rides.append_tail(ride, first, counts[first : first + 6000]).result()
        store.rides.finish(ride)
