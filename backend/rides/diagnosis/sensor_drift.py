"""Drift watch: the zero of a unit's torque sensor over its rides, and when to calibrate it.

Every calibration begins a new step. Rides under another temperature compensation than today's had
another share of temperature, so they are shown and not counted.
"""

from __future__ import annotations

import itertools
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from backend.core.channels import Values
from backend.core.revision import Revision
from backend.core.ride import iso_utc
from backend.core.ride_zero import ZERO_METHOD, ZeroOfRide
from backend.rides.comparison.since_change import RevisionsOf
from backend.rides.diagnosis.zero_trend import (
    ACT_NM,
    DAY_US,
    WATCH_NM,
    Crossing,
    Trend,
    Zeros,
    crossing,
    level_of,
    trend_of,
)
from backend.store import Store
from backend.store.wall_clock import now_us
from backend.tuning.revisions import TRIED

SCALE = ("sensor_offset_counts", "sensor_gain_nm_per_count")
COMPENSATION = (
    "sensor_offset_counts_per_k",
    "sensor_gain_share_per_k",
    "sensor_reference_degc",
)
# Ten years of commuting; a trend needs no older ones.
RIDES_MAX = 5000
BAND_POINTS = 25
# What is drawn ahead: to the level that matters, but neither a stub nor further than back.
AHEAD_DAYS_MIN, AHEAD_DAYS_MAX = 30.0, 365.0


@dataclass(frozen=True)
class Calibration:
    """A revision that moved the sensor's scale. recompensated: also how temperature counts."""

    revision: Revision
    changed: Sequence[dict[str, Any]]
    recompensated: bool


class SensorDriftService:
    """The drift of one unit's sensor. Safe from any thread.

    key_of: of a device that is connected or was; raises NotFound, NoAnswer. revisions_of: its
    configurations, newest first. clock: Unix time in microseconds.
    """

    def __init__(
        self,
        store: Store,
        key_of: Callable[[str], str],
        revisions_of: RevisionsOf,
        clock: Callable[[], int] = now_us,
    ) -> None:
        self._store = store
        self._key_of = key_of
        self._revisions_of = revisions_of
        self._clock = clock

    def __call__(self, device_id: str, shown: int = RIDES_MAX) -> dict[str, Any]:
        """The answer as in the API, with the newest rides of all. Raises NotFound,
        NoAnswer."""
        key = self._key_of(device_id)
        revisions = self._revisions_of(device_id)
        calibrations = calibrations_of(revisions)
        rides = self._store.zeros.of_unit(key, RIDES_MAX)
        stretches = stretches_of(rides, revisions, calibrations)
        today = self._clock() / DAY_US
        left_out, trend = looked_at(rides, stretches, calibrations)
        since = [
            ride
            for ride, stretch in zip(rides, stretches, strict=True)
            if ride.zero.zero_nm is not None and stretch == len(calibrations)
        ]
        latest = latest_of(since, left_out)
        return {
            "unit_key": key,
            "method": ZERO_METHOD,
            "watch_nm": WATCH_NM,
            "act_nm": ACT_NM,
            "level": None if latest is None else level_of(latest.zero.zero_nm or 0.0),
            "latest": None if latest is None else ride_json(latest, left_out),
            "rides": [ride_json(ride, left_out) for ride in rides[:shown]],
            "calibrations": [calibration_json(one) for one in calibrations],
            "no_trend": trend if isinstance(trend, str) else None,
            "trend": None
            if isinstance(trend, str)
            else trend_json(trend, rides, calibrations, today),
        }


def calibrations_of(revisions: Sequence[Revision]) -> list[Calibration]:
    """Every revision that changed how counts become torque, the oldest first. What was only tried
    is none."""
    confirmed = [one for one in reversed(revisions) if one.state != TRIED]
    calibrations = []
    for before, after in itertools.pairwise(confirmed):
        changed = [
            {"name": name, "old": before.parameters.get(name), "new": after.parameters.get(name)}
            for name in (*SCALE, *COMPENSATION)
            if before.parameters.get(name) != after.parameters.get(name)
        ]
        if changed:
            recompensated = any(change["name"] in COMPENSATION for change in changed)
            calibrations.append(Calibration(after, changed, recompensated))
    return calibrations


def stretches_of(
    rides: Sequence[ZeroOfRide],
    revisions: Sequence[Revision],
    calibrations: Sequence[Calibration],
) -> list[int]:
    """How many calibrations lie before each ride: by the configuration that its unit had, else by
    the time."""
    seqs: dict[tuple[int | None, int | None], int] = {
        (one.generation, one.crc32): one.seq
        for one in reversed(revisions)
        if one.generation is not None
    }
    calibrated = [one.revision for one in calibrations]
    return [
        bisect_right([one.seq for one in calibrated], seq)
        if (seq := seqs.get((ride.config_generation, ride.config_crc32)))
        else bisect_right([one.created_us for one in calibrated], ride.started_us)
        for ride in rides
    ]


