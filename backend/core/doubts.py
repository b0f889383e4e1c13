"""What is doubtful of a ride: figures of one thing that disagree, and what no bike or rider can do.

A file may be complete and wrong: a count in other units, a receiver between houses, a sensor that
was lost. Two figures of one thing, or a figure and what is possible, show it whatever the cause.
The figures stay as they are; the ride is in no record until somebody accepts them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from backend.core.breaks import LATITUDE, LONGITUDE, is_reachable, track_steps_m
from backend.core.channels import Values
from backend.core.described import described
from backend.core.device_metadata import DeviceMetadata
from backend.core.distance import RowDistances
from backend.core.intake import Intake

if TYPE_CHECKING:
    from backend.core.ride import RideSummary

DoubtCode: TypeAlias = Literal[
    "wheel_and_track",
    "stated_distance",
    "stated_time",
    "stated_work",
    "rows_left_out",
    "values_left_out",
    "speed",
    "mean_speed",
    "power",
    "climb_rate",
    "climb_share",
    "motor_work",
]

# Wheel and track are laid beside each other in steps so long: a receiver at rest wanders.
CHORD_S = 10.0
TRACK_SHARE, TRACK_KM = 0.15, 0.3
# Of what a device states: its own rounding, and seconds or metres at both ends.
STATED_SHARE, STATED_KM, STATED_S, STATED_WH = 0.05, 0.2, 60.0, 5.0
HEART_RATE = "heart_rate_bpm"
LEFT_OUT_SHARE, LOST_SHARE = 0.1, 0.5
SPEED_KMH_MAX, MEAN_KMH_MAX = 100.0, 45.0
"""Faster than riders descend, and than the hour record of 56.8 km/h goes on a road."""
POWER_W_MAX: Mapping[int, float] = {5: 2500.0, 60: 1200.0, 300: 700.0, 1200: 500.0}
"""Best means of so many seconds above those of world champions (Allen and Coggan, 72 kg: 24.0,
11.5, 7.6 and 6.6 W/kg)."""
CLIMB_M_H_MAX, CLIMB_SHARE_MAX, CLIMB_M_MIN = 3500.0, 0.25, 300.0
"""The rate takes 1 kW for 105 kg; no road rises by a quarter of the way, there and back."""
WORK_SHARE, WORK_WH, MEASURED_SHARE = 1.02, 2.0, 0.95


@described
class Doubt:
    """A figure of the ride, and the other one, or the limit, that it does not agree with."""

    code: DoubtCode
    figure: float
    against: float
    unit: str
    channel: str | None = None
    """Whose values are left out."""
    seconds: float | None = None
    """Over which the power is the mean."""
    accepted: bool = False
    """By somebody who knows better: it keeps the ride from no record."""


@dataclass(frozen=True)
class Evidence:
    """What is known of a finished ride. columns: LATITUDE, LONGITUDE of rows (n,), where there are
    some; start_s, seconds: when each begins and how long it holds. power_w_best: by seconds."""

    columns: Mapping[str, Values]
    start_s: Values
    seconds: Values
    distances: RowDistances | None
    summary: RideSummary
    ascent_m: float | None
    power_w_best: Mapping[int, float | None]
    intake: Intake | None
    metadata: DeviceMetadata


def doubts_of(ride: Evidence) -> tuple[Doubt, ...]:
    """All that is doubtful of a ride; empty for one that agrees with itself."""
    return (*wheel_and_track(ride), *stated(ride), *left_out(ride), *impossible(ride))


def wheel_and_track(ride: Evidence) -> Iterator[Doubt]:
    """Whether the distance by wheel is about that by positions, where both are known."""
    distances = ride.distances
    if distances is None or distances.source == "positions" or LATITUDE not in ride.columns:
        return
    latitude_deg, longitude_deg = ride.columns[LATITUDE], ride.columns[LONGITUDE]
    valid = np.flatnonzero(np.isfinite(latitude_deg) & np.isfinite(longitude_deg))
    if len(valid) < 2:
        return
    chord = np.unique((ride.start_s[valid] - ride.start_s[valid[0]]) // CHORD_S, return_index=True)
    rows = valid[chord[1]]
    track_m = track_steps_m(latitude_deg[rows], longitude_deg[rows])
    wheel_m = np.diff(distances.at_m[rows])
    seconds = np.diff(ride.start_s[rows])
    gaps = np.diff(np.append(0, np.cumsum(distances.gap))[rows])
    alike = (gaps == 0) & (seconds <= 6 * CHORD_S)
    reachable = alike & is_reachable(track_m, seconds)
    # One chord that nobody rides is a receiver's slip; most of them are positions that are none.
    alike = reachable if reachable.sum() > alike.sum() / 2 else alike
    wheel_km, track_km = (float(steps[alike].sum()) / 1000.0 for steps in (wheel_m, track_m))
    if differ(wheel_km, track_km, TRACK_SHARE, TRACK_KM):
        yield Doubt("wheel_and_track", wheel_km, track_km, "km")


def differ(one: float, other: float, share: float, least: float) -> bool:
    """Whether two figures of one thing are apart by a share of the larger, and by a least."""
    return abs(one - other) > max(share * max(abs(one), abs(other)), least)


def stated(ride: Evidence) -> Iterator[Doubt]:
    """Whether the sums that the device states are those of the rows."""
    summary, sums = ride.summary, stated_sums(ride.metadata, ride.summary.duration_s)
    rows_s = float(ride.seconds.sum())
    ours: list[tuple[DoubtCode, float | None, float | None, float, str]] = [
        ("stated_distance", summary.distance_km, sums.get("distance_km"), STATED_KM, "km"),
        ("stated_time", rows_s, sums.get("timer_s"), STATED_S, "s"),
        ("stated_work", summary.rider_wh, sums.get("work_wh"), STATED_WH, "Wh"),
    ]
    for code, figure, told, least, unit in ours:
        if figure is not None and told and differ(figure, told, STATED_SHARE, least):
            yield Doubt(code, figure, told, unit)


def stated_sums(metadata: DeviceMetadata, duration_s: float) -> dict[str, float]:
    """Kilometres, seconds and Wh that the device states of the whole ride: by its sessions, else by
    its laps; none where these are of more, or of less."""
    spans = metadata.statements or metadata.laps
    covered_s = sum(span.to_s - span.from_s for span in spans)
    within = all(span.from_s >= -STATED_S and span.to_s <= duration_s + STATED_S for span in spans)
    if not spans or not within or differ(covered_s, duration_s, STATED_SHARE, STATED_S):
        return {}
    figures: list[dict[str, float | None]] = [
        {figure.name: figure.value for figure in session.figures} for session in metadata.statements
    ] or [{"total_distance": lap.distance_m, "total_timer_time": lap.timer_s}
          for lap in metadata.laps]  # fmt: skip
    names = (
        ("distance_km", "total_distance", 1000.0),
        ("timer_s", "total_timer_time", 1.0),
        ("work_wh", "total_work", 3600.0),
    )
    sums: dict[str, float] = {}
    for name, theirs, divisor in names:
        parts = [value for one in figures if (value := one.get(theirs)) is not None]
        if len(parts) == len(figures):
            sums[name] = sum(parts) / divisor
    return sums


def left_out(ride: Evidence) -> Iterator[Doubt]:
    """Whether much of the file is not in the ride."""
    intake = ride.intake
    if intake is None or not intake.rows_read:
        return
    dropped = sum(intake.rows_dropped.values())
    if dropped > LEFT_OUT_SHARE * intake.rows_read:
        yield Doubt("rows_left_out", float(dropped), float(intake.rows_read), "")
    for channel, count in intake.values_dropped.items():
        # A strap that nobody wears writes zeros, and no figure rests on it.
        if channel != HEART_RATE and count > LOST_SHARE * intake.rows_kept:
            yield Doubt("values_left_out", float(count), float(intake.rows_kept), "", channel)


def impossible(ride: Evidence) -> Iterator[Doubt]:
    """What no bike and no rider can do."""
    summary = ride.summary
    hours = float(ride.seconds.sum()) / 3600.0
    km, top = summary.distance_km or 0.0, summary.speed_kmh_max
    if top is not None and top > SPEED_KMH_MAX:
        yield Doubt("speed", top, SPEED_KMH_MAX, "km/h")
    mean = summary.speed_kmh_mean or (km / hours if hours else 0.0)
    if km > 1.0 and mean > MEAN_KMH_MAX:
        yield Doubt("mean_speed", mean, MEAN_KMH_MAX, "km/h")
    for seconds, limit in POWER_W_MAX.items():
        best = ride.power_w_best.get(seconds)
        if best is not None and best > limit:
            yield Doubt("power", best, limit, "W", seconds=float(seconds))
            break
    if ride.ascent_m is not None and ride.ascent_m > CLIMB_M_MIN:
        if hours and ride.ascent_m / hours > CLIMB_M_H_MAX:
            yield Doubt("climb_rate", ride.ascent_m / hours, CLIMB_M_H_MAX, "m/h")
        elif km and ride.ascent_m / 1000.0 / km > CLIMB_SHARE_MAX:
            yield Doubt("climb_share", 0.1 * ride.ascent_m / km, 100.0 * CLIMB_SHARE_MAX, "%")
    yield from motor_work(summary)


def motor_work(summary: RideSummary) -> Iterator[Doubt]:
    """A motor gives no more than its battery, where both were measured throughout."""
    motor_wh, battery_wh = summary.motor_wh, summary.battery_wh
    unknown_s = (summary.motor_excluded_s or 0.0) + (summary.battery_excluded_s or 0.0)
    measured = unknown_s <= (1.0 - MEASURED_SHARE) * summary.duration_s
    if motor_wh is None or battery_wh is None or not measured:
        return
    if motor_wh > WORK_SHARE * battery_wh + WORK_WH:
        yield Doubt("motor_work", motor_wh, battery_wh, "Wh")


def open_doubts(doubts: Sequence[Doubt], accepted: Sequence[str]) -> int:
    """How many nobody has accepted yet."""
    return sum(doubt.code not in accepted for doubt in doubts)
