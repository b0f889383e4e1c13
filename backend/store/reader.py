"""A ride's rows and overview for the views, from the object or, while it is live, from its tail.

Overviews and footers of the rides last looked at stay in memory, so that zooming costs a row
group and not the whole way. The cache is bounded by rides: a 2 h ride's overview takes 1 MB.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Protocol

import numpy as np

from backend.core.breaks import Mask
from backend.core.channels import ChannelSpec, Counts, Values
from backend.core.energy import FACTORS, derive, sample_seconds
from backend.core.filled import filled_seconds
from backend.core.pyramid import STEPS, Level
from backend.core.ride import Ride, RideRows, TimesUs, breaks_at
from backend.errors import StoreError
from backend.store.soundness import CHANGED, damaged_samples
from backend.store.sql.blobs import Rows16

READERS_CACHED = 8

LoadLevel = Callable[[int, int], Level | None]


class RowSource(Protocol):
    """Where the recorded channels' rows come from."""

    @property
    def row_count(self) -> int: ...
    def times_us(self, start: int, stop: int) -> TimesUs: ...
    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]: ...


class LiveRows:
    """Rows of a ride that is still being recorded, held in memory: int16 (n, channels)."""

    def __init__(self, ride: Ride, rows: Rows16) -> None:
        self._rows = rows
        self._period_us = ride.period_us or 1
        self._place = {channel.name: index for index, channel in enumerate(ride.channels)}

    @property
    def row_count(self) -> int:
        return len(self._rows)

    def times_us(self, start: int, stop: int) -> TimesUs:
        return np.arange(start, stop, dtype=np.int64) * self._period_us

    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]:
        return {name: self._rows[start:stop, self._place[name]].copy() for name in names}


class RideReader:
    """Rows of one ride: recorded channels as stored, derived ones computed on the way."""

    def __init__(self, ride: Ride, source: RowSource, load_level: LoadLevel) -> None:
        self.ride = ride
        self._source = source
        self._load_level = load_level
        self._levels: dict[int, Level | None] = {}
        self._times: TimesUs | None = None
        self._recorded = {channel.name: channel for channel in ride.channels}
        self._derived = {channel.name: channel for channel in ride.derived}

    @property
    def source(self) -> RowSource:
        """Where the rows are."""
        return self._source

    @property
    def row_count(self) -> int:
        """Rows that can be read."""
        return self._source.row_count

    @property
    def period_us(self) -> int | None:
        """Spacing of the rows, None when they are irregular."""
        return self.ride.period_us

    @property
    def offered(self) -> tuple[ChannelSpec, ...]:
        """Recorded and derived channels."""
        return self.ride.offered

    def times_us(self, start: int, stop: int) -> TimesUs:
        """Times of rows [start, stop), microseconds since the ride's start."""
        if self.ride.period_us is not None:
            return np.arange(start, stop, dtype=np.int64) * self.ride.period_us
        if self._times is None:
            with self._reporting_damage():
                self._times = self._source.times_us(0, self.row_count)
        return self._times[start:stop]

    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]:
        """Counts of rows [start, stop) of recorded or derived channels; KeyError for others."""
        needed: dict[str, None] = {}
        for name in names:
            needed |= dict.fromkeys([name] if name in self._recorded else FACTORS[name])
        with self._reporting_damage():
            stored = self._source.counts(list(needed), start, stop)
        return {
            name: stored[name] if name in self._recorded else self._derive(name, stored)
            for name in names
        }

    def values(
        self, names: Sequence[str], start: int = 0, stop: int | None = None
    ) -> dict[str, Values]:
        """Values of rows [start, stop), missing as NaN, of those of the channels that it has."""
        offered = {channel.name: channel for channel in self.offered}
        chosen = [name for name in names if name in offered]
        counts = self.counts(chosen, start, self.row_count if stop is None else stop)
        return {name: offered[name].to_values(counts[name]) for name in chosen}

    def row_seconds(self) -> Values:
        """How long the sample of each row (n,) holds; see core.filled, core.energy."""
        ride, count = self.ride, self.row_count
        if ride.period_us is None:
            return sample_seconds(self.times_us(0, count), self.breaks())
        if not ride.filled:
            return np.broadcast_to(np.float64(ride.period_us / 1e6), (count,))
        speed = self._recorded["speed_kmh"]
        empty = self.counts([speed.name], 0, count)[speed.name] == speed.missing
        return filled_seconds(ride.filled, empty, ride.period_us)

    def breaks(self) -> Mask:
        """Which steps from row to row (n - 1,) are breaks in which nobody knows what was."""
        count = self.row_count
        if self.ride.period_us is not None:
            return np.zeros(max(count - 1, 0), dtype=bool)
        return breaks_at(self.ride.gaps, self.times_us(0, count))

    def chunks(self, names: Sequence[str], rows: int) -> Iterator[RideRows]:
        """The whole ride, `rows` rows at a time."""
        offered = {channel.name: channel for channel in self.offered}
        channels = tuple(offered[name] for name in names)
        for start in range(0, self.row_count, rows):
            stop = min(start + rows, self.row_count)
            counts = self.counts(names, start, stop)
            yield RideRows(channels, self.times_us(start, stop), counts)

    def level(self, rows_per_bin: int) -> Level | None:
        """The coarsest level whose cells are no longer than a bin; None when raw rows are due."""
        steps = [step for step in STEPS if step <= rows_per_bin]
        if not steps or self.ride.state != "done":
            return None
        step = steps[-1]
        if step not in self._levels:
            self._levels[step] = self._load_level(self.ride.id, step)
        return self._levels[step]

    @contextmanager
    def _reporting_damage(self) -> Iterator[None]:
        """A page whose checksum is wrong is damage of this ride."""
        try:
            yield
        except StoreError as error:
            raise damaged_samples(self.ride.id, self.ride.object_key or "", CHANGED) from error

    def _derive(self, name: str, stored: dict[str, Counts]) -> Counts:
        factors = {
            factor: self._recorded[factor].to_values(stored[factor]) for factor in FACTORS[name]
        }
        values = derive(name, factors, self.ride.context.gear_ratio)
        return self._derived[name].to_counts(values)


class ReaderCache:
    """Readers of the finished rides last looked at, the oldest given up first."""

    def __init__(self) -> None:
        self._readers: OrderedDict[int, RideReader] = OrderedDict()
        self._lock = threading.Lock()
        self._forgotten = 0

    def get(self, ride_id: int, open_reader: Callable[[], RideReader]) -> RideReader:
        """The reader of a ride, opened when it is not there; live rides are never kept."""
        with self._lock:
            if ride_id in self._readers:
                self._readers.move_to_end(ride_id)
                return self._readers[ride_id]
            forgotten = self._forgotten
        reader = open_reader()
        if reader.ride.state == "done":
            with self._lock:
                # One that changed or went while it was opened is not kept.
                if self._forgotten == forgotten:
                    self._readers[ride_id] = reader
                while len(self._readers) > READERS_CACHED:
                    self._readers.popitem(last=False)
        return reader

    def forget(self, ride_id: int) -> None:
        """Drop a ride's reader."""
        with self._lock:
            self._forgotten += 1
            self._readers.pop(ride_id, None)
