"""Two kinds of model: what we answer (read from dataclasses) and what we are asked."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Answer(BaseModel):
    """Built from a service's dataclass by attribute; every field is sent, missing is null."""

    model_config = ConfigDict(
        from_attributes=True, json_schema_serialization_defaults_required=True
    )


class Question(BaseModel):
    """A request body. Unknown names are refused: a misspelt field must not look accepted.

    NaN and infinities are refused here, before any service sees them.
    """

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
