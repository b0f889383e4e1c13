"""Writes a simulated unit's configuration the way any host does: one transaction over the wire.

For tests and scenarios in virtual time. The answers are read from the unit's own serial line, so
this may be used only while no other host talks to it.
"""

import zlib
from typing import Any

from firmware_protocol._generated import (
    Bank,
    CfgBeginRequest,
    CfgCommitRequest,
    CfgInfoRequest,
    CfgReadRequest,
    CfgSetRequest,
    CfgValidateRequest,
    MessageId,
    Status,
)
from firmware_protocol.codec import Request, Response, decode, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.layout import Message
from firmware_protocol.parameters import pack_image, set_items, unpack_image
from sim_device.firmware.python.unit import Unit

ANSWER_MS_MAX = 200
READ_LENGTH = 256


class ConfigureError(RuntimeError):
    """The unit refused, or did not answer in time."""


def write_config(unit: Unit, changes: dict[str, Any]) -> None:
    """Changes parameters by their registry names in a standing unit; its clock moves on a little.

    Raises ConfigureError with the unit's status and detail.
    """
    exchange = Exchange(unit)
    info: Any = exchange.ask(CfgInfoRequest())
    staged = unpack_image(_read(exchange, info.image_length)) | changes
    begun: Any = exchange.ask(
        CfgBeginRequest(base_generation=info.generation, base_crc32=info.crc32)
    )
    for items in set_items(changes):
        exchange.ask(CfgSetRequest(transaction=begun.transaction, items=items))
    exchange.ask(CfgValidateRequest(transaction=begun.transaction))
    exchange.ask(
        CfgCommitRequest(
            transaction=begun.transaction,
            staged_crc32=zlib.crc32(pack_image(staged)),
            flags=0,
            confirm_s=0,
        )
    )


def read_image(unit: Unit) -> bytes:
    """The configuration a unit runs on; its clock moves on a little. Raises ConfigureError."""
    exchange = Exchange(unit)
    info: Any = exchange.ask(CfgInfoRequest())
    return _read(exchange, info.image_length)


def _read(exchange: "Exchange", length: int) -> bytes:
    image = b""
    while len(image) < length:
        wanted = min(READ_LENGTH, length - len(image))
        piece: Any = exchange.ask(
            CfgReadRequest(bank=Bank.ACTIVE, offset=len(image), length=wanted)
        )
        if not piece.data:
            raise ConfigureError(f"the image ended after {len(image)} of {length} bytes")
        image += piece.data
    return image


class Exchange:
    """One question at a time, the unit's clock moving on until it is answered; everything but the
    answer is dropped."""

    def __init__(self, unit: Unit) -> None:
        self._unit = unit
        self._decoder = FrameDecoder()
        self._tid = 0

    def ask(self, message: Message) -> Message:
        """The answer's payload. Raises ConfigureError for a refusal and for silence."""
        self.tell(message)
        for _ in range(ANSWER_MS_MAX):
            self._unit.advance_us(1000)
            for frame in self._decoder.feed(self._unit.transmit()):
                answer = decode(frame)
                if not isinstance(answer, Response) or answer.tid != self._tid:
                    continue
                # A host before us may have asked under the same number and left.
                if answer.message_id == message.MESSAGE_ID:
                    return self._accepted(answer)
        raise ConfigureError(f"{type(message).__name__}: no answer in {ANSWER_MS_MAX} ms")

    def tell(self, message: Message) -> None:
        """Sends without waiting for the answer; the clock stands."""
        self._tid = self._tid % 255 + 1
        self._unit.receive(encode_frame(encode(Request(self._tid, message))))

    def _accepted(self, answer: Response) -> Message:
        if answer.status != Status.OK or answer.message is None:
            asked = MessageId(answer.message_id).name
            raise ConfigureError(f"{asked}: {answer.status!r}, detail {answer.detail}")
        return answer.message
