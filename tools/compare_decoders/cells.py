"""Every cell of every record, as Spindle and as fitdecode read it."""

from __future__ import annotations

import io
import math
from collections import Counter
from dataclasses import dataclass, field

import fitdecode
import numpy as np

from backend.formats.fit.developer import E_BIKE_NAMES, described, descriptions
from backend.formats.fit.fields import channel_name, table_of
from backend.formats.fit.profile import RECORD_FIELDS
from backend.formats.fit.salvage import Salvaging
from backend.formats.fit.walk import sound_parts
from backend.formats.fit_numbers import FIELD_DESCRIPTION, RECORD

FIT_EPOCH_S = 631_065_600
SEMICIRCLE_DEG = 180.0 / 2**31
# Ours are doubles of the file's own numbers; the other rounds some of its.
RELATIVE, ABSOLUTE = 1e-6, 1e-6

POSITION = ("position_lat", "position_long")
Row = dict[str, float]


@dataclass
class Comparison:
    """Cells that both read alike, and those that only one has or that differ, by field."""

    records: int = 0
    records_theirs: int = 0
    equal: int = 0
    differ: Counter[str] = field(default_factory=Counter)
    only_ours: Counter[str] = field(default_factory=Counter)
    only_theirs: Counter[str] = field(default_factory=Counter)
    examples: dict[str, tuple[float, float]] = field(default_factory=dict)

    @property
    def same(self) -> bool:
        """Whether nothing that the other read is missing or different here."""
        return self.records == self.records_theirs and not self.differ and not self.only_theirs


def compare(data: bytes) -> Comparison:
    """A file's records, in the file's order, by both readers; as far as the other one reads."""
    ours, theirs = our_rows(data), their_rows(data)
    told = Comparison(len(ours), len(theirs))
    for mine, its in zip(ours, theirs, strict=False):
        for name in mine.keys() | its.keys():
            if name not in its:
                told.only_ours[name] += 1
            elif name not in mine:
                # It writes a speed a second time, as the wider field that some devices have.
                if mine.get(name.removeprefix("enhanced_")) != its[name]:
                    told.only_theirs[name] += 1
                    told.examples.setdefault(name, (math.nan, its[name]))
            elif math.isclose(mine[name], its[name], rel_tol=RELATIVE, abs_tol=ABSOLUTE):
                told.equal += 1
            else:
                told.differ[name] += 1
                told.examples.setdefault(name, (mine[name], its[name]))
    return told


def our_rows(data: bytes) -> list[Row]:
    """Spindle's cells: numbers by field, of every record."""
    parts = sound_parts(data)
    cells = np.frombuffer(data, dtype=np.uint8)
    rows: list[Row] = []
    for part in Salvaging(data).run().parts if parts is None else parts:
        described = descriptions(data, part.of(FIELD_DESCRIPTION))
        table = table_of(cells, part.of(RECORD), RECORD_FIELDS, described)
        own: list[Row] = [{} for _ in range(len(table))]
        named = {"timestamp": table.time_s} | {n: c.values for n, c in table.columns.items()}
        for name, values in named.items():
            for index in np.flatnonzero(np.isfinite(values)):
                own[index][name] = float(values[index])
        rows += own
    return rows


def their_rows(data: bytes) -> list[Row]:
    """fitdecode's cells; what it cannot read on ends the list."""
    rows: list[Row] = []
    try:
        with fitdecode.FitReader(
            io.BytesIO(data),
            check_crc=fitdecode.CrcCheck.DISABLED,
            error_handling=fitdecode.ErrorHandling.IGNORE,
        ) as reader:
            rows.extend(
                their_row(frame)
                for frame in reader
                if isinstance(frame, fitdecode.FitDataMessage) and frame.global_mesg_num == RECORD
            )
    except Exception:
        # It raises what its parts raise: KeyError, ValueError, struct.error.
        return rows
    return rows


def their_row(frame: fitdecode.FitDataMessage) -> Row:
    """One record's numbers by our names."""
    row: Row = {}
    for one in frame.fields:
        if one.name == "timestamp":
            raw = one.raw_value if isinstance(one.raw_value, int | float) else one.value.timestamp()
            row["timestamp"] = float(
                raw if raw < 2**32 and raw == one.raw_value else raw - FIT_EPOCH_S
            )
            continue
        is_developer = getattr(one.field_def, "is_dev", False)
        value = one.value if isinstance(one.value, int | float) else one.raw_value
        if (
            isinstance(value, bool)
            or not isinstance(value, int | float)
            or not math.isfinite(value)
        ):
            continue
        name = channel_name(one.name) if is_developer else one.name
        if is_developer:
            unit = str(getattr(one, "units", None) or "")
            native = getattr(one.field_def.field, "native_field_num", None)
            field = E_BIKE_NAMES.get(name) if native is None else native
            app_field = described(name, unit, 0, RECORD_FIELDS.get(-1 if field is None else field))
            name = app_field.name if app_field.meant in (None, *row) else app_field.meant
            value *= app_field.factor
        if name in POSITION:
            value *= SEMICIRCLE_DEG
        row.setdefault(name, float(value))
    return row
