"""What comes with a request, and answers that are no service's dataclass."""

from __future__ import annotations

import re
from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict


def dated(text: object) -> object:
    """What begins with a date; a bare number, seconds of whatever, is no moment."""
    if isinstance(text, str) and not re.match(r"\d{4}-\d\d-\d\d", text):
        raise ValueError("a moment is told as 2026-05-01T12:00:00Z")
    return text


Moment = Annotated[datetime, BeforeValidator(dated)]


class RequestBody(BaseModel):
    """A request body. Unknown names are refused: a misspelt field must not look accepted.

    NaN and infinities are refused here, before any service sees them.
    """

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class Answer(BaseModel):
    """Built from a service's dataclass by attribute; every field is sent, missing is null."""

    model_config = ConfigDict(
        from_attributes=True, json_schema_serialization_defaults_required=True
    )
