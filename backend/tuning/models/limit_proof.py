"""What is proven of a configuration, as in the API."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import Parameters
from backend.law.limit_proof import Cell
from backend.tuning.models.law import AssistModes, FuzzyTable, UnitLimits

CHANGES = {"fuzzy_table", "second_table", "assist_modes", "limits"}


class LimitProofRequest(RequestBody):
    """Of a unit's configuration, one of its revisions, an entry of the library, or the law's
    defaults; tables, modes, limits and parameters take the place of theirs."""

    device_id: str | None = None
    revision: int | None = Field(default=None, ge=1, description="Of the unit.")
    library: str | None = Field(default=None, max_length=200, description="An entry's id.")
    fuzzy_table: FuzzyTable | None = None
    second_table: FuzzyTable | None = Field(
        default=None, description="Shares speed and torque-rate points with the first."
    )
    assist_modes: AssistModes | None = None
    limits: UnitLimits | None = None
    parameters: Parameters = Field(default_factory=dict, max_length=400)

    def changes(self) -> dict[str, Any]:
        """What takes the place of a part of the configuration."""
        changes_given = self.model_dump(include=CHANGES)
        if self.limits is not None:
            changes_given["limits"].pop("effective_assist_cutoff_kmh")
        return changes_given


class Claim(Answer):
    """A statement about every ride there can be with this configuration."""

    code: str
    message: str
    unit: str
    bound: float | None = Field(description="What was proven; null where it does not happen.")
    allowed: float | None = Field(
        description="What the market asks for; null where it asks for nothing."
    )
    least: bool = Field(description="The market asks for `allowed` or more, not for less.")
    margin: float | None = Field(description="From the bound to what is allowed.")
    holds: bool
    how: Literal["structure", "interval", "recursion"] = Field(
        description="`structure`: a step of the unit's pipeline that every way goes through. "
        "`interval`: bounds over every cell of a table. `recursion`: what filters, ramps and "
        "counters can remember."
    )
    values: dict[str, float | str]


class LimitProof(Answer):
    """Float32 rounding is within every bound. `holds`: every claim keeps the market's law, and
    the unit runs the firmware that was proven."""

    sha256: str = Field(description="Of all that follows but `holds`, `unproven`, `created_at`.")
    config_sha256: str = Field(description="Of all that the law reads of the configuration.")
    table_sha256: str
    market: str
    market_sha256: str
    firmware_version: str = Field(description="Whose C was proven.")
    method: int
    holds: bool
    unproven: Literal["other_firmware"] | None = Field(
        description="Why nothing is said of this unit; null if something is."
    )
    claims: list[Claim]
    cells: list[Cell]
    not_covered: list[str] = Field(description="What no proof about the law can hold.")
    created_at: datetime | None = Field(description="When it was first made here.")
