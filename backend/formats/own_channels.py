"""Which channel each field of a file becomes: a bike's by our rules, others by their name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from backend.core.channels import NARROW_MAX, WIDE_MAX, ChannelSpec, Values
from backend.formats.columns import FIT_FIELDS, FieldRule

# A number so many times above 99 of 100 others was not measured.
FAR = 1000.0
# Digits that a number without a resolution of its own keeps, of its largest.
FLOAT_DIGITS = 8
# Sports whose power is not what a rider gives a bike.
ON_FOOT = frozenset({"running", "walking", "hiking", "swimming", "transition"})
RIDER_POWER = "rider_power_w"


@dataclass(frozen=True)
class Column:
    """One field of all rows. values: float64 (n,), missing as NaN. step: its resolution."""

    values: Values
    unit: str = ""
    step: float = 1.0


def rules_of(columns: Mapping[str, Column], sport: str | None) -> tuple[FieldRule, ...]:
    """A rule for every column that has a value."""
    rules = tuple(
        rule for rule in FIT_FIELDS if sport not in ON_FOOT or rule.channel.name != RIDER_POWER
    )
    taken = {source for rule in rules for source in rule.sources}
    names = {rule.channel.name for rule in FIT_FIELDS}
    others = []
    for name, column in columns.items():
        if name in taken or not np.isfinite(column.values).any():
            continue
        own = f"{name}_of_file" if name in names else name
        others.append(replace(rule(own, column), sources=(name,)))
    return rules + tuple(others)


def rule(name: str, column: Column) -> FieldRule:
    """A channel that holds the values of a column, but for what only damage writes."""
    largest = usual_largest(column.values)
    scale = column.step or float_step(largest)
    if largest / scale > WIDE_MAX:
        scale = float_step(largest)
    highest = WIDE_MAX * scale
    wide = min(float(np.nanmax(np.abs(column.values))), highest) / scale > NARROW_MAX
    return FieldRule(ChannelSpec(name, column.unit, scale, wide), (name,), -highest, highest)


def usual_largest(values: Values) -> float:
    """The largest number of a column; one far beyond nearly all others does not count."""
    sizes = np.abs(values[np.isfinite(values)])
    usual, largest = float(np.quantile(sizes, 0.99)), float(sizes.max())
    return min(largest, FAR * usual) if usual > 0.0 else largest


def float_step(largest: float) -> float:
    """A resolution that keeps numbers up to `largest` in 32 bits."""
    if largest <= 0.0:
        return 1.0
    return float(10.0 ** (np.floor(np.log10(largest)) - FLOAT_DIGITS))


def values_of(columns: Mapping[str, Column]) -> dict[str, Values]:
    """The numbers alone."""
    return {name: column.values for name, column in columns.items()}
