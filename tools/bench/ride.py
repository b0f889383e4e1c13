"""A two hour ride at 100 Hz with what makes real ones hard to compress.

Two strokes a turn with unequal legs and five percent stroke noise, stops, a wandering slope and
speed, and white noise on every analogue channel of the size the sensors have (thesis_checks 6).
"""

from functools import cache

import numpy as np

HZ = 100
SAMPLES = 2 * 3600 * HZ
GEAR_RATIO = 40.34
WHEEL_TURNS_PER_CRANK_TURN = 44 / 14
WHEEL_RADIUS_M = 0.33


def wander(random: np.random.Generator, time_constant_s: float) -> np.ndarray:
    """A slow random walk of unit variance: white noise through a first-order low-pass."""
    share = 1 / (time_constant_s * HZ)
    steps = SAMPLES // HZ
    state, values = 0.0, np.empty(steps)
    noise = random.standard_normal(steps)
    slow = share * HZ
    for index in range(steps):
        state += slow * (-state) + np.sqrt(2 * slow) * noise[index]
        values[index] = state
    return np.interp(np.arange(SAMPLES) / HZ, np.arange(steps), values)


@cache
def two_hours(seed: int = 7) -> dict[str, np.ndarray]:
    """Twelve channels by registry name, float64 (720000,), in the registry's units."""
    random = np.random.default_rng(seed)
    pedalling = np.repeat(random.random(SAMPLES // (20 * HZ)) > 0.12, 20 * HZ).astype(float)
    pedalling = np.convolve(pedalling, np.ones(HZ) / HZ, "same")
    speed = np.clip(19 + 4 * wander(random, 60), 3, 40) * (0.15 + 0.85 * pedalling)
    crank_rpm = speed / 3.6 / WHEEL_RADIUS_M / WHEEL_TURNS_PER_CRANK_TURN * 60 / (2 * np.pi)
    cadence = crank_rpm * (pedalling > 0.5)
    angle = np.cumsum(cadence * 6 / HZ) % 360
    strength = np.clip(28 + 9 * wander(random, 25), 4, 90) * pedalling
    legs = np.abs(np.sin(np.radians(angle))) ** 1.6 * np.where(angle < 180, 1.08, 0.92)
    torque = 1.7 * strength * legs * (1 + 0.05 * wander(random, 0.5))
    torque += random.normal(0, 0.06, SAMPLES)
    filtered = low_pass(torque, 0.5)
    motor_torque = np.clip(filtered * 1.25 / GEAR_RATIO, 0, 2) * (speed < 25)
    motor_rpm = cadence * GEAR_RATIO
    motor_w = motor_torque * motor_rpm * 2 * np.pi / 60
    voltage = 38 - np.linspace(0, 3, SAMPLES) + random.normal(0, 0.02, SAMPLES)
    current = motor_w / 0.85 / voltage + random.normal(0, 0.01, SAMPLES)
    return {
        "speed_kmh": speed + random.normal(0, 0.02, SAMPLES),
        "cadence_rpm": cadence,
        "crank_angle_deg": angle,
        "rider_torque_nm": torque,
        "rider_torque_filtered_nm": filtered,
        "motor_torque_nm": motor_torque,
        "motor_speed_rpm": motor_rpm,
        "battery_current_a": current,
        "battery_voltage_v": voltage,
        "battery_soc_pct": np.linspace(90, 60, SAMPLES),
        "fuzzy_gain": 0.3 - 0.008 * np.clip(speed - 5, 0, 20),
        "motor_temperature_degc": 40 + 8 * (1 - np.exp(-np.arange(SAMPLES) / HZ / 900)),
    }


def low_pass(values: np.ndarray, time_constant_s: float) -> np.ndarray:
    share = 1 / (1 + time_constant_s * HZ)
    kept, filtered = 0.0, np.empty_like(values)
    for index, value in enumerate(values):
        kept += share * (value - kept)
        filtered[index] = kept
    return filtered
