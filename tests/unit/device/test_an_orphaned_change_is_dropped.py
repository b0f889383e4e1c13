"""Goal: a change that broke off does not keep the next one waiting for the unit's lease of 30 s.

Method: the host's session and the real firmware on a line that loses all the unit says for a while,
which is shorter than the 1.5 s of silence that would end the session by itself. HELLO ends what the
session before had open (SPEC 2.3); a host that has nothing open of its own must not use it so.
"""

from __future__ import annotations

import pytest
from sim_device.firmware.python._native import lib

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.device.states import LinkState
from backend.errors import DeviceRefused, NoAnswer
from firmware_protocol import codec, framing
from firmware_protocol._generated import CfgBeginRequest
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.serial_wire import SerialWire

CHANGE = {"pedal_stop_ms": 200}


def connected() -> tuple[SerialWire, ConfigImage]:
    unit = BenchUnit()
    unit.take_wire()
    wire = SerialWire(unit).connect()
    return wire, wire.ask(read_config())


def session_id_of(wire: SerialWire) -> int:
    assert wire.session.handshake is not None
    return wire.session.handshake.hello.session_id


def test_a_begin_whose_answer_was_lost_blocks_nobody() -> None:
    wire, base = connected()
    wire.up.broken = True
    with pytest.raises(NoAnswer, match="unchanged"):
        wire.ask(write_config(base, CHANGE))
    wire.up.broken = False
    began_s = wire.now_s

    wire.run_until(lambda: wire.session.state is LinkState.READY)
    after = wire.ask(write_config(base, CHANGE))

    assert after.parameters["pedal_stop_ms"] == 200
    assert wire.now_s - began_s < 3.0


def test_a_change_that_broke_off_in_the_middle_blocks_nobody() -> None:
    wire, base = connected()
    answered = wire.up.frames
    errors: list[BaseException] = []
    wire.session.start(write_config(base, CHANGE), lambda image: None, errors.append)
    wire.run_until(lambda: wire.up.frames > answered)
    wire.up.broken = True
    wire.run_until(lambda: bool(errors))
    wire.up.broken = False

    wire.run_until(lambda: wire.session.state is LinkState.READY)
    after = wire.ask(write_config(base, CHANGE))

    assert isinstance(errors[0], NoAnswer)
    assert after.parameters["pedal_stop_ms"] == 200


def test_what_another_host_has_open_is_left_to_it() -> None:
    wire, base = connected()
    session = session_id_of(wire)
    begin = codec.Request(200, CfgBeginRequest(base.generation, base.crc32))
    frame = framing.encode_frame(codec.encode(begin))
    lib.bench_send(wire.unit.board, frame, len(frame))
    wire.run(0.1)

    for _ in range(2):
        with pytest.raises(DeviceRefused) as refused:
            wire.ask(write_config(base, CHANGE))
        assert refused.value.status == "BUSY"
    wire.run(2.0)

    assert wire.session.state is LinkState.READY
    assert session_id_of(wire) == session
