"""A ride's rows as the views of insight read them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from backend.core.channels import Values
from backend.core.distance import RowDistances, row_distances
from backend.core.ride import Ride
from backend.store import RideReader, Store


@dataclass(frozen=True)
class Window:
    """A ride and a part of it, seconds since its start; None for its ends."""

    ride_id: int
    from_s: float | None = None
    to_s: float | None = None


@dataclass(frozen=True)
class RideColumns:
    """values: the asked channels that the ride has, (n,) each, missing as NaN. start_s, seconds:
    when each row begins, since the ride's start, and how long it holds."""

    ride: Ride
    values: dict[str, Values]
    start_s: Values
    seconds: Values

    def __getitem__(self, name: str) -> Values | None:
        return self.values.get(name)

    @cached_property
    def distances(self) -> RowDistances | None:
        """Of rides that were asked for DISTANCE_CHANNELS."""
        return row_distances(self.values, self.start_s, self.seconds)


def columns_of(store: Store, ride_id: int, names: Sequence[str]) -> RideColumns:
    """The whole ride: 6 MB a channel of two hours at 100 Hz. Raises NotFound, ObjectDamaged."""
    reader = store.rides.reader(ride_id)
    return columns_from(reader, names)


def columns_from(
    reader: RideReader, names: Sequence[str], start: int = 0, stop: int | None = None
) -> RideColumns:
    """The rows [start, stop) of an open ride, all of them unless it says which."""
    end = reader.row_count if stop is None else stop
    values = reader.values(list(dict.fromkeys(names)), start, end)
    start_s = reader.times_us(start, end) / 1e6
    return RideColumns(reader.ride, values, start_s, np.asarray(reader.row_seconds())[start:end])
