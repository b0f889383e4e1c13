"""Types that the API answers with as they are: each is written down once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, TypeVar, dataclass_transform

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler
    from pydantic_core.core_schema import CoreSchema

Described = TypeVar("Described")
Made = TypeVar("Made")

# Every field is sent, missing is null: so each is required of an answer, also one with a default.
CONFIG = {"use_attribute_docstrings": True, "json_schema_serialization_defaults_required": True}

SCHEMAS: dict[type[Any], CoreSchema] = {}
BEING_MADE: set[type[Any]] = set()


@dataclass_transform(frozen_default=True)
def described(cls: type[Described]) -> type[Described]:
    """A frozen dataclass; in the API's description the docstrings of class and fields describe it.

    Nothing is checked when one is made: that is for what comes from outside, a `RequestBody`. The
    docstring of an inherited field is not seen: write such a field again.
    """
    cls.__pydantic_config__ = CONFIG  # type: ignore[attr-defined]
    cls.__get_pydantic_core_schema__ = classmethod(schema_once)  # type: ignore[attr-defined]
    return dataclass(frozen=True)(cls)


def schema_once(cls: type[Any], source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
    """Pydantic's schema of a described type, made once however many routes answer with it."""
    # A command that only sends a request starts without it.
    from pydantic import TypeAdapter

    if cls not in SCHEMAS:
        if cls in BEING_MADE:
            return handler(source)
        BEING_MADE.add(cls)
        try:
            SCHEMAS[cls] = TypeAdapter(cls).core_schema
        finally:
            BEING_MADE.discard(cls)
    return SCHEMAS[cls]


def from_members(kind: Callable[..., Made], body: Mapping[str, Any]) -> Made:
    """A dataclass from the members it has; what a newer version wrote may have more.

    Raises TypeError where one without a default is missing.
    """
    names = {field.name for field in fields(kind)}  # type: ignore[arg-type]
    return kind(**{name: value for name, value in body.items() if name in names})
