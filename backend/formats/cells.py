"""Cells of text to numbers and times, and the resolution they were written with."""

from __future__ import annotations

import re
from array import array
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime

import numpy as np

from backend.core.channels import NARROW_MAX, WIDE_MAX, Values
from backend.formats.columns import FieldRule

# A longer cell is no number that anything measured.
NUMBER_CHARACTERS_MAX = 40
# Digits behind the point that are looked for: 1e-7 degrees are a centimetre.
DECIMALS_MAX = 7
COLUMNS_MAX = 200
DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+")


def number(cell: str) -> float:
    """A cell as a number, NaN when it is none."""
    text = cell.strip()
    # Python's own spelling of numbers is wider than what files mean by one.
    if len(text) >= NUMBER_CHARACTERS_MAX or "_" in text:
        return np.nan
    try:
        value = float(text)
    except ValueError:
        return np.nan
    return value if np.isfinite(value) else np.nan


def iso_moment(cell: str) -> datetime | None:
    """ISO 8601 -> the moment, without a zone where the cell names none; None when it is not one."""
    try:
        return datetime.fromisoformat(cell.strip())
    except ValueError:
        return None


def unix_seconds(moment: datetime | None) -> float:
    """A moment -> Unix seconds, NaN for none; one without a zone is taken as UTC."""
    if moment is None:
        return np.nan
    aware = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    try:
        return aware.timestamp()
    except (OverflowError, ValueError):
        return np.nan


@dataclass
class Growing:
    """Columns that grow row by row; a cell that is there and no number is counted as unread."""

    rows: int = 0
    columns: dict[str, array[float]] = field(default_factory=dict)
    unread: dict[str, int] = field(default_factory=dict)

    def add(self, cells: Mapping[str, str]) -> None:
        """One row of cells by name."""
        for name, cell in cells.items():
            value = number(cell)
            if np.isnan(value) and DECIMAL_COMMA.fullmatch(cell.strip()):
                # Neither GPX nor TCX has marks of thousands: a comma is the decimal one.
                value = number(cell.replace(",", "."))
            if np.isnan(value):
                if cell.strip():
                    self.unread[name] = self.unread.get(name, 0) + 1
                continue
            column = self.columns.get(name)
            if column is None:
                if len(self.columns) >= COLUMNS_MAX:
                    self.unread[name] = self.unread.get(name, 0) + 1
                    continue
                column = self.columns[name] = array("d")
            column.extend([np.nan] * (self.rows - len(column)))
            column.append(value)
        self.rows += 1

    def values(self) -> dict[str, Values]:
        """Every column (n,), missing as NaN."""
        columns: dict[str, Values] = {}
        for name, column in self.columns.items():
            values = np.full(self.rows, np.nan)
            values[: len(column)] = column
            columns[name] = values
        return columns


def decimals(values: Values) -> int:
    """Digits behind the point that numbers (n,) were written with, at most `DECIMALS_MAX`."""
    finite = values[np.isfinite(values)]
    for digits in range(DECIMALS_MAX):
        scaled = finite * 10.0**digits
        if (np.abs(scaled - np.rint(scaled)) < 1e-4).all():
            return digits
    return DECIMALS_MAX


def step_of(values: Values) -> float:
    """The resolution that numbers (n,) were written with."""
    return float(10.0 ** -decimals(values))


def as_written(rule: FieldRule, columns: Mapping[str, Values]) -> FieldRule:
    """The rule with a channel that keeps every digit of a text's numbers, if any can.

    columns: numbers (n,) by name, in the file's units. A channel's usual scale is that of FIT.
    """
    sources = [columns[name] for name in rule.sources if name in columns]
    finite = np.concatenate([values[np.isfinite(values)] for values in sources] or [np.empty(0)])
    inside = finite[(finite * rule.factor >= rule.lowest) & (finite * rule.factor <= rule.highest)]
    if not len(inside):
        return rule
    counts = inside * (rule.factor / rule.channel.scale)
    if np.abs(counts - np.rint(counts)).max() < 1e-6:
        return rule
    written = decimals(inside)
    for digits in range(written, -1, -1):
        scale = rule.factor * 10.0**-digits
        largest = np.abs(inside).max() * 10.0**digits
        better = digits == written or scale < rule.channel.scale
        if better and largest <= WIDE_MAX:
            wide = bool(largest > NARROW_MAX)
            return replace(rule, channel=replace(rule.channel, scale=scale, wide=wide))
    return rule
