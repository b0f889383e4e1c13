"""The library: named tables and configurations."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from backend.api.models.base import Answer
from backend.api.models.config import ParameterValue


class LibraryRow(Answer):
    """One entry without its values."""

    id: str
    name: str
    kind: Literal["table", "configuration"]
    comment: str = Field(description="What it is good for.")
    family: str = Field(description="Of the units it is for.")
    source: Literal["preset"] = Field(description="`preset`: it comes with Spindle, read only.")


class LibraryList(Answer):
    items: list[LibraryRow]
    next: str | None = None


class LibraryParameter(Answer):
    value: ParameterValue
    unit: str = Field(description="Empty for a number without one, and for a text or a choice.")
    comment: str = ""


class LibraryEntry(Answer):
    """A file as `spindle device restore` takes it; a table holds the parameters of one table."""

    format: Literal["spindle-table", "spindle-configuration"]
    version: Literal[1]
    name: str
    comment: str
    family: str
    parameters: dict[str, LibraryParameter]
