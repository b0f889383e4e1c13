"""What is not there although it should be: rows that were lost, sensors that fell silent."""

from __future__ import annotations

import numpy as np

from backend.core._generated import MOVING_KMH
from backend.views.diagnosis.finding import NOTE, SERIOUS, WARNING, Evidence, Finding, Span

SPEED, AGE = "speed_kmh", "torque_age_ms"
SENSORS = ("rider_torque_nm", "rider_power_w", "cadence_rpm", SPEED, "heart_rate_bpm")
LOST_ROWS, LOST_S = 3, 0.5
"""A hole of less is one late word: half a second is the stroke of one leg at 60 rpm."""
LOST_M = 100.0
"""Of way that the odometer gained in a gap nobody paused for."""
AGE_MS = 250.0
"""The unit's own criterion for TORQUE_LINK: no good word for a quarter of a second."""
WARNING_SHARE, SERIOUS_SHARE = 0.01, 0.10
"""Of the ride: a hundredth moves a mean by as much; a tenth makes its figures another ride's."""


def drop_outs(ride: Evidence) -> list[Finding]:
    """Rows lost while the bike moved, and each sensor that fell silent and came back."""
    whole_s = float(ride.end_s[-1] - ride.start_s[0])
    found = []
    lost = [gap for gap in ride.gaps if gap[1] - gap[0] >= LOST_S and rolled(ride, gap)]
    if lost:
        found.append(finding("rows_lost", lost, whole_s, None))
    for name in SENSORS:
        if name in ride.derived or not ride.has(name):
            continue
        holes = sensor_holes(ride, name)
        if holes:
            found.append(finding("sensor_silent", holes, whole_s, name))
    if ride.has(AGE):
        old = [ride.time(rows) for rows in ride.spans(ride.values[AGE] > AGE_MS)]
        if old:
            found.append(finding("torque_late", old, whole_s, AGE))
    return found


def rolled(ride: Evidence, gap: Span) -> bool:
    """Whether the bike went on in a gap: no pause that the device knows, and it moved."""
    middle = (gap[0] + gap[1]) / 2.0
    if any(begin - 1.0 <= middle <= end + 1.0 for begin, end in ride.paused):
        return False
    before = int(np.searchsorted(ride.start_s, gap[0] + 1e-6)) - 1
    after = min(int(np.searchsorted(ride.start_s, gap[1] - 1e-6)), len(ride.start_s) - 1)
    odometer = ride.values.get("distance_m")
    if odometer is not None and np.isfinite(odometer[[before, after]]).all():
        return bool(odometer[after] - odometer[before] >= min(LOST_M, 2.0 * (gap[1] - gap[0])))
    speed = ride.values.get(SPEED)
    if speed is None:
        return True
    known = speed[max(before - 1, 0) : before + 1]
    return bool(np.nanmax(np.append(known, 0.0)) > MOVING_KMH)


def sensor_holes(ride: Evidence, name: str) -> list[Span]:
    """Where a channel is missing between its first sample and its last, while others are there."""
    there = np.isfinite(ride.values[name])
    known = np.flatnonzero(there)
    others = np.zeros(len(there), np.bool_)
    for other in SENSORS:
        if other != name and other in ride.values:
            others |= np.isfinite(ride.values[other])
    hole = ~there & others
    hole[: known[0]] = hole[known[-1] :] = False
    return [
        ride.time(rows)
        for rows in ride.spans(hole)
        if rows.stop - rows.start >= LOST_ROWS and np.ptp(ride.time(rows)) >= LOST_S
    ]


def finding(kind: str, spans: list[Span], whole_s: float, channel: str | None) -> Finding:
    """All of one kind as one finding; it shows the longest."""
    seconds = sum(end - begin for begin, end in spans)
    begin, end = max(spans, key=lambda span: span[1] - span[0])
    share = seconds / max(whole_s, 1e-9)
    severity = WARNING if share >= WARNING_SHARE else NOTE
    numbers = {
        "times": float(len(spans)),
        "seconds": seconds,
        "seconds_longest": end - begin,
        "share": share,
    }
    severity = SERIOUS if share >= SERIOUS_SHARE else severity
    return Finding(kind, severity, begin, end, numbers, channel)
