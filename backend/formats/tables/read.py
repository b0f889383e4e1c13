"""A table to rides, or to the question what its owner must say first."""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from backend.core.calendar import zone_of
from backend.core.channels import ChannelSpec, Values
from backend.core.intake import Intake
from backend.formats.cells import COLUMNS_MAX, as_written, step_of
from backend.formats.columns import LATITUDE, LONGITUDE, FieldRule, rides_of_columns
from backend.formats.outcome import (
    COMPLETE,
    NEEDS_MAPPING,
    PARTIAL,
    ImportedRide,
    Outcome,
    rejected,
)
from backend.formats.own_channels import Column, rules_of
from backend.formats.questions import (
    LEFT_OUT,
    TIME,
    TableAnswer,
    TableColumn,
    TableQuestion,
    lacking,
)
from backend.formats.tables.layouts import Layout, layout_of
from backend.formats.tables.measures import (
    ANY_POWER,
    POWER_CHANNELS,
    RULES,
    Measure,
    measure_in,
    measure_of,
    named_unit,
    own_rule,
    split_unit,
    words,
)
from backend.formats.tables.numbers import Numbers, numbers_of, table_mark
from backend.formats.tables.text import cells_of, decoded
from backend.formats.tables.times import (
    Times,
    columns_of_time,
    start_in_preamble,
    texts,
    times_of,
)

ROWS_MAX = 2_000_000
SAMPLES = 5
ROWS_OF_MARK = 200
"""Rows that show a table's decimal mark."""
ELECTRIC = frozenset(
    {"battery_voltage_v", "battery_current_a", "motor_current_a", "battery_soc_pct"}
)
MOTOR_TEMPERATURES = ("motor_temperature_degc", "controller_temperature_degc")
# A logger's power is of readings that it averages otherwise than its volts and amperes.
PRODUCT_SHARE, PRODUCT_W_MIN = 0.1, 10.0
# Rates a Cycle Analyst writes at, and how near its odometer must come to one.
LOGGER_RATES_HZ, NEAR = (1.0, 5.0, 10.0), 0.15
# The rate is looked at over so many rows, if at least so far was ridden in them, in the log's unit.
RATE_ROWS, RATE_DISTANCE = 120, 0.02


def read_table(data: bytes, name: str = "", answer: TableAnswer | None = None) -> Outcome:
    """A table -> what came of it. Never raises on any bytes.

    name: of the file, whose date counts where the table has none. answer: what its owner said.
    """
    text = decoded(data)
    if not text.strip("\ufeff \t\r\n"):
        return rejected("empty_file", "The file is empty.", 0)
    try:
        cells = cells_of(text.lstrip("\ufeff\r\n"))
    except csv.Error as error:
        return rejected("damaged", f"The table cannot be read: {error}.")
    if len(cells.rows) > ROWS_MAX:
        return rejected("too_many_rows", f"{len(cells.rows)} rows; at most {ROWS_MAX} are read.")
    layout = layout_of(cells.rows)
    if layout is None:
        return rejected("no_valid_time", "No column of the table names a time.")
    body = [row for row in cells.rows[layout.data_row :] if any(cell.strip() for cell in row)]
    if body and len(body[-1]) < len(layout.names) and not text.endswith(("\n", "\r")):
        # Where a file was cut, it was cut within a number.
        body[-1][-1] = ""
    if layout.preamble and not layout.start:
        layout = replace(layout, start=start_in_preamble(cells.rows[: layout.preamble]))
    return Table(layout, body, cells.separator, name, answer or TableAnswer()).read()


