"""Where a device stands, and why, for people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

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
