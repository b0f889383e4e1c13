"""Frames to messages and back: pure, typed, and no frame makes it raise.

A frame is header and payload without its check value (see framing). What cannot be understood
comes back as Malformed with the reason, so that a session can answer or report it.
"""

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from firmware_protocol._generated import (
    EVENT_BY_CODE,
    MAJOR,
    REQUEST_BY_ID,
    RESPONSE_BY_ID,
    Status,
)
from firmware_protocol._generated import (
    Event as EventCode,
)
from firmware_protocol.layout import Message, ShortPayload

Rows: TypeAlias = npt.NDArray[np.int16]

KIND_REQUEST, KIND_RESPONSE, KIND_STREAM, KIND_ASYNC = range(4)
FLAG_MORE, FLAG_RETRANSMIT, RESERVED_BIT = 1, 2, 4
BULK_SESSION_MAX = 15

_HEADER = struct.Struct("<BBH")
_STREAM = struct.Struct("<IBB")
_EVENT = struct.Struct("<BI")
_BULK = struct.Struct("<IHH")
_EPOCH_BITS, _OVERRUN_BIT, _CLIP_BIT, _ENCODING_BITS = 0x07, 0x08, 0x10, 0x60


class Reason(Enum):
    """Why a frame is not a message; the values are the results of ebl_frame_check."""

    LENGTH = -2
    RESERVED = -3
    VERSION = -4
    UNKNOWN_MSG = -5
    SHAPE = -6


@dataclass(frozen=True, slots=True)
class Request:
    """A question of the host; `retransmit` marks the same tid sent again."""

    tid: int
    message: Message
    retransmit: bool = False


@dataclass(frozen=True, slots=True)
class Response:
    """An answer. `message` is None unless `status` is OK; then `payload` follows the detail.

    `status` is an int outside Status when the unit knows a code we do not: an error all the same.
    """

    tid: int
    message_id: int
    status: Status | int
    detail: int = 0
    message: Message | None = None
    payload: bytes = b""
    retransmit: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Stream:
    """Telemetry rows. `values`: int16 (n, channels), a view of the frame; -32768 is missing."""

    stream_id: int
    seq: int
    t0_us: int
    epoch: int
    values: Rows
    overrun: bool = False
    clip: bool = False


@dataclass(frozen=True, slots=True)
class Event:
    """Something happened in the unit. A code we do not know has no `message` and no `fields`.

    retransmit: sent before, and not acknowledged.
    """

    seq: int
    code: EventCode | int
    t_us: int
    message: Message | None = None
    payload: bytes = b""
    fields: Mapping[str, object] = field(default_factory=dict)
    retransmit: bool = False


@dataclass(frozen=True, slots=True)
class Bulk:
    """A piece of a ride log: `data` lies at byte `offset` of it. `session`: 1 to 15."""

    session: int
    seq: int
    offset: int
    data: bytes


@dataclass(frozen=True, slots=True)
class Malformed:
    """A frame that passed its check value and still cannot be understood."""

    reason: Reason
    frame: bytes


Decoded: TypeAlias = Request | Response | Stream | Event | Bulk | Malformed


def decode(frame: bytes, channel_count: int | None = None) -> Decoded:
    """The message in a frame. `channel_count`: of the stream, where the caller knows it.

    Without it the rows of a stream are as wide as the payload says. Never raises on any bytes.
    """
    if len(frame) < _HEADER.size:
        return Malformed(Reason.LENGTH, frame)
    first, tag, word = _HEADER.unpack_from(frame)
    if first >> 5 != MAJOR:
        return Malformed(Reason.VERSION, frame)
    if first & RESERVED_BIT:
        return Malformed(Reason.RESERVED, frame)
    kind = first >> 3 & 3
    if kind == KIND_STREAM:
        return decode_stream(frame, channel_count)
    retransmit = bool(first & FLAG_RETRANSMIT)
    try:
        if kind == KIND_REQUEST:
            return _request(frame, tag, word, retransmit)
        if kind == KIND_RESPONSE:
            return _response(frame, tag, word, retransmit)
        return _event(frame, word, retransmit) if tag == 0 else _bulk(frame, tag, word)
    except ShortPayload:
        return Malformed(Reason.LENGTH, frame)


def decode_stream(frame: bytes, channel_count: int | None = None) -> Stream | Malformed:
    """A stream frame whose header is already known to be one; the rows are not copied."""
    size = len(frame) - _HEADER.size - _STREAM.size
    if size < 0:
        return Malformed(Reason.LENGTH, frame)
    _, stream_id, seq = _HEADER.unpack_from(frame)
    t0_us, rows, flags = _STREAM.unpack_from(frame, _HEADER.size)
    if channel_count is None:
        channel_count = size // (2 * rows) if rows else 0
    if size != 2 * rows * channel_count or flags & _ENCODING_BITS:
        return Malformed(Reason.SHAPE, frame)
    values = np.frombuffer(frame, dtype="<i2", offset=_HEADER.size + _STREAM.size)
    return Stream(
        stream_id,
        seq,
        t0_us,
        flags & _EPOCH_BITS,
        values.reshape(rows, channel_count),
        bool(flags & _OVERRUN_BIT),
        bool(flags & _CLIP_BIT),
    )


