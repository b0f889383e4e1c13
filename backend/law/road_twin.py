"""The road of a recorded ride, over the distance instead of the time.

The force that held the bike is what the drive did, less what the speed took, over one turn of the
crank; the air is separated by a prior, because one ride cannot tell it from the wind.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from backend.errors import InvalidRequest
from backend.law.recorded_ride import STANDING_MS, Bools, Floats, Recorded, braking_at, reach_of
from sim_device.firmware.python.twin import Road

SPACING_M = 0.05
BRAKE_MS2 = 2.3
UNBRAKED_MS = 0.2
"""Nobody brakes for this much more than the recorded speed."""
AIR_DENSITY_KG_M3 = 1.2
CHAIN_EFFICIENCY = 0.97


@dataclass(frozen=True, slots=True)
class Assumed:
    """What a ride does not tell, and what stands for it."""

    mass_kg: float = 92.0
    drag_area_m2: float = 0.5
    gear_efficiency: float = 0.92


@dataclass(frozen=True, slots=True)
class Forces:
    """What the road's force is made of at each place, (m,): the drive's part by the rider and by
    the motor (before its gears), N, and what a kilogram took to go faster, N/kg."""

    rider_n: Floats
    motor_n: Floats
    inertia_n_per_kg: Floats
    speed_ms: Floats

    def holding_n(self, assumed: Assumed) -> Floats:
        """Grade, rolling and mean wind together, (m,)."""
        drive_n = self.rider_n + assumed.gear_efficiency * self.motor_n
        return (
            CHAIN_EFFICIENCY * drive_n
            - assumed.mass_kg * self.inertia_n_per_kg
            - air(assumed) * self.speed_ms**2
        )


def forces_of(
    ride: Recorded, config: Mapping[str, Any], reach_m: Floats, places: Floats, broken: Bools
) -> Forces:
    """Over one turn of the crank around each place, because the stroke is no hill. No window
    reaches into a place that is broken; those are bridged."""
    width = round(2.0 * np.pi * float(np.median(reach_m)) / SPACING_M)
    moving = ride.speed_ms > 0.1

    def over_a_turn(force_n: Floats) -> Floats:
        work_j = np.where(moving, force_n * ride.speed_ms, 0.0) * ride.step_s
        summed_j = np.concatenate(([0.0], np.cumsum(work_j)[:-1]))
        return rise(by_place(ride.distance_m, summed_j, places), broken, width)

    speed_ms = by_place(ride.distance_m, ride.speed_ms, places)
    return Forces(
        rider_n=over_a_turn(ride.rider_nm / reach_m),
        motor_n=over_a_turn(ride.motor_nm * config["gear_ratio"] / reach_m),
        inertia_n_per_kg=rise(0.5 * speed_ms**2, broken, width),
        speed_ms=speed_ms,
    )


def rise(values: Floats, broken: Bools, width: int) -> Floats:
    """Rise of the values a metre, over `width` places around each, (m,); bridged where broken.

    Raises InvalidRequest where nothing is whole.
    """
    half = max(width // 2, 1)
    slope = np.full(values.size, np.nan)
    if values.size > 2 * half:
        slope[half:-half] = (values[2 * half :] - values[: -2 * half]) / (2 * half * SPACING_M)
        before = np.concatenate(([0], np.cumsum(broken)))
        slope[half:-half][before[2 * half + 1 :] > before[: -2 * half - 1]] = np.nan
    valid = np.flatnonzero(np.isfinite(slope))
    if valid.size == 0:
        raise InvalidRequest(
            "This ride cannot be ridden again: it has not one turn of the crank without a brake or"
            " a stop.",
            "too_short",
        )
    return np.asarray(np.interp(np.arange(slope.size), valid, slope[valid]))


def road_of(ride: Recorded, config: Mapping[str, Any]) -> tuple[Road, Forces]:
    """The ride over its distance, but for the force, which rests on what is assumed."""
    reach_m = reach_of(ride)
    places = np.arange(0.0, ride.distance_m[-1], SPACING_M)
    # Of several samples at one place the last: there the bike was moving off again.
    latest = np.maximum(np.searchsorted(ride.distance_m, places, side="right") - 1, 0)
    turning = np.clip(ride.crank_rad_s * reach_m / np.maximum(ride.speed_ms, 0.1), 0.0, 1.0)
    braking = braking_at(ride)[latest]
    standing_s = standing_times(ride, places)
    forces = forces_of(ride, config, reach_m, places, braking | (standing_s > 0.0))
    road = Road(
        spacing_m=SPACING_M,
        force_n=np.zeros(places.size),
        rider_nm=ride.rider_nm[latest],
        speed_ms=forces.speed_ms,
        ceiling_ms=ceiling(forces.speed_ms, braking, standing_s),
        stand_s=standing_s,
        reach_m=reach_m[latest],
        crank_share=turning[latest],
        motor_degc=ride.motor_degc[latest],
        controller_degc=ride.controller_degc[latest],
        mode=ride.mode[latest],
        braking=braking.astype(np.uint8),
    )
    return road, forces


def air(assumed: Assumed) -> float:
    """1/2 rho CdA, N s2/m2."""
    return 0.5 * AIR_DENSITY_KG_M3 * assumed.drag_area_m2


def by_place(distance_m: Floats, values: Floats, places: Floats) -> Floats:
    """Values at the places, the last of several samples at one place."""
    moved = np.append(np.diff(distance_m) > 0.0, True)
    return np.asarray(np.interp(places, distance_m[moved], values[moved]))


def standing_times(ride: Recorded, places: Floats) -> Floats:
    """Seconds the bike stands at each place, (m,)."""
    still = ride.speed_ms < STANDING_MS
    seconds = np.zeros(places.size)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], still.astype(np.int8), [0]))))
    for start, stop in edges.reshape(-1, 2):
        at = min(int(ride.distance_m[start] / SPACING_M), places.size - 1)
        seconds[at if stop < still.size else -1] += (stop - start) * ride.step_s
    return seconds


def ceiling(speed_ms: Floats, braking: Bools, standing_s: Floats) -> Floats:
    """The speed above which the rider brakes, m/s (m,): as recorded where he did, 0 where he
    stopped, and before it what a brake takes away on the way there."""
    limit = np.where(braking, speed_ms, np.inf)
    limit[standing_s > 0.0] = 0.0
    squared = limit**2
    room = 2.0 * BRAKE_MS2 * SPACING_M
    steps = np.arange(squared.size) * room
    # Backwards: at most what the brake leaves of every later limit. Who braked harder may again.
    swept = np.minimum.accumulate((squared + steps)[::-1])[::-1] - steps
    as_before = np.where(braking | (standing_s > 0.0), 0.0, speed_ms + UNBRAKED_MS)
    return np.asarray(np.maximum(np.sqrt(np.maximum(swept, 0.0)), as_before))
