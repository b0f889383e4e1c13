"""What the motor would have done: a recorded ride through the unit's own law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.energy import RADIANS_PER_S_PER_RPM, SECONDS_PER_HOUR
from backend.errors import InvalidRequest
from sim_device.firmware.python import law

BATTERY_VOLTAGE_V = 36.0
"""Nominal, for rides that did not record it."""
STEPS_MAX = 24 * 3600 * 100
"""A day at 100 Hz; bounds the memory of one replay."""

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Replay:
    """The law's answer, (n,) each, and its sums. NaN is missing.

    assist_ratio: gain included, before limits. limit_shares: part of the steps, 0 to 1, in which
    each limit of the registry held the motor back. motor_work_wh: at the motor's shaft.
    """

    rider_torque_filtered_nm: Floats
    torque_rate: Floats
    assist_ratio: Floats
    fuzzy_gain: Floats
    motor_torque_nm: Floats
    motor_torque_demanded_nm: Floats
    limit_flags: npt.NDArray[np.uint16]
    motor_torque_nm_max: float
    motor_work_wh: float
    limit_shares: dict[str, float]


SAMPLES = (
    "rider_torque_filtered_nm",
    "torque_rate",
    "assist_ratio",
    "fuzzy_gain",
    "motor_torque_nm",
    "motor_torque_demanded_nm",
    "limit_flags",
)
"""The fields of a replay with a value for each step."""


def replay(
    config: Mapping[str, Any],
    speed_kmh: npt.ArrayLike,
    cadence_rpm: npt.ArrayLike,
    torque_raw_counts: npt.ArrayLike,
    mode: npt.ArrayLike,
    *,
    brake: npt.ArrayLike = 0,
    walk_button: npt.ArrayLike = 0,
    inhibit: npt.ArrayLike = 0,
    torque_age_ms: npt.ArrayLike = 0,
    motor_speed_rpm: npt.ArrayLike | None = None,
    battery_voltage_v: npt.ArrayLike = BATTERY_VOLTAGE_V,
    battery_current_a: npt.ArrayLike = np.nan,
    motor_temperature_degc: npt.ArrayLike = np.nan,
    controller_temperature_degc: npt.ArrayLike = np.nan,
    sensor_temperature_degc: npt.ArrayLike = np.nan,
    step_s: float = law.STEP_S,
    first: int = 0,
) -> Replay:
    """A ride from rest through the law.

    config: the unit's parameters by registry name. speed_kmh, cadence_rpm, torque_raw_counts: (n,).
    mode: slot 0 to 4, (n,) or one. motor_speed_rpm: (n,); without it the motor follows the crank.
    battery_current_a, motor_temperature_degc: (n,); without them the law keeps the margin at the
    battery's limit that it keeps in a unit that cannot measure them. brake, walk_button, inhibit,
    torque_age_ms, controller_temperature_degc: (n,); without them nothing is pressed or faulty, the
    torque is fresh and the controller cool. sensor_temperature_degc: (n,); without it the counts
    are not corrected for temperature.
    step_s: time between samples. first: where the answer begins; the law remembers the samples
    before. A sample that is not finite gives no assist and is counted under
    `input_refused`. Raises InvalidRequest for what the law refuses.
    """
    if np.size(speed_kmh) > STEPS_MAX:
        raise InvalidRequest(f"a replay takes at most {STEPS_MAX} samples", "too_many_samples")
    try:
        columns: dict[str, npt.ArrayLike] = {
            "torque_raw_counts": torque_raw_counts,
            "speed_kmh": speed_kmh,
            "cadence_rpm": cadence_rpm,
            "battery_voltage_v": battery_voltage_v,
            "battery_current_a": battery_current_a,
            "motor_temperature_degc": motor_temperature_degc,
            "controller_temperature_degc": controller_temperature_degc,
            "sensor_temperature_degc": sensor_temperature_degc,
            "torque_age_ms": torque_age_ms,
            "mode": mode,
            "brake": brake,
            "walk_button": walk_button,
            "inhibit": inhibit,
        }
        if motor_speed_rpm is not None:
            columns["motor_speed_rpm"] = motor_speed_rpm
        inputs = law_readings(config, columns)
        motor_speed = np.asarray(inputs["motor_speed_rpm"], np.float32)
        outputs = law.assist_run(config, inputs, step_s)
        outputs = {name: values[first:] for name, values in outputs.items()}
    except (law.LawRefused, KeyError, TypeError, ValueError) as refused:
        raise InvalidRequest(f"replay: {refused}", "replay_refused") from refused
    return _summed(outputs, np.broadcast_to(motor_speed, np.shape(speed_kmh))[first:], step_s)


def joined(parts: Sequence[Replay]) -> Replay:
    """Replays one after the other as one."""
    if len(parts) == 1:
        return parts[0]
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in SAMPLES
    }
    return Replay(
        **columns,
        motor_torque_nm_max=max(part.motor_torque_nm_max for part in parts),
        motor_work_wh=sum(part.motor_work_wh for part in parts),
        limit_shares=limit_shares(columns["limit_flags"]),
    )


def law_readings(
    config: Mapping[str, Any], readings: Mapping[str, npt.ArrayLike]
) -> dict[str, npt.ArrayLike]:
    """The law's inputs of what is known, (n,) each or one value.

    readings: speed_kmh, cadence_rpm, mode, and torque_raw_counts or rider_torque_nm; what else is
    known by the names of `replay`, whose defaults stand for what is not.
    """
    complete = {"battery_voltage_v": BATTERY_VOLTAGE_V, "brake": 0, **readings}
    torque_nm = complete.pop("rider_torque_nm", None)
    if torque_nm is not None:
        complete.setdefault("torque_raw_counts", raw_counts_of(config, torque_nm))
    cadence = np.asarray(complete["cadence_rpm"], np.float32)
    follows = np.maximum(cadence, 0.0) * np.float32(config["gear_ratio"])
    return {**complete, "motor_speed_rpm": complete.get("motor_speed_rpm", follows)}


def raw_counts_of(config: Mapping[str, Any], torque_nm: npt.ArrayLike) -> Floats:
    """The raw counts that the unit's calibration turns into these torques, float32 (n,).

    For rides that recorded newton metres only. torque_nm: (n,).
    """
    counts = np.asarray(torque_nm, np.float64) / config["sensor_gain_nm_per_count"]
    return np.asarray(counts + config["sensor_offset_counts"], np.float32)


def limit_shares(limit_flags: npt.NDArray[np.uint16]) -> dict[str, float]:
    """Part of the samples, 0 to 1, in which each limit of the registry was at work. (n,)."""
    samples = max(limit_flags.size, 1)
    return {
        name: np.count_nonzero(limit_flags & flag) / samples for name, flag in law.LIMITS.items()
    }


def _summed(
    outputs: Mapping[str, npt.NDArray[Any]], motor_speed_rpm: Floats, step_s: float
) -> Replay:
    flags = outputs["limit_flags"]
    torque_nm = outputs["motor_torque_nm"]
    motor_rad_s = np.nan_to_num(motor_speed_rpm) * RADIANS_PER_S_PER_RPM
    power_w = torque_nm.astype(np.float64) * motor_rad_s
    samples: dict[str, Any] = {name: outputs[name] for name in SAMPLES}
    return Replay(
        **samples,
        motor_torque_nm_max=float(torque_nm.max(initial=0.0)),
        motor_work_wh=float(power_w.sum()) * step_s / SECONDS_PER_HOUR,
        limit_shares=limit_shares(flags),
    )
