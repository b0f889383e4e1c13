"""A small honest drive unit in Python, for tests of the host's side of the wire.

It keeps the protocol as the SPEC says it (answers cached by tid, transactions, leased streams) and
nothing more: no bike moves. Tests bend it through its attributes: mute it, let it lie, restart it.
"""

from __future__ import annotations

import zlib
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from firmware_protocol._generated import (
    IMAGE_LENGTH,
    PARAMETER_BY_ID,
    PARAMETERS,
    SCHEMA_HASH,
    AliveResponse,
    BootEvent,
    CfgBeginResponse,
    CfgCommitResponse,
    CfgInfoResponse,
    CfgReadResponse,
    CfgRollbackResponse,
    CfgStatusResponse,
    ConfigCommittedEvent,
    ConfigProvisionalEvent,
    ConfigRolledBackEvent,
    EvtFaultListResponse,
    FaultClearedEvent,
    FaultSetEvent,
    HelloResponse,
    MessageId,
    RollbackCause,
    SchemaReadResponse,
    SimGetResponse,
    SimSetResponse,
    Status,
    StrSnapshotResponse,
    StrSubscribeResponse,
    Violation,
)
from firmware_protocol.codec import Event, Request, Response, Stream, decode, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.layout import Message
from firmware_protocol.parameters import default_config, pack_image, unpack_image, violations

CACHE_SIZE = 4
CONTROL_PERIOD_US = 10_000


class Refusal(Exception):
    """A status other than OK."""

    def __init__(self, status: Status, detail: int = 0, payload: bytes = b"") -> None:
        super().__init__(status.name)
        self.status, self.detail, self.payload = status, detail, payload


