"""How far along a ride each of its rows is: in time, in time in motion, or in metres of way.

None of the three ever falls, so rows that follow each other in time do so on every axis, and the
least and greatest value between two places of an axis are those of the rows between. Time in motion
stands while the speed is at most MOVING_KMH or unknown; the way is that of `insight.way`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt

from backend.domain._generated import MOVING_KMH
from backend.domain.channels import ChannelSpec, Counts, Values
from backend.domain.energy import sample_seconds
from backend.domain.ride import PAUSE_MIN_US, TimesUs, find_gaps, pause_us
from backend.errors import FieldError, InvalidRequest
from backend.views.insight.way import way_of

Axis = Literal["time", "moving", "distance"]
SPEED, ODOMETER = "speed_kmh", "distance_m"


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


@dataclass(frozen=True)
class Along:
    """at: float64 (n,), seconds or metres at each row, never falling. edges: the rows at which a
    longer stretch begins or ends that tells no speed, in which the axis may stand."""

    at: Values
    edges: npt.NDArray[np.int64]


def along(ride: Rows, axis: Axis) -> Along | None:
    """Where each row of the whole ride stands on an axis; None where nothing tells it."""
    times = ride.times_us(0, ride.row_count)
    if axis == "time":
        return Along(times / 1e6, np.empty(0, np.int64))
    columns = columns_of(ride, (SPEED, ODOMETER))
    held_s = sample_seconds(times, pause_us(times, ride.period_us))
    at = None
    if axis == "distance":
        way = way_of(columns, times / 1e6, held_s)
        at = way.at_m if way else None
    elif np.isfinite(columns.get(SPEED, np.empty(0))).any():
        step_s = np.where(columns[SPEED] > MOVING_KMH, held_s, 0.0)
        at = np.cumsum(step_s) - step_s
    if at is None:
        return None
    source = columns.get(SPEED, columns.get(ODOMETER, at))
    return Along(at, silent_edges(source, times, ride.period_us))


def told_along(ride: Rows, axis: Axis) -> Along:
    """As `along`; raises InvalidRequest (`no_axis`) where nothing tells it."""
    found = along(ride, axis)
    if found is None:
        message = f"This ride has no speed or way, so it cannot be drawn over {axis}."
        raise InvalidRequest(message, fields=[FieldError("axis", "no_axis", message)])
    return found


def columns_of(ride: Rows, names: Sequence[str]) -> dict[str, Values]:
    """Values of the whole ride, missing as NaN, of those of the channels that it has."""
    offered = {channel.name: channel for channel in ride.offered}
    chosen = [name for name in names if name in offered]
    counts = ride.counts(chosen, 0, ride.row_count)
    return {name: offered[name].to_values(counts[name]) for name in chosen}


def silent_edges(source: Values, times: TimesUs, period_us: int | None) -> npt.NDArray[np.int64]:
    """Rows that begin and end the stretches without a sample that last as long as a pause."""
    silent = [
        gap
        for gap in find_gaps(times, np.isnan(source), period_us)
        if gap.rows_lost and (gap.to_s - gap.from_s) * 1e6 >= PAUSE_MIN_US
    ]
    ends_us = np.array([round(t_s * 1e6) for gap in silent for t_s in (gap.from_s, gap.to_s)])
    return np.searchsorted(times, ends_us).astype(np.int64)
