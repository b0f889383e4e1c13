"""The library: named tables and configurations."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.parameter_value import ParameterValue
from backend.core.request_body import RequestBody
from backend.tuning.models.config import ParameterChange
from backend.tuning.models.law import FuzzyTable, Label, Table
from backend.web.models import Answer

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
    author_proof: Literal["stated", "signed_in"] | None = Field(
        description="How the author is known: `stated` is by their own word, `signed_in` by an "
        "account or a key."
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


class Feel(Answer):
    """Measured on the simulated bike, 100 kg on the level; null where it never came to that."""

    start_s: float | None = Field(description="From rest to 15 km/h under legs.")
    rise_nm_per_s: float = Field(description="Steepest rise of the motor's torque on the way.")
    ripple_pct: float | None = Field(
        description="Rms of the motor's torque about its mean over half a turn of the crank, as a "
        "share of it, under even legs."
    )
    lag_ms: float | None = Field(description="To 63 % of what a sudden push changes.")
    toggles_hz: float = Field(description="On and off a second under legs that hold 25 km/h.")
    market: str = Field(description="That the simulated unit was made for.")
    seconds: float = Field(description="What measuring took.")


class LookedAt(Answer):
    name: str
    kind: Literal["table", "configuration"]
    fuzzy_table: FuzzyTable | None = Field(
        description="Null for a partial configuration that has none."
    )
    feel: Feel | None
    not_felt: str | None = Field(description="Why nothing could be measured.")


class CellChange(Answer):
    row: int = Field(description="Of the speed, from 0.")
    column: int = Field(description="Of the torque rate, from 0.")
    left: Label
    right: Label


class LargestDifference(Answer):
    gain: float = Field(description="Right less left.")
    speed_kmh: float
    torque_rate: float
    left: float
    right: float


class TableComparison(Answer):
    cells: list[CellChange]
    points_changed: list[Literal["speed_points_kmh", "torque_rate_points", "gain_points"]]
    inference_changed: bool
    speeds_kmh: list[float]
    torque_rates: list[float]
    left: list[list[float]] = Field(description="Gain, `[speed][torque rate]`.")
    right: list[list[float]]
    largest: LargestDifference = Field(
        description="Looked for over a finer grid and at every point of both."
    )


class Comparison(Answer):
    left: LookedAt
    right: LookedAt
    parameters: list[ParameterChange] = Field(
        description="What differs; of a table beside a configuration what the table has. Null "
        "where a side says nothing of it."
    )
    tables: TableComparison | None = Field(description="Null where a side has no table.")
