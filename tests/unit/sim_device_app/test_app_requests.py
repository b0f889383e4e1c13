"""Goal: whatever a host asks, the unit gives exactly one true answer. Method: real firmware on
the bench board, every message of the registry, and everything that is not one.

The golden request comes from the protocol's specification (4.1).
"""

import zlib

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import codec, framing
from firmware_protocol._generated import (
    CHANNEL_BY_NAME,
    REQUEST_BY_ID,
    SCHEMA_HASH,
    CfgBeginResponse,
    CfgInfoResponse,
    CfgStagedCrcRequest,
    HelloRequest,
    HelloResponse,
    LogCrcRequest,
    MessageId,
    PingRequest,
    SchemaReadRequest,
    SchemaReadResponse,
    StatsRequest,
    StatsResponse,
    Status,
)
from tests.fakes.bench_logs import logs, ride, unit_with_log
from tests.fakes.bench_unit import BenchUnit

GOLDEN_HELLO = bytes.fromhex("0004200101030101010102020c010203040506072c8a749000")
BOARD_MESSAGES = {MessageId.SIM_GET, MessageId.SIM_SET}


def frame(message_id: int, payload: bytes = b"", tid: int = 9, first: int = 0x20) -> bytes:
    return bytes([first, tid]) + message_id.to_bytes(2, "little") + payload


def again(request: bytes) -> bytes:
    """The same request, marked as sent before."""
    return bytes([request[0] | codec.FLAG_RETRANSMIT]) + request[1:]


def test_the_specifications_hello_is_answered_with_the_units_identity() -> None:
    unit = BenchUnit()

    unit.say(GOLDEN_HELLO)
    (response,) = unit.hear()

    hello = response.message
    assert isinstance(hello, HelloResponse)
    assert (response.tid, hello.major) == (1, 1)
    assert hello.schema_hash == SCHEMA_HASH
    assert hello.uid == b"bench-unit-1"
    assert hello.tx_mtu == 512
    assert hello.rx_mtu == 544


@pytest.mark.parametrize("message_id", sorted(REQUEST_BY_ID))
def test_every_message_of_the_registry_is_answered(message_id: int) -> None:
    unit = BenchUnit()

    response = unit.ask_frame(frame(message_id, bytes(REQUEST_BY_ID[message_id].LENGTH)))

    assert (response.tid, response.message_id) == (9, message_id)
    if message_id in BOARD_MESSAGES:
        assert response.status == Status.UNKNOWN_MSG
    else:
        assert response.status not in (Status.UNKNOWN_MSG, Status.INTERNAL)


@pytest.mark.parametrize("message_id", sorted(set(REQUEST_BY_ID) - BOARD_MESSAGES))
def test_a_request_that_is_too_short_is_told_so(message_id: int) -> None:
    unit = BenchUnit()

    for length in range(REQUEST_BY_ID[message_id].LENGTH):
        response = unit.ask_frame(frame(message_id, bytes(length), tid=length + 1))

        assert (length, response.status) == (length, Status.LENGTH)


def test_a_request_of_a_newer_minor_with_more_fields_is_understood() -> None:
    unit = BenchUnit()

    assert unit.ask_frame(frame(MessageId.PING, b"more than we know")).status == Status.OK


@pytest.mark.parametrize("message_id", [0x0000, 0x000F, 0x01FF, 0x0700, 0x6FFF, 0x7001, 0xFFFF])
def test_an_unknown_message_is_answered_as_unknown(message_id: int) -> None:
    unit = BenchUnit()

    response = unit.ask_frame(frame(message_id, b"?"))

    assert (response.status, response.detail) == (Status.UNKNOWN_MSG, message_id)


@pytest.mark.parametrize("major", [0, 2, 7])
def test_a_frame_of_another_major_version_is_answered_with_ours(major: int) -> None:
    unit = BenchUnit()

    response = unit.ask_frame(frame(MessageId.PING, first=major << 5))

    assert (response.status, response.detail) == (Status.VERSION, 1)


@pytest.mark.parametrize("majors", [(0, 0), (2, 9)])
def test_hello_refuses_a_host_without_a_common_version(majors: tuple[int, int]) -> None:
    unit = BenchUnit()

    response = unit.ask(HelloRequest(*majors, 0, 544, bytes(8)))

    assert (response.status, response.detail) == (Status.VERSION, 1)


