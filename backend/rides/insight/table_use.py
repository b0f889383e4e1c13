"""Where a fuzzy table is ridden: seconds and motor energy of each of its cells.

A sample belongs to the at most four cells whose rules fire for it, in the shares that the law's own
sets give it: neighbouring triangles sum to one, beyond the outer points all of it is the outer
set's. So the seconds of all cells together are the seconds of the samples, and those of a column
are the time in which its rules acted, each moment weighted by how much they had to say.

The points are those of the table as it is edited, the moments those in which a mode ran by it then:
a ride keeps its speeds and torque rates, so a table with other points can be asked about as well.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.energy import MOTOR_POWER, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED, SECONDS_PER_HOUR
from backend.core.fuzzy_table import PARAMETERS_OF, point_faults
from backend.core.ride import Ride, iso_utc
from backend.errors import InvalidRequest, ObjectDamaged
from backend.rides.settings_in_force import ConfigOf, Stretch, source_of, stretches
from backend.store import RideReader, Sought, Store

SETS = 5
RATE_STEP = 0.001
RATE_STEPS = 5000
"""To 5, the largest point a table can have."""
PROPOSED_AT = (0.25, 0.5, 0.75, 0.98)
"""Shares of the time in which the torque rose: each set but the last acts for as long."""
PROPOSED_STEP = 0.005
RISING_S_MIN = 60.0
"""Of less time nothing is proposed."""
NEEDED = ("speed_kmh", "torque_rate", "assist_mode", "cadence_rpm")
# What was asked of the motor: a ride has one of them, or both.
DEMAND_CHANNELS = (MOTOR_TORQUE_DEMANDED, MOTOR_TORQUE)
FUZZY_GAIN = "fuzzy_gain"

Cells = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class TableUse:
    """What the cells of one table came to, [speed][torque rate], (5, 5) each.

    seconds: the samples' time. motor_wh: of the samples whose motor power is known, None where no
    sample's is. motor_excluded_s: time of those whose motor power is not. rising_s: time at each
    torque rate, (RATE_STEPS,) of RATE_STEP; while it does not rise is not in it.
    """

    seconds: Cells
    motor_wh: Cells | None
    motor_excluded_s: float
    rising_s: Values

    @classmethod
    def none(cls) -> Self:
        """Of no samples."""
        return cls(np.zeros((SETS, SETS)), None, 0.0, np.zeros(RATE_STEPS))

    def __add__(self, other: TableUse) -> TableUse:
        """Of both their samples."""
        energies = [use.motor_wh for use in (self, other) if use.motor_wh is not None]
        return TableUse(
            self.seconds + other.seconds,
            np.sum(energies, axis=0) if energies else None,
            self.motor_excluded_s + other.motor_excluded_s,
            self.rising_s + other.rising_s,
        )

    def proposed_rates(self) -> tuple[float, ...] | None:
        """Torque-rate points that these rides use evenly; None where they rise for too little time.

        The first stays 0, where the torque holds or falls. The others divide the time in which it
        rises by PROPOSED_AT.
        """
        total_s = float(self.rising_s.sum())
        if total_s < RISING_S_MIN:
            return None
        edges = (np.arange(RATE_STEPS) + 1) * RATE_STEP
        points = [0.0]
        for share in PROPOSED_AT:
            at = edges[np.searchsorted(np.cumsum(self.rising_s), share * total_s)]
            on_step = round(float(at) / PROPOSED_STEP) * PROPOSED_STEP
            points.append(round(max(on_step, points[-1] + PROPOSED_STEP), 3))
        return tuple(points)


def acting(columns: Mapping[str, Values], slots: Collection[int], needs_gain: bool) -> Mask:
    """The samples (n,) in which the rider pedals and the table says what the motor is asked for.

    columns: NEEDED, one of ASKED and, where the ride has it, FUZZY_GAIN; (n,) each, missing as NaN.
    slots: the modes that run by the table. needs_gain: a gain of nothing was not the table's; so it
    is where the unit has none while the torque falls. Walk assist has no gain at all.
    """
    demand = next(columns[name] for name in DEMAND_CHANNELS if name in columns)
    acts = np.isin(columns["assist_mode"], list(slots))
    acts &= (columns["cadence_rpm"] > 0.0) & (demand > 0.0)
    acts &= np.isfinite(columns["speed_kmh"]) & np.isfinite(columns["torque_rate"])
    if FUZZY_GAIN in columns:
        gain = columns[FUZZY_GAIN]
        acts &= gain > 0.0 if needs_gain else np.isfinite(gain)
    return acts


def table_use(
    columns: Mapping[str, Values],
    seconds: Values,
    speed_points_kmh: Sequence[float],
    torque_rate_points: Sequence[float],
) -> TableUse:
    """Time and motor energy of samples (n,) over the cells of a table with these points.

    columns: speed_kmh and torque_rate, finite; motor_power_w where the ride has it, missing as NaN.
    seconds: how long each sample holds (n,). The points: five each, increasing.
    """
    slower, faster = memberships(speed_points_kmh, columns["speed_kmh"])
    lower, higher = memberships(torque_rate_points, columns["torque_rate"])
    places = slower * SETS + lower
    corners = [
        (places, (1.0 - faster) * (1.0 - higher)),
        (places + 1, (1.0 - faster) * higher),
        (places + SETS, faster * (1.0 - higher)),
        (places + SETS + 1, faster * higher),
    ]
    power_w = columns.get(MOTOR_POWER.name, np.full(len(seconds), np.nan))
    valid = np.isfinite(power_w)
    work_wh = np.where(valid, power_w, 0.0) * seconds / SECONDS_PER_HOUR
    return TableUse(
        seconds=spread(corners, seconds),
        motor_wh=spread(corners, work_wh) if valid.any() else None,
        motor_excluded_s=float(np.sum(seconds[~valid])),
        rising_s=rising(columns["torque_rate"], seconds),
    )


def rising(torque_rate: Values, seconds: Values) -> Values:
    """Time at each torque rate (RATE_STEPS,) of samples (n,); what does not rise is left out."""
    steps = np.clip((torque_rate / RATE_STEP).astype(np.intp), 0, RATE_STEPS - 1)
    seconds_in = np.bincount(steps, weights=seconds, minlength=RATE_STEPS).astype(np.float64)
    seconds_in[0] = 0.0
    return seconds_in


def memberships(points: Sequence[float], values: Values) -> tuple[npt.NDArray[np.intp], Values]:
    """For each value (n,) the set below it, 0 to 3, and its share of the set above, 0 to 1."""
    clamped = np.clip(values, points[0], points[-1])
    lower = np.searchsorted(points[1:-1], clamped, side="right")
    at = np.asarray(points, np.float64)
    return lower, (clamped - at[lower]) / (at[lower + 1] - at[lower])


def spread(corners: Sequence[tuple[npt.NDArray[np.intp], Values]], amounts: Values) -> Cells:
    """Amounts (n,) given to cells by places and shares (n,); (5, 5)."""
    cells = np.zeros(SETS * SETS)
    for places, shares in corners:
        cells += np.bincount(places, shares * amounts, minlength=SETS * SETS)
    return cells.reshape(SETS, SETS)


RIDES_MAX = 20
"""What one question costs: 20 rides of two hours at 100 Hz take some seconds of a thread."""
PIECE_ROWS = 1 << 18
"""Rows at once: 44 min at 100 Hz, 20 MB."""

HOLD_ZERO_RATE = "hold_zero_rate"

Points = Mapping[str, Sequence[float]]


class UseOfTable:
    """Looks at rides one after the other; holds nothing of them.

    config_of: a ride's configuration and where it is from. unit_at: the key of the unit that a
    device has now; None for one that is not there.
    """

    def __init__(
        self, store: Store, config_of: ConfigOf, unit_at: Callable[[str], str | None]
    ) -> None:
        self._store = store
        self._config_of = config_of
        self._unit_at = unit_at

    def __call__(
        self,
        speed_points_kmh: Sequence[float],
        torque_rate_points: Sequence[float],
        table: str = "first",
        ride_ids: Sequence[int] | None = None,
        device: str | None = None,
    ) -> dict[str, Any]:
        """The answer as in the API. Raises InvalidRequest, NotFound."""
        points = checked(speed_points_kmh, torque_rate_points)
        rides, more = self._chosen(ride_ids, device)
        total = TableUse.none()
        counted: list[Ride] = []
        without: list[dict[str, Any]] = []
        by_defaults: list[int] = []
        for ride in rides:
            use, source, reason = self._of(ride, table, points)
            if reason is not None:
                without.append({"id": ride.id, **reason})
                continue
            total += use
            counted.append(ride)
            if source == "defaults":
                by_defaults.append(ride.id)
        return {
            "table": table,
            "rides": [ride.id for ride in counted],
            "rides_without": without,
            "rides_by_defaults": by_defaults,
            "more": more,
            "since": iso_utc(min(ride.started_us for ride in counted)) if counted else None,
            **use_answer(total, points),
        }

    def _chosen(
        self, ride_ids: Sequence[int] | None, device: str | None
    ) -> tuple[Sequence[Ride], bool]:
        """The rides to look at, newest first, and whether there are older ones."""
        if ride_ids is not None:
            if device is not None:
                raise InvalidRequest(
                    "Rides were named and a device as well: leave out ride_ids for the device's "
                    "latest rides, or the device."
                )
            named = [self._store.rides.get(ride_id) for ride_id in dict.fromkeys(ride_ids)]
            return sorted(named, key=lambda ride: ride.started_us, reverse=True), False
        unit = None if device is None else self._unit_at(device) or device
        # One more, because the newest may still be going on.
        page = self._store.rides.list(Sought(device=unit), RIDES_MAX + 1)
        over = [ride for ride in page.items if ride.state == "done"]
        return over[:RIDES_MAX], page.next is not None or len(over) > RIDES_MAX

    def _of(
        self, ride: Ride, table: str, points: Points
    ) -> tuple[TableUse, str, dict[str, str] | None]:
        """What a ride adds, where its configuration is from, and why it adds nothing."""
        none = TableUse.none()
        missing = channels_missing(ride)
        if missing:
            message = f"Ride {ride.id} has no {', '.join(missing)}: where it was is not known."
            return none, "", {"code": "missing_channel", "message": message}
        parts = stretches(self._config_of, ride)
        source = source_of(parts)
        try:
            has_table = any(slots_by(part.config, table) for part in parts)
            use = self._use(ride, parts, table, points) if has_table else none
        except ObjectDamaged as damage:
            return none, source, {"code": damage.code, "message": damage.message}
        if not use.seconds.any():
            message = f"On ride {ride.id} no mode gave assist by this table."
            return none, source, {"code": "not_assisted", "message": message}
        return use, source, None

    def _use(self, ride: Ride, parts: Sequence[Stretch], table: str, points: Points) -> TableUse:
        """One ride's use of the table, read piece by piece."""
        reader = self._store.rides.reader(ride.id)
        seconds, names = reader.row_seconds(), names_for_use(reader.ride)
        use = TableUse.none()
        for start, stop, part in pieces(reader, parts):
            slots = slots_by(part.config, table)
            if not slots:
                continue
            columns = reader.values(names, start, stop)
            acts = acting(columns, slots, needs_gain(part.config))
            use += table_use(
                {name: values[acts] for name, values in columns.items()},
                seconds[start:stop][acts],
                points["speed_points_kmh"],
                points["torque_rate_points"],
            )
        return use


