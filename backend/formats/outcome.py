"""What came of a file: rides, how whole they are, and the reason in a stable word.

state     `complete` everything the file holds was read; `partial` rows are missing or unproven;
          `rejected` nothing could be used
codes     empty_file, unknown_format, unsupported_format, no_records, no_valid_time, too_many_rows,
          too_slow, too_much_memory, parser_crashed, unsafe_content,
          needs_mapping                                      nothing was saved
          truncated, damaged, checksum_mismatch, part_unreadable    something was saved
Programs rely on the words; the detail is for people and says where and how much.
"""

from __future__ import annotations

from dataclasses import dataclass

from backend.core.device_metadata import DeviceMetadata
from backend.core.intake import Intake
from backend.core.ride import RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.formats.questions import TableQuestion

COMPLETE = "complete"
PARTIAL = "partial"
REJECTED = "rejected"
TOO_SLOW = "too_slow"
NEEDS_MAPPING = "needs_mapping"


@dataclass(frozen=True)
class ImportedRide:
    """One ride of a file. started_us: Unix time of its first row. notes: what was put right.

    context: what the file knows of the bike. start_known: False where `started_us` means nothing.
    events, metadata: of the file, beside its rows. intake: what became of its rows and fields.
    """

    started_us: int
    period_us: int | None
    rows: RideRows
    sport: str | None = None
    notes: tuple[str, ...] = ()
    context: RideContext = RideContext()  # noqa: RUF009 - frozen
    start_known: bool = True
    events: tuple[RideEvent, ...] = ()
    intake: Intake | None = None
    metadata: DeviceMetadata = DeviceMetadata()  # noqa: RUF009 - frozen

    @property
    def span_s(self) -> tuple[float, float]:
        """Unix time of its first row, and from there to its last."""
        return self.started_us / 1e6, float(self.rows.times_us[-1]) / 1e6


@dataclass(frozen=True)
class Outcome:
    """What a file became.

    code, detail: None when it is complete. offset: byte where reading first went wrong.
    completeness: share of the file's rows that were read (0..1), None when nobody can say.
    question: what its owner can say of the file; of `needs_mapping` what must be said before it is
    read.
    """

    state: str
    rides: tuple[ImportedRide, ...] = ()
    code: str | None = None
    detail: str | None = None
    offset: int | None = None
    completeness: float | None = None
    question: TableQuestion | None = None

    @property
    def header_sha256(self) -> str | None:
        """By what its question's answer is found."""
        return None if self.question is None else self.question.header_sha256


def rejected(code: str, detail: str, offset: int | None = None) -> Outcome:
    """An outcome without rides."""
    return Outcome(REJECTED, (), code, detail, offset, 0.0)