def test_a_message_in_pieces_is_not_supported() -> None:
    unit = BenchUnit()

    assert unit.ask_frame(frame(MessageId.PING, first=0x21)).status == Status.UNSUPPORTED


@pytest.mark.parametrize(
    ("first", "tid"),
    [(0x24, 9), (0x28, 9), (0x30, 9), (0x38, 9), (0x20, 0)],
    ids=["reserved bit", "response", "stream", "event", "no tid"],
)
def test_what_is_not_a_request_is_left_unanswered(first: int, tid: int) -> None:
    unit = BenchUnit()

    unit.say(framing.encode_frame(frame(MessageId.PING, first=first, tid=tid)))

    assert unit.hear() == []
    assert unit.ask(PingRequest()).status == Status.OK


def test_requests_for_the_board_reach_it_and_no_other() -> None:
    unit = BenchUnit()
    lib.bench_board_requests(unit.board, 1)

    echo = unit.ask_frame(frame(0x7ABC, b"hello board", tid=1))
    assert (echo.status, echo.payload) == (Status.OK, b"hello board")
    assert unit.ask_frame(frame(0x6ABC, b"hello board", tid=2)).status == Status.UNKNOWN_MSG


def test_hello_negotiates_the_frame_size_within_the_units_own() -> None:
    unit = BenchUnit()

    assert unit.hello(host_mtu=200).tx_mtu == 200
    assert unit.hello(host_mtu=1024, nonce=b"12345678").tx_mtu == 544
    assert unit.ask(HelloRequest(1, 1, 0, 127, bytes(8))).status == Status.RANGE


def test_no_response_is_longer_than_the_frame_size_that_was_agreed() -> None:
    unit = BenchUnit()
    header_status_and_check = 4 + 1 + 4 + 4

    for mtu in (128, 200, 544):
        unit.hello(host_mtu=mtu, nonce=mtu.to_bytes(8, "little"))
        message = unit.ask(SchemaReadRequest(0, 0xFFFF)).message
        assert isinstance(message, SchemaReadResponse)
        assert len(message.data) == mtu - header_status_and_check


def test_the_registry_the_unit_was_built_with_can_be_read_from_it(unit: BenchUnit) -> None:
    text = b""
    total = 1

    while len(text) < total:
        message = unit.ask(SchemaReadRequest(len(text), 500)).message
        assert isinstance(message, SchemaReadResponse)
        text += message.data
        total = message.total_length

    assert b"sensor_gain_nm_per_count" in zlib.decompress(text)


def test_every_hello_starts_another_session() -> None:
    unit = BenchUnit()

    sessions = {unit.hello(nonce=bytes([i] * 8)).session_id for i in range(10)}

    assert len(sessions) == 10


def test_a_repeated_hello_is_the_same_session() -> None:
    unit = BenchUnit()
    (hello,) = framing.FrameDecoder().feed(GOLDEN_HELLO)

    first = unit.ask_frame(hello)
    second = unit.ask_frame(again(hello))

    assert first == second


def test_a_hello_that_is_no_repetition_is_another_session() -> None:
    unit = BenchUnit()
    (hello,) = framing.FrameDecoder().feed(GOLDEN_HELLO)

    first, second = unit.ask_frame(hello).message, unit.ask_frame(hello).message

    assert isinstance(first, HelloResponse)
    assert isinstance(second, HelloResponse)
    assert second.session_id == first.session_id + 1


def test_a_retry_is_answered_alike_and_executed_once(unit: BenchUnit) -> None:
    generation, image = unit.read_image()
    begin = frame(
        MessageId.CFG_BEGIN,
        generation.to_bytes(4, "little") + zlib.crc32(image).to_bytes(4, "little"),
        tid=77,
    )

    first = unit.ask_frame(begin)
    repeated = [unit.ask_frame(again(begin)) for _ in range(2)]

    assert first.status == Status.OK
    assert repeated == [first, first]
    assert unit.ask_frame(frame(MessageId.CFG_BEGIN, begin[4:], tid=78)).status == Status.BUSY


