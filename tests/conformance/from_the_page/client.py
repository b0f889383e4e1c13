"""A host as SPEC.md describes one: requests with ids, time-outs and repetitions, and what comes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from tests.conformance.from_the_page.page import Fields, Page, pack, unpack
from tests.conformance.from_the_page.wire import (
    ASYNC,
    REQUEST,
    RESPONSE,
    RETRANSMIT,
    STREAM,
    Frame,
    Receiver,
)

STEP_S = 0.005
ANSWER_S = 0.150
SENDINGS = 4
PENDING_S_MAX = 10.0
ID_MAX = 255
EVENT_CHANNEL = 0


class Line(Protocol):
    """A unit's line, and the time that passes on it."""

    def send(self, data: bytes) -> object: ...

    def receive(self) -> bytes: ...

    def advance(self, seconds: float) -> None: ...


class NoAnswerError(Exception):
    """Nothing came, as often as it was asked."""


@dataclass(frozen=True)
class Answer:
    """status: its name. fields: of an OK. detail, rest: of any other."""

    status: str
    fields: Fields = field(default_factory=dict)
    detail: int = 0
    rest: bytes = b""


@dataclass(frozen=True)
class Event:
    seq: int
    name: str
    fields: Fields
    repeated: bool


@dataclass
class Client:
    """acknowledges: whether events are. repetitions: requests that were sent again."""

    line: Line
    page: Page
    acknowledges: bool = True
    repetitions: int = 0
    events: list[Event] = field(default_factory=list)
    streams: list[Frame] = field(default_factory=list)
    pieces: list[Frame] = field(default_factory=list)
    _answers: list[Frame] = field(default_factory=list)
    _receiver: Receiver = field(default_factory=Receiver)
    _last_id: int = 0

    def connect(self, nonce: bytes, mtu: int = 544) -> Fields:
        """Ends any half frame, and says HELLO."""
        self.line.send(b"\0\0")
        asked = {
            "major_min": 1, "major_max": 1, "host_flags": 0, "host_mtu": mtu, "host_nonce": nonce,
        }  # fmt: skip
        answer = self.ask("HELLO", asked)
        assert answer.status == "OK", answer
        return answer.fields

    def ask(self, name: str, values: Fields | None = None) -> Answer:
        """One request, repeated under its id until it is answered."""
        message = self.page.messages[name]
        self._last_id = self._last_id % ID_MAX + 1
        payload = pack(message.request, values or {})
        for sending in range(SENDINGS):
            self.repetitions += sending > 0
            flags = RETRANSMIT if sending else 0
            request = Frame(REQUEST, self._last_id, message.id, payload, flags)
            self.line.send(request.on_the_wire())
            answer = self._wait(request)
            if answer is not None:
                return answer
        raise NoAnswerError(name)

    def tell(self, name: str, values: Fields) -> None:
        """An acknowledgement that wants no answer: transaction id 0."""
        message = self.page.messages[name]
        payload = pack(message.request, values)
        self.line.send(Frame(REQUEST, 0, message.id, payload).on_the_wire())

    def listen(self, seconds: float) -> None:
        """Let time pass; what comes is sorted by its kind."""
        for _ in range(round(seconds / STEP_S)):
            self.line.advance(STEP_S)
            self._hear()

    def _wait(self, request: Frame) -> Answer | None:
        left_s, pending_s = ANSWER_S, 0.0
        while left_s > 0.0:
            self.line.advance(STEP_S)
            left_s -= STEP_S
            self._hear()
            while self._answers:
                frame = self._answers.pop(0)
                if (frame.tag, frame.word) != (request.tag, request.word):
                    continue
                answer = self._answer(frame)
                if answer.status != "PENDING":
                    return answer
                pending_s += answer.detail / 1000
                if pending_s < PENDING_S_MAX:
                    left_s = answer.detail / 1000 + ANSWER_S
        return None

    def _answer(self, frame: Frame) -> Answer:
        status = self.page.statuses.get(frame.payload[0], str(frame.payload[0]))
        if status == "OK":
            message = self.page.messages[self.page.message_names[frame.word]]
            return Answer(status, unpack(message.response, frame.payload[1:]))
        detail = int.from_bytes(frame.payload[1:3], "little")
        return Answer(status, {}, detail, frame.payload[3:])

    def _hear(self) -> None:
        for frame in self._receiver.feed(self.line.receive()):
            if frame.kind == RESPONSE:
                self._answers.append(frame)
            elif frame.kind == STREAM:
                self.streams.append(frame)
            elif frame.kind == ASYNC and frame.tag == EVENT_CHANNEL:
                self._event(frame)
            elif frame.kind == ASYNC:
                self.pieces.append(frame)

    def _event(self, frame: Frame) -> None:
        name, fields = self.page.events.get(frame.payload[0], (str(frame.payload[0]), ()))
        repeated = bool(frame.flags & RETRANSMIT)
        self.events.append(Event(frame.word, name, unpack(fields, frame.payload[5:]), repeated))
        if self.acknowledges and name not in NOT_ACKNOWLEDGED:
            self.tell("EVT_ACK", {"seq": frame.word})


NOT_ACKNOWLEDGED = ("BOOT", "STREAM_STATS", "STREAM_COUNTS")
