"""Reads registry.toml into typed rows and refuses what the generator could not hold to."""

import json
import re
import struct
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from firmware_protocol.layout import STRUCT_CODES, Channel, Default, Field, Order, Parameter

SIZES = {name: struct.calcsize("<" + code) for name, code in STRUCT_CODES.items()}


class BadRegistry(ValueError):
    """registry.toml breaks one of its own rules; the message names the row."""


@dataclass(frozen=True)
class Table:
    """An enumeration, or flags whose values are bit numbers."""

    name: str
    doc: str
    members: dict[str, int]


@dataclass(frozen=True)
class Layout:
    """A request, a response or an event's fields, and the bytes of its fixed part."""

    fields: tuple[Field, ...]

    @property
    def length(self) -> int:
        return sum(SIZES[f.type] * f.count for f in self.fields if f.type != "bytes")

    @property
    def has_tail(self) -> bool:
        return bool(self.fields) and self.fields[-1].type == "bytes"


@dataclass(frozen=True)
class MessageRow:
    id: int
    name: str
    doc: str
    request: Layout
    response: Layout


@dataclass(frozen=True)
class Registry:
    protocol: dict[str, Any]
    enums: tuple[Table, ...]
    flags: tuple[Table, ...]
    messages: tuple[MessageRow, ...]
    events: tuple[tuple[str, Layout], ...]
    parameters: tuple[Parameter, ...]
    orders: tuple[Order, ...]
    channels: tuple[Channel, ...]
    schema: str
    """Canonical JSON of everything but the prose: what schema_hash is taken over."""

    def enum(self, name: str) -> Table:
        return next(table for table in self.enums if table.name == name)

    @property
    def image_length(self) -> int:
        return sum(parameter.size for parameter in self.parameters)


def load(path: Path) -> Registry:
    """The registry in `path`. Raises BadRegistry."""
    raw = tomllib.loads(path.read_text(encoding="utf-8"))
    enums = _tables(raw["enum"])
    registry = Registry(
        protocol=raw["protocol"],
        enums=enums,
        flags=_tables(raw["flags"]),
        messages=tuple(
            MessageRow(
                row["id"],
                row["name"],
                row["doc"],
                _layout(row["request"], row["name"]),
                _layout(row["response"], row["name"]),
            )
            for row in raw["message"]
        ),
        events=tuple((name, _layout(rows, name)) for name, rows in raw["event_fields"].items()),
        parameters=_parameters(raw["parameter"], enums),
        orders=tuple(
            Order(row["low"], row["high"], row["violation"]) for row in raw.get("order", [])
        ),
        channels=tuple(
            Channel(row["id"], row["name"], row["unit"], row["scale"], row["doc"])
            for row in raw["channel"]
        ),
        schema=json.dumps(_without_prose(raw), sort_keys=True, separators=(",", ":")),
    )
    _check(registry)
    return registry


def _tables(raw: dict[str, dict[str, Any]]) -> tuple[Table, ...]:
    return tuple(
        Table(name, rows["doc"], {key: value for key, value in rows.items() if key != "doc"})
        for name, rows in raw.items()
    )


def _layout(rows: list[list[str]], owner: str) -> Layout:
    fields = []
    for position, (name, text) in enumerate(rows):
        match = re.fullmatch(r"(\w+?)(?:\[(\d+)\])?", text)
        if match is None or (match[1] not in STRUCT_CODES and text != "bytes"):
            raise BadRegistry(f"{owner}.{name}: unknown type {text}")
        if text == "bytes" and position != len(rows) - 1:
            raise BadRegistry(f"{owner}.{name}: bytes must be the last field")
        fields.append(Field(name, match[1], int(match[2] or 1)))
    return Layout(tuple(fields))


def _parameters(rows: list[dict[str, Any]], enums: tuple[Table, ...]) -> tuple[Parameter, ...]:
    access = next(table for table in enums if table.name == "access").members
    parameters = []
    offset = 0
    for row in sorted(rows, key=lambda row: int(row["id"])):
        enum = row.get("enum")
        choices = next((table.members for table in enums if table.name == enum), None)
        if enum is not None and (
            choices is None or list(choices.values()) != [*range(len(choices))]
        ):
            raise BadRegistry(f"{row['name']}: enum {enum} must exist and count up from 0")
        parameter = Parameter(
            id=row["id"],
            name=row["name"],
            group=row["group"],
            type=row["type"],
            unit=row["unit"],
            shape=tuple(row.get("shape", ())),
            length=row["length"] if row["type"] == "text" else SIZES[row["type"]],
            min=row.get("min"),
            max=row.get("max"),
            enum=enum,
            increasing=row.get("increasing", False),
            default=_tuples(row["default"]),
            access=access[row["access"]],
            image_offset=offset,
            doc=row["doc"],
        )
        if (parameter.type == "text" or enum is not None) != (parameter.min is None):
            raise BadRegistry(f"{parameter.name}: numbers need min and max, others have none")
        offset += parameter.size
        parameters.append(parameter)
    return tuple(parameters)


def _tuples(value: Any) -> Default:
    if isinstance(value, list):
        return tuple(_tuples(item) for item in value)
    result: Default = value
    return result


def _without_prose(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_prose(item) for key, item in value.items() if key != "doc"}
    if isinstance(value, list):
        return [_without_prose(item) for item in value]
    return value


def _check(registry: Registry) -> None:
    groups: list[tuple[str, list[tuple[int, str]]]] = [
        ("message", [(row.id, row.name) for row in registry.messages]),
        ("parameter", [(row.id, row.name) for row in registry.parameters]),
        ("channel", [(row.id, row.name) for row in registry.channels]),
    ]
    for kind, rows in groups:
        if len({i for i, _ in rows}) != len(rows) or len({n for _, n in rows}) != len(rows):
            raise BadRegistry(f"two {kind} rows share an id or a name")
    names = {parameter.name for parameter in registry.parameters}
    for order in registry.orders:
        if not {order.low, order.high} <= names:
            raise BadRegistry(f"order of unknown parameters {order.low} and {order.high}")
    if set(registry.enum("event").members) != {name for name, _ in registry.events}:
        raise BadRegistry("every event needs a row in event_fields, and the other way round")
