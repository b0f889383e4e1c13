"""Types that the API answers with as they are: each is written down once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar, dataclass_transform

Described = TypeVar("Described")

# Every field is sent, missing is null: so each is required of an answer, also one with a default.
CONFIG = {"use_attribute_docstrings": True, "json_schema_serialization_defaults_required": True}


@dataclass_transform(frozen_default=True)
def described(cls: type[Described]) -> type[Described]:
    """A frozen dataclass; in the API's description the docstrings of class and fields describe it.

    Nothing is checked when one is made: that is for what comes from outside, a `RequestBody`. The
    docstring of an inherited field is not seen: write such a field again.
    """
    cls.__pydantic_config__ = CONFIG  # type: ignore[attr-defined]
    return dataclass(frozen=True)(cls)
