"""The library: named tables and configurations."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.api.models.base import Answer, Question
from backend.api.models.config import ParameterValue
from backend.api.models.law import FuzzyTable

PARAMETERS_MAX = 400


class LibraryRow(Answer):
    """One entry without its values."""

    id: str
    name: str
    kind: Literal["table", "configuration"]
    comment: str = Field(description="What it is good for.")
    family: str = Field(description="Of the units it is for.")
    source: Literal["preset", "own"] = Field(
        description="`preset`: it comes with Spindle, read only. `own`: a user keeps it here."
    )
    etag: str = Field(description="Of what it is; `If-Match` of a change.")
    deleted: bool
    version: int | None = Field(description="Counts the states of an own item from 1.")
    created_at: datetime | None
    changed_at: datetime | None
    author: str | None = Field(description="Who gave it this state.")
    author_proof: Literal["stated"] | None = Field(
        description="How the author is known: `stated` is by their own word."
    )


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


class DocumentParameter(Question):
    value: ParameterValue
    unit: str = Field(max_length=16)
    comment: str = ""


class LibraryDocument(Question):
    """A document that is to be kept: what `GET /library/{id}` and `spindle device backup` give.

    What it says of a unit, `identity`, `generation` and `crc32`, is not kept.
    """

    format: Literal["spindle-table", "spindle-configuration"]
    version: int = Field(description="1; what a newer Spindle wrote is refused.")
    name: str
    comment: str
    family: str
    parameters: dict[str, DocumentParameter] = Field(max_length=PARAMETERS_MAX)
    identity: dict[str, Any] | None = None
    generation: int | None = None
    crc32: int | None = None


class FisText(Question):
    """A `.fis` file as text."""

    text: str = Field(max_length=64 * 1024)
    name: str = Field(default="", max_length=80, description="The file's own word if empty.")


class Deviation(Answer):
    """The largest difference between the file and the unit over a grid, and where it is."""

    gain: float
    speed_kmh: float
    torque_rate: float
    gain_of_file: float
    gain_of_unit: float
    samples: int | None = Field(
        description="Of the output, ends included, with which the file was evaluated, as MATLAB "
        "does; the unit's centroid is exact. Null for a Sugeno system, which has none."
    )
    points: int = Field(description="So many were compared.")


class ReadFis(Answer):
    """What a file holds; nothing of it is kept until it is posted to `/library`."""

    document: LibraryEntry
    fuzzy_table: FuzzyTable
    deviation: Deviation
