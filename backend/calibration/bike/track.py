"""How far a track goes over the ground for each metre that a wheel told, from positions with noise.

The sum of the chords is no answer: 3 m of noise once a second make a ride at 20 km/h a quarter too
long. The mean square of the chords over one, two, three ... seconds tells noise, way and bends
apart, because they grow differently with the way s between two positions:

    mean chord^2 = 4 sigma^2 + k^2 mean s^2 - bends

Smooth bends take a share of s^4 (an arc), sharp corners one of s^3 (two straight lines). Real roads
have both: k is the mean of the two answers, and half of what they differ by is its limit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from backend.calibration.setup import ECCENTRICITY_SQUARED, SEMI_MAJOR_M
from backend.core.statistics import Numbers

CHORDS_MOST_M = 60.0
"""Longer, and bends decide; shorter, and noise does."""

LAGS_LEAST = 4
"""Of three unknowns."""

BLOCKS_MOST = 20
"""Of a ride; what they differ by tells the scatter, also of noise that lasts for minutes."""

BLOCKS_LEAST = 4

SMOOTH, SHARP = 4, 3


class Track(NamedTuple):
    """ratio: true metres a told metre. noise_m: of a position, in each direction. scatter: standard
    uncertainty of the ratio, of `freedom` degrees. bends_limit: half width."""

    ratio: float
    noise_m: float
    scatter: float
    freedom: int
    bends_limit: float


def track_of(
    latitude_deg: Sequence[float] | Numbers,
    longitude_deg: Sequence[float] | Numbers,
    wheel_m: Sequence[float] | Numbers,
) -> Track | None:
    """Positions (n,), one a second or slower, and the way (n,) that the wheel had told at each;
    None where there are too few to tell."""
    east_m, north_m = on_the_ground(np.asarray(latitude_deg), np.asarray(longitude_deg))
    wheel = np.asarray(wheel_m, np.float64)
    steps = np.diff(wheel)
    moving = steps[steps > 0]
    if not moving.size:
        return None
    lags = max(LAGS_LEAST, round(CHORDS_MOST_M / float(np.median(moving))))
    blocks = min(BLOCKS_MOST, wheel.size // (5 * lags))
    if blocks < BLOCKS_LEAST:
        return None
    smooth, sharp, noise_m = _ratios(east_m, north_m, wheel, lags)
    parts = [
        sum(_ratios(east_m[part], north_m[part], wheel[part], lags)[:2]) / 2
        for part in np.array_split(np.arange(wheel.size), blocks)
        if np.ptp(wheel[part]) > CHORDS_MOST_M
    ]
    if len(parts) < BLOCKS_LEAST:
        return None
    scatter = float(np.std(parts, ddof=1)) / math.sqrt(len(parts))
    return Track((smooth + sharp) / 2, noise_m, scatter, len(parts) - 1, abs(sharp - smooth) / 2)


def on_the_ground(latitude_deg: Numbers, longitude_deg: Numbers) -> tuple[Numbers, Numbers]:
    """Metres to the east and to the north of the first position, each (n,), along the ellipsoid of
    WGS 84: a sphere is off by up to half a percent."""
    middle = np.radians((latitude_deg[1:] + latitude_deg[:-1]) / 2)
    bulge = 1 - ECCENTRICITY_SQUARED * np.sin(middle) ** 2
    parallel_m = SEMI_MAJOR_M / np.sqrt(bulge) * np.cos(middle)
    meridian_m = SEMI_MAJOR_M * (1 - ECCENTRICITY_SQUARED) / bulge**1.5
    start = np.zeros(1)
    east: Numbers = np.concatenate(
        [start, np.cumsum(parallel_m * np.radians(np.diff(longitude_deg)))]
    )
    north: Numbers = np.concatenate(
        [start, np.cumsum(meridian_m * np.radians(np.diff(latitude_deg)))]
    )
    return east, north


def _ratios(
    east_m: Numbers, north_m: Numbers, wheel_m: Numbers, lags: int
) -> tuple[float, float, float]:
    """The ratio with smooth bends and with sharp ones, and the noise of a position in metres."""
    squares, ways = [], []
    for lag in range(1, lags + 1):
        wheel_chord_m = wheel_m[lag:] - wheel_m[:-lag]
        chord = (east_m[lag:] - east_m[:-lag]) ** 2 + (north_m[lag:] - north_m[:-lag]) ** 2
        squares.append(float(chord.mean()))
        ways.append([float((wheel_chord_m**power).mean()) for power in (0, 2, SHARP, SMOOTH)])
    matrix, squared = np.array(ways), np.array(squares)
    weight = 1 / np.sqrt(matrix[:, 1])
    ratios = {}
    for place, power in ((3, SMOOTH), (2, SHARP)):
        terms = matrix[:, [0, 1, place]] * weight[:, None]
        scale = terms.max(axis=0)
        values = np.linalg.lstsq(terms / scale, squared * weight, rcond=None)[0] / scale
        ratios[power] = values
    noise_m = math.sqrt(max(0.0, float(ratios[SMOOTH][0]) / 4))
    smooth, sharp = (math.sqrt(max(0.0, float(ratios[power][1]))) for power in (SMOOTH, SHARP))
    return smooth, sharp, noise_m
