"""Where a device is and why, who its unit says it is, what its link lost; for other threads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

from backend.core.described import described
from backend.device.stream import StreamBlock, StreamStarted


class LinkState(Enum):
    """connecting: no handshake yet, or again. ready: may be read and written. read_only: may
    be read, the reason says why not written. lost: was connected and is silent or unplugged.
    closed: given up by us, or refused."""

    CONNECTING = "connecting"
    READY = "ready"
    READ_ONLY = "read_only"
    LOST = "lost"
    CLOSED = "closed"


CONNECTED = (LinkState.READY, LinkState.READ_ONLY)


class CodedReason(str):
    """A sentence with a code, for those who say it in another language."""

    code: str

    def __new__(cls, text: str, code: str = "") -> CodedReason:
        made = super().__new__(cls, text)
        made.code = code
        return made


def code_of(reason: str) -> str:
    """The code of a sentence; "" for one that has none."""
    return reason.code if isinstance(reason, CodedReason) else ""


@dataclass(frozen=True)
class StateChanged:
    """The device stands elsewhere now; reason is a sentence for people."""

    state: LinkState
    reason: str


@dataclass(frozen=True)
class UnitEvent:
    """Something the unit tells of itself.

    name: of the registry (`FAULT_SET`), or `EVENT_n` of a newer firmware. t_us: unit time, 32 bit.
    """

    name: str
    t_us: int
    fields: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Named:
    """The unit's owner said how it is called, after it was added. Told from any thread."""

    name: str


DeviceEvent: TypeAlias = StateChanged | StreamStarted | StreamBlock | UnitEvent | Named


@described
class Identity:
    """Who a unit says it is, in words and hexadecimal; null for what it does not say, never ""."""

    serial_number: str | None
    """Lasts as long as the unit."""
    model: str
    firmware_version: str | None
    hardware_revision: int | None = None
    protocol_version: str | None = None
    schema_hash: str | None = None
    simulated: bool = False
    boot_id: int | None = None
    """Another one at every start of the unit."""
    reset_cause: str | None = None
    """Why the unit started: `power_on`, `brown_out`, `watchdog`, `fault_handler`, `deadline` or
    `software`; null where its firmware cannot tell."""


@dataclass
class LinkStatistics:
    """Counters since the device was added; a copy is a consistent snapshot.

    frames_bad: damaged on the way (CRC, stuffing, length). frames_malformed: whole, but not of the
    protocol. responses_unexpected: to nothing we asked. stream_frames_foreign: of an earlier
    subscription, dropped instead of misread. stream_frames_repeated: a sequence number that does
    not go forward. round_trip_ms: smoothed, None before the first answer. unit_*: the unit's own
    count of stream frames since its subscription. balance_*: stream frames over all subscriptions,
    up to the unit's latest count that the stream has passed: built = received + lost on the line +
    dropped by the unit, exactly. unit_steps_missed: control steps that came too late for a row.
    unit_events_lost: numbers of events that did not come (yet); the unit was asked for its state
    instead. unit_events_again: repetitions of events that had come.
    bits_per_second: the line's rate now, None where it has none. clock_skew_ppm: how much faster
    than ours the unit's clock runs. clock_uncertainty_ms: how well its time is known,
    half of the shortest round trip.
    """

    bytes_received: int = 0
    bytes_sent: int = 0
    frames_received: int = 0
    frames_bad: int = 0
    frames_malformed: int = 0
    requests_sent: int = 0
    requests_repeated: int = 0
    requests_unanswered: int = 0
    responses_unexpected: int = 0
    stream_frames: int = 0
    stream_rows: int = 0
    stream_rows_lost: int = 0
    stream_frames_foreign: int = 0
    stream_frames_repeated: int = 0
    unit_events: int = 0
    unit_events_lost: int = 0
    unit_events_again: int = 0
    balance_built: int = 0
    balance_received: int = 0
    balance_lost: int = 0
    balance_dropped: int = 0
    unit_steps_missed: int = 0
    unit_frames_built: int | None = None
    unit_frames_dropped: int | None = None
    connections: int = 0
    events_dropped: int = 0
    round_trip_ms: float | None = None
    bits_per_second: int | None = None
    clock_skew_ppm: float | None = None
    clock_uncertainty_ms: float | None = None


@dataclass(frozen=True)
class DeviceStatus:
    """A conversation's state, copied.

    trial_ends_unix_us: when the configuration on trial is given up; None while none is on trial.
    trial_left_s: how long until then. rollback_cause: why
    the latest trial was given up, as in TrialStatus; None while that is not known.
    """

    state: LinkState
    reason: str
    identity: Identity | None
    config_generation: int | None
    config_crc32: int | None
    trial_ends_unix_us: int | None
    trial_left_s: float | None
    rollback_cause: str | None
    faults_active: tuple[str, ...]
    streaming: StreamStarted | None
    last_block: StreamBlock | None
    statistics: LinkStatistics
