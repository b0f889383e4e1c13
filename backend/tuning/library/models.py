"""The library: named tables and configurations."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import ParameterValue
from backend.law.comparison import TableComparison
from backend.law.feel import Feel
from backend.law.fis.evaluation import Deviation
from backend.tuning.library.service import LibraryRow
from backend.tuning.models.law import FuzzyTable, Table
from backend.tuning.types import ParameterChange

PARAMETERS_MAX = 400


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


class DocumentParameter(RequestBody):
    value: ParameterValue
    unit: str = Field(max_length=16)
    comment: str = ""


class LibraryDocument(RequestBody):
    """A document that is to be kept: what `GET /library/{id}` and `spindle device backup` give.

    What it says of a unit, `identity`, `unit_key`, `generation` and `crc32`, is not kept.
    """

    format: Literal["spindle-table", "spindle-configuration"]
    version: int = Field(description="1; what a newer Spindle wrote is refused.")
    name: str
    comment: str
    family: str
    parameters: dict[str, DocumentParameter] = Field(max_length=PARAMETERS_MAX)
    identity: dict[str, Any] | None = None
    unit_key: str | None = None
    generation: int | None = None
    crc32: int | None = None


class FisText(RequestBody):
    """A `.fis` file as text."""

    text: str = Field(max_length=64 * 1024)
    name: str = Field(default="", max_length=80, description="The file's own word if empty.")


class Side(RequestBody):
    """What is compared: just one of `library`, `device` and `fuzzy_table`."""

    library: str | None = Field(default=None, max_length=80, description="Id of an entry.")
    version: int | None = Field(default=None, ge=1, le=2**31 - 1, description="Of an own item.")
    device: str | None = Field(default=None, max_length=200, description="What this unit has.")
    revision: int | None = Field(
        default=None, ge=1, le=2**31 - 1, description="Of the device; what it has now if absent."
    )
    fuzzy_table: FuzzyTable | None = Field(default=None, description="A draft.")
    table: Table = Field(default="first", description="Of a configuration.")


class CompareRequest(RequestBody):
    left: Side
    right: Side
    feel: bool = Field(
        default=False,
        description="Measure both on the simulated bike; a fraction of a second each.",
    )


class TableReview(Answer):
    name: str
    kind: Literal["table", "configuration"]
    fuzzy_table: FuzzyTable | None = Field(
        description="Null for a partial configuration that has none."
    )
    feel: Feel | None
    no_feel_reason: str | None = Field(description="Why nothing could be measured.")


class Comparison(Answer):
    left: TableReview
    right: TableReview
    parameters: list[ParameterChange] = Field(
        description="What differs; of a table beside a configuration what the table has. Null "
        "where a side says nothing of it."
    )
    tables: TableComparison | None = Field(description="Null where a side has no table.")


class ReadFis(Answer):
    """What a file holds; nothing of it is kept until it is posted to `/library`."""

    document: LibraryEntry
    fuzzy_table: FuzzyTable
    deviation: Deviation
