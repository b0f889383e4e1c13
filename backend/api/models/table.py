"""Tables that do not say their units or zone, and what their owner says."""

from __future__ import annotations

from pydantic import Field

from backend.core.request_body import RequestBody
from backend.web.models import Answer


class TableColumn(Answer):
    """One column of a table."""

    name: str
    channel: str | None = Field(description="What it becomes, or `time`; null for nothing known.")
    unit: str | None = Field(description="As the table says it; null where it must be said.")
    units: list[str] = Field(description="What may be said; empty where nothing is asked.")
    samples: list[str] = Field(description="Of the first rows.")


class SaidOfTable(RequestBody):
    """What an owner says of a table. It is kept for every file with the same header."""

    time_zone: str | None = Field(
        default=None, max_length=64, description="An IANA name: `Europe/Dublin`, `UTC`."
    )
    units: dict[str, str] = Field(default_factory=dict, description="By the column's name.")
    rows_per_second: float | None = Field(default=None, gt=0, le=1000)


class KnownAnswer(Answer):
    """What was said before."""

    time_zone: str | None
    units: dict[str, str]
    rows_per_second: float | None


class TableQuestion(Answer):
    """What must be said before a table is read."""

    header_sha256: str
    kind: str
    time_zone: bool = Field(description="Its times have no zone.")
    rows_per_second: bool = Field(description="Its rows have no time.")
    columns: list[TableColumn]
    answer: KnownAnswer | None


class KnownTable(Answer):
    """A kind of table that was answered for."""

    header_sha256: str
    kind: str
    columns: list[str]
    answer: KnownAnswer


class KnownTables(Answer):
    items: list[KnownTable]
