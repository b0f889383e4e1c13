"""A session connects to a unit, keeps in touch, and says why when it cannot.

A small honest unit answers in virtual time (tests/fakes/unit.py). The wire cuts the bytes as it
likes, the unit is silent, restarts, or is of another age; every state must carry a reason that a
person can act on.
"""

from __future__ import annotations

import hashlib
import json
import random
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from backend.device.ebl.session.operation import query
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import LinkState
from backend.errors import LinkError, NoAnswer
from firmware_protocol._generated import CHANNELS, CfgInfoRequest, CfgInfoResponse, MessageId
from firmware_protocol.framing import encode_frame
from firmware_protocol.generate.registry import load
from tests.fakes.bench import Bench, bytewise, whole
from tests.fakes.unit import FakeUnit

REGISTRY = Path(__file__).parents[3] / "firmware_protocol" / "registry.toml"


def three_at_a_time(data: bytes) -> Iterable[bytes]:
    return [data[at : at + 3] for at in range(0, len(data), 3)]


@pytest.mark.parametrize("split", [whole, bytewise, three_at_a_time])
def test_the_unit_is_known_after_hello_however_the_bytes_are_cut(
    split: Callable[[bytes], Iterable[bytes]],
) -> None:
    bench = Bench(FakeUnit(uid=b"SPINDLE-0001"))
    bench.split = split

    bench.connect()

    assert bench.session.state is LinkState.READY
    assert bench.session.handshake is not None
    identity = bench.session.handshake.identity
    assert bytes.fromhex(identity.serial_number) == b"SPINDLE-0001"
    assert identity.firmware_version == "0.1.0"
    assert identity.model == "mid drive"
    assert not identity.simulated


def test_the_session_flushes_half_a_frame_before_it_speaks() -> None:
    bench = Bench(FakeUnit())

    bench.open_port()

    assert bench.session.bytes_to_send() == b"\x00\x00"


def test_what_was_on_the_line_before_us_does_not_disturb() -> None:
    bench = Bench(FakeUnit()).open_port()
    bench.session.receive(random.Random(1).randbytes(3000), bench.now_s)

    bench.run_until(lambda: bench.session.state is LinkState.READY)


def test_garbage_between_frames_is_counted_and_passed_over() -> None:
    bench = Bench(FakeUnit(), StreamPlan()).connect()
    noise = random.Random(2)

    bench.to_host = lambda data: noise.randbytes(40) + b"\x00" + data
    bench.run(2.0)

    assert bench.session.state is LinkState.READY
    assert bench.session.link_statistics().frames_bad > 100
    assert bench.session.link_statistics().stream_rows_lost == 0


def test_a_port_where_nobody_answers_stays_connecting_and_says_what_to_check() -> None:
    unit = FakeUnit()
    unit.silent = True
    bench = Bench(unit).open_port()

    bench.run(3.0)

    assert bench.session.state is LinkState.CONNECTING
    assert "No drive unit answers on the bench. Is it switched on" in bench.session.reason
    assert bench.session.failed_handshakes >= 2


def test_a_unit_switched_on_later_is_found() -> None:
    unit = FakeUnit()
    unit.silent = True
    bench = Bench(unit).open_port()
    bench.run(5.0)

    unit.silent = False

    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=1.5)


def test_hello_is_asked_five_times_before_the_session_pauses() -> None:
    unit = FakeUnit()
    bench = Bench(unit)
    bench.to_host = lambda data: b""
    hellos: list[bytes] = []
    bench.to_unit = lambda data: hellos.append(data) or data if len(data) > 10 else data

    bench.open_port().run(0.85)

    assert len(hellos) == 5
    assert len(set(hellos)) == 2  # the first, and the same marked as sent again
    assert unit.executed == [MessageId.HELLO]


def test_a_silent_unit_is_pinged_and_after_a_second_and_a_half_lost() -> None:
    unit = FakeUnit()
    bench = Bench(unit).connect()
    bench.run(10.0)
    assert unit.executed.count(MessageId.ALIVE) in range(17, 21)

    unit.silent = True
    bench.run(0.9)
    assert bench.session.state is LinkState.READY
    bench.run(0.7)

    assert bench.session.state is LinkState.LOST
    assert "stopped answering" in bench.session.reason


def test_a_lost_unit_that_speaks_again_is_ready_again_and_streams() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan()).connect()
    bench.run(1.0)
    unit.silent = True
    bench.run(10.0)
    assert bench.session.state is LinkState.LOST

    unit.silent = False
    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=1.5)
    before = len(bench.blocks())
    bench.run(1.0)

    assert len(bench.blocks()) - before >= 18
    assert bench.session.link_statistics().connections == 2


