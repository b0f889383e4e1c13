"""The circumference of a bike's wheel, rolled out or by the positions of a ride, beside what its
unit counts with; and the rows of a ride that a measurement of the bike reads.

Nothing is written: that is a change of the configuration like any other.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from backend.calibration.bike.track import track_of
from backend.calibration.bike.types import UnitComparison, Wheel
from backend.calibration.bike.wheel import Circumference, cut_off, from_gps, roll_out, summed
from backend.core._generated import MOVING_KMH
from backend.core.channels import Values
from backend.core.energy import KMH_PER_MS
from backend.core.ride import Ride
from backend.errors import FieldError, InvalidRequest
from backend.rides.rows import Window, columns_from
from backend.rides.settings_in_force import ConfigOf, all_through
from backend.rides.traces.trace import row_window
from backend.store import Store
from backend.tuning.types import Parameter

GAP_S_MAX = 2.5
"""Over a longer gap the bike's motion is unknown; a head unit records one row a second."""


@dataclass(frozen=True)
class Rows:
    """time_s: since the ride's start, (n,). values: (n,) each, none missing."""

    ride: Ride
    time_s: Values
    values: dict[str, Values]

    def __getitem__(self, name: str) -> Values:
        return self.values[name]


def rows_of(store: Store, window: Window, field: str, names: Sequence[str]) -> Rows:
    """The rows of a window that have all of `names`.

    field: of the question, for refusals. Raises NotFound, ObjectDamaged, and InvalidRequest for
    a channel that the ride lacks (`missing_channel`) and for silences (`missing_rows`).
    """
    reader = store.rides.reader(window.ride_id)
    offered = {channel.name for channel in reader.ride.offered}
    lacking = [name for name in names if name not in offered]
    if lacking:
        listed = ", ".join(lacking)
        raise refusal(field, "missing_channel", f"ride {window.ride_id} has no {listed}")
    start, stop, _ = row_window(reader, window.from_s, window.to_s)
    rows = columns_from(reader, names, start, stop)
    complete = np.ones(stop - start, np.bool_)
    for name in names:
        complete &= np.isfinite(rows.values[name])
    time_s = rows.start_s[complete]
    edges = np.concatenate([rows.start_s[:1], time_s, rows.start_s[-1:]])
    if len(time_s) < 2 or np.diff(edges).max() > GAP_S_MAX:
        message = f"ride {window.ride_id} tells nothing there for more than {GAP_S_MAX:g} s"
        raise refusal(field, "missing_rows", message)
    return Rows(reader.ride, time_s, {name: rows.values[name][complete] for name in names})


def refusal(field: str, code: str, message: str) -> InvalidRequest:
    """One fault of a question, by its name."""
    return InvalidRequest(f"{field}: {message}", fields=[FieldError(field, code, message)])


CIRCUMFERENCE_PARAMETER, CUTOFF_PARAMETER = "wheel_circumference_m", "assist_cutoff_kmh"
SPEED, LATITUDE, LONGITUDE = "speed_kmh", "latitude_deg", "longitude_deg"

ENDS_S = 10.0
"""Of a window in which the bike stands, that the other ride need not cover."""

ParametersOf = Callable[[str], Sequence[Parameter]]


@dataclass(frozen=True)
class TrackQuestion:
    """wheel: the ride whose speed is of the wheel. track_ride_id: of another device's ride at the
    same time, which has the positions; None: the same. stored_m: what the wheel's device counts
    with; None: as the ride's configuration says."""

    wheel: Window
    track_ride_id: int | None = None
    stored_m: float | None = None


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
    ) -> Wheel:
        """From marks on the ground. Raises InvalidRequest, and what asking a unit raises."""
        circumference = roll_out(distances_m, turns, tape_limit_m)
        mean_m = float(np.mean(distances_m))
        return Wheel(circumference, mean_m, turns, None, self._compared(device_id, circumference))

    def tracked(self, question: TrackQuestion, device_id: str | None) -> Wheel:
        """From the positions of a ride. Raises NotFound, ObjectDamaged, InvalidRequest with the
        reason why the rides cannot tell, and what asking a unit raises."""
        own = question.track_ride_id in (None, question.wheel.ride_id)
        names = [SPEED, LATITUDE, LONGITUDE] if own else [SPEED]
        wheel = rows_of(self._store, question.wheel, "ride_id", names)
        track = wheel if own else self._track(question, wheel)
        circumference_m = question.stored_m or self._stored_m(wheel)
        distances_m = summed(wheel[SPEED] / KMH_PER_MS, wheel.time_s)
        turns = float(distances_m[-1]) / circumference_m
        later_s = (wheel.ride.started_us - track.ride.started_us) / 1e6
        first = once_a_second(track.time_s)
        at_each_m = np.interp(track.time_s[first] - later_s, wheel.time_s, distances_m)
        track_length = track_of(track[LATITUDE][first], track[LONGITUDE][first], at_each_m)
        circumference = from_gps(track_length, float(distances_m[-1]), turns)
        noise_m = track_length.noise_m if track_length else None
        distance_m = circumference.circumference_m * turns
        compared = self._compared(device_id, circumference)
        return Wheel(circumference, distance_m, turns, noise_m, compared)

    def _track(self, question: TrackQuestion, wheel: Rows) -> Rows:
        """The other device's rows at the same time. Two clocks differ by seconds: the bike stands
        at both ends, or its position is unknown."""
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

    def _stored_m(self, wheel: Rows) -> float:
        config, source = all_through(self._config_of, wheel.ride)
        stored = config.get(CIRCUMFERENCE_PARAMETER)
        if source != "ride" or stored is None:
            message = "nobody knows what this ride's device counted with"
            raise refusal("device_circumference_m", "missing", message)
        return float(stored)

    def _compared(
        self, device_id: str | None, circumference: Circumference
    ) -> UnitComparison | None:
        if device_id is None:
            return None
        by_name = {one.name: one for one in self._parameters_of(device_id)}
        if CIRCUMFERENCE_PARAMETER not in by_name:
            message = f"unit {device_id} does not tell its wheel's circumference"
            raise refusal("device_id", "no_circumference", message)
        stored_m, free = (
            float(str(by_name[CIRCUMFERENCE_PARAMETER].value)),
            by_name[CIRCUMFERENCE_PARAMETER].free,
        )
        limit = by_name.get(CUTOFF_PARAMETER)
        measured_m = circumference.circumference_m
        return UnitComparison(
            device_id,
            stored_m,
            None if free is None else free.min,
            None if free is None else free.max,
            None if free is None else free.min <= measured_m <= free.max,
            100 * (measured_m / stored_m - 1),
            abs(measured_m - stored_m) <= circumference.expanded_m,
            None if limit is None else cut_off(stored_m, circumference, float(str(limit.value))),
        )


def once_a_second(time_s: Values) -> NDArray[np.intp]:
    """The first row (k,) of each second: positions told oftener are the same ones again."""
    return np.unique(np.floor(time_s).astype(np.int64), return_index=True)[1]
