"""The speed: can it be, and does the wheel's circumference agree with the positions."""

from __future__ import annotations

import numpy as np

from backend.core.channels import Values
from backend.core.distance import row_distances
from backend.core.energy import KMH_PER_MS, rate_hz
from backend.core.sphere import EARTH_M
from backend.core.statistics import MEDIAN_TO_MEAN, robust_deviation
from backend.rides.diagnosis.finding import WARNING, DiagnosisFinding, Evidence

SPEED, CADENCE, TORQUE, ODOMETER = "speed_kmh", "cadence_rpm", "rider_torque_nm", "distance_m"
LATITUDE, LONGITUDE = "latitude_deg", "longitude_deg"

JUMP_S, JUMP_MS2 = 0.5, 9.81
"""A tyre holds no more than about its weight (friction 1): over half a second, so that the steps of
a coarse reading do not count."""
SILENT_S, SILENT_RPM, SILENT_NM = 3.0, 30.0, 5.0
"""Cranks that are pushed round this long move a bike."""
CHORD_S, CHORD_KMH = 10.0, 10.0
STRAIGHT = 0.003
"""Two halves may be longer than the whole by this share: 9 degrees of a bend."""
WHEEL_M, WHEEL_CHORDS = 1000.0, 12
WHEEL_SHARE = 0.02
"""Two in a hundred: the difference of two tyres of one nominal size (ISO 5775: 40-622 has 2.224 m
by its outer diameter, some 2 % less under load)."""


def implausible_speed(ride: Evidence) -> list[DiagnosisFinding]:
    """Changes that no tyre can make, and a standing wheel under turning cranks."""
    speed = ride.values[SPEED]
    findings = []
    jumps, greatest = speed_jumps(ride, speed)
    if jumps:
        numbers = {
            "times": float(len(jumps)),
            "acceleration_ms2": greatest,
            "threshold_ms2": JUMP_MS2,
        }
        findings.append(DiagnosisFinding("speed_jump", WARNING, *jumps[0], numbers, SPEED))
    if ride.has(CADENCE, TORQUE):
        driven = (ride.values[CADENCE] > SILENT_RPM) & (ride.values[TORQUE] > SILENT_NM)
        still = driven_without_speed(ride, speed, driven)
        if still:
            begin, end = max(still, key=lambda span: span[1] - span[0])
            numbers = {
                "times": float(len(still)),
                "seconds": sum(stop - start for start, stop in still),
                "threshold_s": SILENT_S,
            }
            findings.append(DiagnosisFinding("speed_silent", WARNING, begin, end, numbers, SPEED))
    return findings


def speed_jumps(ride: Evidence, speed_kmh: Values) -> tuple[list[tuple[float, float]], float]:
    """Where the speed (n,) changed faster than JUMP_MS2, and the greatest change."""
    valid = np.flatnonzero(np.isfinite(speed_kmh))
    at_s, ms = ride.start_s[valid], speed_kmh[valid] / KMH_PER_MS
    later = np.searchsorted(at_s, at_s + JUMP_S - 1e-6)
    inside = later < len(at_s)
    first, later = np.flatnonzero(inside), later[inside]
    # Rows further apart than a pause of the recording are not judged.
    near = at_s[later] - at_s[first] <= 2.0 * max(JUMP_S, float(np.median(np.diff(at_s, append=0))))
    first, later = first[near], later[near]
    rate = np.abs(ms[later] - ms[first]) / np.maximum(at_s[later] - at_s[first], 1e-9)
    fast = np.flatnonzero(rate > JUMP_MS2)
    if not len(fast):
        return [], 0.0
    parts = np.split(fast, np.flatnonzero(np.diff(at_s[first[fast]]) > JUMP_S) + 1)
    spans = [(float(at_s[first[part[0]]]), float(at_s[later[part[-1]]])) for part in parts]
    return spans, float(rate.max())


