"""What comes with a request, and answers that are no service's dataclass."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


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