class Table:
    """One table, its columns as they are understood. answer: what its owner stated of it."""

    def __init__(
        self,
        layout: Layout,
        body: list[list[str]],
        separator: str,
        name: str,
        answer: TableAnswer,
    ) -> None:
        self._layout, self._body, self._name, self._answer = layout, body, name, answer
        self._time = columns_of_time(layout, body)
        self._numbers = self._read_numbers(separator)
        self._measures = {
            place: measure
            for place in self._numbers
            if (measure := self._measure(layout.names[place], self._numbers[place])) is not None
        }
        self._powers = self._open_powers()

    def read(self) -> Outcome:
        """Rides, or what must be stated before."""
        layout, answer = self._layout, self._answer
        columns = {
            place: one.values
            for place, one in self._numbers.items()
            if np.isfinite(one.values).any()
        }
        if not columns:
            times_apart = self._time.places
            names = [name for at, name in enumerate(layout.names) if at not in times_apart]
            sentence = f"No column of {', '.join(names[:12])} is a known channel or a number."
            return rejected("no_records", sentence)
        zone = zone_of(answer.time_zone) if answer.time_zone else None
        if layout.rows_are_time and layout.row_s is None:
            layout = replace(layout, row_s=row_spacing(layout, columns, answer.rows_per_second))
        times = times_of(layout, self._body, self._time, self._name, zone, answer.date_order)
        question = self._question(times, layout)
        if missing := lacking(question, answer):
            kind = f"{layout.kind[0].upper()}{layout.kind[1:]}"
            detail = f"{kind} that does not say: {', '.join(missing)}. Say it once, and every file "
            detail += "with this header is read."
            return replace(rejected(NEEDS_MAPPING, detail), question=question)
        return replace(self._outcome(times, layout, columns, question), question=question)

    def _read_numbers(self, separator: str) -> dict[int, Numbers]:
        """Every column that is no time, by place."""
        places = [
            place
            for place in range(min(len(self._layout.names), COLUMNS_MAX))
            if place not in self._time.places
        ]
        looked = (
            row[place] for row in self._body[:ROWS_OF_MARK] for place in places if place < len(row)
        )
        mark = table_mark(looked, separator)
        return {place: numbers_of(texts(self._body, place), mark) for place in places}

    def _measure(self, name: str, numbers: Numbers) -> Measure | None:
        """What a column is: as its owner stated, by the layout's format, else by its header."""
        stated = self._answer.channels.get(name)
        if stated is not None:
            _, of_layout = layout_unit(self._layout, name) or ("", None)
            unit = split_unit(name)[1] or numbers.unit or of_layout
            return measure_in(stated, unit) if stated in RULES else None
        header = name
        if numbers.unit is not None and split_unit(name)[1] is None:
            header = f"{name} ({numbers.unit})"
        return measured(self._layout, name, header)

    def _open_powers(self) -> set[int]:
        """Columns whose power may be anybody's; those that the columns beside settle are settled.

        Volts times amperes is the battery's power. Beside a cadence it is the rider's, as without
        any sign of a motor.
        """
        by_channel = {m.rule.channel.name: place for place, m in reversed(self._measures.items())}
        open_ones = set()
        for place, measure in self._measures.items():
            name = self._layout.names[place]
            if (
                measure.rule.channel.name != "rider_power_w"
                or words(split_unit(name)[0]) not in ANY_POWER
                or words(name) in self._layout.units
                or name in self._answer.channels
            ):
                continue
            volts, amps = (by_channel.get(c) for c in ("battery_voltage_v", "battery_current_a"))
            if (
                volts is not None
                and amps is not None
                and is_product(
                    self._numbers[place].values,
                    self._numbers[volts].values,
                    self._numbers[amps].values,
                )
            ):
                self._measures[place] = measure_in("battery_power_w", measure.unit)
            elif ELECTRIC & by_channel.keys() and "cadence_rpm" not in by_channel:
                open_ones.add(place)
        return open_ones

    def _unread(self) -> dict[str, int]:
        """Cells that are there and no number, by column."""
        return {
            self._layout.names[place]: one.unread
            for place, one in self._numbers.items()
            if one.unread
        }

    def _question(self, times: Times, layout: Layout) -> TableQuestion:
        header = "\x1f".join([layout.kind, *(words(name) for name in layout.names)])
        columns = [self._column(place, name) for place, name in enumerate(layout.names)]
        return TableQuestion(
            hashlib.sha256(header.encode()).hexdigest(),
            layout.kind,
            times.naive,
            layout.rows_are_time and layout.row_s is None,
            times.order_open,
            tuple(columns),
        )

    def _column(self, place: int, name: str) -> TableColumn:
        samples = tuple(row[place][:40] for row in self._body[:SAMPLES] if place < len(row))
        if place in self._time.places:
            return TableColumn(name, TIME, samples=samples)
        numbers, measure = self._numbers.get(place), self._measures.get(place)
        if numbers is None:
            return TableColumn(name, samples=samples)
        if measure is None:
            unit = named_unit(name, numbers.unit)
            return TableColumn(name, unit=unit, samples=samples, unread=numbers.unread)
        channel = measure.rule.channel.name
        channels: tuple[str, ...] = ()
        if place in self._powers:
            channels = (*POWER_CHANNELS, LEFT_OUT)
        elif numbers.mostly_unread and name not in self._answer.channels:
            channels, samples = (channel, LEFT_OUT), numbers.samples
        choices = measure.choices if measure.unit is None else ()
        return TableColumn(name, channel, measure.unit, choices, samples, channels, numbers.unread)

    def _outcome(
        self,
        times: Times,
        layout: Layout,
        columns: dict[int, Values],
        question: TableQuestion,
    ) -> Outcome:
        answer = self._answer
        read, rules = self._ruled(columns, answer)
        taken_as = {
            column.name: answer.units[column.name] for column in question.columns if column.units
        }
        if question.time_zone and answer.time_zone:
            taken_as["time_zone"] = answer.time_zone
        if layout.rows_are_time and layout.row_s:
            taken_as["rows_per_second"] = f"{1.0 / layout.row_s:g}"
        if times.start_of is not None:
            taken_as["start"] = times.start_of
        if question.date_order and answer.date_order:
            taken_as["date_order"] = answer.date_order
        for name, channel in answer.channels.items():
            if name in layout.names:
                unit = answer.units.get(name)
                taken_as[name] = f"{channel}, {unit}" if channel and unit else channel or "left out"
        unread = self._unread()
        rides: list[ImportedRide] = []
        for rows in parts_of(layout, columns, len(self._body)):
            own = {name: values[rows] for name, values in read.items()}
            rides += rides_of_columns(times.time_s[rows], own, rules, None, unread)
            unread = {}
        if not rides:
            sentence = f"None of the {len(self._body)} rows has a believable time and a value."
            return rejected("no_valid_time", sentence)
        read_rides = tuple(
            replace(ride, intake=with_table(ride.intake, taken_as, times)) if ride.intake else ride
            for ride in rides
        )
        # A short row without a time is a note between the rows, as a sum of each lap.
        timed = np.isfinite(times.time_s)
        lengths = np.array([len(row) for row in self._body])
        short = int(np.sum(timed & (lengths < len(layout.names))))
        if short:
            row_count = sum(len(ride.rows.times_us) for ride in read_rides)
            share = 1.0 - short / max(len(self._body), 1)
            detail = (
                f"{short} of {len(self._body)} rows are cut short; {row_count} rows were saved."
            )
            return Outcome(PARTIAL, read_rides, "truncated", detail, None, share)
        return Outcome(COMPLETE, read_rides, completeness=1.0)

    def _ruled(
        self, columns: Mapping[int, Values], answer: TableAnswer
    ) -> tuple[dict[str, Values], tuple[FieldRule, ...]]:
        """Numbers by a name of their own, and the rule of each; the first of a channel counts."""
        read: dict[str, Values] = {}
        rules: dict[str, FieldRule] = {}
        others: dict[str, Column] = {}
        names = self._layout.names
        stated_first = sorted(columns, key=lambda place: not answer.channels.get(names[place]))
        for place in stated_first:
            values, column_name = columns[place], names[place]
            measure = self._measures.get(place)
            channel = measure.rule.channel.name if measure else ""
            # A controller without the sensor writes zeros.
            is_absent = channel in MOTOR_TEMPERATURES and not np.nan_to_num(values).any()
            if measure is None or channel in rules or is_absent:
                others[own_name(column_name, others)] = Column(values, "", step_of(values))
                continue
            unit = measure.unit if measure.unit is not None else answer.units[column_name]
            rule, added = measure.in_unit(unit)
            if added:
                values, rule = values * rule.factor + added, replace(rule, factor=1.0)
            rule = replace(rule, sources=(channel,))
            read[channel] = values
            rules[channel] = rule if measure.own else as_written(rule, {channel: values})
        for rule in rules_of(others, None):
            if rule.sources[0] in others and rule.channel.name not in rules:
                read[rule.sources[0]] = others[rule.sources[0]].values
                rules[rule.channel.name] = rule
        if self._layout.satellite_altitude and {LATITUDE, LONGITUDE, "altitude_m"} <= read.keys():
            # A receiver without a fix writes zeros.
            nowhere = (read[LATITUDE] == 0) & (read[LONGITUDE] == 0)
            read["altitude_m"] = np.where(nowhere, np.nan, read["altitude_m"])
        return read, tuple(rules.values())


