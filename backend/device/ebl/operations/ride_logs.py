"""The ride logs a unit keeps in its flash: which there are, and what is asked about one."""

from __future__ import annotations

import struct

from backend.device.ebl.session.log_receiver import LogReceiver
from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.device.readings import RideLog, RideLogs
from backend.errors import DeviceRefused, NoAnswer, PeerProtocolError, SpindleError
from firmware_protocol._generated import (
    LogCloseRequest,
    LogConfirmRequest,
    LogConfirmResponse,
    LogCrcRequest,
    LogCrcResponse,
    LogEraseRequest,
    LogEraseResponse,
    LogFlags,
    LogListRequest,
    LogListResponse,
    LogOpenRequest,
    LogOpenResponse,
    Status,
)

ENTRY = struct.Struct("<IIIQQIB7x")
# More than a unit's directory holds; a list that never ends is a broken unit.
LOGS_MAX = 256
LOG_BYTES_MAX = 256 * 1024 * 1024
WINDOW = 32


def list_logs() -> Operation[RideLogs]:
    """Read the directory. Raises DeviceRefused (UNSUPPORTED by a unit without logs), NoAnswer."""
    logs: list[RideLog] = []
    while True:
        part = yield from query(LogListRequest(len(logs), 255), LogListResponse)
        entries = [_log_of(fields) for fields in ENTRY.iter_unpack(_full_entries(part.entries))]
        logs += entries
        if not entries or len(logs) >= part.total:
            return RideLogs(tuple(logs), part.overwritten, part.boot_id, part.now_us)
        if len(logs) > LOGS_MAX:
            raise PeerProtocolError(f"The unit lists more than {LOGS_MAX} ride logs.")


def log_crc(log: RideLog, length: int) -> Operation[int]:
    """The unit's CRC-32 over the first `length` bytes of a log."""
    request = LogCrcRequest(log.log_id, log.generation, 0, length)
    return (yield from query(request, LogCrcResponse)).crc32


def confirm_log(log: RideLog, crc32: int) -> Operation[None]:
    """Tell the unit that the log is safe here: it may free it. DeviceRefused on another CRC-32."""
    request = LogConfirmRequest(log.log_id, log.generation, log.length, crc32)
    yield from query(request, LogConfirmResponse)


def erase_log(log: RideLog) -> Operation[int]:
    """Have the unit free a confirmed log; blocks of its flash erased so far in its life.

    Raises DeviceRefused, with STATE for a log that is being written or is not confirmed, and BUSY
    while it is being fetched.
    """
    request = LogEraseRequest(log.log_id, log.generation)
    response = yield from attempt(request)
    if response.status == Status.BUSY:
        raise DeviceRefused(
            f"Ride log {log.log_id} is being fetched from the unit, or another log is being "
            f"checked. Erase it when that is done, in {response.detail} s at the earliest. "
            "Nothing was erased.",
            status=Status.BUSY.name,
            detail=response.detail,
        )
    return expect(request, response, LogEraseResponse).erases


def outcome_of_erase(log: RideLog) -> Operation[None]:
    """Whether a log whose erasing went unanswered is gone.

    Raises NoAnswer with the outcome `unchanged` when it is still there.
    """
    current = yield from list_logs()
    if any((one.log_id, one.generation) == (log.log_id, log.generation) for one in current.logs):
        raise NoAnswer(
            f"The unit did not answer. It was asked again since: it still has ride log "
            f"{log.log_id}. Erase it once more.",
            outcome="unchanged",
        )


def receive_log(
    log: RideLog, receiver: LogReceiver, offset: int, window: int = WINDOW
) -> Operation[None]:
    """Have the unit send a log from `offset` on to a receiver that the session has."""
    request = LogOpenRequest(log.log_id, log.generation, offset, window, receiver.session)
    opened = yield from query(request, LogOpenResponse)
    if opened.length != log.length or opened.chunk == 0 or opened.length % opened.chunk:
        raise PeerProtocolError(
            f"The unit listed ride log {log.log_id} with {log.length} bytes and opens it with "
            f"{opened.length} in pieces of {opened.chunk}. Read the list again."
        )
    receiver.begin(offset, opened.length, opened.chunk, min(opened.window, window))


def close_log(session: int) -> Operation[None]:
    """End a session; a unit that does not hear it ends it by itself."""
    try:
        yield from attempt(LogCloseRequest(session), attempts=1)
    except SpindleError:
        return


def _full_entries(entries: bytes) -> bytes:
    if len(entries) % ENTRY.size:
        raise PeerProtocolError(
            f"The unit's list of ride logs has {len(entries)} bytes, not a multiple of "
            f"{ENTRY.size}; its firmware does not keep the protocol."
        )
    return entries


def _log_of(fields: tuple[int, ...]) -> RideLog:
    log_id, generation, boot_id, t0_us, t1_us, length, flags = fields
    if length > LOG_BYTES_MAX:
        raise PeerProtocolError(f"The unit lists ride log {log_id} with {length} bytes.")
    return RideLog(
        log_id,
        generation,
        boot_id,
        t0_us,
        t1_us,
        length,
        recording=bool(flags & LogFlags.RECORDING),
        confirmed=bool(flags & LogFlags.CONFIRMED),
        ended=bool(flags & LogFlags.ENDED),
    )
