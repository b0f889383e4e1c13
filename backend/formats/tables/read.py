"""A table to rides, or to the question what its owner must say first."""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from backend.core.calendar import zone_of
from backend.core.channels import ChannelSpec, Values
from backend.formats.cells import COLUMNS_MAX, as_written, number, step_of
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
from backend.formats.questions import TableAnswer, TableColumn, TableQuestion, lacking
from backend.formats.tables.layouts import Layout, layout_of, since_column, time_column
from backend.formats.tables.measures import RULES, Measure, measure_in, measure_of, own_rule, words
from backend.formats.tables.text import cells_of, decoded
from backend.formats.tables.times import Times, times_of

ROWS_MAX = 2_000_000
SAMPLES = 5
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
    return Table(layout, body, cells.decimal_comma, name).read(answer)


class Table:
    """One table, its columns as they are understood."""

    def __init__(self, layout: Layout, body: list[list[str]], comma: bool, name: str) -> None:
        self._layout, self._body, self._comma, self._name = layout, body, comma, name
        since = since_column(layout.names)
        at = time_column(layout.names)
        self._times = {place for place in (at, since[0] if since else None) if place is not None}
        self._measures = {
            place: measure
            for place, column_name in enumerate(layout.names[:COLUMNS_MAX])
            if place not in self._times and (measure := measured(layout, column_name)) is not None
        }

    def read(self, answer: TableAnswer | None) -> Outcome:
        """Rides, or what must be said before."""
        names = [
            column_names
            for place, column_names in enumerate(self._layout.names)
            if place not in self._times
        ]
        columns = self._columns()
        if not columns:
            column_names = ", ".join(names[:12])
            return rejected(
                "no_records", f"No column of {column_names} is a known channel or a number."
            )
        zone = zone_of(answer.time_zone) if answer and answer.time_zone else None
        layout = self._layout
        if layout.rows_are_time and layout.row_s is None:
            rows_per_second = answer.rows_per_second if answer else None
            layout = replace(layout, row_s=row_spacing(layout, columns, rows_per_second))
        times = times_of(layout, self._body, self._name, zone)
        question = self._question(times, layout)
        if missing := lacking(question, answer):
            kind = f"{layout.kind[0].upper()}{layout.kind[1:]}"
            detail = f"{kind} that does not say: {', '.join(missing)}. Say it once, and every file "
            detail += "with this header is read."
            return replace(rejected(NEEDS_MAPPING, detail), question=question)
        return self._outcome(times, layout, columns, answer or TableAnswer(), question)

    def _columns(self) -> dict[int, Values]:
        """The numbers of every column that has any, by place."""
        columns = {}
        for place, _ in enumerate(self._layout.names[:COLUMNS_MAX]):
            if place in self._times:
                continue
            cells = (row[place] if place < len(row) else "" for row in self._body)
            values = np.array([number(cell, self._comma) for cell in cells], np.float64)
            if np.isfinite(values).any():
                columns[place] = values
        return columns

    def _unread(self, columns: Mapping[int, Values]) -> dict[str, int]:
        """Cells that are there and no number, by column."""
        unread = {}
        for place, name in enumerate(self._layout.names):
            if place in self._times:
                continue
            values = columns.get(place)
            filled = sum(1 for row in self._body if place < len(row) and row[place].strip())
            numeric = 0 if values is None else int(np.isfinite(values).sum())
            if filled > numeric:
                unread[name] = filled - numeric
        return unread

    def _question(self, times: Times, layout: Layout) -> TableQuestion:
        header = "\x1f".join([layout.kind, *(words(name) for name in layout.names)])
        columns = []
        for place, name in enumerate(layout.names):
            measure = self._measures.get(place)
            samples = tuple(row[place][:40] for row in self._body[:SAMPLES] if place < len(row))
            if place in self._times:
                columns.append(TableColumn(name, "time", samples=samples))
                continue
            if measure is None:
                columns.append(TableColumn(name, samples=samples))
                continue
            channel = measure.rule.channel.name
            choices = measure.choices if measure.unit is None else ()
            columns.append(TableColumn(name, channel, measure.unit, choices, samples))
        return TableQuestion(
            hashlib.sha256(header.encode()).hexdigest(),
            layout.kind,
            times.naive,
            layout.rows_are_time and layout.row_s is None,
            tuple(columns),
        )

    def _outcome(
        self,
        times: Times,
        layout: Layout,
        columns: dict[int, Values],
        answer: TableAnswer,
        question: TableQuestion,
    ) -> Outcome:
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
        unread = self._unread(columns)
        rides: list[ImportedRide] = []
        for rows in parts_of(layout, columns, len(self._body)):
            own = {name: values[rows] for name, values in read.items()}
            rides += rides_of_columns(times.time_s[rows], own, rules, None, unread)
            unread = {}
        if not rides:
            sentence = f"None of the {len(self._body)} rows has a believable time and a value."
            return rejected("no_valid_time", sentence)
        read_rides = tuple(
            replace(ride, intake=replace(ride.intake, taken_as=taken_as)) if ride.intake else ride
            for ride in rides
        )
        short = sum(len(row) < len(layout.names) for row in self._body)
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
        for place, values in columns.items():
            column_name = self._layout.names[place]
            measure = self._measures.get(place)
            channel = measure.rule.channel.name if measure else ""
            if measure is None or channel in rules:
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


def measured(layout: Layout, column_name: str) -> Measure | None:
    """What a column is: by the layout's format, else by its own header."""
    given_unit = layout.units.get(words(column_name))
    if given_unit is None:
        return measure_of(column_name)
    channel, unit = given_unit
    choices = layout.choices.get(words(column_name), ())
    if channel not in RULES:
        rule = FieldRule(ChannelSpec(channel, unit or "", 0.1), (channel,), -3276, 3276)
        return Measure(rule, unit)
    measure = measure_in(channel, unit)
    return replace(measure, choices=choices) if choices else measure


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