class FakeUnit:
    """Bytes in through `receive`, bytes out through `transmit`, time through `advance`."""

    def __init__(self, uid: bytes = b"FAKE-UNIT-01", channels_value: int = 0) -> None:
        self.uid = uid
        self.boot_id = 1
        self.time_us = 5_000_000
        self.image = pack_image(default_config())
        self.generation = 7
        self.standing_still = True
        self.silent = False
        self.major = 1
        self.schema = b"{}"
        self.schema_hash = SCHEMA_HASH
        self.device_class = 1
        self.executed: list[MessageId] = []  # requests done, not those answered from the cache
        self.lies: Callable[[bytes], bytes] = lambda image: image
        self.refuse: dict[MessageId, Status] = {}
        self.simulation = b"{}"
        self.fault_flags = 0
        self.frames_built = 0
        self.level = channels_value
        self._decoder = FrameDecoder()
        self._cache: OrderedDict[tuple[int, int], bytes] = OrderedDict()
        self._out = bytearray()
        self._staged: bytearray | None = None
        self._transaction = 0
        self._before_trial: tuple[int, bytes] | None = None
        self._trial_ends_us = 0
        self._rollback_cause = RollbackCause.NONE
        self._rolled_back_generation = 0
        self.commits_too_soon = 0  # so many commits are answered with RATE_LIMIT
        self._stream: dict[str, Any] | None = None
        self._epoch = 0
        self._seq = 65530  # soon over the edge of 16 bits
        self._event_seq = 0

    # ------------------------------------------------------------------ the wire

    def receive(self, data: bytes) -> None:
        for frame in self._decoder.feed(data):
            message = decode(frame)
            if isinstance(message, Request) and not self.silent:
                self._out += self._answer(message, frame)

    def transmit(self) -> bytes:
        data = bytes(self._out)
        self._out.clear()
        return data

    def advance(self, seconds: float) -> None:
        """Let time pass in control steps of 10 ms."""
        for _ in range(round(seconds * 100)):
            self.time_us += CONTROL_PERIOD_US
            if self._before_trial is not None and self.time_us >= self._trial_ends_us:
                self.give_up_trial(RollbackCause.TIME_OUT)
            if self._stream is not None:
                self._step_stream(self._stream)

    def give_up_trial(self, cause: RollbackCause = RollbackCause.TIME_OUT) -> None:
        """Return to the configuration before the trial."""
        assert self._before_trial is not None
        self._rollback_cause, self._rolled_back_generation = cause, self.generation
        self.generation, self.image = self._before_trial
        self._before_trial = None
        self.tell(ConfigRolledBackEvent(self.generation, zlib.crc32(self.image)))

    def restart(self, tell: bool = True) -> None:
        """Switch off and on: streams, transactions, caches and trials are gone."""
        if self._before_trial is not None:
            self.give_up_trial(RollbackCause.RESTART)
        self.boot_id += 1
        self.time_us = 0
        self._stream = self._staged = None
        self._cache.clear()
        self._out.clear()
        if tell:
            self.tell(BootEvent(self.boot_id, 0))

    def tell(self, message: Any) -> None:
        """Send an event; a fault it tells of is there, or over."""
        if isinstance(message, FaultSetEvent):
            self.fault_flags |= message.fault_flags
        elif isinstance(message, FaultClearedEvent):
            self.fault_flags &= ~message.fault_flags
        event = Event(self._event_seq, message.CODE, self.time_us % 2**32, message)
        self._event_seq += 1
        self._out += encode_frame(encode(event))

    def skip_stream_frames(self, count: int) -> None:
        """Frames that are built and never arrive."""
        self._seq = (self._seq + count) % 65536

    # ------------------------------------------------------------------ requests

    def _answer(self, request: Request, frame: bytes) -> bytes:
        original = encode(replace(request, retransmit=False)) if request.retransmit else frame
        key = (request.tid, zlib.crc32(original))
        if key not in self._cache or not request.retransmit:
            self._cache.pop(key, None)
            self._cache[key] = encode_frame(self._respond(request))
            if len(self._cache) > CACHE_SIZE:
                self._cache.popitem(last=False)
        return self._cache[key]

    def _respond(self, request: Request) -> bytes:
        message_id = request.message.MESSAGE_ID
        self.executed.append(message_id)
        try:
            if message_id in self.refuse:
                raise Refusal(self.refuse[message_id])
            handler = getattr(self, f"_on_{message_id.name.lower()}", None)
            if handler is None:
                raise Refusal(Status.UNKNOWN_MSG)
            answer: Message | None = handler(request.message)
        except Refusal as refusal:
            return encode(
                Response(
                    request.tid, message_id, refusal.status, refusal.detail, None, refusal.payload
                )
            )
        return encode(Response(request.tid, message_id, Status.OK, 0, answer))

    def _on_hello(self, request: Any) -> Message:
        if not request.major_min <= self.major <= request.major_max:
            raise Refusal(Status.VERSION, self.major)
        crc32 = zlib.crc32(self.image)
        return HelloResponse(
            self.major, 0, self.device_class, 1, (0, 1, 0), bytes(8), self.uid, self.boot_id, 1,
            self.schema_hash, self.generation, crc32, 544, 544, 4, 1, 1, 0, self.time_us,
        )  # fmt: skip

    def _on_ping(self, request: Any) -> None:
        return None

    def _on_alive(self, request: Any) -> Message:
        return AliveResponse(self.boot_id, 1, self.time_us, 0, 0, 0)

    def _on_bye(self, request: Any) -> None:
        self._stream = self._staged = None

    def _on_schema_read(self, request: Any) -> Message:
        piece = self.schema[request.offset : request.offset + request.length]
        return SchemaReadResponse(len(self.schema), piece)

    def _on_evt_fault_list(self, request: Any) -> Message:
        return EvtFaultListResponse(self.fault_flags)

    def _on_sim_get(self, request: Any) -> Message:
        return SimGetResponse(self.simulation)

    def _on_sim_set(self, request: Any) -> Message:
        self.simulation = request.text
        return SimSetResponse(self.simulation)

    # ------------------------------------------------------------------ configuration

    def _on_cfg_info(self, request: Any) -> Message:
        image = self.lies(self.image)
        return CfgInfoResponse(self.generation, zlib.crc32(image), IMAGE_LENGTH, 0)

    def _on_cfg_read(self, request: Any) -> Message:
        image = self.lies(self.image)
        piece = image[request.offset : request.offset + request.length]
        return CfgReadResponse(self.generation, len(image), piece)

    def _on_cfg_begin(self, request: Any) -> Message:
        if (request.base_generation, request.base_crc32) != (
            self.generation,
            zlib.crc32(self.image),
        ):
            raise Refusal(Status.STALE_BASE, self.generation)
        self._transaction += 1
        self._staged = bytearray(self.image)
        return CfgBeginResponse(self._transaction, 30_000)

    def _on_cfg_set(self, request: Any) -> None:
        staged = self._open(request.transaction)
        items = request.items
        while items:
            parameter_id, first, count = int.from_bytes(items[:2], "little"), items[2], items[3]
            row = PARAMETER_BY_ID.get(parameter_id)
            if row is None:
                raise Refusal(Status.UNKNOWN_ID, parameter_id)
            if row.access == 2:
                raise Refusal(Status.ACCESS, parameter_id)
            at, size = row.image_offset + first * row.length, count * row.length
            staged[at : at + size] = items[4 : 4 + size]
            items = items[4 + size :]

    def _on_cfg_validate(self, request: Any) -> None:
        found = violations(unpack_image(bytes(self._open(request.transaction))))
        if found:
            ids = {row.name: row.id for row in PARAMETERS}
            rows = b"".join(
                ids[wrong.field].to_bytes(2, "little") + bytes([wrong.index, Violation[wrong.code]])
                for wrong in found
            )
            raise Refusal(Status.INVALID_CONFIG, len(found), rows)

    def _on_cfg_commit(self, request: Any) -> Message:
        staged = bytes(self._open(request.transaction))
        if not self.standing_still:
            raise Refusal(Status.NOT_STOPPED)
        if zlib.crc32(staged) != request.staged_crc32:
            raise Refusal(Status.CRC_MISMATCH)
        if self.commits_too_soon:
            self.commits_too_soon -= 1
            raise Refusal(Status.RATE_LIMIT, 1500)
        if request.confirm_s:
            self._before_trial = self.generation, self.image
            self._trial_ends_us = self.time_us + request.confirm_s * 1_000_000
        self.image, self._staged = staged, None
        self.generation += 1
        crc32 = zlib.crc32(staged)
        if request.confirm_s:
            self.tell(ConfigProvisionalEvent(self.generation, crc32, request.confirm_s))
        else:
            self.tell(ConfigCommittedEvent(self.generation, crc32))
        return CfgCommitResponse(self.generation, crc32, 3 if request.confirm_s else 0)

    def _on_cfg_status(self, request: Any) -> Message:
        on_trial = self._before_trial is not None
        left_ms = (self._trial_ends_us - self.time_us) // 1000 if on_trial else 0
        crc32 = zlib.crc32(self.image)
        return CfgStatusResponse(
            3 if on_trial else 0,
            self.generation,
            crc32,
            left_ms,
            0,
            0,
            self._rollback_cause,
            self._rolled_back_generation,
        )

    def _on_cfg_confirm(self, request: Any) -> None:
        if (request.generation, request.crc32) != (self.generation, zlib.crc32(self.image)):
            raise Refusal(Status.STALE_BASE, self.generation)
        self._before_trial = None
        self.tell(ConfigCommittedEvent(request.generation, request.crc32))

    def _on_cfg_rollback(self, request: Any) -> Message:
        if self._before_trial is None:
            raise Refusal(Status.STATE)
        self.give_up_trial(RollbackCause.ASKED)
        return CfgRollbackResponse(self.generation, zlib.crc32(self.image))

    def _on_cfg_abort(self, request: Any) -> None:
        self._open(request.transaction)
        self._staged = None

    def _open(self, transaction: int) -> bytearray:
        if self._staged is None or transaction != self._transaction:
            raise Refusal(Status.STATE)
        return self._staged

    # ------------------------------------------------------------------ streams

    def _on_str_subscribe(self, request: Any) -> Message:
        self._epoch = (self._epoch + 1) % 8
        self._stream = {
            "id": request.stream_id,
            "channels": len(request.channel_ids),
            "batch": request.batch,
            "divider": request.divider,
            "lease_us": request.lease_s * 1_000_000,
            "ends_us": self.time_us + request.lease_s * 1_000_000,
            "rows": [],
            "count": 0,
        }
        period_us = request.divider * CONTROL_PERIOD_US
        return StrSubscribeResponse(period_us, request.batch, self._epoch, self._seq, 4000)

    def _on_str_renew(self, request: Any) -> None:
        if self._stream is None:
            raise Refusal(Status.NOT_FOUND)
        self._stream["ends_us"] = self.time_us + request.lease_s * 1_000_000

    def _on_str_snapshot(self, request: Any) -> Message:
        row = np.full(len(request.channel_ids), self.level, dtype="<i2")
        return StrSnapshotResponse(self.time_us, row.tobytes())

    def _step_stream(self, stream: dict[str, Any]) -> None:
        if self.time_us > stream["ends_us"]:
            self._stream = None
            return
        stream["count"] += 1
        if stream["count"] % stream["divider"]:
            return
        stream["rows"].append(np.full(stream["channels"], self.level, dtype=np.int16))
        if len(stream["rows"]) < stream["batch"]:
            return
        period_us = stream["divider"] * CONTROL_PERIOD_US
        t0_us = (self.time_us - (stream["batch"] - 1) * period_us) % 2**32
        values = np.array(stream["rows"])
        stream["rows"] = []
        frame = Stream(stream["id"], self._seq, t0_us, self._epoch, values)
        self._seq = (self._seq + 1) % 65536
        self.frames_built += 1
        if not self.silent:
            self._out += encode_frame(encode(frame))