def looked_at(
    rides: Sequence[ZeroOfRide], stretches: Sequence[int], calibrations: Sequence[Calibration]
) -> tuple[dict[int, str], Trend | str]:
    """Why rides with a zero are not in the trend, by id; and the trend, else why there is none."""
    first = max((i for i, one in enumerate(calibrations, 1) if one.recompensated), default=0)
    with_zero = [
        (ride, step)
        for ride, step in zip(rides, stretches, strict=True)
        if ride.zero.zero_nm is not None
    ]
    left_out = {ride.ride_id: "other_compensation" for ride, step in with_zero if step < first}
    counted = [(ride, step) for ride, step in with_zero if step >= first]

    def column(name: str) -> Values:
        return np.array([getattr(ride.zero, name) for ride, _ in counted], dtype=np.float64)

    zeros = Zeros(
        column("zero_nm"),
        column("uncertainty_nm"),
        column("temperature_degc"),
        days=np.array([ride.started_us / DAY_US for ride, _ in counted]),
        stretch=np.array([step for _, step in counted], dtype=np.intp),
    )
    trend = trend_of(zeros, len(calibrations))
    if isinstance(trend, Trend):
        for (ride, _), used in zip(counted, trend.used, strict=True):
            if not used:
                cold = trend.per_k is not None and ride.zero.temperature_degc is None
                left_out[ride.ride_id] = "no_temperature" if cold else "apart"
    return left_out, trend


def latest_of(since: Sequence[ZeroOfRide], left_out: dict[int, str]) -> ZeroOfRide | None:
    """The zero by which the sensor is judged: the newest. One that lies apart may be a foot, but
    two in a row are a sensor that jumped."""
    is_outlier = [left_out.get(ride.ride_id) == "apart" for ride in since[:2]]
    return since[1] if is_outlier == [True, False] else next(iter(since), None)


def ride_json(ride: ZeroOfRide, left_out: dict[int, str]) -> dict[str, Any]:
    """One ride."""
    return {
        "ride_id": ride.ride_id,
        "started_at": iso_utc(ride.started_us),
        **asdict(ride.zero),
        "left_out": left_out.get(ride.ride_id),
    }


def calibration_json(one: Calibration) -> dict[str, Any]:
    """One calibration."""
    return {
        "seq": one.revision.seq,
        "created_at": one.revision.created_at,
        "author": one.revision.author,
        "reason": one.revision.reason,
        "changed": one.changed,
    }


def trend_json(
    trend: Trend, rides: Sequence[ZeroOfRide], calibrations: Sequence[Calibration], today: float
) -> dict[str, Any]:
    """The trend, when it reaches either level, and the lines to draw."""
    now = len(calibrations)
    watch, act = (crossing(trend, level_nm, today, now) for level_nm in (WATCH_NM, ACT_NM))
    return {
        "rides": int(trend.used.sum()),
        "per_month_nm": asdict(trend.per_month),
        "per_kelvin_nm": asdict(trend.per_k) if trend.per_k else None,
        "no_per_kelvin": trend.no_per_k,
        "typical_degc": trend.typical_degc,
        "scatter_nm": trend.scatter_nm,
        "today": band_json(trend, [today], now)[0],
        "crossings": {"watch": crossing_json(watch), "act": crossing_json(act)},
        "bands": bands_json(trend, rides, calibrations, today, act),
    }


def crossing_json(crossing: Crossing) -> dict[str, Any]:
    """When a level is reached."""
    days = (crossing.day, crossing.earliest_day, crossing.latest_day)
    names = ("at", "earliest_at", "latest_at")
    moments = {
        name: None if day is None else moment(day) for name, day in zip(names, days, strict=True)
    }
    return {"level_nm": crossing.level_nm, "state": crossing.state, **moments}


def bands_json(
    trend: Trend,
    rides: Sequence[ZeroOfRide],
    calibrations: Sequence[Calibration],
    today: float,
    act: Crossing,
) -> list[list[dict[str, Any]]]:
    """The line with its band between calibrations, and ahead; the oldest first."""
    with_zero = [ride.started_us for ride in rides if ride.zero.zero_nm is not None]
    first_day = min(with_zero) / DAY_US
    edges = [first_day, *(one.revision.created_us / DAY_US for one in calibrations)]
    soon = act.day if act.day is not None else act.earliest_day
    ahead = AHEAD_DAYS_MAX if soon is None else soon - today
    back = min(today - first_day, AHEAD_DAYS_MAX)
    edges.append(today + max(min(ahead, back), AHEAD_DAYS_MIN))
    return [
        band_json(trend, np.linspace(edges[step], edges[step + 1], BAND_POINTS), int(step))
        for step in trend.stretches
    ]


def band_json(trend: Trend, days: Any, stretch: int) -> list[dict[str, Any]]:
    """The zero on some days (m,), with its interval of 90 %."""
    line, half = trend.band(np.asarray(days, dtype=float), stretch)
    return [
        {"at": moment(day), "zero_nm": zero, "low_nm": zero - wide, "high_nm": zero + wide}
        for day, zero, wide in zip(days, line.tolist(), half.tolist(), strict=True)
    ]


def moment(day: float) -> str:
    """Days since 1970 -> ISO 8601."""
    return iso_utc(round(day * DAY_US))
