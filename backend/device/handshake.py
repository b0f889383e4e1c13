"""Becoming acquainted: HELLO, the version, the schema (protocol page, 4.3 Connect).

A unit whose schema is the one this program was built with can be read and written. Another schema
is read from the unit and proven by its hash; what both know by id is shown, writing stays off.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from dataclasses import dataclass
from typing import Any

from backend.device.config_trial import TrialStatus, trial_status
from backend.device.identity import Identity
from backend.device.operation import Operation, ask, attempt, expect
from backend.device.refusals import refused
from backend.errors import DeviceRefused, PeerProtocolError
from firmware_protocol._generated import (
    CHANNELS,
    MAJOR,
    MINOR,
    MTU,
    SCHEMA_HASH,
    EvtFaultListRequest,
    EvtFaultListResponse,
    HelloRequest,
    HelloResponse,
    SchemaReadRequest,
    SchemaReadResponse,
    Status,
)
from firmware_protocol.layout import Channel

HELLO_ATTEMPTS = 5
# Bounds what a broken unit can make us read and unpack; ours is 3 KB compressed, 24 KB as text.
SCHEMA_COMPRESSED_BYTES_MAX = 65536
SCHEMA_TEXT_BYTES_MAX = 1_000_000
# Status, detail or total length, header and CRC of a response beside the data.
RESPONSE_OVERHEAD_BYTES = 16


class VersionRefused(PeerProtocolError):
    """The unit speaks no version of the protocol that we speak."""

    default_code = "version"


@dataclass(frozen=True)
class Acquaintance:
    """What the handshake found out.

    read_only_reason: None when the unit may be written. channels: those of the registry that the
    unit has with the same meaning. trial: where its configuration stands, None when not asked.
    """

    hello: HelloResponse
    identity: Identity
    read_only_reason: str | None
    channels: tuple[Channel, ...]
    fault_flags: int
    trial: TrialStatus | None


def become_acquainted(host_nonce: bytes) -> Operation[Acquaintance]:
    """HELLO, version, schema, faults, trial. Raises NoAnswer, VersionRefused, DeviceRefused."""
    hello = yield from _hello(host_nonce)
    reason: str | None = None
    channels: tuple[Channel, ...] = CHANNELS
    if hello.schema_hash != SCHEMA_HASH:
        try:
            schema = yield from read_schema(hello)
            channels = shared_channels(schema)
            reason = (
                f"The unit's description {hello.schema_hash.hex()} is not the one of this Spindle "
                f"({SCHEMA_HASH.hex()}). Live values that both know are shown; to change settings, "
                "use the Spindle that belongs to its firmware, or update one of them."
            )
        except (DeviceRefused, PeerProtocolError) as error:
            channels = ()
            reason = (
                f"The unit's description {hello.schema_hash.hex()} is unknown and could not be "
                f"read from it: {error.message} Nothing is shown rather than something wrong."
            )
    faults = 0
    trial = None
    if reason is None:
        faults, trial = yield from unit_state()
    return Acquaintance(hello, Identity.from_hello(hello), reason, channels, faults, trial)


def unit_state() -> Operation[tuple[int, TrialStatus]]:
    """What the unit's events would have told: its active faults, and its configuration."""
    listed = yield from ask(EvtFaultListRequest(), EvtFaultListResponse)
    trial = yield from trial_status()
    return listed.fault_flags, trial


def read_schema(hello: HelloResponse) -> Operation[dict[str, Any]]:
    """The schema the unit was built with, proven by its hash. Raises PeerProtocolError."""
    piece = min(hello.tx_mtu, MTU) - RESPONSE_OVERHEAD_BYTES
    compressed = b""
    total = 1
    while len(compressed) < total:
        part = yield from ask(SchemaReadRequest(len(compressed), piece), SchemaReadResponse)
        total = part.total_length
        if not part.data or total > SCHEMA_COMPRESSED_BYTES_MAX:
            raise PeerProtocolError(
                f"Its length of {total} bytes is not what it sends; its firmware is damaged."
            )
        compressed += part.data
    return unpack_schema(compressed[:total], hello.schema_hash)


def unpack_schema(compressed: bytes, schema_hash: bytes) -> dict[str, Any]:
    """Decompress and prove a schema. Raises PeerProtocolError when it is not the promised one."""
    unpacker = zlib.decompressobj()
    try:
        text = unpacker.decompress(compressed, SCHEMA_TEXT_BYTES_MAX)
        found = hashlib.sha256(text).digest()[: len(schema_hash)]
        if found != schema_hash:
            raise PeerProtocolError(
                f"It promised {schema_hash.hex()} and sent {found.hex()}; its firmware is damaged."
            )
        schema = json.loads(text)
    except (zlib.error, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise PeerProtocolError(f"It is not readable ({error}).") from error
    if not isinstance(schema, dict):
        raise PeerProtocolError("It is not a table.")
    return schema


def shared_channels(schema: dict[str, Any]) -> tuple[Channel, ...]:
    """The registry's channels that a unit's schema has with the same id, unit and scale."""
    rows = schema.get("channel", [])
    theirs = {row["id"]: row for row in rows if isinstance(row, dict) and "id" in row}
    return tuple(
        channel
        for channel in CHANNELS
        if channel.id in theirs
        and theirs[channel.id].get("unit") == channel.unit
        and theirs[channel.id].get("scale") == channel.scale
    )


def _hello(host_nonce: bytes) -> Operation[HelloResponse]:
    request = HelloRequest(MAJOR, MAJOR, 0, MTU, host_nonce)
    response = yield from attempt(request, HELLO_ATTEMPTS)
    if response.status == Status.VERSION:
        raise VersionRefused(version_text(str(response.detail)))
    if response.status != Status.OK:
        raise refused(request, response)
    hello = expect(request, response, HelloResponse)
    if hello.major != MAJOR:
        raise VersionRefused(version_text(f"{hello.major}.{hello.minor}"))
    return hello


def version_text(theirs: str) -> str:
    """Names both versions and the way out."""
    return (
        f"The unit speaks protocol {theirs}, this Spindle speaks {MAJOR}.{MINOR}. Install the "
        "Spindle that belongs to the unit's firmware, or update the unit."
    )
