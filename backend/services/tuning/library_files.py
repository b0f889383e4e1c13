"""Entries of the library as files for other programs, and their files as documents.

Reading a file keeps nothing: what it holds is answered, for somebody to look at and to keep.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from backend.core.fuzzy_table import LABELS, PARAMETERS_OF, FuzzyTable
from backend.errors import Conflict
from backend.formats.library_document import NAME_MAX, table_document
from backend.law.fis import Deviation, deviation, read_fis, table_of, write_fis

MEDIA_TYPES = {
    "json": "application/json",
    "fis": "text/plain; charset=utf-8",
    "csv": "text/csv; charset=utf-8",
}
FIS_COMMENT = "Read from a .fis file."


@dataclass(frozen=True)
class LibraryFile:
    """A file's text, what it is called, and what kind it is."""

    text: str
    file_name: str
    media_type: str


@dataclass(frozen=True)
class ReadFis:
    """A document made of a `.fis` file, and how far the unit is from what the file says."""

    document: dict[str, Any]
    fuzzy_table: dict[str, Any]
    deviation: Deviation


def library_file(
    entry_id: str, document: Mapping[str, Any], file_format: str, which: str = "first"
) -> LibraryFile:
    """An entry as `json`, `fis` or `csv`; the last two are of one table.

    which: `first` or `second` table of a configuration. Raises Conflict where there is no table.
    """
    if file_format == "json":
        text = json.dumps(document, indent=2, ensure_ascii=False) + "\n"
    else:
        table = document_table(entry_id, document, which)
        text = write_fis(table) if file_format == "fis" else table_csv(table)
    return LibraryFile(text, f"{entry_id}.{file_format}", MEDIA_TYPES[file_format])


def document_table(entry_id: str, document: Mapping[str, Any], which: str = "first") -> FuzzyTable:
    """The table in a document. Raises Conflict where it has none."""
    values = {name: entry["value"] for name, entry in document["parameters"].items()}
    missing = [name for name in PARAMETERS_OF[which].values() if name not in values]
    if missing:
        message = f"{entry_id} has no {which} table: it says nothing of {', '.join(missing)}."
        raise Conflict(message, "entry_has_no_table")
    return FuzzyTable.from_parameters(values, which)


def table_csv(table: FuzzyTable) -> str:
    """The rules as a spreadsheet shows them, then what each label gains."""
    rows = [
        ["speed_kmh \\ torque_rate", *map(repr, table.torque_rate_points)],
        *(
            [repr(speed), *row]
            for speed, row in zip(table.speed_points_kmh, table.rules, strict=True)
        ),
        [],
        ["label", *LABELS],
        ["gain", *map(repr, table.gain_points)],
        ["inference", table.inference],
    ]
    return "".join(",".join(row) + "\r\n" for row in rows)


def read_fis_file(text: str, name: str = "") -> ReadFis:
    """A table from the text of a `.fis` file, compared with the file over a grid.

    name: what the document is to be called, the file's own word if empty. Raises InvalidRequest
    that names the line which no unit can do.
    """
    system = read_fis(text)
    table = table_of(system)
    document = table_document(name[:NAME_MAX] or table.name, FIS_COMMENT, table)
    return ReadFis(document, table.to_json(), deviation(system, table))
