"""Settings for a wish: a few honest knobs turned on the rider's own road, ridden again by its twin.

Each knob stands for something a tuner would turn by hand and stays within what the registry allows.
What a wish means is measured on the twin's ride: energy for a kilometre, or how fast the torque
changes, as rms, where it is felt. Its largest change no twin forecasts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.energy import KMH_PER_MS, SECONDS_PER_HOUR
from backend.core.fuzzy_table import LABELS, PARAMETERS_OF, FuzzyTable
from backend.errors import InvalidRequest
from backend.law.market import cutoff_of
from backend.law.twin import RoadTwin
from sim_device.firmware.python.law import STEP_S, parameter_range
from sim_device.firmware.python.twin import Totals

Floats = npt.NDArray[np.float64]
Config = Mapping[str, Any]

KNOBS = ("ratio", "band", "filter", "torque_rate", "cells")
TARGET_PCT = {"more_range": 10.0, "gentler_start": 20.0, "flatter_at_the_limit": 20.0}

RATIO_SHARES = (0.5, 1.6)
"""Of each ridden mode's own ratio."""
RATE_SCALES = (0.5, 2.0)
FILTER_S_MIN = 0.2
"""Faster, the motor follows the stroke (docs/torque-filter.md)."""
FILTER_S_MAX = 1.0
CELL_KNOBS = 9
"""The first cell, four steps down with speed and four up with torque rate."""

START_KMH = 12.0
LIMIT_KMH = 3.0
"""So far below the cut-off speed a rider feels the limit come and go."""
RISE_S_MIN = 3.0
SAMPLE_STEPS = 5
SAMPLE_S = SAMPLE_STEPS * STEP_S


@dataclass(frozen=True, slots=True)
class Ridden:
    """What rides came to, one after the other. aim: what the wish wants small."""

    aim: float
    totals: tuple[Totals, ...]

    @property
    def battery_j(self) -> float:
        """Of all rides."""
        return sum(told.battery_j for told in self.totals)

    @property
    def duration_s(self) -> float:
        """Of all rides."""
        return sum(told.duration_s for told in self.totals)

    def cost(self, before: Ridden, objective: str) -> float:
        """What the wish takes, per cent: time for range; else what changed beside the wish, of time
        and of energy."""
        time_pct = 100.0 * (self.duration_s / before.duration_s - 1.0)
        if objective == "more_range":
            return time_pct
        battery_pct = 100.0 * (self.battery_j / max(before.battery_j, 1.0) - 1.0)
        return abs(time_pct) + abs(battery_pct)


class Space:
    """The knobs of a configuration as a point of numbers from 0 to 1.

    start: the point of what is set now, as near as the knobs can say it. knobs: those that do
    something with these settings on these rides.
    """

    def __init__(self, config: Config, modes: Sequence[int], knobs: Sequence[str]) -> None:
        """modes: the slots that were ridden. Raises InvalidRequest where no knob is left."""
        self.config = config
        self._modes = [slot for slot in modes if config["mode_laws"][slot] != "off"]
        fuzzy = [slot for slot in self._modes if config["mode_laws"][slot] == "fuzzy"]
        self.which = "second" if fuzzy and config["mode_tables"][fuzzy[0]] else "first"
        dead = set() if fuzzy else {"torque_rate", "cells"}
        if config["torque_filter"] == "half_turn":
            dead.add("filter")
        if not self._modes:
            dead.update(KNOBS)
        self.knobs = tuple(knob for knob in KNOBS if knob in knobs and knob not in dead)
        if not self.knobs:
            raise InvalidRequest(
                "None of these knobs changes anything in the modes that were ridden.", "no_knob"
            )
        self.start = np.concatenate([self._start(knob) for knob in self.knobs])

    def parts(self) -> list[slice]:
        """Which numbers of a point are of each knob."""
        sizes = [CELL_KNOBS if knob == "cells" else 1 for knob in self.knobs]
        ends = np.cumsum(sizes)
        return [slice(int(end - size), int(end)) for end, size in zip(ends, sizes, strict=True)]

    def changes(self, point: Floats) -> dict[str, Any]:
        """The parameters that differ from what is set now, by registry name.

        point: (n,); a knob whose numbers are NaN is not touched.
        """
        changed: dict[str, Any] = {}
        for knob, part in zip(self.knobs, self.parts(), strict=True):
            if not np.isnan(point[part]).any():
                changed |= self._turned(knob, point[part])
        return {name: value for name, value in changed.items() if value != self.config[name]}

    def _start(self, knob: str) -> Floats:
        config = self.config
        if knob == "ratio":
            return placed([1.0], *RATIO_SHARES)
        if knob == "band":
            return placed(
                [config["assist_cutoff_band_kmh"]], *parameter_range("assist_cutoff_band_kmh")
            )
        if knob == "filter":
            return placed([config["torque_filter_s"]], FILTER_S_MIN, FILTER_S_MAX)
        if knob == "torque_rate":
            return placed([0.0], *np.log(RATE_SCALES))
        labels = FuzzyTable.from_parameters(config, self.which).label_indices().astype(np.float64)
        down, up = -np.diff(labels.mean(axis=1)), np.diff(labels.mean(axis=0))
        return np.concatenate((placed([labels[0, 0]], 0.0, 4.0), np.clip([*down, *up], 0.0, 1.0)))

    def _turned(self, knob: str, at: Floats) -> dict[str, Any]:
        config = self.config
        if knob == "ratio":
            low, high = parameter_range("mode_ratios")
            share = between(at[0], *RATIO_SHARES)
            ratios = list(config["mode_ratios"])
            for slot in self._modes:
                ratios[slot] = rounded(ratios[slot], ratios[slot] * share, low, high, 2)
            return {"mode_ratios": ratios}
        if knob in ("band", "filter"):
            name = "assist_cutoff_band_kmh" if knob == "band" else "torque_filter_s"
            low, high = parameter_range(name)
            if knob == "filter":
                low, high = max(low, FILTER_S_MIN), min(high, FILTER_S_MAX)
            digits = 1 if knob == "band" else 2
            return {name: rounded(config[name], between(at[0], low, high), low, high, digits)}
        if knob == "torque_rate":
            name = "fuzzy_torque_rate_points"
            low, high = parameter_range(name)
            scale = float(np.exp(between(at[0], *np.log(RATE_SCALES))))
            return {name: [rounded(old, old * scale, low, high, 3) for old in config[name]]}
        return self._cells(at)

    def _cells(self, at: Floats) -> dict[str, Any]:
        """A monotone table of steps of one label at most, on a surface that is as monotone."""
        names = PARAMETERS_OF[self.which]
        speed = np.concatenate(([0.0], np.cumsum(at[1:5])))
        rate = np.concatenate(([0.0], np.cumsum(at[5:9])))
        labels = np.clip(4.0 * at[0] - speed[:, None] + rate[None, :], 0.0, 4.0)
        rules = [[LABELS[label] for label in row] for row in np.floor(labels + 0.5).astype(int)]
        return {names["rules"]: rules, names["inference"]: "weighted_average"}


