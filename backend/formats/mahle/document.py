"""What such a file tells, gathered as it is met: points, figures of the ride, its two clocks.

Nobody publishes the format. Three real files (2024, repository Byggvir/Radtouren) prove their units
by saying things twice: `gd` ends at `total_distance` and at the length of the track in metres;
3.6 * `ride_distance` / `ride_time` is `avg_speed`; the mean of `rw` above 0 is `avg_rider_watts`,
the largest `cp` is `max_cadence`; `cc` falls by `consumed_capacity` (82.8), while `po` times `vl`
adds up to 81.1 Wh; `mw` is 0.83 of it; `sl` is the rise of `ge` over 100 of `gd`; `tm` is at rest
the air's temperature and rises to 46 with the motor alone. `or`, `bc` and `max_torque` prove
nothing: they are kept under their own names, without a unit.

Points carry the rider's local time, `start_date` and `stop_date` UTC, as the place of the rides
shows. The difference is the zone; where it is none, the zone is asked.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime, timedelta, timezone, tzinfo
from math import isfinite
from typing import Any

import numpy as np

from backend.core.calendar import zone_of
from backend.core.channels import Values
from backend.core.device_metadata import (
    PAUSES_MAX,
    DeviceFigure,
    DeviceMetadata,
    DeviceSession,
    Instrument,
    Pause,
    within,
)
from backend.formats.cells import Growing, as_written, iso_moment, number, step_of, unix_seconds
from backend.formats.columns import FIT_FIELDS, FieldRule, rides_of_columns
from backend.formats.local_times import times_in_zone
from backend.formats.mahle.walk import TIME
from backend.formats.outcome import ImportedRide
from backend.formats.own_channels import Column, rule
from backend.formats.questions import TableAnswer, TableQuestion, lacking

BATTERY, WARNING, PAUSED = "bt", "aw", "PAUSE"
RULES = {rule.channel.name: rule for rule in FIT_FIELDS}
# What a point and its first battery say -> our channel, in its unit.
CHANNELS = {
    "la": "latitude_deg",
    "lo": "longitude_deg",
    "ge": "altitude_m",
    "gd": "distance_m",
    "sl": "grade_pct",
    "sp": "speed_kmh",
    "cp": "cadence_rpm",
    "rw": "rider_power_w",
    "mw": "motor_power_w",
    "tm": "motor_temperature_degc",
    "al": "assist_mode",
    "bt_sc": "battery_soc_pct",
    "bt_vl": "battery_voltage_v",
    "bt_po": "battery_current_a",
}
OTHERS = {"bt_tm": ("battery_temperature_degc", "degC"), "bt_cc": ("battery_left_wh", "Wh")}
# Figures of the whole ride and their units; "" where nothing proves one.
FIGURE_UNITS = {
    "total_distance": "m",
    "ride_distance": "m",
    "ride_time": "s",
    "avg_speed": "km/h",
    "max_speed": "km/h",
    "avg_cadence": "rpm",
    "max_cadence": "rpm",
    "min_rider_watts": "W",
    "avg_rider_watts": "W",
    "max_rider_watts": "W",
    "consumed_capacity": "Wh",
    "consumed_percentage": "%",
    "calories": "",
    "max_motor": "",
    "max_torque": "",
    "battery_cycles": "",
}
STARTS, STOPS, SERIAL, BATTERIES = "start_date", "stop_date", "object_serial", "batteries"
# Zones are whole quarters of an hour; the first point comes so soon after the start.
QUARTER_S, SUMMER_S, SOON_S, ZONE_MAX_S = 900.0, 3600.0, 300.0, 14 * 3600.0
KIND = "ride of Mahle's My SmartBike"
# Unix time of every point (n,), NaN for none, and what the file does not say and was taken as.
Clock = tuple[Values, Mapping[str, str]]
# Every such file lacks the same, and shares its answer.
QUESTION = TableQuestion(hashlib.sha256(KIND.encode()).hexdigest(), KIND, time_zone=True)


class Document:
    """What a file tells, as it is met."""

    def __init__(self) -> None:
        self._points = Growing()
        self._moments: list[datetime | None] = []
        self._paused: list[int] = []
        self._members: dict[str, str] = {}
        self._figures: dict[str, DeviceFigure] = {}

    def member(self, name: str, value: Any) -> None:
        """A member of the document that is no point."""
        if name == BATTERIES and isinstance(value, list):
            for place, battery in enumerate(value[:4]):
                for key, figure in battery.items() if isinstance(battery, dict) else ():
                    self._figure(key if place == 0 else f"{key}_{place + 1}", key, figure)
        elif name in (STARTS, STOPS, SERIAL) and isinstance(value, str):
            self._members[name] = value[:100]
        elif not self._figure(name, name, value) and value is not None:
            self._points.unread.setdefault(plain(name), 1)

    def _figure(self, name: str, key: str, value: Any) -> bool:
        parsed = number(value) if isinstance(value, str) else float("nan")
        if key not in FIGURE_UNITS or not isfinite(parsed):
            return False
        self._figures[name] = DeviceFigure(name, parsed, FIGURE_UNITS[key])
        return True

    def point(self, point: dict[str, Any]) -> None:
        """A point of the ride."""
        cells: dict[str, str] = {}
        for key, value in point.items():
            if key == BATTERY and isinstance(value, list):
                for place, battery in enumerate(value[:4]):
                    before = BATTERY if place == 0 else f"{BATTERY}{place + 1}"
                    for name, content in battery.items() if isinstance(battery, dict) else ():
                        cells[f"{before}_{plain(name)}"] = cell(content)
            elif key == WARNING and value == PAUSED:
                self._paused.append(len(self._moments))
            elif key != TIME:
                cells[plain(key)] = cell(value)
        self._moments.append(iso_moment(str(point.get(TIME, ""))[:40]))
        self._points.add(cells)

    def clock(self, answer: TableAnswer | None, damaged: bool) -> Clock | None:
        """When every point was; None where the zone must be asked."""
        moments = [moment for moment in self._moments if moment is not None]
        if all(moment.tzinfo for moment in moments):
            return self._times(None), {}
        shift_s = shift_of(moments[0], iso_moment(self._members.get(STARTS, "")))
        stopped = None if damaged else iso_moment(self._members.get(STOPS, ""))
        if shift_s is not None and not clock_changed(moments[-1], stopped, shift_s):
            zone = timezone(timedelta(seconds=shift_s))
            return self._times(zone), {"clock": f"{zone}"}
        if answer is None or answer.time_zone is None or lacking(QUESTION, answer):
            return None
        return self._times(zone_of(answer.time_zone)), {"time_zone": answer.time_zone}

    def _times(self, zone: tzinfo | None) -> Values:
        """Unix time of every point (n,), NaN for none. zone: of those that name none."""
        return times_in_zone(self._moments, zone)

    def rides(self, times: Values, taken_as: Mapping[str, str]) -> list[ImportedRide]:
        """Its rides: one, unless it breaks off for hours."""
        read, rules = ruled(self._points.values())
        unread = self._points.unread
        rides_read = rides_of_columns(times, read, rules, "e_biking", unread)
        metadata = self._metadata(times)
        return [
            replace(
                ride,
                metadata=within(
                    metadata, ride.started_us / 1e6, float(ride.rows.times_us[-1]) / 1e6
                ),
                intake=replace(ride.intake, taken_as=taken_as) if ride.intake else None,
            )
            for ride in rides_read
        ]

    def _metadata(self, times: Values) -> DeviceMetadata:
        spans = [times[at : at + 2].tolist() for at in self._paused if at + 1 < len(times)]
        pauses = [Pause(from_s, to_s) for from_s, to_s in spans if to_s > from_s]
        serial = self._members.get(SERIAL, "").encode("ascii", "ignore").decode() or None
        bike = Instrument("light_electric_vehicle", "mahle_ebikemotion", serial_number=serial)
        figures = tuple(self._figures.values())
        known_times = times[np.isfinite(times)]
        statements = (
            (DeviceSession(float(known_times.min()), float(known_times.max()), figures),)
            if figures and len(known_times)
            else ()
        )
        return DeviceMetadata((), tuple(pauses[:PAUSES_MAX]), (bike,), statements)

    def ridden_share(self) -> float | None:
        """Of the time between the start and the stop the file names, what its points cover."""
        moments = [moment for moment in self._moments if moment is not None]
        ends = [iso_moment(self._members.get(name, "")) for name in (STARTS, STOPS)]
        total_s = unix_seconds(ends[1]) - unix_seconds(ends[0])
        if not moments or not total_s > 0:
            return None
        return min(
            max((unix_seconds(moments[-1]) - unix_seconds(moments[0])) / total_s, 0.0), 0.999
        )


def ruled(columns: Mapping[str, Values]) -> tuple[dict[str, Values], tuple[FieldRule, ...]]:
    """Columns by a name of their own, and the rule of each."""
    read: dict[str, Values] = {}
    rules = []
    for key, values in columns.items():
        if key in CHANNELS:
            base_rule = replace(RULES[CHANNELS[key]], sources=(key,), factor=1.0)
            rules.append(as_written(base_rule, {key: values}))
        else:
            name, unit = OTHERS.get(key, (key if key not in RULES else f"{key}_of_file", ""))
            rules.append(replace(rule(name, Column(values, unit, step_of(values))), sources=(key,)))
        read[key] = values
    return read, tuple(rules)


def shift_of(local: datetime, utc: datetime | None) -> float | None:
    """How far a local clock is from UTC, s; None where it is too far from a whole quarter of an
    hour to tell."""
    difference_s = unix_seconds(local) - unix_seconds(utc)
    if not abs(difference_s) <= ZONE_MAX_S + SOON_S:
        return None
    shift_s = QUARTER_S * round(difference_s / QUARTER_S)
    return shift_s if abs(difference_s - shift_s) <= SOON_S else None


def clock_changed(local: datetime, utc: datetime | None, shift_s: float) -> bool:
    """Whether at the ride's end the local clock is an hour off what it was: summer time began or
    ended. Which points were before, only the zone tells."""
    late_s = abs(unix_seconds(local) - unix_seconds(utc) - shift_s)
    return abs(late_s - SUMMER_S) <= SOON_S


def cell(value: Any) -> str:
    """A value of JSON as a cell: of a number its text, of nothing nothing, of others no number."""
    if value is None:
        return ""
    return value if isinstance(value, str) and value.strip() else "?"


def plain(name: str, length: int = 24) -> str:
    """A name as our channels have them, whatever the file calls it."""
    safe = "".join(c if c.isascii() and c.isalnum() else "_" for c in name.lower())[:length]
    return safe if safe[:1].isalpha() else f"field_{safe}"
