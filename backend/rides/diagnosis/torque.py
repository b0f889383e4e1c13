"""The torque sensor: does its zero hold, and does it reach the end of its range."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core._generated import RESTING_KMH
from backend.core.channels import Values
from backend.core.energy import rate_hz
from backend.rides.diagnosis.finding import (
    SERIOUS,
    WARNING,
    DiagnosisFinding,
    Evidence,
    Mask,
    Severity,
)
from backend.rides.insight.crank import RATE_HZ_MIN

TORQUE, RAW, CADENCE, SPEED = "rider_torque_nm", "rider_torque_raw", "cadence_rpm", "speed_kmh"

# The unit's own criterion for its fault TORQUE_DRIFT (firmware/app/faults/signs.c): at rest and
# still within 0.3 Nm for 5 s; more than 3 Nm is a fault; above 8 Nm it is a foot.
STILL_S, STILL_NM, DRIFT_NM, FOOT_NM, REST_RPM = 5, 0.3, 3.0, 8.0, 1.0
ZERO_NM = 1.0
"""Cold moves the zero by about 1 Nm in 50 K; more than that over a whole ride is no weather."""
FULL_SCALE_COUNTS = 32767.0
"""What the converter's end reads, of either sign (physics/torque_sensor.h, faults/inputs.c)."""
FLAT_ROWS, FLAT_STROKES, FLAT_NM = 5, 3, 30.0
"""The greatest torque, held this long in so many strokes: legs make no flat top."""


@dataclass(frozen=True)
class Segment:
    """STILL_S without anybody pushing: when it begins, its torque, and by how much that moved."""

    begin_s: float
    torque_nm: float
    moved_nm: float

    @property
    def is_still(self) -> bool:
        return self.moved_nm <= STILL_NM

    @property
    def shows_zero(self) -> bool:
        return self.is_still and abs(self.torque_nm) <= FOOT_NM


def zero_drift(ride: Evidence) -> list[DiagnosisFinding] | None:
    """The zero at rest, from pieces of STILL_S without a foot on the pedals; None without any."""
    resting = np.abs(ride.values[SPEED]) < RESTING_KMH
    resting &= np.abs(ride.values[CADENCE]) < REST_RPM
    free = [segment for segment in unloaded_segments(ride, resting) if segment.shows_zero]
    if not free:
        return None
    at_s, zeros = [segment.begin_s for segment in free], [segment.torque_nm for segment in free]
    zero = np.array(zeros)
    third = max(len(zero) // 3, 1)
    typical = float(np.median(zero))
    moved = float(np.median(zero[-third:]) - np.median(zero[:third]))
    worst = int(np.argmax(np.abs(zero)))
    numbers = {
        "zero_nm": typical,
        "zero_nm_worst": zeros[worst],
        "moved_nm": moved,
        "rest_s": float(STILL_S * len(zeros)),
        "threshold_nm": ZERO_NM,
    }
    severity: Severity
    if abs(zeros[worst]) > DRIFT_NM:
        severity, numbers["threshold_nm"] = SERIOUS, DRIFT_NM
    elif max(abs(typical), abs(moved)) > ZERO_NM:
        severity = WARNING
    else:
        return []
    return [DiagnosisFinding("zero_drift", severity, at_s[worst], at_s[worst] + STILL_S, numbers)]


def unloaded_segments(ride: Evidence, unloaded: Mask) -> list[Segment]:
    """Pieces of STILL_S in which nobody should push (n,), also those in which somebody does."""
    torque = ride.values[TORQUE]
    return [
        Segment(begin_s, float(np.median(means)), float(np.ptp(means)))
        for rows in ride.spans(unloaded & np.isfinite(torque))
        for begin_s, means in full_segments(ride.start_s[rows], torque[rows])
    ]


def full_segments(start_s: Values, torque_nm: Values) -> list[tuple[float, Values]]:
    """Whole pieces of STILL_S of a rest (n,): when each begins, and its means of a second."""
    second = np.floor(start_s - start_s[0] + 1e-9).astype(np.intp)
    # The last second may not be whole, and the first still has the rider's foot leaving.
    count = int(second[-1])
    sums = np.bincount(second, torque_nm)
    rows = np.bincount(second)
    segments = []
    for begin in range(1, count - STILL_S + 1, STILL_S):
        within = slice(begin, begin + STILL_S)
        if np.all(rows[within] > 0):
            segments.append((float(start_s[0]) + begin, sums[within] / rows[within]))
    return segments


def saturation(ride: Evidence) -> list[DiagnosisFinding] | None:
    """Readings at the end of the converter, else flat tops; None where rows are too rare."""
    if ride.has(RAW):
        return at_the_end(ride)
    torque = ride.values[TORQUE]
    if (rate_hz(ride.seconds) or 0.0) < RATE_HZ_MIN:
        return None
    greatest = float(np.nanmax(torque))
    if greatest < FLAT_NM:
        return []
    tops = [rows for rows in ride.spans(torque == greatest) if rows.stop - rows.start >= FLAT_ROWS]
    if len(tops) < FLAT_STROKES:
        return []
    numbers = {"torque_nm": greatest, "strokes": float(len(tops))}
    return [DiagnosisFinding("saturation", WARNING, *ride.time(tops[0]), numbers, TORQUE)]


def at_the_end(ride: Evidence) -> list[DiagnosisFinding]:
    """Counts at the end of the converter's range."""
    raw = ride.values[RAW]
    ends = list(ride.spans(np.abs(raw) >= FULL_SCALE_COUNTS))
    if not ends:
        return []
    longest = max(ends, key=lambda rows: float(ride.seconds[rows].sum()))
    seconds = sum(float(ride.seconds[rows].sum()) for rows in ends)
    numbers = {"seconds": seconds, "times": float(len(ends)), "threshold_counts": FULL_SCALE_COUNTS}
    return [DiagnosisFinding("saturation", SERIOUS, *ride.time(longest), numbers, RAW)]
