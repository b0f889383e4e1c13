"""Two rides, or two windows of one, side by side.

Both are counted from the start of their windows, in seconds or in metres of way. What a unit asked
of its motor is never laid beside what a motor gave: a ride that tells only what was asked has its
torque under the name of what was asked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from backend.core.channels import ChannelSpec, Values
from backend.core.distance import DISTANCE_CHANNELS
from backend.core.energy import (
    DEMANDED,
    MOTOR_TORQUE,
    MOTOR_TORQUE_CRANK,
    MOTOR_TORQUE_DEMANDED,
    MOTOR_TORQUE_DEMANDED_CRANK,
)
from backend.core.ride import Ride
from backend.errors import FieldError, InvalidRequest
from backend.rides.comparison.figures import Stretch, compared
from backend.rides.comparison.grid import Bins, Laid, binned
from backend.rides.comparison.route_overlap import Positions, route_overlap
from backend.rides.comparison.settings_difference import Part, settings_difference
from backend.rides.insight.crank import CrankTorque
from backend.rides.insight.service import ALTITUDE, ANGLE, CADENCE, POWERS, TORQUE, crank_of_ride
from backend.rides.rows import RideColumns, Window, columns_from
from backend.rides.settings_in_force import ConfigOf
from backend.rides.traces.trace import PIXELS_MAX, row_window
from backend.store import RideReader, Store

By = Literal["time", "distance"]
UNITS: dict[By, str] = {"time": "s", "distance": "m"}
PLACES = ("latitude_deg", "longitude_deg")
OF_FIGURES = (*POWERS, *DISTANCE_CHANNELS, ALTITUDE, *PLACES)
OF_CRANK = (ANGLE, TORQUE, CADENCE, MOTOR_TORQUE_CRANK.name)
DEMANDED_NAMES = {
    MOTOR_TORQUE: MOTOR_TORQUE_DEMANDED,
    MOTOR_TORQUE_CRANK.name: MOTOR_TORQUE_DEMANDED_CRANK.name,
}
"""What the motor torque of a ride is that tells only what was asked."""
DIGITS_MORE = 1
"""Of a mean beside a sample."""


class Side:
    """An open ride and the rows [start, stop) of its window."""

    def __init__(self, store: Store, window: Window, name: str) -> None:
        """name: `a` or `b`. Raises NotFound, ObjectDamaged, InvalidRequest for an empty window."""
        self.reader: RideReader = store.rides.reader(window.ride_id)
        self.ride: Ride = self.reader.ride
        try:
            rows = row_window(self.reader, window.from_s, window.to_s)
        except InvalidRequest as error:
            fields = [replace(one, field=f"{name}_{one.field}") for one in error.fields]
            raise InvalidRequest(error.message, fields=fields) from None
        self.start, self.stop, (self.from_s, self.to_s) = rows
        if self.stop == self.start:
            message = f"Ride {window.ride_id} has no row in this window."
            field = FieldError(f"{name}_from_s", "empty_window", message)
            raise InvalidRequest(message, fields=[field])

    @property
    def part(self) -> Part:
        """What it is of its ride."""
        return self.ride, self.from_s, self.to_s

    def columns(self, names: Sequence[str]) -> RideColumns:
        """The window's rows."""
        return columns_from(self.reader, names, self.start, self.stop)

    @cached_property
    def channels(self) -> dict[str, ChannelSpec]:
        """What can be compared, by the name of what it is, with the ride's own channel."""
        names = DEMANDED_NAMES if self.ride.motor_torque_meaning == DEMANDED else {}
        return {names.get(one.name, one.name): one for one in self.ride.offered}

    def laid(self, by: By) -> Laid | None:
        """Rows on an axis; None where nothing tells it."""
        start_s = self.reader.times_us(self.start, self.stop) / 1e6
        seconds = np.asarray(self.reader.row_seconds())[self.start : self.stop]
        if by == "time":
            return Laid(start_s - self.from_s, start_s - self.from_s + seconds, seconds)
        distances = self.columns(DISTANCE_CHANNELS).distances
        if distances is None:
            return None
        at_m = distances.at_m - distances.at_m[0]
        return Laid(at_m, at_m + distances.step_m, seconds)

    def as_json(self) -> dict[str, Any]:
        """The side as in the API."""
        axes = {by: self.laid(by) for by in UNITS}
        return {
            "ride_id": self.ride.id,
            "from_s": self.from_s,
            "to_s": self.to_s,
            "rows": self.stop - self.start,
            "motor_torque_meaning": self.ride.motor_torque_meaning,
            "length_s": end_of(axes["time"]),
            "length_m": end_of(axes["distance"]),
        }


