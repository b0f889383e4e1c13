"""How far a ride went, row by row: by its odometer, else its speed, else its positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from backend.core.breaks import (
    DISTANCE,
    LATITUDE,
    LONGITUDE,
    Mask,
    is_ridden,
    long_steps,
    track_steps_m,
)
from backend.core.channels import Values
from backend.core.energy import KMH_PER_MS

SPEED = "speed_kmh"
DISTANCE_CHANNELS = (SPEED, DISTANCE, LATITUDE, LONGITUDE)
DistanceSource: TypeAlias = Literal["odometer", "speed", "positions"]


@dataclass(frozen=True)
class RowDistances:
    """Of rows (n,): metres since the start at each, and metres ridden while each held.

    gap: behind which rows one is. lost_m: distance that only the odometer knows, in gaps; it is in
    no row.
    """

    at_m: Values
    step_m: Values
    gap: Mask
    lost_m: float
    source: DistanceSource


def row_distances(
    columns: Mapping[str, Values], start_s: Values, seconds: Values
) -> RowDistances | None:
    """The distances of rows (n,); None where nothing says how far they went.

    columns: DISTANCE_CHANNELS as far as there are some, missing as NaN. start_s, seconds: when each
    row begins and how long it holds.
    """
    gap: Mask = np.diff(start_s, append=start_s[-1:]) > seconds + 1e-6
    odometer = columns.get(DISTANCE)
    if odometer is not None and np.isfinite(odometer).any():
        valid = np.flatnonzero(np.isfinite(odometer))
        last = valid[np.maximum(np.searchsorted(valid, np.arange(len(odometer)), "right") - 1, 0)]
        at_m = np.maximum.accumulate(odometer[last])
        step_m = np.diff(at_m, append=at_m[-1:])
        lost_m = float(step_m[gap].sum())
        return RowDistances(at_m - at_m[0], np.where(gap, 0.0, step_m), gap, lost_m, "odometer")
    speed = columns.get(SPEED)
    if speed is not None and np.isfinite(speed).any():
        step_m = np.where(np.isfinite(speed), speed, 0.0) / KMH_PER_MS * seconds
        return RowDistances(np.cumsum(step_m) - step_m, step_m, gap, 0.0, "speed")
    return distances_of_track(columns, start_s, gap)


def distances_of_track(
    columns: Mapping[str, Values], start_s: Values, gap: Mask
) -> RowDistances | None:
    """As `row_distances`, by the positions alone; None where no two of them follow each other."""
    if LATITUDE not in columns or LONGITUDE not in columns:
        return None
    latitude_deg, longitude_deg = columns[LATITUDE], columns[LONGITUDE]
    valid = np.flatnonzero(np.isfinite(latitude_deg) & np.isfinite(longitude_deg))
    if len(valid) < 2:
        return None
    times_us = np.rint(start_s[valid] * 1e6).astype(np.int64)
    track_m = track_steps_m(latitude_deg[valid], longitude_deg[valid])
    ridden = is_ridden(track_m, np.diff(times_us) / 1e6, long_steps(times_us))
    if not ridden.any():
        return None
    step_m = np.zeros(len(start_s))
    step_m[valid[:-1]] = np.where(ridden, track_m, 0.0)
    return RowDistances(np.cumsum(step_m) - step_m, step_m, gap, 0.0, "positions")
