"""What we answer where a service's dataclass is not the answer itself."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Answer(BaseModel):
    """Built from a service's dataclass by attribute; every field is sent, missing is null."""

    model_config = ConfigDict(
        from_attributes=True, json_schema_serialization_defaults_required=True
    )