def test_a_number_used_again_is_another_request_and_not_an_old_answer() -> None:
    unit = BenchUnit()
    snapshot = frame(MessageId.STR_SNAPSHOT, bytes([CHANNEL_BY_NAME["speed_kmh"].id]))
    unit.inputs(speed_kmh=5.0)
    unit.advance(0.02)
    old = unit.ask_frame(snapshot)
    unit.inputs(speed_kmh=25.0)
    unit.advance(1.0)

    fresh = unit.ask_frame(snapshot)

    speeds = [int.from_bytes(answer.payload[8:10], "little") for answer in (old, fresh)]
    assert speeds == [500, 2500]
    assert unit.ask_frame(again(snapshot)) == fresh


def test_a_repetition_whose_original_never_came_is_a_request() -> None:
    unit = BenchUnit()

    response = unit.ask_frame(again(frame(MessageId.CFG_INFO, tid=3)))

    assert isinstance(response.message, CfgInfoResponse)


def test_a_frame_that_the_line_doubled_is_executed_once() -> None:
    unit = BenchUnit()
    generation, image = unit.read_image()
    fields = generation.to_bytes(4, "little") + zlib.crc32(image).to_bytes(4, "little")
    begin = framing.encode_frame(frame(MessageId.CFG_BEGIN, fields))

    unit.say(begin + begin)
    first, second = unit.hear()

    assert (first.status, second) == (Status.OK, first)


def test_a_late_answer_reaches_nobody_who_was_refused_under_the_same_number() -> None:
    """Two hosts, or one that breaks the rules: LOG_CRC waits, and its number is used again."""
    unit = unit_with_log(4096, 65536)
    ride(unit, 10.0)
    (log,) = logs(unit)
    whole, head = (
        frame(MessageId.LOG_CRC, LogCrcRequest(log.log_id, log.generation, 0, length).to_bytes())
        for length in (log.length, 512)
    )

    assert unit.ask_frame(whole).status == Status.PENDING
    assert unit.ask_frame(head).status == Status.BUSY
    unit.advance(1.0)

    assert unit.ask_frame(again(whole)).status == Status.OK
    assert unit.ask_frame(again(head)).status == Status.BUSY


def test_another_hosts_request_is_not_taken_for_a_retry_of_the_one_before() -> None:
    unit = BenchUnit()
    generation, image = unit.read_image()
    begin = frame(
        MessageId.CFG_BEGIN,
        generation.to_bytes(4, "little") + zlib.crc32(image).to_bytes(4, "little"),
    )
    unit.ask_frame(begin)

    unit.hello(nonce=b"another!")
    response = unit.ask_frame(again(begin))

    assert isinstance(response.message, CfgBeginResponse)
    staged = unit.ask(CfgStagedCrcRequest(response.message.transaction))
    assert staged.status == Status.OK


def test_the_last_four_answers_are_remembered_whatever_their_order() -> None:
    unit = BenchUnit()
    requests = [frame(MessageId.CFG_INFO, tid=tid) for tid in (1, 2, 3, 4)]

    first = [unit.ask_frame(request) for request in requests]
    repeated = [unit.ask_frame(again(request)) for request in reversed(requests)]

    assert first == repeated[::-1]


def test_the_same_tid_with_another_question_is_another_request() -> None:
    unit = BenchUnit()

    assert unit.ask_frame(frame(MessageId.PING, tid=5)).message_id == MessageId.PING
    info = unit.ask_frame(frame(MessageId.CFG_INFO, tid=5))

    assert isinstance(info.message, CfgInfoResponse)


def test_the_receiver_counts_what_it_saw() -> None:
    unit = BenchUnit()
    damaged = bytearray(framing.encode_frame(frame(MessageId.PING)))
    damaged[-2] ^= 0x40
    unit.ask(PingRequest())

    unit.say(bytes(damaged))
    unit.say(b"\x00" + b"\x01" * 3 + b"\x09\x00")
    unit.say(b"\x00" + (b"\xff" + b"x" * 254) * 3 + b"\x00")
    stats = unit.ask(StatsRequest()).message

    assert isinstance(stats, StatsResponse)
    assert stats.frames_ok == 2
    assert stats.crc_errors == 1
    assert stats.cobs_errors == 1
    assert stats.overflows == 1


def test_a_request_split_and_glued_in_any_way_is_the_same_request() -> None:
    unit = BenchUnit()
    wire = b"".join(
        framing.encode_frame(codec.encode(codec.Request(tid, PingRequest()))) for tid in (1, 2, 3)
    )

    for cut in range(len(wire)):
        unit.say(wire[:cut])
        unit.say(wire[cut:])

        assert [response.tid for response in unit.hear()] == [1, 2, 3]
