"""Operations: what is asked of a unit, written from top to bottom.

An operation is a generator. It yields requests and gets their responses; the session sends, waits,
repeats. So a transaction of six round trips reads like six calls, without a thread or a clock:

    def clock() -> Operation[int]:
        snapshot = yield from ask(StrSnapshotRequest(b""), StrSnapshotResponse)
        return snapshot.t_us
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from backend.device.ebl.session.refusals import refused
from backend.errors import FieldError, NoAnswer, PeerProtocolError
from firmware_protocol._generated import Status
from firmware_protocol.codec import Response
from firmware_protocol.layout import Message

# The first sending and three repetitions.
ATTEMPTS = 4
# A unit that asks for longer spares its flash: whoever writes has to know.
PATIENCE_MS = 5000

Result = TypeVar("Result")
Answer = TypeVar("Answer", bound=Message)


class OrphanLeft(NoAnswer):
    """The unit may hold a transaction of ours that we cannot name or did not get it to drop.

    It was not committed. Only a new session ends it before its lease does: the session that sees
    this says HELLO again.
    """

    def __init__(self, message: str, fields: Iterable[FieldError] = ()) -> None:
        super().__init__(message, fields=fields, outcome="unchanged")


@dataclass(frozen=True, slots=True)
class Question:
    """One request of an operation. attempts: sendings before NoAnswer. after_s: not sent before.

    timeout_s: how long each waits for its answer, None for what the line needs.
    """

    message: Message
    attempts: int = ATTEMPTS
    after_s: float = 0.0
    timeout_s: float | None = None


# Yields questions that may be on the way together, gets the responses in the same order.
Operation: TypeAlias = Generator[Sequence[Question], Sequence[Response], Result]


def attempt(
    message: Message,
    attempts: int = ATTEMPTS,
    after_s: float = 0.0,
    timeout_s: float | None = None,
) -> Operation[Response]:
    """Ask and return the response whatever its status. Raises NoAnswer."""
    responses = yield (Question(message, attempts, after_s, timeout_s),)
    return responses[0]


def attempt_patiently(message: Message, waits_max: int = 3) -> Operation[Response]:
    """Ask, and again when the unit says RATE_LIMIT, after the time it names; a longer one than
    PATIENCE_MS is the answer. Raises NoAnswer."""
    response = yield from attempt(message)
    for _ in range(waits_max):
        if response.status != Status.RATE_LIMIT or response.detail > PATIENCE_MS:
            break
        response = yield from attempt(message, after_s=response.detail / 1000.0)
    return response


def query(message: Message, answer: type[Answer], attempts: int = ATTEMPTS) -> Operation[Answer]:
    """Ask and return the answer's fields. Raises DeviceRefused for any status but OK, NoAnswer."""
    response = yield from attempt(message, attempts)
    return expect(message, response, answer)


def query_all(messages: Sequence[Message], answer: type[Answer]) -> Operation[list[Answer]]:
    """Ask several at once, so that the line never idles between them; answers in their order."""
    responses = yield tuple(Question(message) for message in messages)
    return [
        expect(message, response, answer)
        for message, response in zip(messages, responses, strict=True)
    ]


def expect(message: Message, response: Response, answer: type[Answer]) -> Answer:
    """The response's fields. Raises DeviceRefused, or PeerProtocolError for another answer."""
    if response.status != Status.OK:
        raise refused(message, response)
    if not isinstance(response.message, answer):
        raise PeerProtocolError(
            f"The unit answered {type(message).__name__} with something else "
            f"({response.payload[:16].hex()}). Its firmware does not keep the protocol."
        )
    return response.message
