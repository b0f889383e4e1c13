"""How far along a ride each of its rows is: in time, in time in motion, or in metres of way.

None of the three ever falls, so rows that follow each other in time do so on every axis, and the
least and greatest value between two places of an axis are those of the rows between. Time in motion
stands while the speed is at most MOVING_KMH or unknown; distance is that of core.distance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt

from backend.core._generated import MOVING_KMH
from backend.core.breaks import DISTANCE, PAUSE_MIN_US, Mask
from backend.core.channels import ChannelSpec, Counts, Values
from backend.core.distance import DISTANCE_CHANNELS, SPEED, row_distances
from backend.core.ride import TimesUs
from backend.errors import FieldError, InvalidRequest

Axis = Literal["time", "moving", "distance"]


class Rows(Protocol):
    """The rows of a ride, as the store's reader offers them."""

    @property
    def row_count(self) -> int: ...
    @property
    def period_us(self) -> int | None: ...
    @property
    def offered(self) -> Sequence[ChannelSpec]: ...
    def times_us(self, start: int, stop: int) -> TimesUs: ...
    def counts(self, names: Sequence[str], start: int, stop: int) -> Mapping[str, Counts]: ...
    def values(self, names: Sequence[str]) -> Mapping[str, Values]: ...
    def row_seconds(self) -> Values: ...
    def breaks(self) -> Mask: ...


@dataclass(frozen=True)
class AxisPositions:
    """at: float64 (n,), seconds or metres at each row, never falling. edges: the rows at which a
    longer stretch begins or ends that tells no speed, in which the axis may stand."""

    at: Values
    edges: npt.NDArray[np.int64]


def axis_positions(ride: Rows, axis: Axis) -> AxisPositions | None:
    """Where each row of the whole ride stands on an axis; None where nothing tells it."""
    times = ride.times_us(0, ride.row_count)
    if axis == "time":
        return AxisPositions(times / 1e6, np.empty(0, np.int64))
    columns = ride.values(DISTANCE_CHANNELS)
    at = places(columns, times / 1e6, ride.row_seconds(), axis)
    if at is None:
        return None
    return AxisPositions(at, silent_edges(columns.get(SPEED, columns.get(DISTANCE, at)), times))


def places(
    columns: Mapping[str, Values], start_s: Values, seconds: Values, axis: Axis
) -> Values | None:
    """Seconds in motion or metres at each row (n,); None where nothing tells them.

    start_s, seconds: when each row begins and how long it holds.
    """
    if axis == "distance":
        distances = row_distances(columns, start_s, seconds)
        return distances.at_m if distances else None
    speed = columns.get(SPEED)
    if speed is None or not np.isfinite(speed).any():
        return None
    step_s = np.where(speed > MOVING_KMH, seconds, 0.0)
    at: Values = np.cumsum(step_s) - step_s
    return at


def require_axis_positions(ride: Rows, axis: Axis) -> AxisPositions:
    """As `axis_positions`; raises InvalidRequest (`no_axis`) where nothing tells it."""
    positions = axis_positions(ride, axis)
    if positions is None:
        message = f"This ride has no speed or distance, so it cannot be drawn over {axis}."
        raise InvalidRequest(message, fields=[FieldError("axis", "no_axis", message)])
    return positions


def silent_edges(source: Values, times: TimesUs) -> npt.NDArray[np.int64]:
    """Rows that begin and end the stretches without a sample that last as long as a pause."""
    silent = np.concatenate(([False], np.isnan(source), [False])).astype(np.int8)
    edges = np.flatnonzero(np.diff(silent)).reshape(-1, 2)
    edges = np.minimum(edges, len(times) - 1)
    lasts = times[edges[:, 1]] - times[edges[:, 0]] >= PAUSE_MIN_US
    return edges[lasts].ravel().astype(np.int64)
