"""Log files to samples: FIT and CSV, salvage of damaged ones, in a child process."""

from backend.ingest.outcome import COMPLETE, PARTIAL, REJECTED, ImportedRide, Outcome
from backend.ingest.sandbox import Children, ReadingStopped, read_in_child

__all__ = [
    "COMPLETE",
    "PARTIAL",
    "REJECTED",
    "Children",
    "ImportedRide",
    "Outcome",
    "ReadingStopped",
    "read_in_child",
]
