"""Requests of a unit's configuration, and lists of what it is made of."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import TOKEN, TOKEN_PATTERN, Parameters
from backend.tuning.types import Parameter, ParameterChange

CONFIRM_S_MAX = 255
CONFIRM_S = (
    "0 commits for good; else the unit returns to what it had after so many seconds, at a restart "
    "or power loss, unless `POST .../config/confirm` comes first."
)


class ParameterList(Answer):
    items: list[Parameter]
    next: str | None = None


class ConfigPatch(RequestBody):
    parameters: Parameters = Field(min_length=1, max_length=400)
    reason: str = Field(default="", max_length=400)
    confirm_s: int = Field(default=0, ge=0, le=CONFIRM_S_MAX, description=CONFIRM_S)
    token: str | None = Field(
        default=None,
        pattern=TOKEN_PATTERN,
        description=TOKEN,
    )
    read_from: str | None = Field(
        default=None,
        max_length=400,
        description="The `unit_key` of the unit that the values were read from, where they come "
        "from a backup or a revision. What stays with a unit (`of_the_unit`) is refused of another "
        "one, the record of a calibration also where this is not told: 422 `of_another_unit`.",
    )


class TrialValuesRequest(RequestBody):
    """Values to put on trial at once, in the unit's memory alone."""

    parameters: Parameters = Field(min_length=1, max_length=400)
    ttl_s: int = Field(ge=1, le=255, description="The unit ends it after so many seconds.")


class Revision(Answer):
    """Who changed what, when and why."""

    seq: int = Field(description="Counts the configurations of one unit from 1.")
    created_at: datetime
    author: str = Field(description="Empty where nobody knows.")
    author_proof: Literal["stated", "signed_in"] | None = Field(
        description="How the author is known: `stated` is by their own word, `signed_in` by an "
        "account or a key."
    )
    reason: str
    state: str
    generation: int | None
    crc32: int | None
    changed: list[ParameterChange]
    unit_key: str = Field(description="Whose configuration it was, over whatever connection.")


class RevisionList(Answer):
    items: list[Revision]
    next: str | None = None
