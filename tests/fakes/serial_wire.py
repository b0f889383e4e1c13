"""A serial line of finite speed between a session and the bench unit, in virtual time.

Both directions carry `bits_per_second` with ten bits a byte; what the unit says reaches the host
`turn_around_s` later, as behind a USB adapter; whole frames are lost with a chance, by a seed.
"""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable

from sim_device.firmware.python._native import ffi, lib

from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import LinkState
from tests.fakes.bench import SessionBench
from tests.fakes.bench_unit import BenchUnit

STEP_S = 0.001
BITS_PER_BYTE = 10
# What a UART with DMA holds: a little more than the fastest line carries in a step.
UART_BYTES = 256


class Direction:
    """Bytes in order at the line's speed; `lose` decides about each frame."""

    def __init__(self, bytes_per_s: float, lose: Callable[[], bool]) -> None:
        self._bytes_per_step = bytes_per_s * STEP_S
        self._budget = 0.0
        self._lose = lose
        self._half = b""
        # Everything is lost while this is set.
        self.broken = False
        self.frames = 0
        self.lost = 0
        self.carried = 0

    def room(self) -> int:
        """How many bytes this step carries."""
        self._budget = min(self._budget + self._bytes_per_step, self._bytes_per_step + 1.0)
        return int(self._budget)

    def carry(self, data: bytes) -> bytes:
        """The bytes that arrive of those that were sent."""
        self._budget -= len(data)
        self.carried += len(data)
        *frames, self._half = (self._half + data).split(b"\0")
        arrived = b""
        for frame in filter(None, frames):
            self.frames += 1
            if self.broken or self._lose():
                self.lost += 1
            else:
                arrived += b"\0" + frame + b"\0"
        return arrived


class SerialWire(SessionBench):
    """A session that talks to a unit over such a line. `loss`: of frames, in each direction."""

    STEP_S = STEP_S
    PATIENCE_S = 120.0

    def __init__(
        self,
        unit: BenchUnit,
        bits_per_second: int = 115200,
        turn_around_s: float = 0.002,
        loss: float = 0.0,
        seed: int = 1,
        plan: StreamPlan | None = None,
    ) -> None:
        super().__init__(plan)
        chance = random.Random(seed)
        self.unit = unit
        self.bits_per_second = bits_per_second
        self.bytes_per_s = bits_per_second / BITS_PER_BYTE
        self.loss = loss
        self.up = Direction(self.bytes_per_s, lambda: chance.random() < self.loss)
        self.down = Direction(self.bytes_per_s, lambda: chance.random() < self.loss)
        self.plugged = True
        self._delay_steps = round(turn_around_s / STEP_S)
        self._late: deque[bytes] = deque([b""] * self._delay_steps)
        self._unsent = b""
        self._buffer = ffi.new("uint8_t[]", lib.BENCH_LINE_BYTES)
        lib.bench_line_capacity(unit.board, UART_BYTES)

    def connect(self) -> SerialWire:
        """Open the port and wait until the handshake is done, without loss."""
        loss, self.loss = self.loss, 0.0
        self.session.port_opened(self.now_s, "the wire", b"12345678", self.bits_per_second)
        self.run_until(lambda: self.session.state is LinkState.READY)
        self.loss = loss
        return self

    def step(self) -> None:
        """A millisecond."""
        self.now_s += STEP_S
        lib.bench_advance_us(self.unit.board, 1000)
        taken = lib.bench_receive(self.unit.board, self._buffer, self.up.room())
        arrived = self.up.carry(bytes(ffi.buffer(self._buffer, taken)))
        self._late.append(arrived if self.plugged else b"")
        data = self._late.popleft()
        if data:
            self.session.receive(data, self.now_s)
        self.session.tick(self.now_s)
        self._unsent += self.session.bytes_to_send()
        room = self.down.room()
        sent, self._unsent = self._unsent[:room], self._unsent[room:]
        heard = self.down.carry(sent)
        if heard and self.plugged:
            lib.bench_send(self.unit.board, heard, len(heard))