class RideComparison:
    """Compares two rides at a time. Holds nothing of them; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, a: Window, b: Window) -> dict[str, Any]:
        """Figures, settings, ways and what can be drawn, as in the API.

        Raises NotFound, ObjectDamaged, InvalidRequest for a window without rows.
        """
        sides = self._sides(a, b)
        one, other = sides
        rows = [side.columns(OF_FIGURES) for side in sides]
        figures = compared(*(stretch(side, of) for side, of in zip(sides, rows, strict=True)))
        meanings = [side.ride.motor_torque_meaning for side in sides]
        return {
            "a": one.as_json(),
            "b": other.as_json(),
            "figures": [asdict(figure) for figure in figures],
            "motor_torque": "apart" if len({*meanings, None}) == 3 else "alike",
            "channels": [
                {
                    "name": name,
                    "unit": (one.channels.get(name) or other.channels[name]).unit,
                    "a": name in one.channels,
                    "b": name in other.channels,
                }
                for name in {**one.channels, **other.channels}
            ],
            **shared_route(sides, rows),
            "settings": settings_difference(self._config_of, one.part, other.part),
        }

    def crank(self, a: Window, b: Window) -> dict[str, Any]:
        """Torque over the crank's angle of both, and B's less A's. Raises as the comparison."""
        results = [crank_of_ride(side.columns(OF_CRANK)) for side in self._sides(a, b)]
        torques = [one if isinstance(one, CrankTorque) else None for one in results]
        one, other = torques
        difference: dict[str, Any] = {"rider_nm": None, "motor_nm": None}
        if one and other:
            difference["rider_nm"] = bin_differences(one.rider_nm, other.rider_nm)
            if one.motor_nm and other.motor_nm:
                difference["motor_nm"] = bin_differences(one.motor_nm, other.motor_nm)
        return {
            "a": asdict(one) if one else None,
            "b": asdict(other) if other else None,
            "a_refused": results[0] if isinstance(results[0], str) else None,
            "b_refused": results[1] if isinstance(results[1], str) else None,
            "difference": difference,
        }

    def series(
        self,
        a: Window,
        b: Window,
        by: By,
        channels: Sequence[str] | None,
        part: tuple[float, float | None] = (0.0, None),
        pixels: int = 1000,
    ) -> dict[str, Any]:
        """Both rides in bins of one axis, as in the API.

        channels: names as the comparison tells them, None for those that both have. part: of the
        axis, None for its end. Raises as the comparison, and InvalidRequest for a channel that
        neither has, and for an axis that one does not tell.
        """
        sides = self._sides(a, b)
        laid = [require_laid(side, by) for side in sides]
        end = max(end_of(rows) or 0.0 for rows in laid)
        low, high = part[0], end if part[1] is None else part[1]
        if not 0.0 <= low < high or not 1 <= pixels <= PIXELS_MAX:
            message = f"Nothing lies from {low:g} to {high:g} {UNITS[by]} in {pixels} px."
            raise InvalidRequest(message, fields=[FieldError("from_x", "empty_window", message)])
        edges = np.linspace(low, high, pixels + 1)
        names = chosen(sides, channels)
        bins = [bins_of(side, rows, names, edges) for side, rows in zip(sides, laid, strict=True)]
        return {
            "by": by,
            "unit": UNITS[by],
            "end_x": end,
            "x": np.round(edges, 6).tolist(),
            "channels": [channel_comparison(name, sides, bins) for name in names],
            "a_gaps": gaps_of(sides[0], laid[0]),
            "b_gaps": gaps_of(sides[1], laid[1]),
        }

    def _sides(self, a: Window, b: Window) -> tuple[Side, Side]:
        return Side(self._store, a, "a"), Side(self._store, b, "b")


def end_of(laid: Laid | None) -> float | None:
    """Where the last row of an axis stops holding."""
    return None if laid is None else float(laid.until.max())


def require_laid(side: Side, by: By) -> Laid:
    """Rows on an axis. Raises InvalidRequest (`no_axis`) where nothing tells it."""
    laid = side.laid(by)
    if laid is None:
        message = f"Ride {side.ride.id} has no speed and no distance: it cannot be drawn over {by}."
        raise InvalidRequest(message, fields=[FieldError("by", "no_axis", message)])
    return laid


