"""The handshake: HELLO, the version, the schema.

A unit whose schema is the one this program was built with can be read and written. Another schema
is taken from those known or read from the unit, and proven by its hash. Where it means the same to
us, the unit is like any other; else what both know is shown, and writing stays off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from backend.device.configuration import TrialStatus
from backend.device.ebl.session.hello_identity import identity_of
from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.device.ebl.session.refusals import refused
from backend.device.ebl.session.schema import Schemas, differences, schema_of_unit, shared_channels
from backend.device.ebl.session.trial_status import trial_status
from backend.device.states import Identity
from backend.errors import DeviceRefused, NoAnswer, PeerProtocolError
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
    ResetCause,
    StartInfoRequest,
    StartInfoResponse,
    Status,
)
from firmware_protocol.layout import Channel
from firmware_protocol.spelling import word_of

HELLO_ATTEMPTS = 5
# What a person can take in; the rest is counted.
DIFFERENCES_SHOWN = 3


class VersionRefused(PeerProtocolError):
    """The unit speaks no version of the protocol that we speak."""

    default_code = "version"


@dataclass(frozen=True)
class Handshake:
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


def run_handshake(
    host_nonce: bytes,
    schemas: Schemas,
    go_faster: Callable[[HelloResponse], Operation[None]],
) -> Operation[Handshake]:
    """HELLO, version, the line's rate, schema, faults, trial.

    schemas: those known from before; one that is read is added. Raises NoAnswer, VersionRefused,
    DeviceRefused.
    """
    hello = yield from _hello(host_nonce)
    yield from go_faster(hello)
    reason: str | None = None
    channels: tuple[Channel, ...] = CHANNELS
    if hello.schema_hash != SCHEMA_HASH:
        reason, channels = yield from _other_schema(hello, schemas)
    faults = 0
    trial = None
    cause = None
    if reason is None:
        faults, trial = yield from read_unit_state()
        cause = yield from _reset_cause()
    identity = identity_of(hello, cause)
    return Handshake(hello, identity, reason, channels, faults, trial)


def _reset_cause() -> Operation[str | None]:
    """Why the unit started, in lower case; None where its firmware has no word for it."""
    response = yield from attempt(StartInfoRequest())
    if not isinstance(response.message, StartInfoResponse):
        return None
    cause = response.message.reset_cause
    return word_of(ResetCause(cause).name) if cause in set(ResetCause) else f"cause_{cause}"


def _other_schema(
    hello: HelloResponse, schemas: Schemas
) -> Operation[tuple[str | None, tuple[Channel, ...]]]:
    """Why a unit of another schema is only looked at, None if it is not, and its channels."""
    name = hello.schema_hash.hex()
    try:
        schema = yield from schema_of_unit(hello, schemas)
    except VersionRefused:
        raise
    except (DeviceRefused, PeerProtocolError, NoAnswer) as error:
        return (
            f"The unit's description {name} is unknown and could not be read from it: "
            f"{error.message} Nothing is shown rather than something wrong, and nothing can be "
            "changed. Connect again, or use the Spindle that belongs to its firmware."
        ), ()
    wrong = differences(schema)
    if not wrong:
        return None, shared_channels(schema)
    more = f" and {len(wrong) - DIFFERENCES_SHOWN} more" if len(wrong) > DIFFERENCES_SHOWN else ""
    return (
        f"The unit's description {name} is not the one of this Spindle ({SCHEMA_HASH.hex()}): "
        f"{'; '.join(wrong[:DIFFERENCES_SHOWN])}{more}. Live values that both know are shown; to "
        "change settings, use the Spindle that belongs to its firmware, or update one of them."
    ), shared_channels(schema)


def read_unit_state() -> Operation[tuple[int, TrialStatus]]:
    """What the unit's events would have told: its active faults, and its configuration."""
    listed = yield from query(EvtFaultListRequest(), EvtFaultListResponse)
    trial = yield from trial_status()
    return listed.fault_flags, trial


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
