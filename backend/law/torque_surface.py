"""What a mode's table gives over its whole grid, as motor, battery and market leave it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.errors import InvalidRequest
from backend.law.mode_curves import CADENCE_RPM
from backend.law.ride_replay import law_readings
from sim_device.firmware.python import law

POINTS_MAX = 64 * 64
"""A tenth of a second of C."""
SETTLED_STEPS = 60
"""For each point: what is left of a step from its neighbour is below 1 in 20, the mean of a minute
included, which the C lets run 300 times as fast; neighbours differ by little."""
WARM_STEPS = 2000
"""Before the first point: longer than the slowest torque filter."""
RAMPS = (
    "assist_ramp_up_nm_per_s",
    "assist_ramp_down_nm_per_s",
    "mode_ramp_up_nm_per_s",
    "mode_ramp_down_nm_per_s",
)

Config = Mapping[str, Any]
Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class TorqueSurface:
    """At the crank, (n, m) each, rows = speeds.

    demanded_nm: by the mode's law. delivered_nm: what is left of it after every limit.
    limit_flags: bits of the registry, of what limited it.
    """

    demanded_nm: Floats
    delivered_nm: Floats
    limit_flags: npt.NDArray[np.uint16]


def torque_surface(
    config: Config,
    mode: int,
    rider_torque_nm: float,
    speeds_kmh: npt.ArrayLike,
    torque_rates: npt.ArrayLike,
) -> TorqueSurface:
    """What a steady push gets for long in a mode, at CADENCE_RPM, the motor cool.

    config: the unit's parameters by registry name; its ramps are left out, because they end.
    speeds_kmh: (n,). torque_rates: (m,). Raises InvalidRequest for what the law refuses.
    """
    speeds = np.asarray(speeds_kmh, np.float32)
    rates = np.asarray(torque_rates, np.float32)
    if speeds.size * rates.size > POINTS_MAX:
        message = f"{speeds.size} speeds by {rates.size} torque rates are more than {POINTS_MAX}"
        raise InvalidRequest(f"{message} points; ask for a coarser grid", "too_many_points")
    # To and fro, so that each point is settled from one beside it.
    order = np.arange(speeds.size * rates.size).reshape(speeds.size, rates.size)
    order[1::2] = order[1::2, ::-1]
    path = order.ravel()
    readings: dict[str, npt.ArrayLike] = {
        "speed_kmh": np.repeat(speeds, rates.size)[path],
        "cadence_rpm": CADENCE_RPM,
        "rider_torque_nm": rider_torque_nm,
        "mode": mode,
    }
    try:
        rows = law.pack_inputs(law_readings(config, readings))
        one = law.AssistLaw({**config, **_no_ramps()})
        one.run(np.repeat(rows[:1], WARM_STEPS))
        outputs = one.settle(rows, np.tile(rates, speeds.size)[path], SETTLED_STEPS)
    except (law.LawRefused, KeyError, TypeError, ValueError) as refused:
        raise InvalidRequest(f"surface: {refused}", "surface_refused") from refused
    shaped = np.empty((speeds.size, rates.size), law.OUTPUT_DTYPE)
    shaped.ravel()[path] = outputs
    demanded = shaped["assist_ratio"] * shaped["rider_torque_filtered_nm"]
    return TorqueSurface(
        demanded_nm=np.asarray(demanded, np.float32),
        delivered_nm=np.asarray(shaped["motor_torque_nm"] * config["gear_ratio"], np.float32),
        limit_flags=shaped["limit_flags"],
    )


def _no_ramps() -> Config:
    """Ramps as steep as they can be set."""
    most = {name: law.parameter_range(name)[1] for name in RAMPS}
    return {
        name: [int(steepest)] * 5 if name.startswith("mode_") else steepest
        for name, steepest in most.items()
    }
