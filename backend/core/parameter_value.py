"""Values of a unit's parameters as JSON, and the token that lets some of them be written."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, StrictInt, StrictStr

# Strict: `true` is no number, and `"5"` is no 5.
Number = StrictInt | Annotated[float, Field(strict=True, allow_inf_nan=False)]
Scalar = Number | StrictStr
Row = Annotated[list[Scalar], Field(max_length=64)]
ParameterValue = Scalar | Row | Annotated[list[Row], Field(max_length=64)] | None
Parameters = dict[str, ParameterValue]
TOKEN_PATTERN = "^[0-9a-fA-F]{144}$"
TOKEN = "The maker's answer to the `challenge` of a refusal `token_needed`."
