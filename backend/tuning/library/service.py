"""The library: tables and configurations under a name, to look at and to put into a unit.

What comes with Spindle is in it, read only, beside what its users keep there. Nothing here touches
a unit. Whatever is changed or deleted stays among the versions of its item. An entry is a file for
other programs, too; reading such a file keeps nothing: what it holds is answered, for somebody to
look at and to keep.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal, Protocol

from backend.core.canonical_json import sha256_of
from backend.core.described import described
from backend.core.fuzzy_table import LABELS, PARAMETERS_OF, FuzzyTable
from backend.errors import AccessDenied, ConfigConflict, Conflict, NotFound
from backend.formats.library_document import NAME_MAX, library_document, table_document
from backend.law import presets
from backend.law.fis import Deviation, deviation, read_fis, table_of, write_fis
from backend.tuning.library.types import LibraryVersion
from backend.tuning.types import is_match

FORMAT_START = "spindle-"
# Own items differ from presets by their id alone.
OWN = re.compile(r"own-([1-9][0-9]{0,17})")

Document = dict[str, Any]


@described
class LibraryRow:
    """One entry without its values."""

    id: str
    """What the entry is requested by."""
    name: str
    kind: Literal["table", "configuration"]
    comment: str
    """What it is good for."""
    family: str
    """Of the units it is for."""
    source: Literal["preset", "own"]
    """`preset`: it comes with Spindle, read only. `own`: a user keeps it here."""
    etag: str
    """Of what it is; `If-Match` of a change."""
    deleted: bool = False
    version: int | None = None
    """Counts the states of an own item from 1."""
    created_at: datetime | None = None
    changed_at: datetime | None = None
    author: str | None = None
    """Who gave it this state."""
    author_proof: Literal["stated", "signed_in"] | None = None
    """How the author is known: `stated` is by their own word, `signed_in` by an account or a
    key."""


@dataclass(frozen=True, slots=True)
class LibraryEntry:
    """A document, and the ETag of what it is."""

    document: Document
    etag: str


class LibraryItems(Protocol):
    """Where own items are kept; library.records has one, and says what each method does."""

    def newest(self) -> tuple[LibraryVersion, ...]: ...

    def versions(self, item_id: int) -> tuple[LibraryVersion, ...]: ...

    def add(self, body: Mapping[str, Any], author: str) -> LibraryVersion: ...

    def change(
        self, item_id: int, check: Any, author: str, body: Mapping[str, Any] | None
    ) -> LibraryVersion | None: ...


class Library:
    """Looks at and changes the library; from any thread, with or without a unit."""

    def __init__(self, items: LibraryItems) -> None:
        self._items = items

    def rows(self, deleted: bool = False) -> list[LibraryRow]:
        """Every preset by name, then every own item by age; deleted ones only if asked for."""
        all_rows = [preset_row(name) for name in presets.names()]
        own = [row_of(item) for item in self._items.newest()]
        return all_rows + [row for row in own if deleted or not row.deleted]

    def entry(self, entry_id: str, version: int | None = None) -> LibraryEntry:
        """An entry as a file that `spindle device restore` takes, as it is or as it once was.

        A deleted item is found by its version alone. Raises NotFound.
        """
        if entry_id in presets.names() and version is None:
            document = presets.load(entry_id).to_json()
            return LibraryEntry(document, preset_etag(document))
        for item in self._versions(entry_id):
            if item.seq == version or (version is None and not item.deleted):
                return LibraryEntry(dict(item.body), item_etag(item))
            if version is None:
                break
        which = entry_id if version is None else f"{entry_id} in version {version}"
        raise NotFound(f"The library has no {which!r}. GET /library lists what it has.")

    def versions(self, entry_id: str) -> list[LibraryRow]:
        """Every state an own item was in, newest first. Raises NotFound."""
        versions_found = [row_of(item) for item in self._versions(entry_id)]
        if not versions_found:
            raise NotFound(f"The library has no own {entry_id!r}, only those have versions.")
        return versions_found

    def add(self, document: object, author: str) -> LibraryRow:
        """Keep a document as a new item. Raises InvalidRequest with every fault named, Conflict
        where its name is taken, StoreError."""
        body = library_document(document)
        require_no_preset(body["name"])
        return row_of(self._items.add(body, author))

    def change(
        self, entry_id: str, document: object, if_match: str | None, author: str
    ) -> LibraryRow:
        """Give an item another content; a deleted one is back with it.

        if_match: ETag of what the change was made for, None for whatever it is. Raises AccessDenied
        for a preset, NotFound, InvalidRequest, ConfigConflict if somebody else changed it, Conflict
        where its name is taken, StoreError; after each of them the item is unchanged.
        """
        item_id = own_id(entry_id)
        body = library_document(document)
        require_no_preset(body["name"])
        return self._change(entry_id, item_id, body, if_match, author)

    def remove(self, entry_id: str, if_match: str | None, author: str) -> LibraryRow:
        """Take an item out of the library; its versions stay. Raises as `change`."""
        return self._change(entry_id, own_id(entry_id), None, if_match, author)

    def _change(
        self, entry_id: str, item_id: int, body: Document | None, if_match: str | None, author: str
    ) -> LibraryRow:
        def check(now: LibraryVersion) -> None:
            if not is_match(item_etag(now), if_match):
                raise ConfigConflict(
                    f"The change was made for {entry_id} as {if_match}, but it is {item_etag(now)} "
                    "now: somebody else changed it. Read it again and change that.",
                    "item_changed",
                )
            if body is None and now.deleted:
                raise NotFound(f"The library has no {entry_id!r}: it is deleted already.")

        stored = self._items.change(item_id, check, author, body)
        if stored is None:
            raise NotFound(f"The library has no {entry_id!r}. GET /library lists what it has.")
        return row_of(stored)

    def _versions(self, entry_id: str) -> tuple[LibraryVersion, ...]:
        own = OWN.fullmatch(entry_id)
        return () if own is None else self._items.versions(int(own[1]))


def own_id(entry_id: str) -> int:
    """The number of an own item. Raises AccessDenied for a preset, NotFound."""
    if entry_id in presets.names():
        raise AccessDenied(
            f"{entry_id} comes with Spindle and stays as it is: save it under another name.",
            "preset_read_only",
        )
    own = OWN.fullmatch(entry_id)
    if own is None:
        raise NotFound(f"The library has no {entry_id!r}. GET /library lists what it has.")
    return int(own[1])


def require_no_preset(name: str) -> None:
    """Raises Conflict for the name of something that comes with Spindle."""
    if name in presets.names():
        raise Conflict(f"{name!r} comes with Spindle: choose another name.", "name_taken")


def preset_row(name: str) -> LibraryRow:
    """The row of what comes with Spindle."""
    one = presets.load(name)
    tag = preset_etag(one.to_json())
    return LibraryRow(name, one.name, kind_of(one.kind), one.comment, one.family, "preset", tag)


def kind_of(word: str) -> Literal["table", "configuration"]:
    """The word of a document's kind."""
    return "table" if word == "table" else "configuration"


def row_of(item: LibraryVersion) -> LibraryRow:
    """The row of a state of an own item."""
    return LibraryRow(
        id=f"own-{item.item_id}",
        name=item.name,
        kind=kind_of(item.body["format"].removeprefix(FORMAT_START)),
        comment=item.body["comment"],
        family=item.body["family"],
        source="own",
        etag=item_etag(item),
        deleted=item.deleted,
        version=item.seq,
        created_at=item.made_at,
        changed_at=item.created_at,
        author=item.author or None,
        author_proof=item.author_proof,
    )


def preset_etag(document: Document) -> str:
    """Names what a preset holds: it changes with the content and with nothing else."""
    return f'"{sha256_of(document)[:16]}"'


def item_etag(item: LibraryVersion) -> str:
    """Names one state of an item: it changes with every change."""
    return f'"{item.seq}-{item.sha256[:8]}"'


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
