"""A recorded ride's gaps filled from the unit's own log of it.

    log's rows -> the ride's empty rows at the same unit time -> the same ride, written anew

A recording has gaps where the link was lost; the log has none, but fewer rows. Its rows go where
they were taken and nothing is made up between them: a stretch with a log's row is told as filled,
at the log's rate, and the rest stays a gap. A sample that was recorded is never replaced. Where the
log began earlier or ended later, the ride grows. The new object is written first; one transaction
makes the ride point to it, so a crash leaves the old ride or the new one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from backend.core.channels import Counts
from backend.core.filled import Filled, filled_mask
from backend.core.ride import Ride
from backend.core.ride_events import CLOCK_SET, RideEvent
from backend.formats import ImportedRide
from backend.imports.duplicates import ride_span_us
from backend.store import RideStore
from backend.store.filling import Filling

# The recorder's lead-in, its last second, and the last block of a log make no ride longer.
ENDS_US = 5_000_000
# What a ride may grow to: a day at 100 Hz, as the recorder has it.
ROWS_MAX = 24 * 3600 * 100

Places = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Room:
    """Unit time a ride may have rows in: its own, and what no other ride has."""

    from_us: int
    to_us: int


def fill(
    rides: RideStore,
    candidates: Sequence[Ride],
    imported: ImportedRide,
    upload_id: str | None = None,
) -> int:
    """Fill the rides that a log belongs to; how many rows got samples.

    candidates: those rides, finished, in order of time. upload_id: where the log came from. Raises
    StoreError, Conflict, and then the rides are as they were, or some of them already filled; safe
    to repeat.
    """
    rows = 0
    start_us, stop_us = imported_span_us(imported)
    for number, ride in enumerate(candidates):
        before_us = ride_span_us(candidates[number - 1])[1] if number else start_us
        own = ride_span_us(ride)
        after_us = stop_us if number == len(candidates) - 1 else own[1]
        filling = plan(ride, imported, Room(max(before_us, start_us), after_us))
        if filling is not None:
            rides.fill(ride, filling, upload_id)
            rows += len(filling.places)
    return rows


def imported_span_us(imported: ImportedRide) -> tuple[int, int]:
    """Unit time from a log's first row to behind its last."""
    start_us = imported.context.unit_t0_us or 0
    return start_us, start_us + int(imported.rows.times_us[-1]) + (imported.period_us or 0)


def plan(ride: Ride, imported: ImportedRide, room: Room) -> Filling | None:
    """What the log has for a ride's empty rows, None when nothing."""
    period_us, t0_us = ride.period_us, ride.context.unit_t0_us
    if period_us is None or t0_us is None or imported.period_us is None:
        return None
    log_t0_us = imported.context.unit_t0_us or 0
    has_samples = rows_with_samples(ride, imported)
    unit_us = log_t0_us + imported.rows.times_us[has_samples]
    at = np.rint((unit_us - t0_us) / period_us).astype(np.int64)
    step = max(1, round(imported.period_us / period_us))
    before, after = growth(ride, at, step, room)
    empty = empty_rows(ride, before, after)
    at += before
    fits = (at >= 0) & (at < len(empty))
    fits[fits] &= empty[at[fits]]
    places, first = np.unique(at[fits], return_index=True)
    if not len(places):
        return None
    shift_s = before * period_us / 1e6
    shift_of_log_s = (log_t0_us - t0_us) / 1e6 + shift_s
    spans = spans_of(places, empty, step, period_us, imported.period_us)
    used = [
        replace(span, from_s=span.from_s + shift_s, to_s=span.to_s + shift_s)
        for span in ride.filled
    ]
    return Filling(
        rows_before=before,
        rows_after=after,
        places=places,
        counts=counts_for(ride, imported, has_samples[fits][first]),
        filled=tuple(sorted([*used, *spans], key=lambda span: span.from_s)),
        events=moved(ride.events, shift_s) + moved(events_without_clock(imported), shift_of_log_s),
    )


