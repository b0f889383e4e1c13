"""What routes of imports take and give."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.formats.questions import OfferedChannel, TableAnswer, TableColumn
from backend.imports.records import AnsweredTable
from backend.store.upload_rows import UploadParts


class Upload(Answer):
    """Where a file stands. `code` and `detail` say why it is not a whole ride.

    A file that rides came from lives as long as one of them; any other can be removed.
    """

    id: str
    name: str
    length: int
    received: int
    state: Literal["receiving", "queued", "complete", "partial", "rejected"]
    code: str | None
    detail: str | None
    ride_ids: list[int]
    completeness: float | None
    duplicate_of: int | None = Field(description="The ride the same bytes became before.")
    expires_at: datetime | None = Field(
        description="When it goes by itself; null while a ride lives on it or it waits to be read."
    )
    part_of: str | None = Field(description="The upload of the container it came within.")
    parts: UploadParts | None = Field(description="Of a container; null for any other file.")
    has_columns: bool = Field(
        description="Whether its owner can say what it leaves open: `get_mapping`."
    )
    doubtful_rides: int = Field(
        description="How many of its rides have figures that disagree or cannot be."
    )


class UploadList(Answer):
    items: list[Upload]
    next: str | None


class TableAnswerRequest(RequestBody):
    """What an owner says of a table. It is kept for every file with the same header."""

    time_zone: str | None = Field(
        default=None, max_length=64, description="An IANA name: `Europe/Dublin`, `UTC`."
    )
    units: dict[str, str] = Field(default_factory=dict, description="By the column's name.")
    rows_per_second: float | None = Field(default=None, gt=0, le=1000)
    date_order: Literal["day_first", "month_first"] | None = Field(
        default=None, description="How 03/04 is read: 3 April or 4 March."
    )
    channels: dict[str, str] = Field(
        default_factory=dict,
        description="What a column is, by its name, whether that is asked or not: a name of "
        '`offered_channels`; `""` for none of them, its numbers stay under its own name.',
    )
    read_again: bool = Field(
        default=False,
        description="Whether other files with this header that were read before are read by it.",
    )


class TableQuestion(Answer):
    """What can be said of a table, and what must be before it is read."""

    header_sha256: str
    kind: str
    time_zone: bool = Field(description="Its times have no zone.")
    rows_per_second: bool = Field(description="Its rows have no time.")
    date_order: bool = Field(description="Whether 03/04 is in April or in March.")
    columns: list[TableColumn]
    offered_channels: list[OfferedChannel]
    answer: TableAnswer | None
    files_read: int = Field(description="Other files with this header whose rides are here.")


class AnsweredTables(Answer):
    items: list[AnsweredTable]


class LogDownload(Answer):
    """From `waiting` to `done` or `failed`; only then the unit may free the log."""

    state: Literal["waiting", "fetching", "checking", "keeping", "done", "failed"]
    received: int
    length: int
    bytes_per_s: float | None
    detail: str | None
    upload_id: str | None
    ride_id: int | None = Field(description="The ride it became or was already.")
    duplicate_of: int | None = Field(description="The ride that was here before; null if new.")
    confirmed: bool = Field(description="Whether the unit knows that the log is safe.")


class UnitLog(Answer):
    log_id: int
    generation: int = Field(description="Tells a log from another of the same number.")
    state: Literal["recording", "closed", "cut_off"]
    started_at: datetime | None = Field(description="Null when the unit was restarted since.")
    duration_s: float
    length: int
    confirmed: bool
    download: LogDownload | None


class UnitLogs(Answer):
    """The oldest first. overwritten: given up by the unit before anybody fetched them."""

    items: list[UnitLog]
    overwritten: int
    next: str | None = None
