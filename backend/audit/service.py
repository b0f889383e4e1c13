"""Who changed what, a page at a time and as a file."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from typing import Any, Literal

from backend.audit.records import AuditReader
from backend.audit.types import AuditFilter, AuditPage
from backend.core.canonical_json import canonical_text
from backend.core.moments import utc
from backend.core.spreadsheet import guarded
from backend.errors import FieldError, InvalidRequest
from backend.store.audit import HASHED

ExportFormat = Literal["csv", "jsonl"]
COLUMNS = (*(name for name in HASHED if name != "at_us"), "sha256")
# What a number of SQL holds.
ID_DIGITS_MAX = 18


class Audit:
    """Looks only. From any thread; all of it raises StoreError."""

    def __init__(self, reader: AuditReader) -> None:
        self._reader = reader

    def page(self, sought: AuditFilter, limit: int = 50, cursor: str | None = None) -> AuditPage:
        """One page, the newest first; cursor: the `next` of the page before. Raises
        InvalidRequest."""
        found = self._reader.page(sought, limit + 1, cursor_id(cursor))
        items = tuple(found[:limit])
        return AuditPage(items, str(items[-1].id) if len(found) > limit else None)

    def export(self, sought: AuditFilter, file_format: ExportFormat) -> Iterator[bytes]:
        """All events that are looked for, the oldest first, line by line.

        jsonl: every line is the object whose canonical JSON without `sha256` has that hash; so
        `before` and `after` are strings of JSON, and times microseconds. csv: for spreadsheets.
        """
        lines = json_lines if file_format == "jsonl" else csv_lines
        return lines(self._reader.rows(sought))


def cursor_id(cursor: str | None) -> int | None:
    """The number of the last event of the page before. Raises InvalidRequest."""
    if cursor is None:
        return None
    if not (cursor.isascii() and cursor.isdecimal() and len(cursor) <= ID_DIGITS_MAX):
        message = "cursor must be the `next` of an earlier page."
        raise InvalidRequest(message, fields=[FieldError("cursor", "not_a_cursor", message)])
    return int(cursor)


def json_lines(rows: Iterator[Mapping[str, Any]]) -> Iterator[bytes]:
    """An event a line, as it was hashed."""
    for row in rows:
        yield f"{canonical_text(row)}\n".encode()


def csv_lines(rows: Iterator[Mapping[str, Any]]) -> Iterator[bytes]:
    """An event a line, its moment in UTC; no cell is a formula."""
    line = io.StringIO(newline="")
    writer = csv.writer(line)
    writer.writerow(["at_utc", *COLUMNS])
    for row in rows:
        cells = (row[name] for name in COLUMNS)
        shown = (guarded(cell) if isinstance(cell, str) else cell for cell in cells)
        writer.writerow([utc(row["at_us"]).isoformat(), *shown])
        yield line.getvalue().encode()
        line.seek(0)
        line.truncate()
    # The names at least, where there is no event.
    yield line.getvalue().encode()
