"""Files on their way to becoming rides."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.web.models import Answer


class UploadParts(Answer):
    """How many of the files within a container are in which state."""

    waiting: int
    complete: int
    partial: int
    rejected: int
    here: int = Field(description="Rides that were known before the container came.")


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


class UploadList(Answer):
    items: list[Upload]
    next: str | None
