"""Log files to samples: FIT, GPX, TCX and CSV, salvage of damaged ones, in a child process."""

from backend.formats.containers.archive import BrokenArchive, Entry, Left, entries
from backend.formats.containers.bulk import Titles
from backend.formats.formats import SNIFFED_BYTES, is_archive, refused_by_head
from backend.formats.outcome import (
    COMPLETE,
    NEEDS_MAPPING,
    PARTIAL,
    REJECTED,
    ImportedRide,
    Outcome,
)
from backend.formats.sandbox import Readers, ReadingStopped, read_in_child

__all__ = [
    "COMPLETE",
    "NEEDS_MAPPING",
    "PARTIAL",
    "REJECTED",
    "SNIFFED_BYTES",
    "BrokenArchive",
    "Entry",
    "ImportedRide",
    "Left",
    "Outcome",
    "Readers",
    "ReadingStopped",
    "Titles",
    "entries",
    "is_archive",
    "read_in_child",
    "refused_by_head",
]
