"""CSV with a header line: our own export, and tables with one row per time and FIT's field names.

Separators comma, semicolon or tab; a decimal comma when the separator is a semicolon. The time is
`time_utc`, `timestamp` or `time` (ISO 8601, UTC unless it says otherwise); with `t_s`, seconds
since the first row, the time is exact to the microsecond.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from datetime import UTC, datetime

import numpy as np

from backend.domain.channels import ChannelSpec, Values
from backend.ingest.columns import FIT_FIELDS, FieldRule, rides_of_columns
from backend.ingest.outcome import COMPLETE, PARTIAL, Outcome, rejected

TIME_NAMES = ("time_utc", "timestamp", "time")
SECONDS_NAME = "t_s"
ROWS_MAX = 2_000_000
COLUMNS_MAX = 200
NAME_PATTERN = re.compile(r"[a-z][a-z0-9_]{0,47}")
KMH_PER_MS = 3.6

# Suffix of our channel names -> unit and the scale that holds what a bike has of it.
UNITS: dict[str, tuple[str, float]] = {
    "_kmh": ("km/h", 0.01),
    "_rpm": ("rpm", 0.1),
    "_nm": ("Nm", 0.01),
    "_v": ("V", 0.002),
    "_a": ("A", 0.001),
    "_w": ("W", 0.1),
    "_pct": ("%", 0.01),
    "_degc": ("degC", 0.01),
    "_deg": ("deg", 0.02),
}
SCALES: dict[str, float] = {
    "cadence_rpm": 0.01,
    "motor_torque_nm": 0.0001,
    "motor_torque_demanded_nm": 0.0001,
    "motor_torque_available_nm": 0.0001,
    "rider_torque_raw": 1.0,
    "torque_rate": 0.0005,
    "fuzzy_gain": 0.00005,
    "assist_ratio": 0.0002,
}


def looks_like_rows(head: bytes) -> bool:
    """Whether the first line is a header with a time and at least one more column."""
    names = header_names(head)
    return len(names) > 1 and any(name in TIME_NAMES for name in names)


def header_names(head: bytes) -> list[str]:
    """The names in the first line, as they would be of a table."""
    line = head.split(b"\n", 1)[0].decode("utf-8-sig", errors="replace")
    return [name.strip().strip('"').lower() for name in re.split(r"[,;\t]", line)]


def header_refusal(head: bytes) -> Outcome | None:
    """Why a table with a time in its header is no ride all the same; None for other files."""
    names, times = header_names(head), ", ".join(TIME_NAMES)
    if len(names) == 1 and names[0] in (*TIME_NAMES, SECONDS_NAME):
        detail = f"The only column is {names[0]}: times, and nothing that was measured at them."
        return rejected("no_records", detail, 0)
    if SECONDS_NAME in names and not any(name in TIME_NAMES for name in names):
        detail = f"{SECONDS_NAME} counts seconds, but nothing says from when: add one of {times}."
        return rejected("no_valid_time", detail, 0)
    return None


def read_csv(data: bytes) -> Outcome:
    """A CSV file -> what came of it. Never raises on any bytes."""
    text = data.decode("utf-8-sig", errors="replace")
    if not text:
        return rejected("empty_file", "The file is empty.", 0)
    separator = separator_of(text.split("\n", 1)[0])
    try:
        table = list(csv.reader(io.StringIO(text), delimiter=separator))
    except csv.Error as error:
        return rejected("damaged", f"The table cannot be read: {error}.")
    if len(table) > ROWS_MAX:
        return rejected("too_many_rows", f"{len(table)} rows; at most {ROWS_MAX} are read.")
    names = [name.strip().strip('"').lower() for name in table[0]][:COLUMNS_MAX]
    body = [row for row in table[1:] if any(cell.strip() for cell in row)]
    columns = number_columns(names, body, decimal_comma=separator == ";")
    times = row_times(names, body, columns.get(SECONDS_NAME))
    fields = rules_for(names, columns)
    if not fields:
        return rejected("no_records", f"No column of {', '.join(names[:12])} is a known channel.")
    rides = tuple(rides_of_columns(times, columns, fields))
    if not rides:
        return rejected(
            "no_valid_time", f"None of the {len(body)} rows has a believable time and a value."
        )
    kept = sum(len(ride.rows.times_us) for ride in rides)
    short = sum(len(row) < len(names) for row in body)
    if short:
        share = 1.0 - short / max(len(body), 1)
        detail = f"{short} of {len(body)} rows are cut short; {kept} rows were saved."
        return Outcome(PARTIAL, rides, "truncated", detail, None, share)
    return Outcome(COMPLETE, rides, completeness=1.0)


def separator_of(line: str) -> str:
    """The separator that occurs most in the header."""
    return max(",;\t", key=line.count)


def number_columns(
    names: Sequence[str], body: Sequence[Sequence[str]], decimal_comma: bool
) -> dict[str, Values]:
    """Every column that holds numbers; the first of equal names wins."""
    columns: dict[str, Values] = {}
    for index, name in enumerate(names):
        if name in TIME_NAMES or name in columns or not NAME_PATTERN.fullmatch(name):
            continue
        cells = (row[index] if index < len(row) else "" for row in body)
        columns[name] = np.array([number(cell, decimal_comma) for cell in cells], np.float64)
    return columns


def number(cell: str, decimal_comma: bool) -> float:
    """A cell as a number, NaN when it is none."""
    text = cell.strip()
    if decimal_comma:
        text = text.replace(",", ".")
    try:
        return float(text) if len(text) < 40 else np.nan
    except ValueError:
        return np.nan


def row_times(
    names: Sequence[str], body: Sequence[Sequence[str]], seconds: Values | None
) -> Values:
    """Unix time of every row (n,), NaN where it cannot be read."""
    index = next((names.index(name) for name in TIME_NAMES if name in names), None)
    if index is None:
        return np.full(len(body), np.nan)
    if seconds is not None and np.isfinite(seconds).any():
        first = int(np.flatnonzero(np.isfinite(seconds))[0])
        start = iso_seconds(body[first][index] if index < len(body[first]) else "")
        shifted: Values = seconds + (start - float(seconds[first]))
        return shifted
    cells = (row[index] if index < len(row) else "" for row in body)
    return np.array([iso_seconds(cell) for cell in cells], np.float64)


def iso_seconds(cell: str) -> float:
    """ISO 8601 -> Unix seconds, NaN when it is not one."""
    try:
        moment = datetime.fromisoformat(cell.strip())
    except ValueError:
        return np.nan
    aware = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    try:
        return aware.timestamp()
    except (OverflowError, ValueError):
        return np.nan


def rules_for(names: Sequence[str], columns: dict[str, Values]) -> tuple[FieldRule, ...]:
    """How each column becomes a channel: FIT's names as in FIT, our own by their unit suffix."""
    known = {rule.channel.name: rule for rule in FIT_FIELDS}
    by_source = {source: rule for rule in FIT_FIELDS for source in rule.sources}
    rules: dict[str, FieldRule] = {}
    for name in dict.fromkeys(names):
        if name not in columns or name == SECONDS_NAME:
            continue
        rule = own_rule(name) or by_source.get(name) or known.get(name)
        if rule is None:
            continue
        factor = speed_factor(columns) if name == "speed" else 1.0
        sources = (name,)
        rules.setdefault(
            rule.channel.name,
            FieldRule(rule.channel, sources, rule.lowest, rule.highest, factor),
        )
    return tuple(rules.values())