def _request(frame: bytes, tid: int, message_id: int, retransmit: bool) -> Decoded:
    message_type = REQUEST_BY_ID.get(message_id)
    if message_type is None:
        return Malformed(Reason.UNKNOWN_MSG, frame)
    return Request(tid, message_type.from_bytes(frame[_HEADER.size :]), retransmit)


def _response(frame: bytes, tid: int, message_id: int, retransmit: bool) -> Decoded:
    payload = frame[_HEADER.size :]
    if not payload:
        return Malformed(Reason.LENGTH, frame)
    if payload[0] == Status.OK:
        message_type = RESPONSE_BY_ID.get(message_id)
        if message_type is None:
            return Malformed(Reason.UNKNOWN_MSG, frame)
        message = message_type.from_bytes(payload[1:])
        return Response(tid, message_id, Status.OK, 0, message, payload[1:], retransmit)
    if len(payload) < 3:
        return Malformed(Reason.LENGTH, frame)
    detail = int.from_bytes(payload[1:3], "little")
    status = _known(Status, payload[0])
    return Response(tid, message_id, status, detail, None, payload[3:], retransmit)


def _bulk(frame: bytes, session: int, seq: int) -> Decoded:
    if session > BULK_SESSION_MAX:
        return Malformed(Reason.UNKNOWN_MSG, frame)
    if len(frame) < _HEADER.size + _BULK.size:
        return Malformed(Reason.LENGTH, frame)
    offset, length, _ = _BULK.unpack_from(frame, _HEADER.size)
    data = frame[_HEADER.size + _BULK.size :]
    if length != len(data) or not data:
        return Malformed(Reason.SHAPE, frame)
    return Bulk(session, seq, offset, bytes(data))


def _event(frame: bytes, seq: int, retransmit: bool) -> Decoded:
    if len(frame) < _HEADER.size + _EVENT.size:
        return Malformed(Reason.LENGTH, frame)
    code, t_us = _EVENT.unpack_from(frame, _HEADER.size)
    payload = frame[_HEADER.size + _EVENT.size :]
    message_type = EVENT_BY_CODE.get(code)
    if message_type is None:
        return Event(seq, code, t_us, None, payload, {}, retransmit)
    message = message_type.from_bytes(payload)
    names = [column.name for column in message.LAYOUT if not column.high_of]
    return Event(
        seq,
        EventCode(code),
        t_us,
        message,
        payload,
        {name: getattr(message, name) for name in names},
        retransmit,
    )


def _known(codes: type[Status], code: int) -> Status | int:
    try:
        return codes(code)
    except ValueError:
        return code


def encode(message: Request | Response | Stream | Event | Bulk) -> bytes:
    """The frame of a message. Raises struct.error or ValueError if a value does not fit."""
    if isinstance(message, Request):
        identity = message.message.MESSAGE_ID
        header = _header(KIND_REQUEST, message.retransmit, message.tid, identity)
        return header + message.message.to_bytes()
    if isinstance(message, Response):
        header = _header(KIND_RESPONSE, message.retransmit, message.tid, message.message_id)
        body = message.message.to_bytes() if message.message is not None else message.payload
        detail = b"" if message.status == Status.OK else struct.pack("<H", message.detail)
        return header + bytes([message.status]) + detail + body
    if isinstance(message, Stream):
        flags = message.epoch & _EPOCH_BITS
        flags |= _OVERRUN_BIT * message.overrun | _CLIP_BIT * message.clip
        header = _header(KIND_STREAM, False, message.stream_id, message.seq)
        rows = np.ascontiguousarray(message.values, dtype="<i2")
        return header + _STREAM.pack(message.t0_us, len(rows), flags) + rows.tobytes()
    if isinstance(message, Bulk):
        header = _header(KIND_ASYNC, False, message.session, message.seq)
        return header + _BULK.pack(message.offset, len(message.data), 0) + message.data
    header = _header(KIND_ASYNC, message.retransmit, 0, message.seq)
    body = message.message.to_bytes() if message.message is not None else message.payload
    return header + _EVENT.pack(message.code, message.t_us) + body


def _header(kind: int, retransmit: bool, tag: int, word: int) -> bytes:
    return _HEADER.pack(MAJOR << 5 | kind << 3 | FLAG_RETRANSMIT * retransmit, tag, word)
