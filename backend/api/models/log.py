"""Ride logs in a unit's flash, and how far their download is."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.web.models import Answer


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


class ErasedLog(Answer):
    log_id: int
    erases: int | None = Field(
        description="Blocks of the flash for logs erased in its life; null if its answer was lost."
    )


class UnitLogs(Answer):
    """The oldest first. overwritten: given up by the unit before anybody fetched them."""

    items: list[UnitLog]
    overwritten: int
    next: str | None = None
