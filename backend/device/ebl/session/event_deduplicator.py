"""The unit's events by their numbers: each is delivered once, and what the line lost comes again.

The unit repeats an event that matters until it is acknowledged (SPEC 1.4), so one may come twice,
or late. A late one tells what happened; how things stand now is asked for.
"""

from __future__ import annotations

from collections import deque
from enum import Enum, auto

from backend.device.states import LinkStatistics
from firmware_protocol._generated import (
    BootEvent,
    EvtAckRequest,
    StreamCountsEvent,
    StreamStatsEvent,
)
from firmware_protocol.codec import Event, Request, encode
from firmware_protocol.framing import encode_frame

SEQ_MODULUS = 1 << 16
# The unit keeps 8 events; a repetition of an older one is not possible.
REMEMBERED_MAX = 64
# Of a request that wants no answer.
NO_TID = 0


class Arrival(Enum):
    """How an event came. LATE: after newer ones. AFTER_A_GAP: others before it did not come yet."""

    IN_ORDER = auto()
    AFTER_A_GAP = auto()
    LATE = auto()
    AGAIN = auto()


class EventDeduplicator:
    """Which events have come; a unit's next life starts a new page."""

    def __init__(self, statistics: LinkStatistics) -> None:
        self._statistics = statistics
        self._boot_id: int | None = None
        self._next_seq: int | None = None
        self._recent_seqs: deque[int] = deque(maxlen=REMEMBERED_MAX)
        self._missing: deque[int] = deque(maxlen=REMEMBERED_MAX)

    def handshake_done(self, boot_id: int) -> None:
        """HELLO was answered: after a reboot old numbers mean nothing, and none before is lost."""
        if boot_id != self._boot_id:
            self._recent_seqs.clear()
        self._boot_id = boot_id
        self._next_seq = None
        self._missing.clear()

    def classify(self, event: Event) -> Arrival:
        """Note an event and say how it came."""
        if isinstance(event.message, BootEvent) and event.message.boot_id != self._boot_id:
            self.handshake_done(event.message.boot_id)
        if event.seq in self._recent_seqs:
            self._statistics.unit_events_again += 1
            return Arrival.AGAIN
        self._recent_seqs.append(event.seq)
        self._statistics.unit_events += 1
        if event.retransmit or self._is_behind(event.seq):
            if event.seq in self._missing:
                self._missing.remove(event.seq)
                self._statistics.unit_events_lost -= 1
            return Arrival.LATE
        expected, self._next_seq = self._next_seq, (event.seq + 1) % SEQ_MODULUS
        lost = 0 if expected is None else (event.seq - expected) % SEQ_MODULUS
        self._statistics.unit_events_lost += lost
        self._missing.extend(
            (event.seq - back) % SEQ_MODULUS for back in range(min(lost, REMEMBERED_MAX), 0, -1)
        )
        return Arrival.AFTER_A_GAP if lost else Arrival.IN_ORDER

    def _is_behind(self, seq: int) -> bool:
        if self._next_seq is None:
            return False
        return (seq - self._next_seq) % SEQ_MODULUS >= SEQ_MODULUS // 2


def acknowledgement(event: Event) -> bytes:
    """What to send when an event has come; b"" for those that the unit does not repeat."""
    if isinstance(event.message, BootEvent | StreamCountsEvent | StreamStatsEvent):
        return b""
    return encode_frame(encode(Request(NO_TID, EvtAckRequest(event.seq))))