def pieces(reader: RideReader, parts: Sequence[Stretch]) -> Iterator[tuple[int, int, Stretch]]:
    """A ride's rows [start, stop), at most `PIECE_ROWS` of one configuration at a time."""
    for part in parts:
        first, end = part.rows(reader)
        for start in range(first, end, PIECE_ROWS):
            yield start, min(start + PIECE_ROWS, end), part


def checked(speed_points_kmh: Sequence[float], torque_rate_points: Sequence[float]) -> Points:
    """The points by their fields. Raises InvalidRequest naming what no table may have."""
    points = {"speed_points_kmh": speed_points_kmh, "torque_rate_points": torque_rate_points}
    faults = [fault for field, five in points.items() for fault in point_faults(field, five)]
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"points of the table: {listed}", "invalid_fuzzy_table", faults)
    return points


def channels_missing(ride: Ride) -> list[str]:
    """What a ride lacks for saying where in a table it was."""
    offered = {channel.name for channel in ride.channels}
    missing = [name for name in NEEDED if name not in offered]
    return missing if offered.intersection(DEMAND_CHANNELS) else [*missing, DEMAND_CHANNELS[-1]]


def slots_by(config: Mapping[str, Any], table: str) -> list[int]:
    """The mode slots that run by a table."""
    laws, numbers = config.get("mode_laws", ()), config.get("mode_tables", ())
    law_number = tuple(PARAMETERS_OF).index(table)
    return [
        slot
        for slot, (law, number) in enumerate(zip(laws, numbers, strict=True))
        if law == "fuzzy" and number == law_number
    ]


