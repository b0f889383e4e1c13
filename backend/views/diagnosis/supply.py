"""Battery and heat: does the supply break down under load, does heat take assist away."""

from __future__ import annotations

import numpy as np

from backend.views.diagnosis.finding import NOTE, SERIOUS, WARNING, Evidence, Finding, Mask

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


def brown_out(ride: Evidence) -> list[Finding]:
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
    severity = SERIOUS if under or cut else WARNING
    at_s = ride.start_s[lowest]
    begin, end = max(spans or times, key=lambda span: span[1] - span[0], default=(at_s, at_s))
    return [Finding("brown_out", severity, float(begin), float(end), numbers, VOLTAGE)]


def derating(ride: Evidence) -> list[Finding]:
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
    severity = WARNING if share >= DERATED_SHARE else NOTE
    return [Finding("derating", severity, *ride.time(longest), numbers)]


def too_hot(ride: Evidence) -> Mask:
    """Rows (n,) in which heat holds the motor back."""
    if ride.has(FLAGS):
        flags = np.nan_to_num(ride.values[FLAGS]).astype(np.int64)
        told: Mask = (flags & ride.limits.temperature) != 0
        return told
    hot = np.zeros(len(ride.start_s), np.bool_)
    for name, threshold in HOT_DEGC.items():
        if name in ride.values:
            hot |= ride.values[name] >= threshold
    return hot