def test_a_streaming_unit_is_not_pinged() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan()).connect()

    bench.run(10.0)

    assert MessageId.PING not in unit.executed


def test_a_restarted_unit_is_asked_again_who_it_is() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan()).connect()
    bench.run(1.0)

    unit.restart()
    bench.run(0.5)

    assert unit.executed.count(MessageId.HELLO) == 2
    assert bench.session.state is LinkState.READY
    assert bench.session.handshake is not None
    assert bench.session.handshake.identity.boot_id == 2
    assert LinkState.CONNECTING in bench.states()[-2:]


def test_a_restart_nobody_told_of_is_noticed_by_the_lost_stream() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan()).connect()
    bench.run(1.0)

    unit.restart(tell=False)
    bench.run(4.0)

    assert bench.session.handshake is not None
    assert bench.session.handshake.identity.boot_id == 2
    assert bench.blocks()[-1].epoch == 2


def test_a_vanished_port_is_lost_and_its_return_is_ready() -> None:
    bench = Bench(FakeUnit(), StreamPlan()).connect()

    bench.session.port_failed(bench.now_s, LinkError("ttyUSB0: the port vanished."))
    bench.run(3.0)
    assert bench.session.state is LinkState.LOST
    assert bench.session.reason == "ttyUSB0: the port vanished."

    bench.open_port(b"87654321")
    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=0.2)


def test_what_was_asked_when_the_port_vanished_gets_an_answer() -> None:
    bench = Bench(FakeUnit()).connect()
    errors: list[BaseException] = []
    question = query(CfgInfoRequest(), CfgInfoResponse)

    bench.session.start(question, lambda found: None, errors.append)
    bench.session.port_failed(bench.now_s, LinkError("ttyUSB0: the port vanished."))

    assert [type(error) for error in errors] == [NoAnswer]


def test_asking_while_not_connected_is_refused_with_the_reason() -> None:
    bench = Bench(FakeUnit())

    with pytest.raises(NoAnswer, match="being opened"):
        bench.ask(query(CfgInfoRequest(), CfgInfoResponse))


def test_a_unit_of_another_major_version_is_refused_naming_both() -> None:
    unit = FakeUnit()
    unit.major = 2
    bench = Bench(unit).open_port()

    bench.run(1.0)

    assert bench.session.state is LinkState.CLOSED
    assert "protocol 2, this Spindle speaks 1.0" in bench.session.reason


def test_a_unit_that_answers_in_frames_of_another_major_is_refused_too() -> None:
    unit = FakeUnit()
    unit.silent = True
    bench = Bench(unit).open_port()
    bench.run(0.1)

    bench.session.receive(encode_frame(bytes([0x48, 1, 1, 0, 0])), bench.now_s)

    assert bench.session.state is LinkState.CLOSED
    assert "protocol 2, this Spindle" in bench.session.reason


def other_schema(
    change: Callable[[dict[str, list[dict[str, object]]]], object],
) -> tuple[bytes, bytes]:
    """A unit's schema that differs from ours by `change`: compressed text and hash."""
    schema = json.loads(load(REGISTRY).schema)
    change(schema)
    text = json.dumps(schema).encode()
    return zlib.compress(text), hashlib.sha256(text).digest()[:8]


def test_an_unknown_schema_is_read_proven_and_makes_the_unit_read_only() -> None:
    unit = FakeUnit()
    unit.schema, unit.schema_hash = other_schema(lambda schema: schema["channel"].pop(3))
    bench = Bench(unit, StreamPlan()).connect()

    bench.run(1.0)

    assert bench.session.state is LinkState.READ_ONLY
    assert unit.schema_hash.hex() in bench.session.reason
    names = [channel.name for channel in bench.blocks()[0].channels]
    assert len(names) == len(CHANNELS) - 1
    assert "rider_torque_nm" not in names


def test_a_schema_that_is_not_the_promised_one_shows_nothing_rather_than_something_wrong() -> None:
    unit = FakeUnit()
    unit.schema, _ = other_schema(lambda schema: schema["channel"].pop())
    unit.schema_hash = b"promised"
    bench = Bench(unit, StreamPlan()).connect()

    bench.run(1.0)

    assert bench.session.state is LinkState.READ_ONLY
    assert "could not be read" in bench.session.reason
    assert bench.blocks() == []


def test_closing_says_goodbye() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan()).connect()

    bench.session.close(bench.now_s)
    bench.run(0.1)

    assert unit.executed[-1] is MessageId.BYE
    assert bench.session.state is LinkState.CLOSED
