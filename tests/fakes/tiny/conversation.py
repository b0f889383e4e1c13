"""The conversation with a tiny unit: one question at a time, live values asked five times a second.

The unit has no clock and numbers nothing, so a row belongs to the moment of its answer: it takes
the place of that moment on a grid of the host's clock, and a place without an answer is a lost row.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from backend.core.channels import ChannelSpec
from backend.device.conversation import OnError, OnResult, Operation, Result
from backend.device.states import (
    DeviceEvent,
    DeviceStatus,
    Identity,
    LinkState,
    LinkStatistics,
    StateChanged,
)
from backend.device.stream import StreamBlock, StreamStarted
from backend.errors import LinkError, NoAnswer, SpindleError

CHANNELS = (ChannelSpec("speed_kmh", "km/h", 0.1), ChannelSpec("cadence_rpm", "rpm", 0.1))
PERIOD_US = 200_000
ANSWER_S = 0.3
ATTEMPTS = 2
US_PER_S = 1_000_000


class NoLine:
    """A line whose rate is never changed."""

    def take_change(self) -> int | None:
        return None

    def refused(self) -> None:
        """Nothing was asked for."""


class TinyConversation:
    """As backend.device.conversation.Conversation."""

    def __init__(self, now_s: float, streaming: bool) -> None:
        self.wall_offset_us = 0
        self.failed_handshakes = 0
        self.line = NoLine()
        self.state, self.reason = LinkState.CONNECTING, "The port is being opened."
        self._statistics = LinkStatistics()
        self._streaming = streaming
        self._started: StreamStarted | None = None
        self._last_block: StreamBlock | None = None
        self._identity: Identity | None = None
        self._events: deque[DeviceEvent] = deque()
        self._out = bytearray()
        self._in = bytearray()
        self._waiting: deque[tuple[Operation[Any], OnResult[Any], OnError]] = deque()
        self._running: tuple[Operation[Any], OnResult[Any], OnError] | None = None
        self._question: str | None = None
        self._attempts = 0
        self._answer_until_s = self._now_s = now_s
        self._open = False
        self._epoch = 0
        self._stream_t0_us = self._next_index = 0

    # ------------------------------------------------------------------ bytes and time

    @property
    def is_busy(self) -> bool:
        return self._running is not None

    def receive(self, data: bytes, now_s: float) -> None:
        self._now_s = now_s
        self._statistics.bytes_received += len(data)
        self._in += data
        while b"\n" in self._in:
            line, _, rest = bytes(self._in).partition(b"\n")
            self._in = bytearray(rest)
            self._statistics.frames_received += 1
            if self._question is not None:
                self._question = None
                self._go_on(partial(_send, line.decode("ascii", "replace")))

    def tick(self, now_s: float) -> None:
        self._now_s = now_s
        if not self._open:
            return
        if self._question is not None and now_s >= self._answer_until_s:
            self._repeat_or_give_up()
        elif self._running is None:
            self._begin_next()

    def bytes_to_send(self) -> bytes:
        data = bytes(self._out)
        self._out.clear()
        self._statistics.bytes_sent += len(data)
        return data

    def next_events(self) -> list[DeviceEvent]:
        events = list(self._events)
        self._events.clear()
        return events

    # ------------------------------------------------------------------ the port

    def port_opened(
        self,
        now_s: float,
        name: str,
        nonce: bytes,
        bits_per_second: float | None = None,
        wanted: float | None = None,
    ) -> None:
        self._now_s, self._open = now_s, True
        self._in.clear()

    def port_failed(self, now_s: float, error: LinkError) -> None:
        self._now_s, self._open = now_s, False
        self._fail_all(NoAnswer(error.message, error.code))
        self._set_state(self._absent(), error.message)

    def close(self, now_s: float) -> None:
        self._open = False
        self._fail_all(LinkError("The device was removed."))
        self._set_state(LinkState.CLOSED, "The device was removed.")

    # ------------------------------------------------------------------ work

    def start(
        self, operation: Operation[Result], on_result: OnResult[Result], on_error: OnError
    ) -> None:
        if self.state is not LinkState.READY:
            operation.close()
            on_error(NoAnswer(self.reason, "not_connected"))
            return
        self._waiting.append((operation, on_result, on_error))
        if self._running is None:
            self._begin_next()

    def abandon(self, operation: Operation[Any], error: SpindleError) -> None:
        if self._running is not None and self._running[0] is operation:
            self._question = None
            self._go_on(lambda running: running.throw(error))

    def status(self) -> DeviceStatus:
        return DeviceStatus(
            state=self.state,
            reason=self.reason,
            identity=self._identity,
            config_generation=None,
            config_crc32=None,
            trial_ends_unix_us=None,
            trial_left_s=None,
            rollback_cause=None,
            faults_active=(),
            streaming=self._started,
            last_block=self._last_block,
            statistics=replace(self._statistics),
        )

    # ------------------------------------------------------------------ inside

    def _begin_next(self) -> None:
        if self._waiting:
            self._running = self._waiting.popleft()
        elif self.state is not LinkState.READY:
            self._running = (who_are_you(), self._connected, self._not_connected)
        elif self._started is not None and self._place() >= self._next_index:
            self._running = (read_values(), self._row, lambda error: None)
        else:
            return
        self._go_on(next)

    def _go_on(self, step: Callable[[Operation[Any]], str]) -> None:
        """Run the operation to its next question, or to its end."""
        if self._running is None:
            return
        operation, on_result, on_error = self._running
        try:
            question = step(operation)
        except StopIteration as done:
            self._running = None
            on_result(done.value)
        except SpindleError as error:
            self._running = None
            on_error(error)
        else:
            self._question, self._attempts = question, 0
            self._ask()

    def _ask(self) -> None:
        self._out += f"{self._question}\n".encode()
        self._attempts += 1
        self._statistics.requests_sent += 1
        self._answer_until_s = self._now_s + ANSWER_S

    def _repeat_or_give_up(self) -> None:
        if self._attempts < ATTEMPTS:
            self._statistics.requests_repeated += 1
            self._ask()
            return
        self._question = None
        silent = NoAnswer("The unit answers nothing. Check battery and cable.", "silent")
        self._go_on(lambda running: running.throw(silent))
        if self.state is LinkState.READY:
            self._fail_all(silent)
            self._set_state(LinkState.LOST, silent.message)

    def _connected(self, identity: Identity) -> None:
        self._identity = identity
        self.failed_handshakes = 0
        self._statistics.connections += 1
        self._set_state(LinkState.READY, f"{identity.model} is connected.")
        if self._streaming:
            self._epoch += 1
            self._stream_t0_us, self._next_index = round(self._now_s * US_PER_S), 0
            self._started = StreamStarted(self._epoch, PERIOD_US, CHANNELS)
            self._events.append(self._started)

    def _not_connected(self, error: BaseException) -> None:
        self.failed_handshakes += 1
        self._set_state(self._absent(), str(error))

    def _place(self) -> int:
        """Which row of the grid belongs to this moment."""
        return (round(self._now_s * US_PER_S) - self._stream_t0_us) // PERIOD_US

    def _row(self, counts: tuple[int, int]) -> None:
        place = self._place()
        if self._started is None or place < self._next_index:
            return
        self._last_block = StreamBlock(
            t0_us=self._stream_t0_us + place * PERIOD_US,
            period_us=PERIOD_US,
            first_index=place,
            values=np.array([counts], np.int16),
            lost_rows_before=place - self._next_index,
            epoch=self._epoch,
            wall_us=round(self._now_s * US_PER_S) + self.wall_offset_us,
            channels=CHANNELS,
        )
        self._next_index = place + 1
        self._statistics.stream_rows += 1
        self._events.append(self._last_block)

    def _fail_all(self, error: SpindleError) -> None:
        self._question, self._started, self._last_block = None, None, None
        if self._running is not None:
            self._go_on(lambda running: running.throw(error))
        while self._waiting:
            operation, _, on_error = self._waiting.popleft()
            operation.close()
            on_error(error)

    def _absent(self) -> LinkState:
        return LinkState.CONNECTING if self._identity is None else LinkState.LOST

    def _set_state(self, state: LinkState, reason: str) -> None:
        if (state, reason) != (self.state, self.reason):
            self.state, self.reason = state, reason
            self._events.append(StateChanged(state, reason))


def _send(told: str, operation: Operation[Any]) -> Any:
    return operation.send(told)


def who_are_you() -> Operation[Identity]:
    """Its name and version are all it has."""
    told = (yield "I").split()
    if len(told) != 2 or told[0] != "TINY":
        raise LinkError("This is no tiny unit.")
    return Identity(serial_number=None, model="Tiny", firmware_version=told[1])


def read_values() -> Operation[tuple[int, int]]:
    """Counts of `CHANNELS`."""
    speed, cadence = (yield "V").split()
    return int(speed), int(cadence)
