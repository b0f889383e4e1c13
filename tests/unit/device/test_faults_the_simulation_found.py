"""Goal: what the simulated link brought to light stays mended (tests/simulation/regressions.toml).

Each test is one such fault, with the real firmware in virtual time and the one accident it needs.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_transaction import CommitUnanswered, read_config
from backend.device.ebl.operations.config_transaction import write_config as write
from backend.device.ebl.session.operation import query
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import LinkState
from backend.errors import DeviceRefused
from firmware_protocol._generated import (
    CfgBeginRequest,
    CfgBeginResponse,
    MessageId,
    PingRequest,
    PingResponse,
    Status,
)
from firmware_protocol.codec import Event, Request, Response, Stream, decode
from firmware_protocol.framing import FrameDecoder, encode_frame
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.simulated_unit import LockstepAsUnit

CHANGE = {"pedal_stop_ms": 240}


class Line:
    """Loses whole frames that `lost` says so of, one direction of a bench."""

    def __init__(self, lost: Callable[[object], bool]) -> None:
        self.lost = lost
        self.passed: list[object] = []
        self._decoder = FrameDecoder()

    def __call__(self, data: bytes) -> bytes:
        out = bytearray()
        for frame in self._decoder.feed(data):
            message = decode(frame)
            if not self.lost(message):
                self.passed.append(message)
                out += encode_frame(frame)
        return bytes(out)


class Mortal(LockstepAsUnit):
    """The firmware, which can be restarted."""

    def __init__(self) -> None:
        super().__init__(LockstepUnit(seed=1))

    def restart(self) -> None:
        self.unit = LockstepUnit(seed=1, flash=self.unit.unit.flash(), boot_id=2)


def bench(plan: StreamPlan | None = None) -> Bench:
    return Bench(Mortal(), plan)


def is_answer_to(message: object, identity: MessageId) -> bool:
    return isinstance(message, Response) and message.message_id == identity


def asks(message: object, identity: MessageId) -> bool:
    return isinstance(message, Request) and message.message.MESSAGE_ID is identity


def test_a_subscription_nobody_answered_is_asked_for_again() -> None:
    there = bench(StreamPlan())
    lost = Line(lambda message: asks(message, MessageId.STR_SUBSCRIBE))
    there.to_unit = lost
    there.connect()
    there.run(1.5)
    assert there.blocks() == []

    lost.lost = lambda message: False
    there.run(4.0)

    assert there.session.state is LinkState.READY
    assert there.blocks() != []


def test_a_change_that_cannot_be_read_back_is_not_called_unchanged() -> None:
    there = bench().connect()
    base = there.ask(read_config())
    committed: list[object] = []

    def gone(message: object) -> bool:
        committed.extend([message] if is_answer_to(message, MessageId.CFG_COMMIT) else [])
        return bool(committed) and not is_answer_to(message, MessageId.CFG_COMMIT)

    there.to_host = Line(gone)

    with pytest.raises(CommitUnanswered):
        there.ask(write(base, CHANGE))


def test_a_commit_repeated_to_a_restarted_unit_is_not_called_refused() -> None:
    """The unit committed, lost its power before it could say so, and knows of no transaction."""
    there = bench().connect()
    base = there.ask(read_config())
    unit = there.unit
    assert isinstance(unit, Mortal)

    def dies_after_commit(message: object) -> bool:
        answer = message if isinstance(message, Response) else None
        if answer and is_answer_to(answer, MessageId.CFG_COMMIT) and answer.status == Status.OK:
            unit.restart()
            return True
        return isinstance(message, Event)

    there.to_host = Line(dies_after_commit)

    with pytest.raises(CommitUnanswered):
        there.ask(write(base, CHANGE))

    there.to_host = lambda data: data
    assert there.ask(read_config()).parameters["pedal_stop_ms"] == 240


def test_whatever_goes_on_beside_it_a_lost_answer_is_repeated_while_the_unit_knows_it() -> None:
    """The unit keeps four answers: sixteen quick requests must not push the slow one out."""
    there = bench().connect()
    base = there.ask(read_config())
    begins = 0

    def first_begin(message: object) -> bool:
        nonlocal begins
        begins += is_answer_to(message, MessageId.CFG_BEGIN)
        return begins == 1 and is_answer_to(message, MessageId.CFG_BEGIN)

    there.to_host = Line(first_begin)
    begun: list[object] = []
    request = CfgBeginRequest(base.generation, base.crc32)
    there.session.start(query(request, CfgBeginResponse), begun.append, begun.append)
    for _ in range(16):
        there.session.start(query(PingRequest(), PingResponse), lambda _: None, lambda _: None)
    there.run_until(lambda: bool(begun))

    assert isinstance(begun[0], CfgBeginResponse)


def test_a_unit_that_talks_and_hears_nothing_is_lost_and_the_reason_says_which_way() -> None:
    there = bench(StreamPlan()).connect()
    there.run(1.0)

    there.to_unit = lambda data: b""
    there.run(6.0)

    assert LinkState.LOST in there.states()
    assert any(
        "one direction" in event.reason for event in there.events if hasattr(event, "reason")
    )
    there.to_unit = lambda data: data
    there.run_until(lambda: there.session.state is LinkState.READY, 3.0)


def test_a_restart_between_hello_and_its_answer_is_not_forgotten() -> None:
    there = bench(StreamPlan())
    unit = there.unit
    assert isinstance(unit, Mortal)
    restarted: list[bool] = []

    def restarts_after_hello(message: object) -> bool:
        if is_answer_to(message, MessageId.HELLO) and not restarted:
            restarted.append(True)
            unit.restart()
        return False

    there.to_host = Line(restarts_after_hello)
    there.open_port()
    there.run(3.0)

    assert there.session.handshake is not None
    assert there.session.handshake.identity.boot_id == 2
    assert there.session.state is LinkState.READY
    assert there.blocks() != []


def test_a_restart_nobody_told_of_shows_in_the_unit_s_clock() -> None:
    there = bench(StreamPlan())
    unit = there.unit
    assert isinstance(unit, Mortal)
    unit.advance(5.0)
    unit.transmit()
    restarted: list[bool] = []

    def restarts_after_the_faults(message: object) -> bool:
        if is_answer_to(message, MessageId.EVT_FAULT_LIST) and not restarted:
            restarted.append(True)
            unit.restart()
        return isinstance(message, Event)

    there.to_host = Line(restarts_after_the_faults)
    there.open_port()
    there.run(3.0)

    assert there.session.handshake is not None
    assert there.session.handshake.identity.boot_id == 2
    assert there.session.reason.startswith("Connected")
    assert there.blocks() != []


def test_damage_is_still_in_the_account_after_a_new_handshake() -> None:
    there = bench().connect()
    before = there.session.link_statistics().frames_bad

    there.session.receive(b"\x00\x05damage\x00", there.now_s)
    there.session.receive(b"\x00\x03moredamage\x00\x00\x07half of a", there.now_s)
    there.to_unit = lambda data: b""
    there.run(2.0)
    there.to_unit = lambda data: data
    there.run_until(lambda: there.session.state is LinkState.READY)

    assert there.session.link_statistics().frames_bad >= before + 3


def test_a_transaction_left_open_is_told_with_the_time_it_has_left() -> None:
    there = bench().connect()
    base = there.ask(read_config())
    there.ask(query(CfgBeginRequest(base.generation, base.crc32), CfgBeginResponse))

    with pytest.raises(DeviceRefused, match="ends by itself in 30 s") as caught:
        there.ask(write(base, CHANGE))

    assert caught.value.status == "BUSY"


def test_a_unit_that_is_back_at_its_short_frames_is_read_all_the_same() -> None:
    """Rebooted, and no HELLO since: 128 bytes a frame until HELLO."""
    there = bench().connect()
    unit = there.unit
    assert isinstance(unit, Mortal)
    there.to_host = Line(lambda message: isinstance(message, Event | Stream))
    unit.restart()

    config = there.ask(read_config())

    assert isinstance(config, ConfigImage)
    assert isinstance(there.session, Session)