def with_table(intake: Intake, taken_as: Mapping[str, str], times: Times) -> Intake:
    """An intake with what is known of the whole table."""
    restarts = dict(intake.restarts) | ({"time": times.restarts} if times.restarts else {})
    return replace(intake, taken_as=taken_as, restarts=restarts)


def is_product(power: Values, volts: Values, amps: Values) -> bool:
    """Whether a power (n,) is that of a voltage and a current, rounded or not."""
    product = volts * amps
    valid = np.isfinite(power) & np.isfinite(product) & (np.abs(product) > PRODUCT_W_MIN)
    if not valid.any():
        return False
    off = np.abs(power[valid] - product[valid])
    return bool(np.mean(off <= PRODUCT_SHARE * np.abs(product[valid]) + 1.0) >= 0.9)


def measured(layout: Layout, column_name: str, header: str) -> Measure | None:
    """What a column is: by the layout's format, else by its own header."""
    given_unit = layout_unit(layout, column_name)
    if given_unit is None:
        return measure_of(header)
    channel, unit = given_unit
    choices = layout.choices.get(words(column_name), ())
    if channel not in RULES:
        rule = FieldRule(ChannelSpec(channel, unit or "", 0.1), (channel,), -3276, 3276)
        return Measure(rule, unit)
    measure = measure_in(channel, unit)
    return replace(measure, choices=choices) if choices else measure


