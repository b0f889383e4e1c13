"""Configurations that the unit takes, at every edge of what it takes, and readings at theirs.

Drawn from the registry's rows alone: a parameter that is added is drawn too. What comes out has
passed the host's check, which agrees with the unit's to the bit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from firmware_protocol._generated import PARAMETERS
from firmware_protocol.layout import Parameter, Value
from firmware_protocol.parameter_values import STEP_SHARE, choices_of, is_too_near
from firmware_protocol.parameters import default_config, violations
from sim_device.firmware.python.law import INPUT_DTYPE

DENORMAL = 1.4e-45
"""The smallest float32 above zero."""

EDGES = {
    "torque_raw_counts": [0.0, DENORMAL, -1.0, 100.0, 1500.0, 3000.0, 32766.0, -32766.0, 1e6, -1e6],
    "speed_kmh": [0.0, DENORMAL, 0.001, 5.999, 6.0, 14.7, 23.999, 24.0, 24.999, 25.0, 45.0, 1e6],
    "cadence_rpm": [0.0, DENORMAL, -DENORMAL, 1.0, 60.0, 120.0, -30.0, 1e6],
    "motor_speed_rpm": [0.0, DENORMAL, -DENORMAL, 1.0, 2270.0, 2999.999, 3000.0, -100.0, 1e6],
    "battery_voltage_v": [0.0, DENORMAL, 23.999, 24.0, 30.0, 30.001, 36.0, 42.0, -1e6, 1e6],
    "battery_current_a": [0.0, DENORMAL, 12.0, -5.0, 3e38, -3e38, math.inf, math.nan],
    "motor_temperature_degc": [-273.0, 20.0, 110.0, 129.999, 130.0, 3e38, math.inf, math.nan],
    "controller_temperature_degc": [-40.0, 85.0, 99.999, 100.0, -3e38, -math.inf, math.nan],
    "torque_age_ms": [0, 0, 0, 50, 51, 65535],
    "mode": [0, 1, 2, 3, 4, 5, 255],
    "brake": [0, 0, 0, 0, 1],
    "walk_button": [0, 0, 1],
    "inhibit": [0, 0, 0, 0, 1],
}
"""Values of each reading at which a step of the law turns, and those no sensor gives."""

RIDING = {
    "torque_raw_counts": 3000.0,
    "speed_kmh": 12.0,
    "cadence_rpm": 60.0,
    "motor_speed_rpm": 1500.0,
    "battery_voltage_v": 41.0,
    "battery_current_a": 4.0,
    "motor_temperature_degc": 60.0,
    "controller_temperature_degc": 40.0,
    "torque_age_ms": 2,
    "mode": 3,
    "brake": 0,
    "walk_button": 0,
    "inhibit": 0,
}
"""What most readings are most of the time, so that the edges of the others are met in motion."""


def points_of(row: Parameter, random: np.random.Generator) -> list[float]:
    """Increasing points: spread, as near as may be, or a step apart after rounding."""
    assert row.min is not None
    assert row.max is not None
    kind = random.integers(4)
    span = row.max - row.min
    if kind == 0:
        cuts = np.sort(random.uniform(row.min, row.max, row.count))
        return _raised(row, cuts)
    nearest = float(STEP_SHARE * np.float32(row.least_step))
    step = row.least_step if kind == 1 else nearest
    start = [row.min, row.min + DENORMAL, row.max - 4.001 * step][random.integers(3)]
    if kind == 3:
        start = row.min + random.uniform() * (span - 4.001 * step)
    return _raised(row, start + step * np.arange(row.count))


def _raised(row: Parameter, points: npt.ArrayLike) -> list[float]:
    """The points as float32, each moved up by floats until it is far enough above the last."""
    found: list[float] = []
    for point in np.asarray(points, np.float32):
        while found and is_too_near(found[-1], float(point), row.least_step):
            wanted = np.float32(found[-1]) + STEP_SHARE * np.float32(row.least_step)
            point = np.nextafter(max(point, wanted), np.float32(np.inf))
        found.append(float(point))
    return found


def value_of(row: Parameter, random: np.random.Generator) -> Value:
    """A value at an edge of its range, or anywhere within."""
    if row.type == "text":
        return _shaped(row, [""] * row.count)
    if row.enum is not None:
        names = choices_of(row)
        same = random.random() < 0.3
        chosen = [names[random.integers(len(names))] for _ in range(row.count)]
        return _shaped(row, chosen[:1] * row.count if same else chosen)
    if row.increasing:
        return list(points_of(row, random))
    return _shaped(row, [_number(row, random) for _ in range(row.count)])


def _number(row: Parameter, random: np.random.Generator) -> float | int:
    assert row.min is not None
    assert row.max is not None
    if row.type != "f32":
        low, high = int(row.min), int(row.max)
        return int([low, high, random.integers(low, high + 1)][random.integers(3)])
    low32, high32 = np.float32(row.min), np.float32(row.max)
    inside = np.float32(random.uniform(row.min, row.max))
    above, below = np.nextafter(low32, high32), np.nextafter(high32, low32)
    return float([low32, above, inside, inside, below, high32][random.integers(6)])


def _shaped(row: Parameter, elements: list[Any]) -> Value:
    for size in reversed(row.shape):
        elements = [elements[at : at + size] for at in range(0, len(elements), size)]
    value: Value = elements[0]
    return value


def accepted_config(random: np.random.Generator) -> dict[str, Value]:
    """A configuration of edges that has no violation. Some parameters keep their default."""
    while True:
        config = default_config()
        kept = random.uniform(0.0, 0.9)
        for row in PARAMETERS:
            if random.random() >= kept:
                config[row.name] = value_of(row, random)
        if not violations(config):
            return config


def readings(random: np.random.Generator, steps: int) -> npt.NDArray[np.void]:
    """INPUT_DTYPE (steps,): some readings as on a ride, the others jump from edge to edge.

    One in a hundred rows has a reading that is no number.
    """
    rows = np.empty(steps, INPUT_DTYPE)
    for name, edges in EDGES.items():
        if random.random() < 0.7:
            rows[name] = RIDING[name]
            continue
        places = random.integers(len(edges), size=steps)
        stays = random.random(steps) < random.choice([0.0, 0.7, 0.97])
        for index in range(1, steps):
            if stays[index]:
                places[index] = places[index - 1]
        rows[name] = np.array(edges)[places].astype(INPUT_DTYPE[name])
    for name in ("torque_raw_counts", "speed_kmh", "motor_speed_rpm", "battery_voltage_v"):
        broken = random.random(steps) < 0.0025
        rows[name][broken] = random.choice([math.nan, math.inf, -math.inf, 1.1e6])
    return rows