def driven_without_speed(
    ride: Evidence, speed_kmh: Values, driven: np.ndarray[tuple[int], np.dtype[np.bool_]]
) -> list[tuple[float, float]]:
    """Where cranks are pushed round and the wheel stands; torque may rest within a stroke."""
    begun = np.convolve(driven, np.ones(window_rows(ride)), "same") > 0.0
    still = begun & (ride.values[CADENCE] > SILENT_RPM) & ~(speed_kmh > 0.0)
    spans = [ride.time(rows) for rows in ride.spans(still)]
    return [span for span in spans if span[1] - span[0] >= SILENT_S]


def window_rows(ride: Evidence) -> int:
    """Rows of a second."""
    return max(1, min(round(min(rate_hz(ride.seconds) or 1.0, 1000.0)), len(ride.start_s)))


def wheel(ride: Evidence) -> list[DiagnosisFinding] | None:
    """The way by the wheel against the way by positions, over straight stretches.

    A stretch takes CHORD_S and is straight where its halves are no longer than the whole. The
    spread of the stretches gives the error of their median. None with too few of them.
    """
    distances = row_distances(ride.values, ride.start_s, ride.seconds)
    if distances is None:
        return None
    has_position = np.isfinite(ride.values[LATITUDE]) & np.isfinite(ride.values[LONGITUDE])
    positioned = np.flatnonzero(has_position)
    picked = positioned[chord_ends(ride.start_s[positioned])]
    at_s, rolled_to_m = ride.start_s[picked], distances.at_m[picked]
    x_m, y_m = plane(ride.values[LATITUDE][picked], ride.values[LONGITUDE][picked])
    half_m = np.hypot(np.diff(x_m), np.diff(y_m))
    straight_m = np.hypot(x_m[2:] - x_m[:-2], y_m[2:] - y_m[:-2])
    rolled_m, duration_s = rolled_to_m[2:] - rolled_to_m[:-2], at_s[2:] - at_s[:-2]
    halves_m = half_m[:-1] + half_m[1:]
    good = (duration_s <= 2.0 * CHORD_S) & (
        rolled_m / np.maximum(duration_s, 1e-9) > CHORD_KMH / KMH_PER_MS
    )
    good &= halves_m <= straight_m * (1.0 + STRAIGHT)
    share = straight_m[good] / rolled_m[good]
    if len(share) < WHEEL_CHORDS or rolled_m[good].sum() < WHEEL_M:
        return None
    median = float(np.median(share))
    error = MEDIAN_TO_MEAN * robust_deviation(share) / len(share) ** 0.5
    if abs(median - 1.0) <= max(WHEEL_SHARE, 3.0 * error):
        return []
    numbers = {
        "positions_per_wheel": median,
        "error": error,
        "stretches": float(len(share)),
        "way_m": float(rolled_m[good].sum()),
        "threshold": WHEEL_SHARE,
    }
    if ride.limits.wheel_circumference_m is not None:
        numbers["wheel_circumference_m"] = ride.limits.wheel_circumference_m
        numbers["wheel_circumference_m_by_positions"] = ride.limits.wheel_circumference_m * median
    where = float(ride.start_s[0]), float(ride.end_s[-1])
    return [DiagnosisFinding("wheel", WARNING, *where, numbers)]


def chord_ends(at_s: Values) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """One row of each half chord."""
    _, first = np.unique((at_s // (CHORD_S / 2.0)).astype(np.int64), return_index=True)
    return np.asarray(first, np.intp)


def plane(latitude_deg: Values, longitude_deg: Values) -> tuple[Values, Values]:
    """Metres east and north of the first place; good to a part in a thousand within 100 km."""
    if not len(latitude_deg):
        return latitude_deg, longitude_deg
    north, east = np.radians(latitude_deg), np.radians(longitude_deg)
    x_m: Values = (east - east[0]) * np.cos(north) * EARTH_M
    y_m: Values = (north - north[0]) * EARTH_M
    return x_m, y_m
