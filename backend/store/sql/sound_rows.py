"""Rows of a damaged database: read as far as they can be, and known for what they are.

SQLite has no checksum of its own. A flipped bit in a row leaves text that is no UTF-8, JSON that
does not parse, or a value of another type than its column's. Reading such a row raises nothing
here; whoever reads it calls `is_sound` and decides what one damaged row means. A bit that makes
another valid value is not seen.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

from sqlalchemy import JSON, Column, Row
from sqlalchemy.sql.type_api import TypeEngine

from backend.errors import InvalidRequest

# What is raised where a schema, a row or an object's facts hold something else than was written.
NOT_AS_WRITTEN = (
    KeyError,
    TypeError,
    ValueError,
    AttributeError,
    OverflowError,
    InvalidRequest,
)


class DamagedText(str):
    """Text whose bytes are no UTF-8; what cannot be decoded is U+FFFD."""

    __slots__ = ()


class DamagedJson:
    """Stands for a JSON value that does not parse."""


DAMAGED_JSON = DamagedJson()


def decoded(raw: bytes) -> str:
    """Text of an SQLite database (the driver's `text_factory`)."""
    try:
        return raw.decode()
    except UnicodeDecodeError:
        return DamagedText(raw.decode(errors="replace"))


def parsed(text: str | bytes) -> object:
    """A JSON column's value, `DAMAGED_JSON` where it does not parse."""
    if isinstance(text, DamagedText):
        return DAMAGED_JSON
    try:
        return json.loads(text)
    except (ValueError, TypeError):
        return DAMAGED_JSON


def is_sound(row: Row[object], columns: Iterable[Column[object]]) -> bool:
    """Whether every value of a row is one that its column can hold."""
    values = row._mapping
    return all(fits(values[column.name], column) for column in columns)


def fits(value: object, column: Column[object]) -> bool:
    """Whether a column can hold a value."""
    if value is None:
        return bool(column.nullable) or column.primary_key
    if isinstance(column.type, JSON):
        return not isinstance(value, DamagedJson)
    return isinstance(value, stored_types(column.type)) and not isinstance(value, DamagedText)


def stored_types(kind: TypeEngine[object]) -> tuple[type, ...]:
    """The Python types of a column's values; SQLite gives a whole number for 2.0."""
    python_type = kind.python_type
    return (int, float) if python_type is float else (python_type,)
