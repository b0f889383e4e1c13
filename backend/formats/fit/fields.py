"""Messages of one kind to columns: every number of a file, with its unit, in the file's order."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.formats.fit.layout import Definition, Field
from backend.formats.fit.profile import COMPRESSED_SPEED_DISTANCE, ProfileField
from backend.formats.fit_numbers import BASE_TYPES, TIMESTAMP, UINT32
from backend.formats.own_channels import Column

Bytes = npt.NDArray[np.uint8]
Places = npt.NDArray[np.int64]
Columns = dict[str, Column]

# Twelve bits of speed and twelve of a distance, as three bytes have them.
TWELVE_BITS = 1 << 12
SPEED_SCALE, ROUNDS_SCALE = 100, 16
ROUNDS = "compressed_distance"


@dataclass(frozen=True)
class Described:
    """A field that an app described. value = number x factor, in `unit`. meant: the profile's
    field that it is."""

    name: str
    unit: str
    base: int
    factor: float = 1.0
    meant: str | None = None


@dataclass
class Table:
    """The messages of one kind, in the file's order.

    time_s: FIT time float64 (n,), NaN for none. unread: names of fields that are no single number,
    with how many messages have them.
    """

    time_s: Values
    columns: Columns = field(default_factory=dict)
    unread: dict[str, int] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.time_s)

    def values(self, name: str) -> Values:
        """A field's numbers (n,), NaN where no message has it."""
        column = self.columns.get(name)
        return np.full(len(self), np.nan) if column is None else column.values

    def of_rows(self, rows: npt.NDArray[np.intp]) -> Table:
        """Some of the messages; `unread` tells of all."""
        columns = {n: replace(c, values=c.values[rows]) for n, c in self.columns.items()}
        return Table(self.time_s[rows], columns, self.unread)


def table_of(
    data: Bytes,
    definitions: Iterable[Definition],
    names: Mapping[int, ProfileField],
    described: Mapping[tuple[int, int], Described] | None = None,
) -> Table:
    """Messages -> columns.

    data: uint8, the file. names: fields by number. described: developers' fields by owner and
    number. Of two fields of one name in a message the first that has a value counts.
    """
    present = list(definitions)
    offsets = [np.frombuffer(d.offsets, dtype=np.int64) for d in present]
    if not present:
        return Table(np.empty(0))
    order = np.argsort(np.concatenate(offsets), kind="stable")
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    table = Table(np.full(len(order), np.nan))
    first = 0
    for definition, at in zip(present, offsets, strict=True):
        rows = place[first : first + len(at)]
        first += len(at)
        messages = data[at[:, None] + np.arange(definition.size)]
        fill_times(table.time_s, rows, definition, at, messages)
        for one in definition.fields:
            if one.number == TIMESTAMP and one.developer is None:
                continue
            for name, column in columns_of(messages, one, definition.little, names, described):
                if column is None:
                    table.unread[name] = table.unread.get(name, 0) + len(at)
                else:
                    write_column(table, name, column, rows)
    for app_field in (described or {}).values():
        if app_field.meant is not None:
            merge_column(table, app_field.name, app_field.meant)
    add_up_rounds(table)
    return table


def fill_times(
    time_s: Values, rows: Places, definition: Definition, at: Places, messages: Bytes
) -> None:
    """Times of one definition's messages: their own, or what their headers told."""
    if definition.time_at:
        stamp = Field(TIMESTAMP, BASE_TYPES[UINT32].size, UINT32, definition.time_at)
        time_s[rows] = numbers(messages, stamp, definition.little)
    for row, offset in zip(rows, at, strict=True) if definition.time_of_offset else ():
        given_s = definition.time_of_offset.get(int(offset))
        if given_s is not None:
            time_s[row] = given_s


def write_column(table: Table, name: str, column: Column, rows: Places) -> None:
    """Write one definition's values into the column of all."""
    existing = table.columns.get(name)
    if existing is None:
        existing = replace(column, values=np.full(len(table), np.nan))
        table.columns[name] = existing
    existing.values[rows] = np.where(
        np.isnan(existing.values[rows]), column.values, existing.values[rows]
    )


def merge_column(table: Table, name: str, meant: str) -> None:
    """Make an app's column the profile's, unless the device itself wrote that in the same rows."""
    column, native = table.columns.get(name), table.columns.get(meant)
    if column is None or (
        native is not None and (np.isfinite(column.values) & np.isfinite(native.values)).any()
    ):
        return
    write_column(table, meant, column, np.arange(len(table)))
    del table.columns[name]


