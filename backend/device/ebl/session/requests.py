"""Requests under way: bounded in number, repeated with the same tid, timed by the line itself.

A repetition has the same tid and fields and is marked RETRANSMIT, so the unit recognises it and
answers from its cache without doing the work twice (SPEC.md, 2.2).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from backend.device.ebl.session.operation import Question
from backend.device.states import LinkStatistics
from backend.errors import LinkError, NoAnswer, SpindleError
from firmware_protocol._generated import Status
from firmware_protocol.codec import Request, Response, encode
from firmware_protocol.framing import encode_frame

TIMEOUT_S_MIN = 0.150
# A unit that says PENDING again and again must not hold a caller for ever.
PENDING_S_MAX = 10.0
# Waiting requests of all operations together; more means somebody asks without reading.
WAITING_MAX = 64
# Bits on the line for a byte: start, eight, stop.
BITS_PER_BYTE = 10

OnAnswer = Callable[[Response | SpindleError], None]


@dataclass(eq=False)
class _Pending:
    question: Question
    on_answer: OnAnswer
    ready_s: float | None = None
    tid: int = 0
    number: int = 0
    wire: bytes = b""
    attempts_left: int = 0
    sent_s: float = 0.0
    due_s: float = 0.0
    pending_since_s: float | None = None
    repeated: bool = False


class RequestTable:
    """The requests that wait for their turn or their answer.

    outstanding_max: how many the unit takes at once. bits_per_second: None where frames take no
    time. longest_answer: bytes of the longest answer, for its time on the line.
    """

    def __init__(self, statistics: LinkStatistics) -> None:
        self.outstanding_max = 1
        self.bits_per_second: float | None = None
        self.longest_answer = 128
        self._statistics = statistics
        self._next_tid = 1
        self._started = 0
        self._smoothed_s: float | None = None
        self._shut: SpindleError | None = None
        self._waiting: deque[_Pending] = deque()
        self._pending: dict[int, _Pending] = {}

    @property
    def is_idle(self) -> bool:
        """Whether nothing is under way; what waits for its time does not keep the line busy."""
        return not self._pending and all(one.question.after_s > 0.0 for one in self._waiting)

    def submit(self, question: Question, on_answer: OnAnswer) -> Callable[[], None]:
        """Queue a question; `on_answer` gets the response or the error, exactly once.

        The result takes the question back: it is not sent (again), and `on_answer` gets nothing.
        """
        if self._shut is not None:
            raise self._shut
        if len(self._waiting) >= WAITING_MAX:
            raise LinkError("The unit has too many requests waiting; try again in a moment.")
        entry = _Pending(question, on_answer)
        self._waiting.append(entry)
        return partial(self._withdraw, entry)

    def frames_due(self, now_s: float) -> bytes:
        """Bytes to send now: new requests while there is room, repetitions whose time has come.

        Requests out of attempts get NoAnswer.
        """
        out = bytearray()
        for entry in [entry for entry in self._pending.values() if entry.due_s <= now_s]:
            if self._pending.get(entry.tid) is not entry:
                # Whoever got the answer before this one ended the conversation.
                continue
            if entry.attempts_left > 0:
                entry.repeated = True
                self._statistics.requests_repeated += 1
                out += self._send(entry, now_s)
            else:
                del self._pending[entry.tid]
                self._statistics.requests_unanswered += 1
                entry.on_answer(_no_answer(entry))
        for entry in self._ready(now_s):
            if not self._may_start():
                break
            self._waiting.remove(entry)
            self._start(entry)
            out += self._send(entry, now_s)
        return bytes(out)

    def answered(self, response: Response, now_s: float) -> None:
        """Match a response to its request; one that fits nothing is counted and dropped."""
        entry = self._pending.get(response.tid)
        if entry is None or response.message_id != entry.question.message.MESSAGE_ID:
            self._statistics.responses_unexpected += 1
            return
        if response.status == Status.PENDING:
            self._extend_deadline(entry, response.detail / 1000.0, now_s)
            return
        del self._pending[entry.tid]
        if not entry.repeated:
            # Karn: a repeated request does not tell which sending was answered.
            self._measure(now_s - entry.sent_s)
        entry.on_answer(response)

    def start_from(self, tid: int) -> None:
        """Number requests from `tid`, so that a unit's cache does not take us for our past."""
        self._next_tid = tid % 256 or 1

    def open(self, outstanding_max: int) -> None:
        """Take requests (again)."""
        self._shut = None
        self.outstanding_max = outstanding_max

    def shut(self, error: SpindleError) -> None:
        """Give every request this error, later ones too until `open`: the unit is gone."""
        self._shut = error
        entries = [*self._pending.values(), *self._waiting]
        self._pending.clear()
        self._waiting.clear()
        for entry in entries:
            entry.on_answer(error)

    def timeout_s(self, request_bytes: int) -> float:
        """How long an answer may take: max(150 ms, 4 SRTT + time on the line)."""
        line_s = 0.0
        if self.bits_per_second:
            line_s = (request_bytes + self.longest_answer) * BITS_PER_BYTE / self.bits_per_second
        return max(TIMEOUT_S_MIN, 4.0 * (self._smoothed_s or 0.0) + line_s)

    def _withdraw(self, entry: _Pending) -> None:
        if entry in self._waiting:
            self._waiting.remove(entry)
        if self._pending.get(entry.tid) is entry:
            del self._pending[entry.tid]

    def _may_start(self) -> bool:
        """Whether one more request keeps every repetition recognisable.

        The unit remembers its last `outstanding_max` answers. A request whose answer was lost must
        still be among them when it is repeated, so no more than that may start after the oldest.
        """
        if not self._pending:
            return True
        oldest = next(iter(self._pending.values()))
        return self._started - oldest.number < self.outstanding_max

    def _ready(self, now_s: float) -> list[_Pending]:
        """What waits for nothing but its turn, in order."""
        ready = []
        for entry in self._waiting:
            if entry.ready_s is None:
                entry.ready_s = now_s + entry.question.after_s
            if entry.ready_s <= now_s:
                ready.append(entry)
        return ready

    def _start(self, entry: _Pending) -> None:
        while self._next_tid in self._pending:
            self._next_tid = self._next_tid % 255 + 1
        entry.tid = self._next_tid
        self._next_tid = self._next_tid % 255 + 1
        entry.attempts_left = entry.question.attempts
        entry.number = self._started
        self._started += 1
        self._pending[entry.tid] = entry
        self._statistics.requests_sent += 1

    def _send(self, entry: _Pending, now_s: float) -> bytes:
        request = Request(entry.tid, entry.question.message, retransmit=entry.repeated)
        entry.wire = encode_frame(encode(request))
        entry.attempts_left -= 1
        entry.sent_s = now_s
        patience_s = entry.question.timeout_s
        if patience_s is None:
            patience_s = self.timeout_s(len(entry.wire))
        entry.due_s = now_s + patience_s
        return entry.wire

    def _extend_deadline(self, entry: _Pending, hint_s: float, now_s: float) -> None:
        if entry.pending_since_s is None:
            entry.pending_since_s = now_s
        if now_s - entry.pending_since_s < PENDING_S_MAX:
            entry.due_s = now_s + hint_s + self.timeout_s(len(entry.wire))

    def _measure(self, round_trip_s: float) -> None:
        before = self._smoothed_s
        self._smoothed_s = round_trip_s if before is None else before + (round_trip_s - before) / 8
        self._statistics.round_trip_ms = self._smoothed_s * 1000.0


def _no_answer(entry: _Pending) -> NoAnswer:
    request_name = type(entry.question.message).__name__.removesuffix("Request")
    return NoAnswer(
        f"The unit did not answer {request_name} ({entry.question.attempts} attempts). "
        "Check that it is switched on and the cable holds."
    )
