"""Minimum and maximum of any channels over any window, in as many bins as the screen has pixels.

How a window is cut:
- Few rows: each row is its own bin (`kind` = `rows`), minimum and maximum are the row's value.
- Regular rows: every bin has the same number of rows (the last may have fewer). From 128 rows a bin
  on, bins are made of whole cells of the pyramid; the window then grows by less than one bin at
  either end, and the bins' own times say so.
- Irregular rows (head units): bins of equal time, cut at pauses; bins without rows are left out,
  and one missing bin stands in each pause, so that no line is ever drawn across it.
- Over another axis than time (`traces.axis_positions`): bins of equal length of that axis, cut at
  pauses and where the axis' own channel falls silent, always from raw rows; a missing bin as above.
In each case the minimum and maximum of a bin are exactly those of the rows from its first to its
last time, both included.

Binary form, little-endian, `application/octet-stream`:
    bytes 0..3    "SPV1"
    bytes 4..7    u32 H, length of the header; 8 + H is a multiple of 8
    bytes 8..8+H  header, JSON in UTF-8, padded with spaces
    then          the arrays; their offsets count bytes from the first byte after the header
The header:
    {"from_s", "to_s":       the window that was asked for, seconds since the ride's start
     "rows":                 rows of the ride in the bins
     "bins": n,              length of every array
     "kind":                 "rows" | "minmax"
     "axis":                 "time" | "moving" | "distance"
     "x_first", "x_last":    as the times below, in seconds in motion or metres; absent for "time"
     "t_first_s": {"dtype": "float64", "offset"},  time of a bin's first row
     "t_last_s":  {"dtype": "float64", "offset"},  time of its last row
     "channels": [{"name", "unit", "scale", "dtype": "int16" | "int32", "missing",
                   "min_offset", "max_offset"}]}
value = count * scale, and count == missing means there is no sample. Every offset is a multiple of
8. For `rows` the first and last times, and minimum and maximum, are one array: equal offsets.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec, Counts, Values
from backend.core.pyramid import Level, reduce_groups
from backend.errors import FieldError, InvalidRequest
from backend.rides.traces.axes import Axis, AxisPositions, Rows, require_axis_positions

MAGIC = b"SPV1"
# A screen has at most this many columns; more would only cost the browser memory.
PIXELS_MAX = 10_000
ALIGNMENT = 8

Starts = npt.NDArray[np.int64]


class RideReader(Rows, Protocol):
    """A ride's rows and its overview; the store's reader offers both."""

    def level(self, rows_per_bin: int) -> Level | None: ...


@dataclass(frozen=True)
class Trace:
    """Bins of a window; arrays as the module's docstring tells. x: x_first and x_last."""

    from_s: float
    to_s: float
    rows: int
    kind: str
    t_first_s: Values
    t_last_s: Values
    channels: tuple[ChannelSpec, ...]
    minimum: Mapping[str, Counts]
    maximum: Mapping[str, Counts]
    axis: Axis = "time"
    x: tuple[Values, Values] | None = None

    def to_json(self) -> dict[str, object]:
        """Plain JSON with physical values, missing as null."""
        return {
            "from_s": self.from_s,
            "to_s": self.to_s,
            "rows": self.rows,
            "bins": len(self.t_first_s),
            "kind": self.kind,
            "axis": self.axis,
            "t_first_s": self.t_first_s.tolist(),
            "t_last_s": self.t_last_s.tolist(),
            "x_first": None if self.x is None else self.x[0].tolist(),
            "x_last": None if self.x is None else self.x[1].tolist(),
            "channels": [
                {
                    "name": channel.name,
                    "unit": channel.unit,
                    "min": json_values(channel, self.minimum[channel.name]),
                    "max": json_values(channel, self.maximum[channel.name]),
                }
                for channel in self.channels
            ],
        }

    def to_bytes(self) -> bytes:
        """The binary form of the module's docstring."""
        body = bytearray()
        placed: dict[int, int] = {}

        def place(array: npt.NDArray[np.generic]) -> int:
            if id(array) not in placed:
                body.extend(bytes(-len(body) % ALIGNMENT))
                placed[id(array)] = len(body)
                body.extend(array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes())
            return placed[id(array)]

        other = {
            name: {"dtype": "float64", "offset": place(array)}
            for name, array in zip(("x_first", "x_last"), self.x or (), strict=False)
        }
        header = {
            "from_s": self.from_s,
            "to_s": self.to_s,
            "rows": self.rows,
            "bins": len(self.t_first_s),
            "kind": self.kind,
            "axis": self.axis,
            **other,
            "t_first_s": {"dtype": "float64", "offset": place(self.t_first_s)},
            "t_last_s": {"dtype": "float64", "offset": place(self.t_last_s)},
            "channels": [
                {
                    "name": channel.name,
                    "unit": channel.unit,
                    "scale": channel.scale,
                    "dtype": channel.dtype.name,
                    "missing": channel.missing,
                    "min_offset": place(self.minimum[channel.name]),
                    "max_offset": place(self.maximum[channel.name]),
                }
                for channel in self.channels
            ],
        }
        text = json.dumps(header, separators=(",", ":")).encode()
        text += b" " * (-(8 + len(text)) % ALIGNMENT)
        return MAGIC + struct.pack("<I", len(text)) + text + bytes(body)