def placed(values: Sequence[float], low: float, high: float) -> Floats:
    """Where values lie between two ends, 0 to 1."""
    return np.clip((np.asarray(values, np.float64) - low) / (high - low), 0.0, 1.0)


def between(share: float, low: float, high: float) -> float:
    """The value at a share of the way."""
    return float(low + share * (high - low))


def rounded(old: float, new: float, low: float, high: float, digits: int) -> float:
    """As a person would type it; the old value where it rounds to the same."""
    value = round(min(max(new, low), high), digits)
    return old if value == round(old, digits) else value


class Road:
    """Rides that are ridden again as one: the twins, and what the wish is measured by."""

    def __init__(self, twins: Sequence[RoadTwin], objective: str, config: Config) -> None:
        """config: of the rides. Raises InvalidRequest where a wish cannot be evaluated on them."""
        self._twins = twins
        self._objective = objective
        self._crank_per_motor = float(config["gear_ratio"])
        cutoff = cutoff_of(config)
        self._cutoff_kmh = cutoff.holds_kmh if cutoff else 25.0
        self.distance_km = sum(float(twin.ride.distance_m[-1]) for twin in twins) / 1000.0
        before = self.ridden(config)
        if before is None or before.aim <= 0.0:
            raise InvalidRequest(
                "These rides do not tell this wish: they have too little of what it is measured"
                f" by. {MEASURED[objective]}",
                "wish_not_told",
            )
        self.before = before

    @property
    def modes(self) -> list[int]:
        """The slots that were ridden, the one ridden longest first."""
        recorded_slots = np.concatenate([twin.ride.mode for twin in self._twins])
        slots, counts = np.unique(recorded_slots, return_counts=True)
        return [int(slot) for slot in slots[np.argsort(-counts)]]

    def ridden(self, config: Config) -> Ridden | None:
        """The rides with this configuration; None where a unit would not take it or the bike
        would have stood."""
        rises, totals = [], []
        for twin in self._twins:
            try:
                totals_now, samples = twin.ridden(config, twin.rider, SAMPLE_STEPS)
            except InvalidRequest:
                return None
            if totals_now.gave_up:
                return None
            totals.append(totals_now)
            rises.append(self._rises(samples))
        all_rises = np.concatenate(rises)
        if self._objective == "more_range":
            battery_j = sum(totals_now.battery_j for totals_now in totals)
            aim = battery_j / SECONDS_PER_HOUR / self.distance_km
        elif all_rises.size * SAMPLE_S < RISE_S_MIN:
            return None
        else:
            aim = float(np.sqrt(np.mean(all_rises**2)))
        return Ridden(aim, tuple(totals))

    def _rises(self, samples: npt.NDArray[np.void]) -> Floats:
        """How fast the torque at the crank changes where the wish looks, Nm/s (k,)."""
        kmh = samples["speed_ms"][1:] * KMH_PER_MS
        nm_per_s = np.diff(samples["motor_nm"]) * self._crank_per_motor / SAMPLE_S
        if self._objective == "gentler_start":
            return np.maximum(nm_per_s[(kmh > 0.5) & (kmh < START_KMH)], 0.0)
        return np.asarray(nm_per_s[kmh > self._cutoff_kmh - LIMIT_KMH])


MEASURED = {
    "more_range": "Range needs a motor that helped.",
    "gentler_start": f"A start needs {RISE_S_MIN:g} s below {START_KMH:g} km/h with the motor.",
    "flatter_at_the_limit": (
        f"The limit needs {RISE_S_MIN:g} s within {LIMIT_KMH:g} km/h of the cut-off speed."
    ),
}


def gained_pct(objective: str, before: float, after: float) -> float:
    """How much of the wish came true, per cent."""
    if objective == "more_range":
        return 100.0 * (before / after - 1.0)
    return 100.0 * (1.0 - after / before)
