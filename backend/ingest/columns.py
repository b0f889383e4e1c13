"""From the columns a file happens to have to the rows of a ride, by our rules.

- A row without a believable time is dropped, and counted.
- Rows of the same second are one row: some head units write a row's parts one after the other.
- Missing is missing: a maker's "no value" number (65535, 255) never becomes a value, nor does what
  no bike can do (a damaged file is full of it). Both become null, never 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.domain.channels import ChannelSpec, Counts, Values
from backend.domain.ride import RideRows
from backend.ingest.outcome import ImportedRide

# FIT's zero, 1989-12-31; what lies before it is a clock that was never set.
EPOCH_S = 631_065_600
LATEST_S = 4_102_444_800
# No ride lasts longer; a row further from the middle one has a wrong clock.
SPAN_S_MAX = 7 * 86_400
# Rows closer than this to equal spacing make a regular ride.
REGULAR_TOLERANCE_US = 1000

Seconds = npt.NDArray[np.float64]


@dataclass(frozen=True)
class FieldRule:
    """How a field of a file becomes a channel.

    sources: names of the field, the best first. factor: file's unit -> channel's unit.
    lowest, highest: what a bike can do; beyond it the sample is missing.
    """

    channel: ChannelSpec
    sources: tuple[str, ...]
    lowest: float
    highest: float
    factor: float = 1.0


SEMICIRCLE_DEG = 180.0 / 2**31

FIT_FIELDS: tuple[FieldRule, ...] = (
    FieldRule(ChannelSpec("speed_kmh", "km/h", 0.0036), ("enhanced_speed", "speed"), 0, 117.9, 3.6),
    FieldRule(ChannelSpec("cadence_rpm", "rpm", 1.0), ("cadence",), 0, 254),
    FieldRule(ChannelSpec("rider_power_w", "W", 1.0), ("power",), 0, 4000),
    FieldRule(ChannelSpec("rider_torque_nm", "Nm", 0.01), ("rider_torque",), -320, 320),
    FieldRule(ChannelSpec("motor_power_w", "W", 1.0), ("motor_power",), 0, 4000),
    FieldRule(ChannelSpec("motor_torque_nm", "Nm", 0.01), ("motor_torque",), -320, 320),
    FieldRule(ChannelSpec("motor_current_a", "A", 0.01), ("motor_current",), -320, 320),
    FieldRule(ChannelSpec("battery_voltage_v", "V", 0.01), ("battery_voltage",), 0, 120),
    FieldRule(ChannelSpec("battery_soc_pct", "%", 1.0), ("ebike_battery_level",), 0, 100),
    FieldRule(ChannelSpec("assist_mode", "", 1.0), ("ebike_assist_mode",), 0, 254),
    FieldRule(ChannelSpec("assist_level_pct", "%", 1.0), ("ebike_assist_level_percent",), 0, 254),
    FieldRule(ChannelSpec("range_km", "km", 1.0), ("ebike_travel_range",), 0, 1000),
    FieldRule(ChannelSpec("fuzzy_gain", "", 0.0001), ("fuzzy_gain",), 0, 3),
    FieldRule(ChannelSpec("heart_rate_bpm", "bpm", 1.0), ("heart_rate",), 1, 254),
    FieldRule(ChannelSpec("temperature_degc", "degC", 1.0), ("temperature",), -60, 120),
    FieldRule(ChannelSpec("altitude_m", "m", 0.2), ("enhanced_altitude", "altitude"), -500, 6000),
    FieldRule(ChannelSpec("grade_pct", "%", 0.01), ("grade",), -100, 100),
    FieldRule(ChannelSpec("distance_m", "m", 0.01, wide=True), ("distance",), 0, 2e7),
    FieldRule(
        ChannelSpec("latitude_deg", "deg", SEMICIRCLE_DEG, wide=True), ("position_lat",), -90, 90
    ),
    FieldRule(
        ChannelSpec("longitude_deg", "deg", SEMICIRCLE_DEG, wide=True),
        ("position_long",),
        -180,
        180,
    ),
)


def ride_of_columns(
    time_s: Seconds,
    columns: Mapping[str, Values],
    fields: tuple[FieldRule, ...] = FIT_FIELDS,
    sport: str | None = None,
) -> ImportedRide | None:
    """Columns (n,) and Unix times (n,) -> a ride; None when no row has a believable time.

    columns: by the file's field names, missing as NaN.
    """
    notes: list[str] = []
    order, started_us, times_us = ordered_rows(time_s, notes)
    if not len(order):
        return None
    starts = np.flatnonzero(np.concatenate(([True], np.diff(times_us) > 0)))
    if len(starts) < len(times_us):
        notes.append(f"{len(times_us) - len(starts)} rows of the same time were joined")
    channels: list[ChannelSpec] = []
    counts: dict[str, Counts] = {}
    for rule in fields:
        values = rule_values(rule, columns, notes)
        if values is None:
            continue
        merged = first_present(values[order], starts)
        if np.isfinite(merged).any():
            channels.append(rule.channel)
            counts[rule.channel.name] = rule.channel.to_counts(merged)
    times = times_us[starts]
    rows = RideRows(tuple(channels), times, counts)
    return ImportedRide(started_us, regular_period_us(times), rows, sport, tuple(notes))


def ordered_rows(
    time_s: Seconds, notes: list[str]
) -> tuple[npt.NDArray[np.intp], int, npt.NDArray[np.int64]]:
    """Rows with believable times in order of time, start in Unix us, times from it in us."""
    believable = np.isfinite(time_s) & (time_s > EPOCH_S) & (time_s < LATEST_S)
    if believable.any():
        middle_s = float(np.median(time_s[believable]))
        believable &= np.abs(np.where(believable, time_s, middle_s) - middle_s) < SPAN_S_MAX
    keep = np.flatnonzero(believable)
    if len(keep) < len(time_s):
        notes.append(f"{len(time_s) - len(keep)} rows without a believable time were left out")
    if not len(keep):
        return keep, 0, np.empty(0, np.int64)
    unix_us = np.rint(time_s[keep] * 1e6).astype(np.int64)
    sorting = np.argsort(unix_us, kind="stable")
    if (np.diff(unix_us) < 0).any():
        notes.append("the clock went backwards; rows were put in order")
    ordered_us = unix_us[sorting]
    return keep[sorting], int(ordered_us[0]), ordered_us - ordered_us[0]


def rule_values(rule: FieldRule, columns: Mapping[str, Values], notes: list[str]) -> Values | None:
    """The rule's channel (n,), from its best source row by row; None when no source is there."""
    found = [columns[name] for name in rule.sources if name in columns]
    if not found:
        return None
    values = np.array(found[0], dtype=np.float64)
    for other in found[1:]:
        values = np.where(np.isnan(values), other, values)
    values *= rule.factor
    impossible = np.isfinite(values) & ((values < rule.lowest) | (values > rule.highest))
    if impossible.any():
        notes.append(f"{int(impossible.sum())} impossible values of {rule.channel.name} left out")
    values[impossible | ~np.isfinite(values)] = np.nan
    return values


def first_present(values: Values, starts: npt.NDArray[np.intp]) -> Values:
    """The first sample that is there in each group of rows beginning at `starts`."""
    if len(starts) == len(values):
        return values
    index = np.where(np.isfinite(values), np.arange(len(values)), len(values))
    first = np.minimum.reduceat(index, starts)
    return np.append(values, np.nan)[first]


def regular_period_us(times_us: npt.NDArray[np.int64]) -> int | None:
    """The spacing when every row keeps to it, else None."""
    if len(times_us) < 2:
        return None
    period_us = round(float(times_us[-1]) / (len(times_us) - 1))
    expected = np.arange(len(times_us), dtype=np.int64) * period_us
    regular = period_us > 0 and bool(np.abs(times_us - expected).max() <= REGULAR_TOLERANCE_US)
    return period_us if regular else None
