"""The conversation with one unit, without a port, a thread or a clock.

Rules of this file:
- Bytes and `now_s` come in; bytes, events and operations' results go out.
- Nothing waits, and nothing raises on what the unit sends: damage is counted and skipped.
- A state always has a reason a person can act on.

    OPENING --port_opened--> FLUSHING --50 ms--> HANDSHAKE --HELLO, schema--> UP
    UP --silent 1.5 s, unit restarted--> HANDSHAKE
    HANDSHAKE --no answer, refused--> PAUSING --> HANDSHAKE
    any --port_failed--> OPENING         any --close--> ENDED
"""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from enum import Enum, auto
from typing import TypeVar

from backend.device.conversation import OnError, OnResult
from backend.device.ebl.session.baud_rate import BaudRate
from backend.device.ebl.session.clock_keeper import ClockKeeper
from backend.device.ebl.session.event_deduplicator import (
    NO_TID,
    Arrival,
    EventDeduplicator,
    acknowledgement,
)
from backend.device.ebl.session.handshake import Handshake, VersionRefused, run_handshake
from backend.device.ebl.session.log_receiver import LogReceiver
from backend.device.ebl.session.operation import Operation, OrphanLeft, attempt
from backend.device.ebl.session.reasons import (
    handshake_reason,
    newer_version,
    no_stream_reason,
    opening_reason,
    orphan_reason,
    port_reason,
    read_only_reason,
    ready_reason,
    removed_reason,
    restarted_reason,
    rx_timeout_reason,
    tx_timeout_reason,
    version_reason,
    waiting_reason,
)
from backend.device.ebl.session.requests import RequestTable
from backend.device.ebl.session.runner import OperationRunner
from backend.device.ebl.session.schema import Schemas
from backend.device.ebl.session.state_keeper import StateKeeper
from backend.device.ebl.session.stream_keeper import StreamKeeper
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.ebl.session.subscription import Subscription
from backend.device.ebl.session.unit_state import UnitState
from backend.device.states import DeviceEvent, DeviceStatus, LinkState, LinkStatistics, StateChanged
from backend.device.stream import StreamBlock, StreamStarted
from backend.errors import LinkError, NoAnswer, SpindleError
from firmware_protocol._generated import (
    MTU,
    MTU_BEFORE_HELLO,
    AliveRequest,
    AliveResponse,
    BootEvent,
    ByeRequest,
    ConfigRolledBackEvent,
    Status,
    StreamCountsEvent,
)
from firmware_protocol.codec import (
    Bulk,
    Event,
    Malformed,
    Reason,
    Request,
    Response,
    Stream,
    decode,
    encode,
)
from firmware_protocol.framing import FrameDecoder, encode_frame

Result = TypeVar("Result")

FLUSH = b"\x00\x00"
FLUSH_S = 0.050
PING_S = 0.500
SILENCE_S = 1.5
PAUSE_S = 0.5
REFUSED_PAUSE_S = 5.0
# A caller that stops reading must not make the session grow: 1000 blocks are 50 s at 100 Hz.
EVENTS_MAX = 1000
BYE_TID = 255


class _Phase(Enum):
    OPENING = auto()
    FLUSHING = auto()
    HANDSHAKE = auto()
    PAUSING = auto()
    UP = auto()
    ENDED = auto()


