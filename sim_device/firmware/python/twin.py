"""Rides a recorded road again, by the unit's own law: the door to sim_device/twin.

Lengths in m, speeds in m/s, torques in Nm: rider's at the crank, motor's at its shaft.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from sim_device.firmware.python import law
from sim_device.firmware.python._native import ffi, lib

Floats = npt.NDArray[np.float64]
INTEGERS = ("mode", "braking")

SAMPLE_DTYPE: Final = np.dtype(
    [
        ("t_s", np.float64),
        ("distance_m", np.float64),
        ("speed_ms", np.float64),
        ("rider_nm", np.float64),
        ("motor_nm", np.float64),
        ("limit_flags", np.uint16),
    ],
    align=True,
)
assert SAMPLE_DTYPE.itemsize == ffi.sizeof("twin_sample"), law.OTHER_SOURCES


@dataclass(frozen=True, slots=True)
class Road:
    """A recorded ride over the distance, (n,) each at equal spacing; see twin.h."""

    spacing_m: float
    force_n: Floats
    rider_nm: Floats
    speed_ms: Floats
    ceiling_ms: Floats
    stand_s: Floats
    reach_m: Floats
    crank_share: Floats
    motor_degc: Floats
    controller_degc: Floats
    mode: npt.NDArray[np.uint8]
    braking: npt.NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Bike:
    """What moves the bike and what feeds it; units and formulas in twin.h."""

    mass_kg: float
    air_n_s2_per_m2: float
    chain_efficiency: float
    gear_efficiency: float
    open_v: float
    sag_v_per_j: float
    resistance_ohm: float
    loss_w_per_rad2: float
    power_share: float
    loss_w_per_nm2: float
    idle_w: float


@dataclass(frozen=True, slots=True)
class Rider:
    """How the rider answers another speed, 0 to 1 each; see twin.h."""

    power_share: float
    hold_share: float
    cadence_share: float = 0.0


@dataclass(frozen=True, slots=True)
class Totals:
    """What a ride came to, as in twin.h. gave_up: it stood where the recorded ride did not, or took
    too long. limit_s: by the registry's names."""

    duration_s: float
    motor_work_j: float
    battery_j: float
    rider_work_j: float
    moving_s: float
    ripple_nm2_per_s: float
    crawling_s: float
    gave_up: bool
    limit_s: dict[str, float]


class Twin:
    """One recorded road and bike, to be ridden as often as one likes."""

    def __init__(self, road: Road, bike: Bike, longest_s: float) -> None:
        """longest_s: a ride that takes longer is given up."""
        names = [field.name for field in fields(Road) if field.name != "spacing_m"]
        kinds = {name: np.uint8 if name in INTEGERS else np.float64 for name in names}
        arrays = {name: np.ascontiguousarray(getattr(road, name), kinds[name]) for name in names}
        self._kept = [
            ffi.from_buffer("uint8_t[]" if name in INTEGERS else "double[]", array)
            for name, array in arrays.items()
        ]
        count = road.force_n.size
        if count < 2 or any(array.shape != (count,) for array in arrays.values()):
            raise ValueError(f"a road needs vectors of one length, 2 and more; it has {count}")
        views = dict(zip(names, self._kept, strict=True))
        self._road = ffi.new("twin_road *", {"spacing_m": road.spacing_m, "count": count, **views})
        self._bike = ffi.new("twin_bike *", {f.name: getattr(bike, f.name) for f in fields(Bike)})
        self._longest_s = longest_s

    def ride(
        self, config: Mapping[str, Any], rider: Rider, sample_steps: int = 0
    ) -> tuple[Totals, npt.NDArray[np.void]]:
        """One ride. config: the unit's parameters by registry name. sample_steps: a sample every so
        many control steps, 0 for none -> SAMPLE_DTYPE (k,). Raises LawRefused."""
        native = law.native_config(config)
        steps = max(sample_steps, 1)
        room = int(self._longest_s / law.STEP_S / steps) + 2 if sample_steps else 0
        samples = np.empty(room, SAMPLE_DTYPE)
        totals = ffi.new("twin_ride_totals *")
        lib.twin_ride(
            self._road,
            self._bike,
            ffi.new("twin_rider *", [rider.power_share, rider.hold_share, rider.cadence_share]),
            native,
            self._longest_s,
            steps,
            ffi.cast("twin_sample *", ffi.from_buffer(samples, require_writable=True)),
            room,
            totals,
        )
        told = {field.name: getattr(totals, field.name) for field in fields(Totals)}
        told["gave_up"] = bool(totals.gave_up)
        told["limit_s"] = {
            name: totals.limit_s[flag.bit_length() - 1] for name, flag in law.LIMITS.items()
        }
        return Totals(**told), samples[: totals.samples]
