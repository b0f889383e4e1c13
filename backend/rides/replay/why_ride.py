"""Why the motor gave what it gave at a moment of a ride, and where it was held back.

The configuration is the one that was in force at the moment; without it nothing is explained,
because the steps would be another unit's. The law remembers: averages, ramps and what the market's
mean allows. So its C runs from the start of the ride's segment, ten minutes at most, and the last
step is reported.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from backend import law
from backend.core.channels import Values
from backend.core.energy import DELIVERED, MOTOR_TORQUE
from backend.core.ride import Ride
from backend.errors import Conflict, InvalidRequest
from backend.law import law_defaults
from backend.rides.replay.service import LIMITS, law_inputs, read_columns, remembered_rows
from backend.rides.settings_in_force import ConfigOf
from backend.store import Store
from backend.tuning.why import number, why_json

HOLDING_LIMITS = (
    "speed_cutoff",
    "brake",
    "motor_torque",
    "battery_current",
    "motor_speed",
    "battery_voltage",
    "temperature",
    "fault",
    "market",
)
"""Limits that hold back who pedals. Ramps and tapers belong to how a mode feels."""
CUT_HOLE_S = 1.0
"""A cut that returns within this time goes on: the two strokes of a turn leave holes."""
CUT_S_MIN = 0.2
CUTS_MAX = 2000
RECORDED = ("fuzzy_gain", "motor_torque_demanded_nm", "assist_ratio")
ROUNDING = {"fuzzy_gain": 0.002, "assist_ratio": 0.004}
"""How far a figure may be off because it and the readings are rounded: ten times and more what 300
moments of simulated rides had. What is asked of a motor at its limit turns on readings between two
samples."""


class WhyRide:
    """Explains moments of rides. Holds nothing of them; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int, t_s: float) -> dict[str, Any]:
        """The answer as in the API.

        t_s: seconds since the ride's start. Raises NotFound; Conflict `no_table` where the ride's
        configuration is not known; InvalidRequest for a ride that lacks what the law needs and for
        a moment without a sample.
        """
        reader = self._store.rides.reader(ride_id)
        config = self._recorded_config(reader.ride, t_s)
        period_us = reader.period_us or 0
        row = round(t_s * 1e6 / max(period_us, 1))
        rows = remembered_rows(reader, row, row + 1)
        first = min(int(rows.min()), reader.row_count)
        columns = read_columns(reader, first, min(int(rows.max()) + 1, reader.row_count))
        if row >= reader.row_count or not np.isfinite(columns["speed_kmh"][row - first]):
            raise InvalidRequest(
                f"Ride {ride_id} has no sample at {t_s:g} s: choose a moment that was recorded.",
                code="no_sample",
            )
        step_s = period_us / 1e6
        columns = {name: values[rows - first] for name, values in columns.items()}
        readings = law_inputs(columns)
        delivered = self._delivered_nm(reader.ride, columns)
        why = law.why(config, readings, step_s=step_s, delivered_nm=delivered)
        moment = {"kind": "ride", "ride_id": ride_id, "t_s": row * step_s, "hold_s": None}
        recorded = {
            name: number(columns[name][-1]) if name in columns else None for name in RECORDED
        }
        worked_out = {"fuzzy_gain": why.gain, "assist_ratio": why.assist_ratio}
        return why_json(why, config, readings, moment, "ride", recorded) | {
            "warmed_up_s": (row - first) * step_s,
            "differs": differing(recorded, worked_out),
        }

    def cuts(self, ride_id: int) -> list[dict[str, Any]]:
        """Stretches in which a limit held the motor back, in order of time, as the unit told it."""
        reader = self._store.rides.reader(ride_id)
        columns = reader.values([LIMITS])
        if LIMITS not in columns or reader.period_us is None:
            return []
        return cuts_of(np.nan_to_num(columns[LIMITS]).astype(np.uint16), reader.period_us / 1e6)

    def _recorded_config(self, ride: Ride, t_s: float) -> Mapping[str, Any]:
        config, source = self._config_of(ride, t_s)
        if source != "ride":
            raise Conflict(
                f"Nobody kept the configuration that ride {ride.id} was made with, so why the "
                "motor gave what it gave is not known.",
                code="no_table",
            )
        return {**law_defaults(), **config}

    def _delivered_nm(self, ride: Ride, columns: Mapping[str, Values]) -> float | None:
        """At the motor's shaft; what was only asked of it is not that."""
        if ride.motor_torque_meaning != DELIVERED:
            return None
        return number(columns[MOTOR_TORQUE][-1])


def differing(
    recorded: Mapping[str, float | None], worked_out: Mapping[str, float | None]
) -> list[dict[str, Any]]:
    """Figures of the law that the unit told otherwise, by more than rounding."""
    return [
        {"figure": name, "recorded": sent, "worked_out": here}
        for name, rounding in ROUNDING.items()
        if (sent := recorded[name]) is not None
        and (here := worked_out[name]) is not None
        and abs(sent - here) > rounding
    ]


def cuts_of(flags: np.ndarray[Any, np.dtype[np.uint16]], step_s: float) -> list[dict[str, Any]]:
    """`{from_s, to_s, at_s, limits}` of each stretch of flags (n,) that holds back.

    At most CUTS_MAX. at_s: a moment near its middle in which a limit is at work.
    """
    limited = np.flatnonzero(flags & sum(law.LIMITS[name] for name in HOLDING_LIMITS))
    if not len(limited):
        return []
    ends = np.flatnonzero(np.diff(limited) > round(CUT_HOLE_S / step_s))
    firsts, lasts = (
        limited[np.append(0, ends + 1)],
        limited[np.append(ends, len(limited) - 1)],
    )
    long_enough = (lasts - firsts + 1) * step_s >= CUT_S_MIN
    cuts = []
    for first, last in zip(firsts[long_enough], lasts[long_enough], strict=True):
        middle = limited[np.searchsorted(limited, (first + last) // 2)]
        all_of = int(np.bitwise_or.reduce(flags[first : last + 1]))
        cuts.append(
            {
                "from_s": float(first * step_s),
                "to_s": float((last + 1) * step_s),
                "at_s": float(middle * step_s),
                "limits": [name for name in HOLDING_LIMITS if law.LIMITS[name] & all_of],
            }
        )
    return cuts[:CUTS_MAX]
