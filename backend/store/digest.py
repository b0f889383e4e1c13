"""The overview, figures, gaps and events of a ride from its rows.

One column is in memory at a time, so a day's ride needs no more than an hour's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from backend.core.breaks import find_breaks
from backend.core.channels import ChannelSpec, Counts, Values
from backend.core.energy import FACTORS, derivable, derive, sample_seconds
from backend.core.filled import filled_mask, filled_seconds
from backend.core.pyramid import STEPS, Level, first_level, reduce_groups
from backend.core.ride import Gap, Ride, RideSummary, find_gaps, summarise
from backend.core.ride_events import RideEvent, events_of_rows, merged
from backend.store.parquet import ROW_GROUP_ROWS, release_memory
from backend.store.reader import RowSource

# A row of a log is up to so much later than what it shows.
SAME_EVENT_S = 0.2
PIECE_ROWS = 4 * ROW_GROUP_ROWS


@dataclass(frozen=True)
class Digest:
    """What is computed once from a ride's rows and kept in SQL."""

    levels: tuple[Level, ...]
    summary: RideSummary
    gaps: tuple[Gap, ...]
    events: tuple[RideEvent, ...]
    rows_empty: int


def digest(file: RowSource, ride: Ride) -> Digest:
    """Overview, figures and gaps of a ride from its rows."""
    columns = FileColumns(file, ride.channels, ride.context.gear_ratio)
    times = file.times_us(0, file.row_count)
    empty = np.ones(file.row_count, dtype=bool)
    pairs: dict[str, list[tuple[Counts, Counts]]] = {}
    events: list[RideEvent] = []
    for channel in ride.channels:
        counts = columns.counts(channel)
        empty &= counts == channel.missing
        events += events_of_rows(channel, counts, times)
        pairs[channel.name] = pyramid(counts)
    for channel in columns.derived:
        pairs[channel.name] = pyramid(columns.counts(channel))
    seconds, breaks = None, np.zeros(max(len(times) - 1, 0), dtype=bool)
    if ride.period_us is None:
        breaks = find_breaks(columns, times, ride.metadata.pauses)
        seconds = sample_seconds(times, breaks)
    elif ride.filled:
        seconds = filled_seconds(ride.filled, empty, ride.period_us)
        empty &= ~filled_mask(ride.filled, file.row_count, ride.period_us)
    offered = ride.channels + columns.derived
    result = Digest(
        levels=tuple(
            Level(
                step,
                offered,
                {name: levels[depth][0] for name, levels in pairs.items()},
                {name: levels[depth][1] for name, levels in pairs.items()},
            )
            for depth, step in enumerate(STEPS)
        ),
        summary=summarise(columns, times, ride.period_us, seconds),
        gaps=find_gaps(times, empty, breaks),
        events=tuple(merged(events, ride.events, SAME_EVENT_S)),
        rows_empty=int(np.sum(empty)),
    )
    release_memory()
    return result


def pyramid(counts: Counts) -> list[tuple[Counts, Counts]]:
    """Minimum and maximum of every level of `STEPS`, the finer feeding the coarser."""
    levels = [first_level(counts, STEPS[0])]
    for finer, step in pairwise(STEPS):
        low, high = levels[-1]
        levels.append(reduce_groups(low, high, np.arange(0, len(low), step // finer)))
    return levels


class FileColumns(Mapping[str, Values]):
    """A ride's channels by name as physical values (n,), read or derived when asked for."""

    def __init__(
        self, file: RowSource, channels: tuple[ChannelSpec, ...], gear_ratio: float | None
    ) -> None:
        self._file = file
        self._recorded = {channel.name: channel for channel in channels}
        self._gear_ratio = gear_ratio
        self.derived = derivable(self._recorded.keys(), gear_ratio)

    def __getitem__(self, name: str) -> Values:
        if name not in self._recorded and all(name != c.name for c in self.derived):
            raise KeyError(name)
        values = np.empty(self._file.row_count)
        for start, stop in self._segments():
            values[start:stop] = self._values(name, start, stop)
        return values

    def __iter__(self) -> Iterator[str]:
        yield from self._recorded
        yield from (channel.name for channel in self.derived)

    def __len__(self) -> int:
        return len(self._recorded) + len(self.derived)

    def counts(self, channel: ChannelSpec) -> Counts:
        """Counts (n,) of a recorded or derived channel."""
        if channel.name in self._recorded:
            return self._file.counts([channel.name], 0, self._file.row_count)[channel.name]
        counts = np.empty(self._file.row_count, channel.dtype)
        for start, stop in self._segments():
            counts[start:stop] = channel.to_counts(self._values(channel.name, start, stop))
        return counts

    def _values(self, name: str, start: int, stop: int) -> Values:
        """Physical values of rows [start, stop) of a recorded or derived channel."""
        if name in self._recorded:
            counts = self._file.counts([name], start, stop)[name]
            return self._recorded[name].to_values(counts)
        factors = {factor: self._values(factor, start, stop) for factor in FACTORS[name]}
        return derive(name, factors, self._gear_ratio)

    def _segments(self) -> Iterator[tuple[int, int]]:
        """Stretches of the ride: physical values take four times the room of counts."""
        rows = self._file.row_count
        return ((start, min(start + PIECE_ROWS, rows)) for start in range(0, rows, PIECE_ROWS))
