"""The unit's real firmware on the bench board, spoken to as a host would: messages in and out.

Everything is virtual: time passes only in `advance`, the line is memory, and the flash loses its
power after exactly as many bytes as a test asks for.
"""

import math
import zlib
from typing import Any

import numpy as np
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol import codec, framing, parameters
from firmware_protocol._generated import (
    Bank,
    CfgBeginRequest,
    CfgBeginResponse,
    CfgCommitRequest,
    CfgReadRequest,
    CfgReadResponse,
    CfgSetRequest,
    CfgValidateRequest,
    CommitFlags,
    EvtFaultClearRequest,
    EvtFaultClearResponse,
    EvtFaultListRequest,
    EvtFaultListResponse,
    HelloRequest,
    HelloResponse,
    Status,
)
from firmware_protocol.layout import Message, Value

FLASH_BLOCK_BYTES = 1024
FLASH_BYTES = 8 * FLASH_BLOCK_BYTES
ALL_FAULTS = 0x7FFF_7FFF


class BenchUnit:
    """One unit. `events`, `streams` and `bulks` gather what it says without being asked."""

    def __init__(
        self,
        provisioned: bool = True,
        flash_block_bytes: int = FLASH_BLOCK_BYTES,
        flash_bytes: int = FLASH_BYTES,
    ) -> None:
        created = lib.bench_create(flash_block_bytes, flash_bytes)
        assert created != ffi.NULL
        self.board = ffi.gc(created, lib.bench_destroy)
        if provisioned:
            assert lib.bench_provision(self.board) == 0
        self._tid = 0
        self._boot_id = 0
        self._decoder = framing.FrameDecoder()
        self.events: list[codec.Event] = []
        # Those the unit sent again; nothing here acknowledges them but a test that says so.
        self.events_repeated: list[codec.Event] = []
        self.streams: list[codec.Stream] = []
        self.bulks: list[codec.Bulk] = []
        self.boot()

    def boot(self) -> None:
        """Power off and on: RAM is new, the flash keeps what it holds."""
        self._boot_id += 1
        self._decoder = framing.FrameDecoder()
        self.events.clear()
        self.events_repeated.clear()
        self.streams.clear()
        self.bulks.clear()
        lib.bench_boot(self.board, self._boot_id)
        self.hear()

    def advance(self, seconds: float) -> None:
        """Let time pass; what the unit says meanwhile is heard."""
        lib.bench_advance_us(self.board, round(seconds * 1e6))
        self.hear()

    def advance_unread(self, seconds: float) -> None:
        """Let time pass while nobody reads the line."""
        lib.bench_advance_us(self.board, round(seconds * 1e6))

    def say(self, wire: bytes) -> None:
        """Bytes to the unit, as they are."""
        assert lib.bench_send(self.board, wire, len(wire)) == len(wire)
        lib.bench_poll(self.board)

    def hear(self) -> list[codec.Response]:
        """Everything the unit has said; the responses are returned."""
        responses = []
        for frame in self.take_frames():
            decoded = codec.decode(frame)
            if isinstance(decoded, codec.Event):
                (self.events_repeated if decoded.retransmit else self.events).append(decoded)
            elif isinstance(decoded, codec.Stream):
                self.streams.append(decoded)
            elif isinstance(decoded, codec.Bulk):
                self.bulks.append(decoded)
            elif isinstance(decoded, codec.Response):
                responses.append(decoded)
            else:
                # An OK to a message the registry does not know: the board's echo.
                assert isinstance(decoded, codec.Malformed), decoded
                assert decoded.reason is codec.Reason.UNKNOWN_MSG
                responses.append(_unknown_response(frame))
        return responses

    def take_wire(self) -> bytes:
        """The bytes that wait on the line, as they are."""
        capacity = lib.BENCH_LINE_BYTES
        buffer = ffi.new("uint8_t[]", capacity)
        return bytes(ffi.buffer(buffer, lib.bench_receive(self.board, buffer, capacity)))

    def take_frames(self) -> list[bytes]:
        """The frames that wait on the line, in their order."""
        return self._decoder.feed(self.take_wire())

    def line_room(self, length: int) -> None:
        """How many bytes the line takes until it is read; 0 is a host that does not listen."""
        lib.bench_line_capacity(self.board, length)

    def line_baud(self, baud: int) -> None:
        """What the line carries in bits per second, as the unit knows it; 0 is no limit."""
        lib.bench_line_baud(self.board, baud)

    def ask_frame(self, frame: bytes) -> codec.Response:
        """One request frame, and its one response."""
        self.hear()
        self.say(framing.encode_frame(frame))
        responses = self.hear()
        assert len(responses) == 1, responses
        return responses[0]

    def ask(self, message: Message) -> codec.Response:
        """A request with a fresh tid, and its response."""
        self._tid = self._tid % 255 + 1
        response = self.ask_frame(codec.encode(codec.Request(self._tid, message)))
        assert (response.tid, response.message_id) == (self._tid, message.MESSAGE_ID)
        return response

    def ask_again(self, message: Message) -> codec.Response:
        """The latest request once more, as a host repeats one whose answer it did not hear."""
        repeated = codec.Request(self._tid, message, retransmit=True)
        return self.ask_frame(codec.encode(repeated))

    def hello(self, host_mtu: int = 544, nonce: bytes = bytes(8)) -> HelloResponse:
        """A session."""
        message = self.ask(HelloRequest(1, 1, 0, host_mtu, nonce)).message
        assert isinstance(message, HelloResponse)
        return message

    def inputs(self, **values: float) -> None:
        """Change what the sensors read, by the names of hal_inputs.

        speed_kmh: of the wheel, whose pulses follow; NaN is a sensor that is known to be broken.
        """
        speed_kmh = values.pop("speed_kmh", None)
        if speed_kmh is not None:
            broken = math.isnan(speed_kmh)
            values.setdefault("speed_age_ms", lib.HAL_SPEED_NOT_MEASURED if broken else 0)
            lib.bench_wheel_set(self.board, 0.0 if broken else speed_kmh)
        inputs = ffi.new("hal_inputs *")
        lib.bench_inputs_get(self.board, inputs)
        for name, value in values.items():
            setattr(inputs, name, value)
        lib.bench_inputs_set(self.board, inputs)

    def output(self) -> Any:
        """The law's latest output."""
        output = ffi.new("assist_output *")
        lib.bench_output(self.board, output)
        return output

    def motor_nm(self) -> float:
        """What the unit asks of its motor."""
        return float(lib.bench_motor_torque_nm(self.board))

    def event_codes(self) -> list[int]:
        """What it told by itself, in its order."""
        return [event.code for event in self.events]

    def faults(self) -> int:
        """The fault flags it tells."""
        message = self.ask(EvtFaultListRequest()).message
        assert isinstance(message, EvtFaultListResponse)
        return message.fault_flags

    def clear_faults(self) -> int:
        """Clear what may be cleared; the fault flags that are left."""
        message = self.ask(EvtFaultClearRequest(ALL_FAULTS)).message
        assert isinstance(message, EvtFaultClearResponse)
        return message.fault_flags

    def flash(self) -> np.ndarray:
        """The flash itself: writing to it is damage."""
        size = lib.bench_flash_size(self.board)
        return np.frombuffer(ffi.buffer(lib.bench_flash(self.board), size), dtype=np.uint8)

    def read_image(self, bank: Bank = Bank.ACTIVE) -> tuple[int, bytes]:
        """Generation and whole image of a bank, in as many pieces as the MTU asks for."""
        image = b""
        while True:
            message = self.ask(CfgReadRequest(bank, len(image), 0xFFFF)).message
            assert isinstance(message, CfgReadResponse)
            image += message.data
            if len(image) == message.total_length:
                return message.generation, image

    def config(self) -> dict[str, Value]:
        """The active configuration."""
        return parameters.unpack_image(self.read_image()[1])

    def begin(self) -> int:
        """A transaction on what is active."""
        generation, image = self.read_image()
        response = self.ask(CfgBeginRequest(generation, crc32(image)))
        assert isinstance(response.message, CfgBeginResponse), response
        return response.message.transaction

    def stage(self, transaction: int, changes: dict[str, Value]) -> bytes:
        """Set the changes and validate; returns the image that should now be staged."""
        for items in parameters.set_items(changes):
            assert self.ask(CfgSetRequest(transaction, items)).status == Status.OK
        assert self.ask(CfgValidateRequest(transaction)).status == Status.OK
        return parameters.pack_image(self.config() | changes)

    def write(self, changes: dict[str, Value], confirm_s: int = 0) -> codec.Response:
        """A whole transaction; the response to its commit. confirm_s: on trial for so long."""
        transaction = self.begin()
        image = self.stage(transaction, changes)
        flags = CommitFlags.PROVISIONAL if confirm_s else 0
        commit = CfgCommitRequest(transaction, crc32(image), flags, confirm_s)
        response = self.ask(commit)
        if response.status == Status.RATE_LIMIT:
            self.advance(response.detail / 1000)
            response = self.ask(commit)
        return response


def crc32(image: bytes) -> int:
    """The check value of an image, from the standard library."""
    return zlib.crc32(image)


def _unknown_response(frame: bytes) -> codec.Response:
    message_id = int.from_bytes(frame[2:4], "little")
    return codec.Response(frame[1], message_id, Status(frame[4]), 0, None, frame[5:])