def trace(
    ride: RideReader,
    names: Sequence[str] | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    pixels: int = 1000,
    axis: Axis = "time",
) -> Trace:
    """Bins of the window [from_s, to_s] of a ride, at most `pixels` of them (pauses come on top).

    names: channels, recorded or derived, None for all. from_s, to_s: seconds since the ride's
    start whatever the axis, None for its ends. Raises InvalidRequest for unknown channels, a window
    of no width, and an axis that the ride does not tell.
    """
    channels = chosen(ride, names)
    if not 1 <= pixels <= PIXELS_MAX:
        raise refusal("px", "out_of_range", f"px is {pixels}: it must be from 1 to {PIXELS_MAX}.")
    start, stop, window = row_window(ride, from_s, to_s)
    rows_per_bin = -(-(stop - start) // pixels)
    if ride.period_us is None or axis != "time":
        return uneven_trace(ride, channels, start, stop, window, pixels, axis)
    level = ride.level(rows_per_bin)
    if level is not None:
        return pyramid_trace(ride, channels, level, start, stop, window, rows_per_bin)
    starts = np.arange(0, stop - start, max(rows_per_bin, 1))
    return reduced(ride, channels, start, stop, window, starts)


def refusal(field: str, code: str, message: str) -> InvalidRequest:
    """The refusal of one field of the question."""
    return InvalidRequest(message, fields=[FieldError(field, code, message)])


def chosen(ride: RideReader, names: Sequence[str] | None) -> tuple[ChannelSpec, ...]:
    """The ride's channels of these names, in this order."""
    offered = {channel.name: channel for channel in ride.offered}
    unknown = [name for name in names or () if name not in offered]
    if unknown:
        message = f"This ride has no channel {', '.join(unknown)}. It has {', '.join(offered)}."
        raise refusal("channels", "unknown_channel", message)
    return tuple(offered[name] for name in dict.fromkeys(offered if names is None else names))


def row_window(
    ride: RideReader, from_s: float | None, to_s: float | None
) -> tuple[int, int, tuple[float, float]]:
    """Rows [start, stop) whose time lies in the window, and the window in seconds."""
    count = ride.row_count
    last_us = int(ride.times_us(count - 1, count)[0]) if count else 0
    begin_s = 0.0 if from_s is None else from_s
    end_s = last_us / 1e6 if to_s is None else to_s
    if not (np.isfinite(begin_s) and np.isfinite(end_s)) or end_s < begin_s:
        field = "from_s" if to_s is None else "to_s"
        message = f"The window from {begin_s} s to {end_s} s has no width."
        raise refusal(field, "empty_window", message)
    begin_us = round(min(max(begin_s, 0.0) * 1e6, 2.0**62))
    end_us = round(min(max(end_s, -1.0) * 1e6, 2.0**62))
    if ride.period_us is not None:
        start = min(-(-begin_us // ride.period_us), count)
        stop = min(end_us // ride.period_us + 1, count)
    else:
        times = ride.times_us(0, count)
        start = int(np.searchsorted(times, begin_us, side="left"))
        stop = int(np.searchsorted(times, end_us, side="right"))
    return start, max(stop, start), (begin_s, end_s)


def reduced(
    ride: RideReader,
    channels: tuple[ChannelSpec, ...],
    start: int,
    stop: int,
    window: tuple[float, float],
    starts: Starts,
) -> Trace:
    """Bins over the raw rows [start, stop), beginning at `starts` counted from `start`."""
    rows = stop - start
    counts = ride.counts([channel.name for channel in channels], start, stop)
    times = ride.times_us(start, stop) / 1e6
    if len(starts) == rows:
        return Trace(*window, rows, "rows", times, times, channels, counts, counts)
    pairs = {name: reduce_groups(array, array, starts) for name, array in counts.items()}
    ends = np.append(starts[1:], rows) - 1
    minimum = {name: pair[0] for name, pair in pairs.items()}
    maximum = {name: pair[1] for name, pair in pairs.items()}
    return Trace(*window, rows, "minmax", times[starts], times[ends], channels, minimum, maximum)


def pyramid_trace(
    ride: RideReader,
    channels: tuple[ChannelSpec, ...],
    level: Level,
    start: int,
    stop: int,
    window: tuple[float, float],
    rows_per_bin: int,
) -> Trace:
    """Bins of whole cells of one level, over regular rows."""
    period_us = ride.period_us or 1
    cells_per_bin = -(-rows_per_bin // level.step)
    first, last = start // level.step, -(-stop // level.step)
    starts = np.arange(0, last - first, cells_per_bin)
    pairs = {
        channel.name: reduce_groups(
            level.minimum[channel.name][first:last],
            level.maximum[channel.name][first:last],
            starts,
        )
        for channel in channels
    }
    first_rows = (starts + first) * level.step
    covered = min(last * level.step, ride.row_count)
    last_rows = np.append(first_rows[1:], covered) - 1
    return Trace(
        *window,
        rows=covered - first * level.step,
        kind="minmax",
        t_first_s=first_rows * period_us / 1e6,
        t_last_s=last_rows * period_us / 1e6,
        channels=channels,
        minimum={name: pair[0] for name, pair in pairs.items()},
        maximum={name: pair[1] for name, pair in pairs.items()},
    )


def uneven_trace(
    ride: RideReader,
    channels: tuple[ChannelSpec, ...],
    start: int,
    stop: int,
    window: tuple[float, float],
    pixels: int,
    axis: Axis,
) -> Trace:
    """Bins of equal length of an axis, cut at pauses, with a missing bin in each pause."""
    positions = require_axis_positions(ride, axis)
    at = positions.at[start:stop]
    times = ride.times_us(start, stop)
    paused = ride.breaks()[start : max(stop - 1, start)]
    cut = cuts(positions, start, stop)
    if len(times) <= pixels:
        starts = np.arange(len(times))
    else:
        # A nanometre or a nanosecond: the axis may stand over the whole window.
        width = max((at[-1] - at[0]) / pixels, 1e-9)
        bins = np.minimum((at - at[0]) // width, pixels - 1)
        starts = np.concatenate(([0], np.flatnonzero((np.diff(bins) > 0) | paused | cut) + 1))
    bare = reduced(ride, channels, start, stop, window, starts)
    if axis != "time" and len(times):
        ends = np.append(starts[1:], len(times)) - 1
        bare = replace(bare, axis=axis, x=(at[starts], at[ends]))
    breaks = np.flatnonzero(paused[starts[1:] - 1]) + 1
    return opened(bare, breaks) if len(breaks) else bare


def cuts(positions: AxisPositions, start: int, stop: int) -> npt.NDArray[np.bool_]:
    """Before which of the rows [start + 1, stop) a bin ends because the axis' channel does."""
    cut = np.zeros(max(stop - start - 1, 0), np.bool_)
    edges = positions.edges[(positions.edges > start) & (positions.edges < stop)]
    cut[edges - start - 1] = True
    return cut


def opened(bare: Trace, breaks: Starts) -> Trace:
    """With a missing bin put in before each of `breaks`, in the middle of the pause."""
    same = bare.kind == "rows"

    def between(first: Values, last: Values, into: Values) -> Values:
        return np.insert(into, breaks, (last[breaks - 1] + first[breaks]) / 2.0)

    first, last = bare.t_first_s, bare.t_last_s
    t_first = between(first, last, first)
    minimum = {c.name: interrupted(c, bare.minimum[c.name], breaks) for c in bare.channels}
    maximum = {c.name: interrupted(c, bare.maximum[c.name], breaks) for c in bare.channels}
    x = bare.x
    return replace(
        bare,
        t_first_s=t_first,
        t_last_s=t_first if same else between(first, last, last),
        minimum=minimum,
        maximum=minimum if same else maximum,
        x=None if x is None else (between(*x, into=x[0]), between(*x, into=x[1])),
    )


def interrupted(channel: ChannelSpec, counts: Counts, breaks: Starts) -> Counts:
    """Counts with a missing one put in before each of `breaks`."""
    widened: Counts = np.insert(counts, breaks, channel.missing).astype(counts.dtype)
    return widened


def json_values(channel: ChannelSpec, counts: Counts) -> list[float | None]:
    """Physical values rounded to what the scale can carry, missing as None."""
    digits = max(0, -int(np.floor(np.log10(channel.scale)))) + 2
    missing = channel.missing
    return [
        None if count == missing else round(count * channel.scale, digits)
        for count in counts.tolist()
    ]