def rows_with_samples(ride: Ride, imported: ImportedRide) -> Places:
    """Rows of the log that have a sample of a channel the ride has."""
    names = {channel.name for channel in ride.channels}
    has_samples = np.zeros(len(imported.rows.times_us), dtype=bool)
    for channel in imported.rows.channels:
        if channel.name in names:
            has_samples |= imported.rows.counts[channel.name] != channel.missing
    return np.flatnonzero(has_samples)


def growth(ride: Ride, at: Places, step: int, room: Room) -> tuple[int, int]:
    """Rows a ride grows by at its ends. at: rows of the log, counted from the ride's first."""
    period_us, t0_us = ride.period_us or 1, ride.context.unit_t0_us or 0
    lowest, highest = (round((us - t0_us) / period_us) for us in (room.from_us, room.to_us))
    inside = at[(at >= lowest) & (at < highest)]
    if not len(inside):
        return 0, 0
    before = max(0, -int(inside[0]))
    after = max(0, min(int(inside[-1]) + step, highest) - ride.row_count)
    before = before if before * period_us > ENDS_US else 0
    after = after if after * period_us > ENDS_US else 0
    return (before, after) if ride.row_count + before + after <= ROWS_MAX else (0, 0)


def empty_rows(ride: Ride, before: int, after: int) -> npt.NDArray[np.bool_]:
    """Which rows of the grown ride have no sample and are not of a filled stretch."""
    period_us = ride.period_us or 1
    empty = np.zeros(ride.row_count, dtype=bool)
    for gap in ride.gaps:
        start = round(gap.from_s * 1e6 / period_us)
        empty[start : start + (gap.rows_lost or 0)] = True
    empty &= ~filled_mask(ride.filled, ride.row_count, ride.period_us)
    return np.concatenate((np.ones(before, bool), empty, np.ones(after, bool)))


def spans_of(
    places: Places, empty: npt.NDArray[np.bool_], step: int, period_us: int, log_period_us: int
) -> list[Filled]:
    """Stretches that rows at `places` fill: each reaches to the next, at most to the gap's end."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], empty, [False])).astype(np.int8)))
    gap_stops = edges[1::2]
    ends = gap_stops[np.searchsorted(gap_stops, places, side="right")]
    breaks = (np.diff(places) > step + 1) | (np.diff(ends) > 0)
    firsts = np.concatenate(([0], np.flatnonzero(breaks) + 1))
    lasts = np.concatenate((firsts[1:] - 1, [len(places) - 1]))
    spans = []
    for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True):
        start = int(places[first])
        stop = int(min(places[last] + step, ends[last]))
        spans.append(
            Filled(
                from_s=start * period_us / 1e6,
                to_s=stop * period_us / 1e6,
                rows_lost=stop - start,
                rows_filled=last - first + 1,
                period_us=log_period_us,
            )
        )
    return spans


def counts_for(ride: Ride, imported: ImportedRide, rows: Places) -> dict[str, Counts]:
    """The log's samples at `rows` in the counts of the ride's channels."""
    channels_by_name = {channel.name: channel for channel in imported.rows.channels}
    counts_by_name: dict[str, Counts] = {}
    for channel in ride.channels:
        theirs = channels_by_name.get(channel.name)
        if theirs is None:
            continue
        counts = imported.rows.counts[channel.name][rows]
        same = (theirs.scale, theirs.wide) == (channel.scale, channel.wide)
        counts_by_name[channel.name] = (
            counts if same else channel.to_counts(theirs.to_values(counts))
        )
    return counts_by_name


def events_without_clock(imported: ImportedRide) -> tuple[RideEvent, ...]:
    """The events of a log but those of its clock: the ride is dated by its own."""
    return tuple(event for event in imported.events if event.kind != CLOCK_SET)


def moved(events: Sequence[RideEvent], by_s: float) -> tuple[RideEvent, ...]:
    """The same events on a clock that began `by_s` earlier."""
    return tuple(replace(event, t_s=event.t_s + by_s) for event in events)
