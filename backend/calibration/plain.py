"""Dataclasses as plain JSON and back: strict, and every field at fault is named.

Strict: no text for a number, no unknown or missing name, no NaN; a value that nobody has is null.
The bounds stand beside the fields, as annotations.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Hashable, Mapping
from functools import cache
from typing import Any, ClassVar, TypeVar, cast

from pydantic import ConfigDict, TypeAdapter, ValidationError

from backend.errors import FieldError, InvalidRequest

Value = TypeVar("Value")


class Plain:
    """What a dataclass inherits to be read strictly."""

    __slots__ = ()
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(
        strict=True, extra="forbid", allow_inf_nan=False
    )


def to_plain(value: Any) -> Any:
    """A dataclass of this room as plain JSON."""
    return _adapter(cast(Hashable, type(value))).dump_python(value, mode="json")


def from_plain(
    kind: type[Value],
    body: Any,
    faults_of: Callable[[Value], list[FieldError]] | None = None,
) -> Value:
    """Plain JSON as a `kind`. faults_of: what no single field shows.

    Raises InvalidRequest naming every field at fault.
    """
    try:
        value: Value = _adapter(cast(Hashable, kind)).validate_json(_text(body))
    except ValidationError as error:
        raise refused(kind, _faults(error)) from None
    faults = faults_of(value) if faults_of else []
    if faults:
        raise refused(kind, faults)
    return value


def refused(kind: type, faults: list[FieldError]) -> InvalidRequest:
    """The error that names every field at fault."""
    listed = "; ".join(fault.message for fault in faults)
    name = kind.__name__.lower()
    return InvalidRequest(f"{name}: {listed}", f"invalid_{name}", faults)


def _text(body: Any) -> str:
    try:
        return json.dumps(body)
    except (TypeError, ValueError) as error:
        message = f"not plain JSON: {error}"
        raise InvalidRequest(message, "invalid", [FieldError("", "not_json", message)]) from None


def _faults(error: ValidationError) -> list[FieldError]:
    """A list that is also called too short for its own faulty entry is not named."""
    entries = error.errors()
    places = [entry["loc"] for entry in entries]
    return [
        _fault(entry)
        for entry in entries
        if not any(
            len(place) > len(entry["loc"]) and place[: len(entry["loc"])] == entry["loc"]
            for place in places
        )
    ]


def _fault(entry: Mapping[str, Any]) -> FieldError:
    field = "".join(
        f"[{part}]" if isinstance(part, int) else f".{part}" for part in entry["loc"]
    ).lstrip(".")
    return FieldError(field, entry["type"], f"{field}: {entry['msg']}")


@cache
def _adapter(kind: Hashable) -> TypeAdapter[Any]:
    return TypeAdapter(cast(Any, kind))