def own_rule(name: str) -> FieldRule | None:
    """The rule of a column of our own export, None for other names."""
    suffix = next((suffix for suffix in UNITS if name.endswith(suffix)), None)
    if name not in SCALES and suffix is None:
        return None
    unit, scale = UNITS[suffix] if suffix else ("", 1.0)
    scale = SCALES.get(name, scale)
    wide = name in ("latitude_deg", "longitude_deg")
    if wide:
        return None
    limit = 32767 * scale
    return FieldRule(ChannelSpec(name, unit, scale), (name,), -limit, limit)


def speed_factor(columns: dict[str, Values]) -> float:
    """3.6 when `speed` is in m/s, 1 when it is in km/h: whichever fits the odometer better.

    Tables call both "speed"; without a `distance` FIT's metres per second are assumed.
    """
    distance, speed = columns.get("distance"), columns["speed"]
    if distance is None or not np.isfinite(distance).any():
        return KMH_PER_MS
    metres = float(np.nanmax(distance) - np.nanmin(distance))
    # One row a second, as these tables have.
    summed = float(np.nansum(speed))
    if metres <= 0 or summed <= 0:
        return KMH_PER_MS
    ratio = summed / metres
    return KMH_PER_MS if ratio < np.sqrt(KMH_PER_MS) else 1.0
