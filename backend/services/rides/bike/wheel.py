"""The circumference of a bike's wheel, rolled out or by the positions of a ride, beside what its
unit counts with. Nothing is written: that is a change of the configuration like any other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from backend.domain._generated import MOVING_KMH
from backend.domain.calibration.bike.arrays import summed
from backend.domain.calibration.bike.track import track_of
from backend.domain.calibration.bike.wheel import (
    Circumference,
    CutOff,
    cut_off,
    from_gps,
    roll_out,
)
from backend.domain.channels import Values
from backend.domain.energy import KMH_PER_MS
from backend.services.rides.bike.window import Rows, refusal, rows_of
from backend.services.rides.insight.rows import Window
from backend.services.rides.settings_in_force import ConfigOf, all_through
from backend.services.tuning.config_view import ParameterView
from backend.store import Store

KEPT, LIMIT = "wheel_circumference_m", "assist_cutoff_kmh"
SPEED, LATITUDE, LONGITUDE = "speed_kmh", "latitude_deg", "longitude_deg"

ENDS_S = 10.0
"""Of a window in which the bike stands, that the other ride need not cover."""

ParametersOf = Callable[[str], Sequence[ParameterView]]


@dataclass(frozen=True)
class Beside:
    """What the unit counts with. free_*: what may be set without the maker's token; None: the unit
    has no band. in_band: the measured value lies within. agrees: so does the kept one within the
    measurement's uncertainty. cut_off: what the kept one makes of the unit's assist cut-off."""

    device_id: str
    kept_m: float
    free_min_m: float | None
    free_max_m: float | None
    in_band: bool | None
    difference_pct: float
    agrees: bool
    cut_off: CutOff | None


@dataclass(frozen=True)
class WheelMeasured:
    """distance_m, turns: on the ground, and of the wheel, on it. noise_m: of a position, in each
    direction; None of a roll-out. beside: None without a unit."""

    measured: Circumference
    distance_m: float
    turns: float
    noise_m: float | None
    beside: Beside | None


@dataclass(frozen=True)
class TrackQuestion:
    """wheel: the ride whose speed is of the wheel. track_ride_id: of another device's ride at the
    same time, which has the positions; None: the same. told_m: what the wheel's device counts
    with; None: as the ride's configuration says."""

    wheel: Window
    track_ride_id: int | None = None
    told_m: float | None = None


class WheelMeasure:
    """Measures a wheel. Holds nothing; safe from any thread.

    parameters_of: a connected unit's, by its device id. config_of: a ride's.
    """

    def __init__(self, store: Store, config_of: ConfigOf, parameters_of: ParametersOf) -> None:
        self._store = store
        self._config_of = config_of
        self._parameters_of = parameters_of

    def rolled(
        self, distances_m: Sequence[float], turns: float, tape_limit_m: float, device_id: str | None
    ) -> WheelMeasured:
        """From marks on the ground. Raises InvalidRequest, and what asking a unit raises."""
        found = roll_out(distances_m, turns, tape_limit_m)
        mean_m = float(np.mean(distances_m))
        return WheelMeasured(found, mean_m, turns, None, self._beside(device_id, found))

    def tracked(self, question: TrackQuestion, device_id: str | None) -> WheelMeasured:
        """From the positions of a ride. Raises NotFound, ObjectDamaged, InvalidRequest with the
        reason why the rides cannot tell, and what asking a unit raises."""
        own = question.track_ride_id in (None, question.wheel.ride_id)
        names = [SPEED, LATITUDE, LONGITUDE] if own else [SPEED]
        wheel = rows_of(self._store, question.wheel, "ride_id", names)
        track = wheel if own else self._track(question, wheel)
        told_m = question.told_m or self._told_m(wheel)
        way_m = summed(wheel[SPEED] / KMH_PER_MS, wheel.time_s)
        turns = float(way_m[-1]) / told_m
        later_s = (wheel.ride.started_us - track.ride.started_us) / 1e6
        first = once_a_second(track.time_s)
        at_each_m = np.interp(track.time_s[first] - later_s, wheel.time_s, way_m)
        along = track_of(track[LATITUDE][first], track[LONGITUDE][first], at_each_m)
        found = from_gps(along, float(way_m[-1]), turns)
        noise_m = along.noise_m if along else None
        distance_m = found.circumference_m * turns
        beside = self._beside(device_id, found)
        return WheelMeasured(found, distance_m, turns, noise_m, beside)

    def _track(self, question: TrackQuestion, wheel: Rows) -> Rows:
        """The other device's rows at the same time. Two clocks differ by seconds: the bike stands
        at both ends, or nobody knows where it was."""
        ends = wheel[SPEED][[0, -1]]
        if ends.max() > MOVING_KMH:
            message = "the bike must stand at both ends of the window: the clocks of two differ"
            raise refusal("ride_id", "not_standing", message)
        number = question.track_ride_id or 0
        started_us = self._store.rides.get(number).started_us
        later_s = (wheel.ride.started_us - started_us) / 1e6
        begin_s, end_s = wheel.time_s[0] + later_s, wheel.time_s[-1] + later_s
        if end_s <= max(begin_s, 0.0):
            message = f"ride {number} is of another time"
            raise refusal("track_ride_id", "other_time", message)
        window = Window(number, max(float(begin_s), 0.0), float(end_s))
        rows = rows_of(self._store, window, "track_ride_id", [LATITUDE, LONGITUDE])
        missed_s = max(rows.time_s[0] - begin_s, end_s - rows.time_s[-1])
        if missed_s > ENDS_S:
            message = f"ride {number} does not cover the window by {missed_s:.0f} s"
            raise refusal("track_ride_id", "not_covered", message)
        return rows

    def _told_m(self, wheel: Rows) -> float:
        config, source = all_through(self._config_of, wheel.ride)
        told = config.get(KEPT)
        if source != "ride" or told is None:
            message = "nobody knows what this ride's device counted with"
            raise refusal("told_circumference_m", "missing", message)
        return float(told)

    def _beside(self, device_id: str | None, found: Circumference) -> Beside | None:
        if device_id is None:
            return None
        by_name = {one.name: one for one in self._parameters_of(device_id)}
        if KEPT not in by_name:
            message = f"unit {device_id} does not tell its wheel's circumference"
            raise refusal("device_id", "no_circumference", message)
        kept_m, free = float(str(by_name[KEPT].value)), by_name[KEPT].free
        limit = by_name.get(LIMIT)
        measured_m = found.circumference_m
        return Beside(
            device_id,
            kept_m,
            None if free is None else free.min,
            None if free is None else free.max,
            None if free is None else free.min <= measured_m <= free.max,
            100 * (measured_m / kept_m - 1),
            abs(measured_m - kept_m) <= found.expanded_m,
            None if limit is None else cut_off(kept_m, found, float(str(limit.value))),
        )


def once_a_second(time_s: Values) -> NDArray[np.intp]:
    """The first row (k,) of each second: positions told oftener are the same ones again."""
    return np.unique(np.floor(time_s).astype(np.int64), return_index=True)[1]