def needs_gain(config: Mapping[str, Any]) -> bool:
    """Whether a gain of nothing was not the table's: the unit has none while the torque falls."""
    return bool(config.get("fuzzy_falling_torque", HOLD_ZERO_RATE) != HOLD_ZERO_RATE)


def names_for_use(ride: Ride) -> list[str]:
    """What the view asks for of a ride, some of which it may lack."""
    offered = {channel.name for channel in ride.offered}
    demand = next(name for name in DEMAND_CHANNELS if name in offered)
    return [*NEEDED, demand, FUZZY_GAIN, MOTOR_POWER.name]


def use_answer(use: TableUse, points: Points) -> dict[str, Any]:
    """Sums and cells as in the API."""
    total_s = float(use.seconds.sum())
    wh = use.motor_wh

    def by_point(field: str, axis: int) -> list[dict[str, float | None]]:
        seconds = use.seconds.sum(axis=axis)
        energies = [None] * len(seconds) if wh is None else wh.sum(axis=axis).tolist()
        return [
            {
                "point": point,
                "seconds": float(spent_s),
                "share": float(spent_s) / total_s if total_s else None,
                "motor_wh": energy_wh,
            }
            for point, spent_s, energy_wh in zip(points[field], seconds, energies, strict=True)
        ]

    return {
        "assisted_s": total_s,
        "motor_excluded_s": use.motor_excluded_s,
        "torque_rate_points_proposed": use.proposed_rates(),
        "columns": by_point("torque_rate_points", 0),
        "rows": by_point("speed_points_kmh", 1),
        "cells": {
            "seconds": use.seconds.tolist(),
            "motor_wh": None if wh is None else wh.tolist(),
        },
    }