def stretch(side: Side, rows: RideColumns) -> Stretch:
    """A window as its figures are counted."""
    times_us = side.reader.times_us(side.start, side.stop)
    meaning = side.ride.motor_torque_meaning
    return Stretch(rows.values, times_us, side.reader.period_us, rows.seconds, meaning)


def shared_route(sides: tuple[Side, Side], columns: Sequence[RideColumns]) -> dict[str, Any]:
    """Whether both took the same route, or why that is unknown: which has no positions."""
    placed = [all(rows[name] is not None for name in PLACES) for rows in columns]
    if not all(placed):
        return {
            "route_overlap": None,
            "no_route": "neither" if not any(placed) else "ab"[placed[0]],
        }
    comparison = route_overlap(*map(positions, sides, columns))
    return {
        "route_overlap": asdict(comparison) if comparison else None,
        "no_route": None if comparison else "too_few",
    }


def positions(side: Side, rows: RideColumns) -> Positions:
    """Where a window's rows were."""
    latitude, longitude = (rows.values[name] for name in PLACES)
    breaks = side.reader.breaks()[side.start : side.stop - 1]
    at_m = rows.distances.at_m if rows.distances else None
    return Positions(latitude, longitude, rows.start_s, breaks, at_m)


def chosen(sides: tuple[Side, Side], channels: Sequence[str] | None) -> list[str]:
    """The channels that are asked for, or those that both have. Raises InvalidRequest."""
    one, other = sides
    if channels is None:
        return [name for name in one.channels if name in other.channels]
    unknown = [name for name in channels if name not in {**one.channels, **other.channels}]
    if unknown:
        message = f"Neither ride has {', '.join(unknown)}."
        raise InvalidRequest(message, fields=[FieldError("channels", "unknown_channel", message)])
    return list(dict.fromkeys(channels))


def bins_of(side: Side, laid: Laid, names: Sequence[str], edges: Values) -> dict[str, Bins]:
    """The bins of the channels that a side has; only the rows of the part are read."""
    part = laid.part(float(edges[0]), float(edges[-1]))
    own = {name: side.channels[name] for name in names if name in side.channels}
    first = side.start + part.start
    values = side.reader.values(
        [channel.name for channel in own.values()], first, first + part.stop - part.start
    )
    holding = laid.of(part)
    # Between the samples of a log that filled a gap lie rows that hold for no time.
    with_time = np.flatnonzero(holding.seconds > 0.0)
    rows = Laid(holding.at[with_time], holding.until[with_time], holding.seconds[with_time])
    return {name: binned(rows, values[spec.name][with_time], edges) for name, spec in own.items()}


def channel_comparison(
    name: str, sides: tuple[Side, Side], bins: Sequence[Mapping[str, Bins]]
) -> dict[str, Any]:
    """One channel of both, and the difference of their means where both have one."""
    spec = sides[0].channels.get(name) or sides[1].channels[name]
    digits = max(0, -int(np.floor(np.log10(spec.scale)))) + DIGITS_MORE
    one, other = (of.get(name) for of in bins)
    difference = None if one is None or other is None else rounded(other.mean - one.mean, digits)
    return {
        "name": name,
        "unit": spec.unit,
        "a": extremes(one, digits),
        "b": extremes(other, digits),
        "difference": difference,
    }


def extremes(bins: Bins | None, digits: int) -> dict[str, Any] | None:
    """Least and greatest of a side; None where it has no such channel."""
    if bins is None:
        return None
    return {"min": rounded(bins.minimum, digits), "max": rounded(bins.maximum, digits)}


def rounded(values: Values, digits: int) -> list[float | None]:
    """Numbers for JSON, missing as None."""
    return [None if value != value else value for value in np.round(values, digits).tolist()]


def gaps_of(side: Side, laid: Laid) -> list[dict[str, float]]:
    """Stretches of the axis without samples, as in the API."""
    start_s = side.reader.times_us(side.start, side.stop) / 1e6
    last = len(start_s) - 1

    def place(t_s: float) -> float:
        return float(laid.at[min(int(np.searchsorted(start_s, t_s)), last)])

    inside = [gap for gap in side.ride.gaps if gap.to_s > start_s[0] and gap.from_s < start_s[-1]]
    return [{"from_x": place(gap.from_s), "to_x": place(gap.to_s)} for gap in inside]


def bin_differences(a: Sequence[float], b: Sequence[float]) -> list[float]:
    """B less A, bin by bin."""
    return [other - one for one, other in zip(a, b, strict=True)]
