"""Battery, heat and losses: does the supply break down under load, does heat take assist away, and
what is missing: rows that were lost, sensors that fell silent."""

from __future__ import annotations

import numpy as np

from backend.core._generated import MOVING_KMH
from backend.rides.diagnosis.finding import (
    NOTE,
    SERIOUS,
    WARNING,
    DiagnosisFinding,
    Evidence,
    FindingKind,
    Mask,
    Severity,
    Span,
)

VOLTAGE, CURRENT, FLAGS = "battery_voltage_v", "battery_current_a", "limit_flags"
MOTOR_HOT, CONTROLLER_HOT = "motor_temperature_degc", "controller_temperature_degc"

# The unit's own criteria (registry, BATTERY_LOW and UNDER_VOLTAGE): half a second below
# battery_voltage_v_min; and 3 V below it, and below 27 V.
LOW_S, UNDER_V, UNDER_V_MAX = 0.5, 3.0, 27.0
GAP_AFTER_S = 1.0
"""A recording that ends so soon after a low voltage ended with the supply."""
RESTING_A = 0.5
# Where the unit begins to lower the assist (registry, MOTOR_TEMPERATURE, CONTROLLER_TEMPERATURE).
HOT_DEGC = {MOTOR_HOT: 110.0, CONTROLLER_HOT: 85.0}
DERATED_SHARE = 0.05
"""Of the ride: from here on the rider feels it on every climb."""


def brown_out(ride: Evidence) -> list[DiagnosisFinding]:
    """Voltage below the least that the configuration allows, and rows that end with it."""
    voltage = ride.values[VOLTAGE]
    least_v = ride.limits.battery_voltage_v_min or 0.0
    low = voltage < least_v
    times = [ride.time(rows) for rows in ride.spans(low)]
    cut = [gap for gap in ride.gaps if any(0 <= gap[0] - end <= GAP_AFTER_S for _, end in times)]
    spans = [(begin, end) for begin, end in times if end - begin >= LOW_S]
    lowest = int(np.nanargmin(voltage))
    under = bool(voltage[lowest] < min(least_v - UNDER_V, UNDER_V_MAX))
    if not spans and not cut and not under:
        return []
    current = ride.values.get(CURRENT, np.full(len(voltage), np.nan))
    resting = voltage[np.abs(current) < RESTING_A]
    resting = resting[np.isfinite(resting)]
    numbers = {
        "voltage_v_min": float(voltage[lowest]),
        "threshold_v": least_v,
        "seconds": float(ride.seconds[low].sum()),
        "times": float(len(times)),
        "restarts": float(len(cut)),
    }
    if len(resting):
        numbers["resting_v"] = float(np.median(resting))
    if np.isfinite(current[lowest]):
        numbers["current_a"] = float(current[lowest])
    severity: Severity = SERIOUS if under or cut else WARNING
    at_s = ride.start_s[lowest]
    begin, end = max(spans or times, key=lambda span: span[1] - span[0], default=(at_s, at_s))
    return [DiagnosisFinding("brown_out", severity, float(begin), float(end), numbers, VOLTAGE)]


def derating(ride: Evidence) -> list[DiagnosisFinding]:
    """Time in which heat lowered the assist: as the unit told it, else by its temperatures."""
    hot = too_hot(ride)
    spans = list(ride.spans(hot))
    if not spans:
        return []
    seconds = float(ride.seconds[hot].sum())
    share = seconds / max(float(ride.seconds.sum()), 1e-9)
    longest = max(spans, key=lambda rows: float(ride.seconds[rows].sum()))
    numbers = {"seconds": seconds, "share": share, "times": float(len(spans))}
    for name, threshold in HOT_DEGC.items():
        if ride.has(name):
            numbers[f"{name}_max"] = float(np.nanmax(ride.values[name]))
            numbers[f"{name}_threshold"] = threshold
    severity: Severity = WARNING if share >= DERATED_SHARE else NOTE
    return [DiagnosisFinding("derating", severity, *ride.time(longest), numbers)]


def too_hot(ride: Evidence) -> Mask:
    """Rows (n,) in which heat holds the motor back."""
    if ride.has(FLAGS):
        flags = np.nan_to_num(ride.values[FLAGS]).astype(np.int64)
        limited: Mask = (flags & ride.limits.temperature) != 0
        return limited
    hot = np.zeros(len(ride.start_s), np.bool_)
    for name, threshold in HOT_DEGC.items():
        if name in ride.values:
            hot |= ride.values[name] >= threshold
    return hot


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


def drop_outs(ride: Evidence) -> list[DiagnosisFinding]:
    """Rows lost while the bike moved, and each sensor that fell silent and came back."""
    total_s = float(ride.end_s[-1] - ride.start_s[0])
    findings = []
    lost = [gap for gap in ride.gaps if gap[1] - gap[0] >= LOST_S and rolled(ride, gap)]
    if lost:
        findings.append(finding("rows_lost", lost, total_s, None))
    for name in SENSORS:
        if name in ride.derived or not ride.has(name):
            continue
        holes = sensor_holes(ride, name)
        if holes:
            findings.append(finding("sensor_silent", holes, total_s, name))
    if ride.has(AGE):
        old = [ride.time(rows) for rows in ride.spans(ride.values[AGE] > AGE_MS)]
        if old:
            findings.append(finding("torque_late", old, total_s, AGE))
    return findings


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
    speeds = speed[max(before - 1, 0) : before + 1]
    return bool(np.nanmax(np.append(speeds, 0.0)) > MOVING_KMH)


def sensor_holes(ride: Evidence, name: str) -> list[Span]:
    """Where a channel is missing between its first sample and its last, while others are there."""
    present = np.isfinite(ride.values[name])
    valid = np.flatnonzero(present)
    others = np.zeros(len(present), np.bool_)
    for other in SENSORS:
        if other != name and other in ride.values:
            others |= np.isfinite(ride.values[other])
    hole = ~present & others
    hole[: valid[0]] = hole[valid[-1] :] = False
    return [
        ride.time(rows)
        for rows in ride.spans(hole)
        if rows.stop - rows.start >= LOST_ROWS and np.ptp(ride.time(rows)) >= LOST_S
    ]


def finding(
    kind: FindingKind, spans: list[Span], total_s: float, channel: str | None
) -> DiagnosisFinding:
    """All of one kind as one finding; it shows the longest."""
    seconds = sum(end - begin for begin, end in spans)
    begin, end = max(spans, key=lambda span: span[1] - span[0])
    share = seconds / max(total_s, 1e-9)
    severity: Severity = WARNING if share >= WARNING_SHARE else NOTE
    numbers = {
        "times": float(len(spans)),
        "seconds": seconds,
        "seconds_longest": end - begin,
        "share": share,
    }
    severity = SERIOUS if share >= SERIOUS_SHARE else severity
    return DiagnosisFinding(kind, severity, begin, end, numbers, channel)