class Session:
    """One unit as the host sees it.

    plan: what to stream after the handshake, None for nothing. schemas: those of
    units met before, by their hash; one that is read is added.
    """

    def __init__(
        self, now_s: float, plan: StreamPlan | None = None, schemas: Schemas | None = None
    ) -> None:
        self.state = LinkState.CONNECTING
        self.reason: str = opening_reason()
        self.handshake: Handshake | None = None
        self.unit_state = UnitState()
        self.last_block: StreamBlock | None = None
        # HELLOs in a row that led nowhere; the driver reopens a port that stays silent.
        self.failed_handshakes = 0
        # Unix time minus the caller's clock, so that blocks carry a wall time without a clock here.
        self.wall_offset_us = 0
        self._schemas: Schemas = {} if schemas is None else schemas
        self._statistics = LinkStatistics()
        self._subscription = Subscription(self._statistics)
        self._requests = RequestTable(self._statistics)
        self._runner = OperationRunner(self._requests)
        self.line = BaudRate(self._requests)
        self.clock = ClockKeeper(self._statistics)
        self._log: LogReceiver | None = None
        self._event_deduplicator = EventDeduplicator(self._statistics)
        self._state_keeper = StateKeeper(self.unit_state, self._runner, lambda: self._now_s)
        self._stream = StreamKeeper(
            plan,
            self._subscription,
            self._runner,
            lambda: self._now_s,
            on_started=self._emit,
            on_reboot=self._rebooted,
            on_refused=self._no_stream,
        )
        self._decoder = FrameDecoder(MTU)
        self._bad_before = 0
        self._events: deque[DeviceEvent] = deque()
        self._out = bytearray()
        self._phase = _Phase.OPENING
        self._until_s = self._received_s = self._now_s = now_s
        self._port_name = ""
        self._nonce = bytes(8)
        # The latest restart the unit told of since it was last asked who it is.
        self._boot_id_heard: int | None = None
        self._requests.shut(LinkError(self.reason))

    # ------------------------------------------------------------------ bytes and time

    def receive(self, data: bytes, now_s: float) -> None:
        """Take what arrived, in any split. Never raises."""
        self._now_s = now_s
        self._subscription.read_at(now_s)
        self._statistics.bytes_received += len(data)
        if self._phase in (_Phase.OPENING, _Phase.FLUSHING, _Phase.ENDED):
            return
        frames = list(self._decoder.feed(data))
        stats = self._decoder.stats
        bad = stats.crc_errors + stats.cobs_errors + stats.overflows
        self._statistics.frames_bad = self._bad_before + bad
        for frame in frames:
            self._received_s = now_s
            self._statistics.frames_received += 1
            self._frame(frame)
        self._acknowledge_log()
        self._out += self._requests.frames_due(now_s)

    def tick(self, now_s: float) -> None:
        """Let time pass: repetitions, pings, leases, silence."""
        self._now_s = now_s
        self._subscription.read_at(now_s)
        if self._phase in (_Phase.FLUSHING, _Phase.PAUSING) and now_s >= self._until_s:
            self.line.start_over(is_responding=False)
            self._start_handshake()
        elif self._phase is _Phase.UP:
            self._do_due_work()
        self._acknowledge_log()
        self._out += self._requests.frames_due(now_s)

    def bytes_to_send(self) -> bytes:
        """Take what is to be sent now, in order."""
        data = bytes(self._out)
        self._out.clear()
        self._statistics.bytes_sent += len(data)
        return data

    def next_events(self) -> list[DeviceEvent]:
        """Take what happened since the last call, oldest first."""
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
        requested: float | None = None,
    ) -> None:
        """A port is open. nonce: 8 random bytes, so that no unit mistakes us for our past.

        bits_per_second, requested: as in backend.device.link.Link.
        """
        self._now_s = now_s
        self._port_name = name
        self._nonce = nonce
        self.line.opened(bits_per_second, requested)
        self._requests.start_from(nonce[0])
        self._bad_before = self._statistics.frames_bad
        self._decoder = FrameDecoder(MTU)
        self._out = bytearray(FLUSH)
        self._phase = _Phase.FLUSHING
        self._until_s = now_s + FLUSH_S
        if self.state is LinkState.CONNECTING:
            self._set_state(self.state, waiting_reason(name))

    def port_failed(self, now_s: float, error: LinkError) -> None:
        """The port does not open or is gone; the message of `error` becomes the reason."""
        self._now_s = now_s
        self._phase = _Phase.OPENING
        self._out.clear()
        self._break_off(NoAnswer(error.message, error.code))
        self._set_state(self._absent(), port_reason(error))

    def close(self, now_s: float) -> None:
        """Say goodbye; the bytes are still to be sent. The session is of no further use."""
        self._now_s = now_s
        if self._phase is _Phase.UP:
            self._out += encode_frame(encode(Request(BYE_TID, ByeRequest())))
        self._phase = _Phase.ENDED
        self._break_off(LinkError("The device was removed."))
        self._set_state(LinkState.CLOSED, removed_reason())

    # ------------------------------------------------------------------ work

    def start(
        self, operation: Operation[Result], on_result: OnResult[Result], on_error: OnError
    ) -> None:
        """Run an operation; exactly one callback is called, with LinkError when not connected."""
        if self._phase is not _Phase.UP:
            operation.close()
            on_error(NoAnswer(self.reason, "not_connected"))
            return

        def failed(error: BaseException) -> None:
            if isinstance(error, OrphanLeft) and self._phase is _Phase.UP:
                self._repeat_handshake(orphan_reason())
            on_error(error)

        self._runner.start(operation, on_result, failed)

    def abandon(self, operation: Operation[Result], error: SpindleError) -> None:
        """Wait no longer for an operation's answers: it goes on with this error."""
        self._runner.abandon(operation, error)

    def receive_log(self, receiver: LogReceiver | None) -> None:
        """Give a ride log's frames to `receiver` from now on; None for nobody."""
        self._log = receiver
        if receiver is not None and self._phase is not _Phase.UP:
            self._end_log(self.reason)

    @property
    def is_busy(self) -> bool:
        """Whether answers or a log are awaited, so that reading soon pays."""
        return self._log is not None or not self._requests.is_idle

    @property
    def mtu(self) -> int:
        """The largest frame that both sides take, in decoded bytes."""
        if self.handshake is None:
            return MTU_BEFORE_HELLO
        hello = self.handshake.hello
        return min(MTU, hello.rx_mtu, hello.tx_mtu)

    @property
    def streaming(self) -> StreamStarted | None:
        """What is being streamed, None when nothing is."""
        return self._subscription.started

    def status(self) -> DeviceStatus:
        """A copy of what other threads may want to know."""
        ends_s = self.unit_state.trial_ends_s
        return DeviceStatus(
            state=self.state,
            reason=self.reason,
            identity=self.handshake.identity if self.handshake else None,
            config_generation=self.unit_state.config_generation,
            config_crc32=self.unit_state.config_crc32,
            trial_ends_unix_us=None if ends_s is None else self._unix_us(ends_s),
            trial_left_s=None if ends_s is None else max(0.0, ends_s - self._now_s),
            rollback_cause=self.unit_state.rollback_cause,
            faults_active=self.unit_state.faults_active,
            streaming=self.streaming,
            last_block=self.last_block,
            statistics=self.link_statistics(),
        )

    def link_statistics(self) -> LinkStatistics:
        """A copy of the counters."""
        return replace(self._statistics, bits_per_second=self.line.current)

    # ------------------------------------------------------------------ inside

    def _frame(self, frame: bytes) -> None:
        message = decode(frame)
        if isinstance(message, Stream):
            block = self._subscription.take(message, self._wall_us())
            if block is not None:
                self.last_block = block
                self._emit(block)
        elif isinstance(message, Response):
            self._requests.answered(message, self._now_s)
            if message.status == Status.SESSION and self._phase is _Phase.UP:
                self._repeat_handshake(restarted_reason())
        elif isinstance(message, Event):
            self._unit_event(message)
        elif isinstance(message, Bulk):
            if self._log is not None:
                self._log.take(message, self._now_s)
        else:
            self._statistics.frames_malformed += 1
            other_major = isinstance(message, Malformed) and message.reason is Reason.VERSION
            if other_major and self._phase is _Phase.HANDSHAKE:
                self._requests.shut(newer_version(frame[0] >> 5))

    def _unit_event(self, event: Event) -> None:
        arrival = self._event_deduplicator.classify(event)
        self._out += acknowledgement(event)
        if arrival is Arrival.AGAIN:
            return
        if isinstance(event.message, StreamCountsEvent):
            self._subscription.counted(event.message)
        late = arrival is Arrival.LATE
        unit_event = self.unit_state.take(event, self._statistics, self._now_s, late)
        if unit_event is not None:
            self._emit(unit_event)
            # What the handshake asked for may be older; a return does not say why it was.
            returned = isinstance(event.message, ConfigRolledBackEvent)
            if returned or self._phase is not _Phase.UP:
                self._state_keeper.mark_stale()
        if arrival is not Arrival.IN_ORDER:
            self._state_keeper.mark_stale()
        if not isinstance(event.message, BootEvent):
            return
        self._boot_id_heard = event.message.boot_id
        if self._phase is _Phase.UP and self._has_rebooted():
            self._repeat_handshake(restarted_reason())

    def _has_rebooted(self) -> bool:
        """Whether a restart was heard since HELLO was asked and HELLO was answered before it."""
        boot_id = self.handshake.identity.boot_id if self.handshake else None
        return self._boot_id_heard is not None and self._boot_id_heard != boot_id

    def _start_handshake(self) -> None:
        self._phase = _Phase.HANDSHAKE
        self._boot_id_heard = None
        self._requests.open(outstanding_max=1)
        handshake = run_handshake(self._nonce, self._schemas, self.line.go_faster)
        self._runner.start(handshake, self._handshake_done, self._handshake_failed)

    def _handshake_done(self, handshake: Handshake) -> None:
        if self._phase is not _Phase.HANDSHAKE:
            return
        self.handshake = handshake
        if self._has_rebooted():
            self.line.start_over(is_responding=True)
            self._start_handshake()
            return
        self.line.proven(self._now_s)
        self.failed_handshakes = 0
        self._event_deduplicator.handshake_done(handshake.hello.boot_id)
        self.unit_state.begin(handshake, self._now_s)
        if handshake.read_only_reason is None:
            self.clock.begin(self._now_s)
        self._phase = _Phase.UP
        self._received_s = self._now_s
        self._statistics.connections += 1
        hello = handshake.hello
        self._requests.outstanding_max = max(1, hello.max_outstanding)
        self._requests.longest_answer = self.mtu
        if handshake.read_only_reason is None:
            self._set_state(LinkState.READY, ready_reason(handshake.identity))
        else:
            self._set_state(LinkState.READ_ONLY, read_only_reason(handshake.read_only_reason))
        self._stream.begin(handshake)

    def _handshake_failed(self, error: BaseException) -> None:
        if self._phase is not _Phase.HANDSHAKE:
            return
        if isinstance(error, NoAnswer) and self.line.try_another():
            self._start_handshake()
            return
        self._phase = _Phase.PAUSING
        refused = isinstance(error, VersionRefused)
        self._until_s = self._now_s + (REFUSED_PAUSE_S if refused else PAUSE_S)
        self.failed_handshakes += 0 if refused else 1
        if refused:
            self._set_state(LinkState.CLOSED, version_reason(error))
        else:
            reason = handshake_reason(self._port_name, self.line.tried(), error)
            self._set_state(self._absent(), reason)

    def _no_stream(self, error: BaseException) -> None:
        if self._phase is _Phase.UP:
            self._set_state(self.state, no_stream_reason(self.reason, error))

    def _do_due_work(self) -> None:
        if self.state is LinkState.READY:
            self._state_keeper.refresh()
        silent_s = self._now_s - self._received_s
        if silent_s >= SILENCE_S:
            self._connection_lost(rx_timeout_reason(self._port_name))
        elif self._stream.tx_timed_out:
            self._connection_lost(tx_timeout_reason(self._port_name))
        elif self._stream.do_due_work():
            return
        elif self._requests.is_idle and self.clock.due(self._now_s):
            self.clock.synchronise(self._runner, lambda: self._now_s, self._wall_us)
        elif silent_s >= PING_S and self._requests.is_idle:
            self._runner.start(attempt(AliveRequest()), self._is_alive, lambda error: None)

    def _is_alive(self, response: Response) -> None:
        """BOOT may have been lost; the line that was silent asks whether it is still the same."""
        handshake, now = self.handshake, response.message
        if not isinstance(now, AliveResponse) or handshake is None:
            return
        met = (handshake.hello.boot_id, handshake.hello.session_id)
        if self._phase is _Phase.UP and met != (now.boot_id, now.session_id):
            self._repeat_handshake(restarted_reason())

    def _connection_lost(self, reason: str) -> None:
        self._break_off(NoAnswer(reason))
        self._set_state(LinkState.LOST, reason)
        self.line.lost(self._now_s)
        self.line.start_over(is_responding=False)
        self._out += FLUSH
        self._start_handshake()

    def _rebooted(self, reason: str) -> None:
        if self._phase is _Phase.UP:
            self._repeat_handshake(reason)

    def _repeat_handshake(self, reason: str) -> None:
        self._break_off(NoAnswer(reason))
        self._set_state(LinkState.CONNECTING, reason)
        self.line.start_over(is_responding=True)
        self._start_handshake()

    def _break_off(self, error: SpindleError) -> None:
        """End the stream and fail everything that waits for the unit."""
        self.clock.end()
        self.last_block = None
        self._end_log(error.message)
        self._requests.shut(error)
        self._stream.end()

    def _acknowledge_log(self) -> None:
        """Acknowledgements are not answered: the next one says everything again."""
        acknowledgement = self._log.acknowledgement(self._now_s) if self._log else None
        if acknowledgement is not None:
            self._out += encode_frame(encode(Request(NO_TID, acknowledgement)))

    def _end_log(self, reason: str) -> None:
        if self._log is not None:
            self._log.break_off(reason)
            self._log = None

    def _absent(self) -> LinkState:
        return LinkState.CONNECTING if self.handshake is None else LinkState.LOST

    def _set_state(self, state: LinkState, reason: str) -> None:
        if (state, reason) != (self.state, self.reason):
            self.state, self.reason = state, reason
            self._emit(StateChanged(state, reason))

    def _emit(self, event: DeviceEvent) -> None:
        if len(self._events) >= EVENTS_MAX:
            self._events.popleft()
            self._statistics.events_dropped += 1
        self._events.append(event)

    def _wall_us(self) -> int:
        return self._unix_us(self._now_s)

    def _unix_us(self, at_s: float) -> int:
        return round(at_s * 1e6) + self.wall_offset_us
