"""Bytes of a table to rows of cells, whatever encoding, separator and line ends it has."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass

MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
# Where two occur alike, a comma is in the numbers.
SEPARATORS = ";\t,"
# Lines whose cells decide separator and decimal comma.
LOOKED_AT = 40
COMMA_NUMBER = re.compile(r"\s*[+-]?\d+,\d+\s*")
POINT_NUMBER = re.compile(r"\s*[+-]?\d+\.\d+\s*")


@dataclass(frozen=True)
class Cells:
    """Rows of cells, and whether a comma is the decimal point."""

    rows: list[list[str]]
    decimal_comma: bool


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
    head = next((line for line in text[:8192].splitlines() if line.strip()), "")
    separator = max(SEPARATORS, key=head.count)
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))
    looked = [cell for row in rows[:LOOKED_AT] for cell in row]
    commas = sum(1 for cell in looked if COMMA_NUMBER.fullmatch(cell))
    points = sum(1 for cell in looked if POINT_NUMBER.fullmatch(cell))
    return Cells(rows, separator != "," and commas > points)