def layout_unit(layout: Layout, column_name: str) -> tuple[str, str | None] | None:
    """Channel and unit of a column that a layout's format defines."""
    name, _ = split_unit(column_name)
    return layout.units.get(words(column_name)) or layout.units.get(words(name))


def own_name(column_name: str, taken: Mapping[str, object]) -> str:
    """A name for a column that no rule knows; not one that means something here."""
    name = "_".join(words(column_name).encode("ascii", "ignore").decode().split())[:36]
    if not name[:1].isalpha() or own_rule(name) is not None or name in RULES or name in taken:
        name = f"column_{name}".rstrip("_")
    number, free = 1, name
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free


def row_spacing(
    layout: Layout, columns: Mapping[int, Values], rows_per_second: float | None
) -> float | None:
    """Seconds of a row of a logger that writes no time: by its odometer, else as was said.

    What the speed adds up to between two kilometres is what the odometer says, at one rate.
    """
    given_s = 1.0 / rows_per_second if rows_per_second else None
    places = [words(name) for name in layout.names]
    if "s" not in places or "d" not in places:
        return given_s
    speed, distance = columns.get(places.index("s")), columns.get(places.index("d"))
    if speed is None or distance is None:
        return given_s
    steps = np.diff(distance)
    rates = []
    for rows in np.array_split(np.flatnonzero(steps >= 0), max(1, len(steps) // RATE_ROWS)):
        ridden, summed = float(np.sum(steps[rows])), float(np.nansum(speed[rows]))
        if ridden > RATE_DISTANCE and summed > 0:
            rates.append(summed / 3600.0 / ridden)
    if not rates:
        return given_s
    rate = float(np.median(rates))
    near = min(LOGGER_RATES_HZ, key=lambda one: abs(one - rate))
    return 1.0 / near if abs(rate - near) <= NEAR * near else given_s


def parts_of(
    layout: Layout, columns: Mapping[int, Values], count: int
) -> list[np.ndarray[tuple[int], np.dtype[np.intp]]]:
    """Rows of each ride: a logger whose odometer goes back to zero begins another."""
    rows = np.arange(count)
    places = [words(name) for name in layout.names]
    if not layout.rows_are_time or "d" not in places or places.index("d") not in columns:
        return [rows]
    distance = columns[places.index("d")]
    valid = np.flatnonzero(np.isfinite(distance))
    back = (np.diff(distance[valid]) < 0) & (distance[valid][1:] < 0.05)
    return np.split(rows, valid[1:][back])
