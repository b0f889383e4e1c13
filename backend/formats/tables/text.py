"""Bytes of a table to rows of cells, whatever encoding, separator and line ends it has."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from dataclasses import dataclass

MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
# Where two divide the lines alike, the first: a comma can be in the numbers.
SEPARATORS = ";\t,|"
STATED = re.compile(r"\s*sep=(.)\s*\r?\n", re.IGNORECASE)
QUOTED = re.compile(r'"[^"]*"')
# Lines, from all over the file, that decide about the separator.
LINES_LOOKED_AT = 400


@dataclass(frozen=True)
class Cells:
    """Rows of cells, and the mark between them."""

    rows: list[list[str]]
    separator: str


def decoded(data: bytes) -> str:
    """The text; what is no UTF-8 is Latin-1, as older head units write."""
    for mark, encoding in MARKS:
        if data.startswith(mark):
            return data.decode(encoding, errors="replace")
    try:
        return data.decode()
    except UnicodeDecodeError as error:
        # One flipped bit far inside a file in UTF-8 is damage, not another encoding.
        if any(byte >= 0x80 for byte in data[: error.start]):
            return data.decode(errors="replace")
        return data.decode("latin-1")


def cells_of(text: str) -> Cells:
    """Every row. Raises csv.Error for what cannot be a table."""
    stated = STATED.match(text)
    if stated is not None:
        text = text[stated.end() :]
    separator = stated.group(1) if stated is not None else separator_of(text)
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))
    return Cells(rows, separator)


def separator_of(text: str) -> str:
    """The mark that divides most lines into as many cells.

    Above the header there may be lines that have none, or others, of it.
    """
    lines = [QUOTED.sub("", line) for line in text.splitlines() if line.strip()]
    looked = lines[:: max(1, len(lines) // LINES_LOOKED_AT)]

    def agreeing(mark: str) -> int:
        counts = Counter(line.count(mark) for line in looked)
        counts.pop(0, None)
        return max(counts.values(), default=0)

    return max(SEPARATORS, key=agreeing)
