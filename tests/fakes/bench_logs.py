"""Rides and ride logs of the bench unit: ride, list, fetch, as a host without a window would."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

from sim_device.firmware.python._native import lib

from backend.device.ebl.operations.ride_logs import ENTRY
from firmware_protocol import codec, framing
from firmware_protocol._generated import (
    LogAckRequest,
    LogConfirmRequest,
    LogFlags,
    LogListRequest,
    LogListResponse,
    LogOpenRequest,
    Status,
)
from firmware_protocol.layout import Message
from tests.fakes.bench_unit import BenchUnit

SESSION = 7
STANDSTILL_S = 20.0
BLOCK_BYTES = 2048
LOG_BYTES = 32 * BLOCK_BYTES


@dataclass(frozen=True)
class Entry:
    """A log as LOG_LIST tells it."""

    log_id: int
    generation: int
    boot_id: int
    t0_us: int
    t1_us: int
    length: int
    flags: LogFlags


def unit_with_log(block_bytes: int, log_bytes: int) -> BenchUnit:
    """A unit whose flash for logs is of this size, connected."""
    unit = BenchUnit()
    assert lib.bench_log_flash(unit.board, block_bytes, log_bytes) == 0
    unit.boot()
    unit.hello()
    return unit


def unit_with_room() -> BenchUnit:
    """With room for a few rides."""
    return unit_with_log(BLOCK_BYTES, LOG_BYTES)


def ride(unit: BenchUnit, seconds: float, speed_kmh: float = 18.0) -> None:
    """Ride, then stand until the log is closed."""
    unit.inputs(speed_kmh=speed_kmh)
    unit.advance(seconds)
    unit.inputs(speed_kmh=0.0)
    unit.advance(STANDSTILL_S + 1.0)


def directory(unit: BenchUnit) -> LogListResponse:
    message = unit.ask(LogListRequest(0, 255)).message
    assert isinstance(message, LogListResponse)
    return message


def logs(unit: BenchUnit) -> list[Entry]:
    """Every log, the oldest first."""
    found: list[Entry] = []
    while True:
        message = unit.ask(LogListRequest(len(found), 255)).message
        assert isinstance(message, LogListResponse)
        rows = list(ENTRY.iter_unpack(message.entries))
        found += [Entry(*row[:6], LogFlags(row[6])) for row in rows]
        if not rows or len(found) == message.total:
            return found


def begin(unit: BenchUnit, log: Entry, offset: int = 0, window: int = 32) -> None:
    """Open a log; its pieces gather in `bulks`."""
    request = LogOpenRequest(log.log_id, log.generation, offset, window, SESSION)
    assert unit.ask(request).status == Status.OK


def fetch(unit: BenchUnit, log: Entry) -> bytes:
    """The whole log, piece by piece as it comes."""
    data = b""
    waited = 0
    unit.bulks.clear()
    begin(unit, log)
    while len(data) < log.length:
        if not unit.bulks:
            # The flash is being erased.
            unit.advance(0.01)
            waited += 1
            assert waited < 100, log
        for piece in unit.bulks:
            assert (piece.session, piece.offset) == (SESSION, len(data))
            data += piece.data
        unit.bulks.clear()
        acknowledge(unit, len(data))
        unit.hear()
    return data


def acknowledge(unit: BenchUnit, base: int, bitmap: int = 0, session: int = SESSION) -> None:
    request = codec.Request(0, LogAckRequest(session, base, bitmap))
    unit.say(framing.encode_frame(codec.encode(request)))


def late_answer(unit: BenchUnit, request: Message) -> codec.Response:
    """The answer to a request that is answered PENDING first."""
    unit.say(framing.encode_frame(codec.encode(codec.Request(201, request))))
    first, *answers = unit.hear()
    if first.status != Status.PENDING:
        return first
    for _ in range(1000):
        if answers:
            assert [answer.tid for answer in answers] == [201]
            return answers[0]
        lib.bench_advance_us(unit.board, 10_000)
        answers = unit.hear()
    raise AssertionError("PENDING was the last word")


def confirm(unit: BenchUnit, log: Entry, data: bytes) -> Status | int:
    request = LogConfirmRequest(log.log_id, log.generation, len(data), zlib.crc32(data))
    return late_answer(unit, request).status
