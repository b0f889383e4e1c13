"""A unit's own description of its wire: read, proven by its hash, kept, and compared with ours.

What has another hash may still be the same where it matters: a firmware that knows one message
more or less keeps the same configuration. Such a unit is tuned like any other; one whose
parameters, channels or messages mean something else is only looked at.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from typing import Any

from backend.device.ebl.session.operation import Operation, query
from backend.errors import PeerProtocolError
from firmware_protocol._generated import (
    BANDS,
    CHANNELS,
    ENUM_BY_NAME,
    MTU,
    ORDERS,
    PARAMETERS,
    REQUEST_BY_ID,
    RESPONSE_BY_ID,
    Access,
    HelloResponse,
    MessageId,
    SchemaReadRequest,
    SchemaReadResponse,
)
from firmware_protocol.layout import Channel, Field, Parameter

# Bounds what a broken unit can make us read and unpack; ours is 3 KB compressed, 24 KB as text.
SCHEMA_COMPRESSED_BYTES_MAX = 65536
SCHEMA_TEXT_BYTES_MAX = 1_000_000
# Status, detail or total length, header and CRC of a response beside the data.
RESPONSE_OVERHEAD_BYTES = 16
# What Spindle cannot do without: to read, write and prove a configuration, and to stream.
NEEDED = (
    MessageId.CFG_INFO,
    MessageId.CFG_READ,
    MessageId.CFG_BEGIN,
    MessageId.CFG_SET,
    MessageId.CFG_VALIDATE,
    MessageId.CFG_COMMIT,
    MessageId.CFG_ABORT,
    MessageId.CFG_STATUS,
    MessageId.STR_SUBSCRIBE,
    MessageId.STR_RENEW,
    MessageId.EVT_FAULT_LIST,
)

BAND_KEYS = ("parameter", "around", "within_pct", "within", "times")

# Compressed schemas as units sent them, by their hash in hex.
Schemas = MutableMapping[str, bytes]


def schema_of_unit(hello: HelloResponse, schemas: Schemas) -> Operation[dict[str, Any]]:
    """The schema a unit was built with: one of `schemas`, else read from the unit and put there.

    Raises PeerProtocolError when what the unit sends is not what it promised, DeviceRefused,
    NoAnswer.
    """
    name = hello.schema_hash.hex()
    stored = schemas.get(name)
    if stored is not None:
        try:
            return unpack_schema(stored, hello.schema_hash)
        except PeerProtocolError:
            del schemas[name]
    compressed = yield from read_schema(hello)
    schema = unpack_schema(compressed, hello.schema_hash)
    schemas[name] = compressed
    return schema


def read_schema(hello: HelloResponse) -> Operation[bytes]:
    """The compressed schema in a unit. Raises PeerProtocolError, DeviceRefused, NoAnswer."""
    piece = min(hello.tx_mtu, MTU) - RESPONSE_OVERHEAD_BYTES
    compressed = b""
    total = 1
    while len(compressed) < total:
        part = yield from query(SchemaReadRequest(len(compressed), piece), SchemaReadResponse)
        total = part.total_length
        if not part.data or total > SCHEMA_COMPRESSED_BYTES_MAX:
            raise PeerProtocolError(
                f"Its length of {total} bytes is not what it sends; its firmware is damaged."
            )
        compressed += part.data
    return compressed[:total]


def unpack_schema(compressed: bytes, schema_hash: bytes) -> dict[str, Any]:
    """Decompress and prove a schema. Raises PeerProtocolError when it is not the promised one."""
    unpacker = zlib.decompressobj()
    try:
        text = unpacker.decompress(compressed, SCHEMA_TEXT_BYTES_MAX)
        digest = hashlib.sha256(text).digest()[: len(schema_hash)]
        if digest != schema_hash:
            raise PeerProtocolError(
                f"It promised {schema_hash.hex()} and sent {digest.hex()}; its firmware is damaged."
            )
        schema = json.loads(text)
    except (zlib.error, UnicodeDecodeError, ValueError, RecursionError) as error:
        raise PeerProtocolError(f"It is not readable ({error}).") from error
    if not isinstance(schema, dict):
        raise PeerProtocolError("It is not a table.")
    return schema


def shared_channels(schema: Mapping[str, Any]) -> tuple[Channel, ...]:
    """The registry's channels that a unit's schema has with the same id, unit and scale."""
    theirs = _by_id(schema, "channel")
    return tuple(channel for channel in CHANNELS if _is_channel(channel, theirs.get(channel.id)))


def differences(schema: Mapping[str, Any]) -> list[str]:
    """What keeps us from tuning a unit of this schema, in words; empty when nothing does."""
    return [
        *_parameter_differences(schema),
        *_channel_differences(schema),
        *_message_differences(schema),
    ]


def _parameter_differences(schema: Mapping[str, Any]) -> Iterator[str]:
    theirs = _by_id(schema, "parameter")
    for row in PARAMETERS:
        other = theirs.pop(row.id, None)
        if other is None:
            yield f"it has no {row.name}"
        elif _meaning(row) != _their_meaning(other, schema):
            yield f"{row.name} means something else to it"
    for other in theirs.values():
        yield f"this Spindle does not know its {other.get('name')}"
    ours = [(order.low, order.high) for order in ORDERS]
    if ours != [(row.get("low"), row.get("high")) for row in _rows(schema, "order")]:
        yield "its rules between parameters are others"
    bands = [(b.parameter, b.around, b.within_pct, b.within, b.times) for b in BANDS]
    if bands != [tuple(row.get(key) for key in BAND_KEYS) for row in _rows(schema, "band")]:
        yield "its bands around the factory's values are others"


def _meaning(row: Parameter) -> tuple[object, ...]:
    choices = ENUM_BY_NAME[row.enum].__members__ if row.enum else {}
    return (
        row.name,
        row.type,
        row.unit,
        list(row.shape),
        row.length if row.type == "text" else None,
        row.min,
        row.max,
        {name: int(value) for name, value in choices.items()},
        row.increasing,
        Access(row.access).name,
        row.ratchet,
        row.may_be_none,
    )


def _their_meaning(row: Mapping[str, Any], schema: Mapping[str, Any]) -> tuple[object, ...]:
    enums = schema.get("enum")
    choices = enums.get(row.get("enum"), {}) if isinstance(enums, dict) else {}
    return (
        row.get("name"),
        row.get("type"),
        row.get("unit"),
        row.get("shape", []),
        row.get("length"),
        row.get("min"),
        row.get("max"),
        choices,
        row.get("increasing", False),
        row.get("access"),
        row.get("ratchet", False),
        row.get("none") is not None,
    )


def _channel_differences(schema: Mapping[str, Any]) -> Iterator[str]:
    """Rows of every channel are read by position: ours must be their first ones."""
    theirs = _by_id(schema, "channel")
    first = sorted(theirs)[: len(CHANNELS)]
    for position, channel in enumerate(CHANNELS):
        if not _is_channel(channel, theirs.get(channel.id)) or first[position] != channel.id:
            yield f"its channel {channel.name} is another or missing"
            return


def _is_channel(channel: Channel, theirs: Mapping[str, Any] | None) -> bool:
    return (
        theirs is not None
        and theirs.get("unit") == channel.unit
        and theirs.get("scale") == channel.scale
    )


def _message_differences(schema: Mapping[str, Any]) -> Iterator[str]:
    """A newer side may add fields at the end: what we ask must suffice, what we get be enough."""
    theirs = _by_id(schema, "message")
    for identity, request in REQUEST_BY_ID.items():
        other = theirs.get(identity)
        name = MessageId(identity).name
        if other is None:
            if identity in NEEDED:
                yield f"it does not know {name}"
            continue
        request_layout, response_layout = (
            _layout(request.LAYOUT),
            _layout(RESPONSE_BY_ID[identity].LAYOUT),
        )
        their_request = _without_high_halves(other.get("request"))
        theirs_answered = _without_high_halves(other.get("response"))
        if not _begins_with(request_layout, their_request) or not _begins_with(
            theirs_answered, response_layout
        ):
            yield f"{name} means something else to it"


def _layout(fields: Sequence[Field]) -> list[list[str]]:
    """What must be there: a high half is read as 0 where a side does not know it."""
    return [
        [f.name, f.type + (f"[{f.count}]" if f.count > 1 else "")] for f in fields if not f.high_of
    ]


def _without_high_halves(layout: object) -> object:
    """A unit's layout of a message as `_layout` gives ours."""
    if not isinstance(layout, list):
        return layout
    return [field for field in layout if not (isinstance(field, list) and field[2:] == ["high"])]


def _begins_with(longer: object, shorter: object) -> bool:
    if not isinstance(longer, list) or not isinstance(shorter, list):
        return False
    return longer[: len(shorter)] == shorter


def _rows(schema: Mapping[str, Any], table: str) -> list[Mapping[str, Any]]:
    rows = schema.get(table)
    return [row for row in rows if isinstance(row, dict)] if isinstance(rows, list) else []


def _by_id(schema: Mapping[str, Any], table: str) -> dict[int, Mapping[str, Any]]:
    return {row["id"]: row for row in _rows(schema, table) if isinstance(row.get("id"), int)}
