"""Rides for the store's tests: an honest 12 channel ride at 100 Hz, and small ones."""

from __future__ import annotations

from itertools import accumulate

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext
from backend.store import Store

CHANNELS = tuple(
    ChannelSpec(name, unit, scale)
    for name, unit, scale in (
        ("speed_kmh", "km/h", 0.01),
        ("cadence_rpm", "rpm", 0.01),
        ("rider_torque_nm", "Nm", 0.01),
        ("rider_torque_raw", "counts", 1.0),
        ("rider_torque_filtered_nm", "Nm", 0.01),
        ("motor_torque_nm", "Nm", 0.0001),
        ("motor_current_a", "A", 0.001),
        ("motor_speed_rpm", "rpm", 0.1),
        ("battery_current_a", "A", 0.001),
        ("battery_voltage_v", "V", 0.002),
        ("fuzzy_gain", "", 0.00005),
        ("assist_mode", "", 1.0),
    )
)
PERIOD_US = 10_000
STARTED_US = 1_700_000_000_000_000
GEAR_RATIO = 40.34

Values = npt.NDArray[np.float64]
Rows16 = npt.NDArray[np.int16]


def wandering(rng: np.random.Generator, rows: int, time_constant_s: float, size: float) -> Values:
    """An Ornstein-Uhlenbeck walk: what slopes, wind and moods do to a ride."""
    keep = float(np.exp(-0.01 / time_constant_s))
    kicks = rng.normal(0.0, size * np.sqrt(1.0 - keep**2), rows)
    return np.fromiter(accumulate(kicks, lambda y, kick: keep * y + kick), float, rows)


def held(values: Values, every: int) -> Values:
    """A sensor that only has a new value every so many rows."""
    return np.repeat(values[::every], every)[: len(values)]


def honest_ride(rows: int, seed: int = 1) -> Rows16:
    """Counts int16 (rows, 12) of a commuter's ride with a mid-drive at 100 Hz.

    Two strokes a turn with a stronger leg; stops; a 12 bit torque sensor with one count of noise;
    speed from a wheel magnet and cadence from 24 poles, so both step as pulses come; currents and
    voltage with the ripple of a 10 bit converter. Nothing is smoothed to compress better.
    """
    rng = np.random.default_rng(seed)
    time_s = np.arange(rows) / 100.0
    speed = np.clip(20.0 + wandering(rng, rows, 30.0, 5.0), 3.0, 45.0)
    riding = np.minimum(1.0, np.abs((time_s % 300.0) - 10.0) / 10.0)
    speed *= np.where(time_s % 300.0 < 20.0, riding, 1.0)
    cadence = np.where(speed > 2.0, np.clip(70.0 + wandering(rng, rows, 20.0, 6.0), 20, 80), 0.0)
    angle = np.cumsum(cadence / 60.0 * 0.01) * 2.0 * np.pi
    stroke = np.abs(np.sin(angle)) ** 1.6 * (1.0 + 0.1 * np.sign(np.sin(angle)))
    effort = np.clip(35.0 + wandering(rng, rows, 15.0, 8.0), 5.0, 90.0)
    # 0.1 Nm per count: 12 bits over 400 Nm.
    raw = np.rint(1000.0 + stroke * effort * (cadence > 0) / 0.1 + rng.normal(0.0, 1.0, rows))
    torque = (raw - 1000.0) * 0.1
    filtered = np.convolve(torque, np.ones(50) / 50.0, "full")[:rows]
    gain = np.clip(0.35 - 0.01 * (held(speed, 16) - 15.0), 0.0, 0.5)
    motor = np.clip(filtered * gain / GEAR_RATIO, 0.0, 2.5)
    turns = cadence * GEAR_RATIO
    current = np.rint((motor / 0.065 + rng.normal(0.0, 0.02, rows)) / 0.032) * 0.032
    electrical = motor * turns * 2.0 * np.pi / 60.0 / 0.85 / 36.0
    battery = np.rint((electrical + 0.1 + rng.normal(0.0, 0.01, rows)) / 0.032) * 0.032
    voltage = np.rint((37.5 - 0.15 * battery - time_s / 3600.0) / 0.04) * 0.04
    columns = (
        held(speed, 16),
        held(cadence, 4),
        torque,
        raw,
        filtered,
        motor,
        current,
        held(turns, 2),
        battery,
        voltage,
        gain,
        np.full(rows, 2.0),
    )
    pairs = zip(CHANNELS, columns, strict=True)
    return np.stack([channel.to_counts(values) for channel, values in pairs], 1).astype(np.int16)


def recording(store: Store, rows: int = 300) -> int:
    """The id of a ride that is recorded and going on."""
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, RideContext())
    store.rides.append_tail(ride_id, 0, honest_ride(rows)).result()
    return ride_id
