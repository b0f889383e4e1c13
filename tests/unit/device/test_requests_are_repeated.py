"""Requests survive a bad line: repeated with the same tid, done once, bounded in time and number.

The line between session and unit loses what the test tells it to. The unit keeps its last four
answers, so a repetition is recognised (protocol page, 4.3).
"""

from __future__ import annotations

import pytest

from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.device.ebl.session.operation import Operation, Question, query, query_all
from backend.device.ebl.session.requests import RequestTable
from backend.device.states import LinkStatistics
from backend.errors import DeviceRefused, NoAnswer
from firmware_protocol._generated import (
    CfgInfoRequest,
    CfgInfoResponse,
    MessageId,
    PingRequest,
    PingResponse,
    SimGetRequest,
    SimGetResponse,
    Status,
)
from firmware_protocol.codec import Request, Response, decode, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from tests.fakes.bench import Bench
from tests.fakes.unit import FakeUnit


class Lossy:
    """Loses chosen non-empty pieces, counted from 0."""

    def __init__(self, *lost: int) -> None:
        self.lost = set(lost)
        self.seen = 0

    def __call__(self, data: bytes) -> bytes:
        if not data:
            return data
        self.seen += 1
        return b"" if self.seen - 1 in self.lost else data


@pytest.mark.parametrize("lost", range(6))
def test_a_write_survives_a_lost_acknowledgement_and_is_done_once(lost: int) -> None:
    unit = FakeUnit()
    bench = Bench(unit).connect()
    base = bench.ask(read_config())
    unit.executed.clear()

    bench.to_host = Lossy(lost)
    after = bench.ask(write_config(base, {"motor_torque_nm_max": 1.5}))

    assert after.generation == base.generation + 1
    assert unit.executed.count(MessageId.CFG_COMMIT) == 1
    assert unit.executed.count(MessageId.CFG_BEGIN) == 1
    assert bench.session.link_statistics().requests_repeated == 1


def test_a_lost_request_is_repeated_too() -> None:
    bench = Bench(FakeUnit()).connect()

    bench.to_unit = Lossy(0, 1)
    info = bench.ask(query(CfgInfoRequest(), CfgInfoResponse))

    assert info.generation == 7
    assert bench.session.link_statistics().requests_repeated == 2


def test_after_four_sendings_there_is_no_answer_and_the_error_says_so() -> None:
    bench = Bench(FakeUnit()).connect()
    pieces = Lossy(*range(100))

    bench.to_unit = pieces
    with pytest.raises(NoAnswer, match="did not answer CfgInfo"):
        bench.ask(query(CfgInfoRequest(), CfgInfoResponse))

    assert pieces.seen == 4


def test_a_refusal_names_the_status_and_its_meaning() -> None:
    unit = FakeUnit()
    unit.refuse[MessageId.SIM_GET] = Status.UNKNOWN_MSG
    bench = Bench(unit).connect()

    with pytest.raises(DeviceRefused, match=r"UNKNOWN_MSG.*does not know this request") as caught:
        bench.ask(query(SimGetRequest(), SimGetResponse))

    assert caught.value.status == "UNKNOWN_MSG"


def test_no_more_requests_are_under_way_than_the_unit_takes() -> None:
    bench = Bench(FakeUnit()).connect()
    sent: list[int] = []
    decoder = FrameDecoder()

    def count(data: bytes) -> bytes:
        frames = decoder.feed(data)
        if frames:
            sent.append(len(frames))
        return data

    bench.to_unit = count
    answers = bench.ask(query_all([CfgInfoRequest()] * 10, CfgInfoResponse))

    assert len(answers) == 10
    assert max(sent) == 4


def test_answers_to_many_questions_keep_their_order() -> None:
    def both() -> Operation[list[int]]:
        responses = yield (Question(CfgInfoRequest()), Question(PingRequest()))
        return [response.message_id for response in responses]

    bench = Bench(FakeUnit()).connect()

    assert bench.ask(both()) == [MessageId.CFG_INFO, MessageId.PING]


def table_with_one_request() -> tuple[RequestTable, list[object]]:
    table = RequestTable(LinkStatistics())
    answers: list[object] = []
    table.submit(Question(PingRequest()), answers.append)
    return table, answers


def pong(tid: int, status: Status = Status.OK, detail: int = 0) -> Response:
    message = PingResponse() if status == Status.OK else None
    return Response(tid, MessageId.PING, status, detail, message)


def test_a_repetition_is_the_same_request_marked_as_sent_again() -> None:
    table, _ = table_with_one_request()

    first = table.frames_due(0.0)
    again = [table.frames_due(now_s) for now_s in (0.2, 0.4)]

    assert first == encode_frame(encode(Request(1, PingRequest())))
    assert again == [encode_frame(encode(Request(1, PingRequest(), retransmit=True)))] * 2


def test_the_first_timeout_is_150_ms_and_grows_with_a_slow_line() -> None:
    table, _ = table_with_one_request()
    assert table.timeout_s(20) == pytest.approx(0.150)

    table.frames_due(0.0)
    table.answered(pong(1), 0.100)
    table.bits_per_second = 9600.0
    table.longest_answer = 544

    # 4 x 100 ms, and (20 + 544) bytes of ten bits at 9600 baud: 587.5 ms.
    assert table.timeout_s(20) == pytest.approx(0.400 + 0.5875)


def test_a_repeated_request_does_not_spoil_the_measured_round_trip() -> None:
    table, _ = table_with_one_request()
    table.frames_due(0.0)
    table.frames_due(0.2)

    # Whichever sending this answers, 140 ms is not the round trip.
    table.answered(pong(1), 0.340)

    assert table.timeout_s(0) == pytest.approx(0.150)


def test_a_unit_that_needs_longer_says_so_and_is_not_asked_again_meanwhile() -> None:
    table, answers = table_with_one_request()
    table.frames_due(0.0)

    table.answered(pong(1, Status.PENDING, 1000), 0.1)

    assert table.frames_due(1.0) == b""
    table.answered(pong(1), 1.05)
    assert len(answers) == 1


def test_a_unit_cannot_keep_a_caller_waiting_for_ever() -> None:
    table, answers = table_with_one_request()
    now_s = 0.0

    while not answers and now_s < 60.0:
        for _ in FrameDecoder().feed(table.frames_due(now_s)):
            pass
        table.answered(pong(1, Status.PENDING, 500), now_s)
        now_s += 0.4

    assert [type(answer) for answer in answers] == [NoAnswer]
    assert now_s < 15.0


def test_an_answer_to_nothing_we_asked_is_counted_and_dropped() -> None:
    statistics = LinkStatistics()
    table = RequestTable(statistics)

    table.answered(pong(77), 0.0)

    assert statistics.responses_unexpected == 1


def test_request_numbers_go_round_and_never_use_zero() -> None:
    table = RequestTable(LinkStatistics())
    tids = []
    for _ in range(600):
        table.submit(Question(PingRequest()), lambda answer: None)
        (frame,) = FrameDecoder().feed(table.frames_due(0.0))
        request = decode(frame)
        assert isinstance(request, Request)
        tids.append(request.tid)
        table.answered(pong(request.tid), 0.0)

    assert set(tids) == set(range(1, 256))
