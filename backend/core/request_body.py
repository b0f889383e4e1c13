"""What comes from outside with a request."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class RequestBody(BaseModel):
    """A request body. Unknown names are refused: a misspelt field must not look accepted.

    NaN and infinities are refused here, before any service sees them.
    """

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