def columns_of(
    messages: Bytes,
    one: Field,
    little: bool,
    names: Mapping[int, ProfileField],
    described: Mapping[tuple[int, int], Described] | None,
) -> Iterable[tuple[str, Column | None]]:
    """The columns a field makes; None for what is no single number."""
    if one.developer is not None:
        description = (described or {}).get((one.developer, one.number))
        if description is None:
            # Its type is unknown without a description.
            yield f"developer_{one.developer}_{one.number}", None
            return
        typed = Field(one.number, one.size, description.base, one.at)
        if is_number(typed):
            values = numbers(messages, typed, little) * description.factor
            step = integer_step(typed) * description.factor
            yield description.name, Column(values, description.unit, step)
        else:
            yield description.name, None
        return
    profile_field = names.get(one.number, ProfileField(f"unknown_{one.number}"))
    if profile_field.name == COMPRESSED_SPEED_DISTANCE and one.size == 3:
        yield from speed_and_rounds(messages, one)
    elif is_number(one):
        values = numbers(messages, one, little) / profile_field.scale - profile_field.offset
        yield (
            profile_field.name,
            Column(values, profile_field.unit, integer_step(one) / profile_field.scale),
        )
    else:
        yield profile_field.name, None


def is_number(one: Field) -> bool:
    """Whether a field is one number, not text, bytes or several."""
    base = BASE_TYPES.get(one.base)
    return base is not None and bool(base.code) and one.size == base.size


def integer_step(one: Field) -> float:
    """Resolution of the raw number: 1 for whole ones, 0 for what has none of its own."""
    return 0.0 if BASE_TYPES[one.base].code in "fd" else 1.0


def numbers(messages: Bytes, one: Field, little: bool) -> Values:
    """A field's raw numbers (n,) as float64, FIT's "no value" as NaN."""
    base = BASE_TYPES[one.base]
    order = "<" if little else ">"
    cells = np.ascontiguousarray(messages[:, one.at : one.at + one.size])
    raw = cells.view(f"{order}{base.code}")[:, 0]
    # A float's bits may be no number that can be converted in silence.
    with np.errstate(invalid="ignore"):
        values: Values = raw.astype(np.float64)
    if base.invalid is not None:
        values[raw == base.invalid] = np.nan
    else:
        values[~np.isfinite(values)] = np.nan
    return values


def speed_and_rounds(messages: Bytes, one: Field) -> Iterable[tuple[str, Column]]:
    """Speed in m/s and a distance in 1/16 m that goes round, out of three bytes."""
    cells = messages[:, one.at : one.at + one.size].astype(np.int64)
    speed = (cells[:, 0] | (cells[:, 1] & 0x0F) << 8) / SPEED_SCALE
    rounds = (cells[:, 1] >> 4 | cells[:, 2] << 4).astype(np.float64)
    nothing = (cells == 0xFF).all(axis=1)
    speed[nothing] = rounds[nothing] = np.nan
    yield "speed", Column(speed, "m/s", 1 / SPEED_SCALE)
    yield ROUNDS, Column(rounds)


def add_up_rounds(table: Table) -> None:
    """The distance of a whole ride out of one that goes round after 256 m."""
    rounds = table.columns.pop(ROUNDS, None)
    if rounds is None or "distance" in table.columns:
        return
    valid = np.isfinite(rounds.values)
    valid_rounds = rounds.values[valid]
    distance = np.full(len(table), np.nan)
    steps = np.diff(valid_rounds, prepend=valid_rounds[:1]) % TWELVE_BITS
    distance[valid] = (
        (valid_rounds[:1] + np.cumsum(steps)) / ROUNDS_SCALE if len(valid_rounds) else valid_rounds
    )
    table.columns["distance"] = Column(distance, "m", 1 / ROUNDS_SCALE)


def own_field(definition: Definition, number: int) -> Field | None:
    """A message's field of that number that is no developer's; None where it has none."""
    return next((f for f in definition.fields if f.number == number and f.developer is None), None)


def text(data: bytes, definition: Definition, offset: int, number: int) -> str:
    """A text field of one message, "" when there is none."""
    one = own_field(definition, number)
    if one is None:
        return ""
    raw = data[offset + one.at : offset + one.at + one.size]
    return raw.split(b"\0", 1)[0].decode("utf-8", errors="replace").strip()


def channel_name(field_name: str) -> str:
    """A name as our channels have them: lower case, digits and underscores."""
    return re.sub(r"[^a-z0-9]+", "_", field_name.lower()).strip("_")[:40]
