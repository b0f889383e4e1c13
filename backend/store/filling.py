"""Rows from elsewhere put into a finished ride's gaps: the ride's new rows, piece by piece."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import PurePosixPath

import numpy as np
import numpy.typing as npt
from sqlalchemy import Connection

from backend.core.channels import Counts
from backend.core.filled import Filled
from backend.core.ride import Ride, RideRows
from backend.core.ride_events import RideEvent
from backend.store.deletion import MADE
from backend.store.objects import Objects
from backend.store.parquet import ROW_GROUP_ROWS, RideFile, read_facts
from backend.store.ride_table import upload_file


@dataclass(frozen=True)
class Filling:
    """What a ride becomes.

    rows_before, rows_after: rows it grows by at either end. places: int64 (m,), rows of the grown
    ride that get samples, increasing and without any so far. counts: by channel, each (m,).
    filled, events: all of the grown ride, times since its new start.
    """

    rows_before: int
    rows_after: int
    places: npt.NDArray[np.int64]
    counts: Mapping[str, Counts]
    filled: tuple[Filled, ...]
    events: tuple[RideEvent, ...]


def grown(ride: Ride, filling: Filling) -> Ride:
    """The ride as it will be, but for what is computed from its rows."""
    earlier_us = filling.rows_before * (ride.period_us or 0)
    t0_us = ride.context.unit_t0_us
    return replace(
        ride,
        started_us=ride.started_us - earlier_us,
        row_count=ride.row_count + filling.rows_before + filling.rows_after,
        context=replace(ride.context, unit_t0_us=None if t0_us is None else t0_us - earlier_us),
        filled=filling.filled,
        events=filling.events,
        # The unit's own log has the end that the recording may have lacked.
        cut_short=False,
    )


def filled_chunks(
    file: RideFile, ride: Ride, filling: Filling, start: int = 0, stop: int | None = None
) -> Iterator[RideRows]:
    """Rows [start, stop) of the grown ride, a row group at a time.

    ride: as it is, with its rows in `file`.
    """
    total = filling.rows_before + file.row_count + filling.rows_after
    end = total if stop is None else min(stop, total)
    for at in range(start, end, ROW_GROUP_ROWS):
        until = min(at + ROW_GROUP_ROWS, end)
        counts = {
            channel.name: np.full(until - at, channel.missing, channel.dtype)
            for channel in ride.channels
        }
        _copy_recorded(file, filling.rows_before, counts, at, until)
        first, last = np.searchsorted(filling.places, (at, until))
        for name, samples in filling.counts.items():
            counts[name][filling.places[first:last] - at] = samples[first:last]
        times_us = np.arange(at, until, dtype=np.int64) * (ride.period_us or 1)
        yield RideRows(ride.channels, times_us, counts)


def _copy_recorded(
    file: RideFile, rows_before: int, counts: dict[str, Counts], at: int, until: int
) -> None:
    """The rows that the ride has, into those of the grown ride from `at` to `until`."""
    first = max(0, at - rows_before)
    last = min(file.row_count, until - rows_before)
    if first >= last:
        return
    place = first + rows_before - at
    for name, recorded in file.counts(list(counts), first, last).items():
        counts[name][place : place + last - first] = recorded


def facts_before(
    connection: Connection, objects: Objects, ride: Ride, upload_id: str | None, part: str
) -> dict[str, object]:
    """Facts of a ride whose rows become others which neither it nor its rows tell.

    upload_id: whose rows these are. part: what this upload is to the ride.
    """
    key = str(ride.object_key)
    facts, _, _ = read_facts(objects.local_path(key))
    original, file = upload_file(connection, ride.upload_id), upload_file(connection, upload_id)
    sources = {name: list(facts.get(name, ())) for name in ("filled_from", "earlier")}
    if part == MADE:
        if upload_id != ride.upload_id:
            sources["earlier"] += [original] if original else []
        original = file
    else:
        sources["filled_from"] += [file] if file else []
    replaces = [PurePosixPath(key).stem, *facts.get("replaces", [])]
    return sources | {"replaces": replaces} | ({"original": original} if original else {})
