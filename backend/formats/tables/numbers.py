"""Numbers as people and their programs write them: 12,5 or 12.5, 1.005,3 or 1,005.3, 54 %, 21 km/h.

A mark that is decisive in one cell decides for its column: two marks (the last is the decimal one),
one that comes twice (thousands), one without three digits behind it (decimal). A column of nothing
but cells like 1,234 follows the rest of the table.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Literal

import numpy as np

from backend.core.channels import Values
from backend.formats.cells import number

Mark = Literal[",", "."]

WRITTEN = re.compile(
    r"([+-]?\d[\d.,'’   ]*|[+-]?[.,]\d+)((?:[eE][+-]?\d+)?)\s*(%|[^\d\s.,][^\d]{0,11})?"
)
GROUPS = re.compile(r"['’   ](?=\d{3}(?:\D|$))")
SAMPLES = 3
# Cells that decide about a column.
LOOKED_AT = 500


@dataclass(frozen=True)
class Numbers:
    """A column read. values: (n,), NaN for what is no number. unit: that all its cells name.

    unread: cells that hold something else, samples: the first of them.
    """

    values: Values
    unit: str | None = None
    unread: int = 0
    samples: tuple[str, ...] = ()

    @property
    def mostly_unread(self) -> bool:
        """Whether more cells hold something that is no number than numbers."""
        return self.unread > int(np.isfinite(self.values).sum())


def numbers_of(cells: Sequence[str], decimal: Mark) -> Numbers:
    """A column. decimal: the mark of the table's other columns."""
    values = np.array([number(cell) for cell in cells], np.float64)
    odd = [place for place in np.flatnonzero(np.isnan(values)).tolist() if cells[place].strip()]
    if not odd and decimal == ".":
        return Numbers(values)
    matches = {place: WRITTEN.fullmatch(cells[place].strip()) for place in odd}
    written = [match.group(1) for match in matches.values() if match is not None]
    plain = (cell.strip() for cell in cells if "." in cell and "," not in cell)
    mark = column_mark([*written[:LOOKED_AT], *islice(plain, LOOKED_AT)]) or decimal
    if mark == ",":
        with_point = (
            place for place, cell in enumerate(cells) if "." in cell and place not in matches
        )
        for place in with_point:
            values[place] = number(without_groups(cells[place].strip(), ","))
    units = {(match.group(3) or "").strip() for match in matches.values() if match is not None}
    for place, match in matches.items():
        if match is not None:
            values[place] = number(without_groups(match.group(1), mark) + match.group(2))
    unread = [cells[place] for place in odd if np.isnan(values[place])]
    unit = next(iter(units)) if len(units) == 1 and len(written) > len(cells) / 2 else ""
    return Numbers(values, unit or None, len(unread), tuple(cell[:40] for cell in unread[:SAMPLES]))


def without_groups(text: str, decimal: Mark) -> str:
    """A number without marks of thousands, with a point."""
    text = GROUPS.sub("", text).strip()
    other = "." if decimal == "," else ","
    return text.replace(other, "").replace(decimal, ".")


def column_mark(cells: Iterable[str]) -> Mark | None:
    """The decimal mark that the cells of a column show; None where none is decisive."""
    marks = [mark for cell in cells if (mark := cell_mark(GROUPS.sub("", cell))) is not None]
    if not marks:
        return None
    return "," if marks.count(",") > marks.count(".") else "."


def cell_mark(text: str) -> Mark | None:
    """The decimal mark of one number, None where it shows none."""
    commas, points = text.count(","), text.count(".")
    if commas and points:
        return "," if text.rfind(",") > text.rfind(".") else "."
    if commas > 1:
        return "."
    if points > 1:
        return ","
    if not commas and not points:
        return None
    mark: Mark = "," if commas else "."
    whole, _, rest = text.partition(mark)
    digits = re.match(r"\d*", rest)
    if (
        digits is not None
        and len(digits.group()) == 3
        and 0 < len(whole.lstrip("+-")) <= 3
        and whole.lstrip("+-") != "0"
    ):
        return None
    return mark


def table_mark(cells: Iterable[str], separator: str) -> Mark:
    """The decimal mark of a whole table, by its cells that show one."""
    mark = column_mark(cell.strip() for cell in cells if WRITTEN.fullmatch(cell.strip()))
    return mark or ("," if separator == ";" else ".")
