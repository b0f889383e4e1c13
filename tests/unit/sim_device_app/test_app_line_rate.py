"""Goal: the unit changes its rate only together with its host, or not at all. Method: real firmware
on the bench board, time in its hand; what it says and when is looked at byte by byte.

Times and conditions are those of the protocol's specification (2.1, the line's rate).
"""

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import codec
from firmware_protocol._generated import (
    CHANNELS,
    BaudRates,
    PingRequest,
    SetBaudRequest,
    SetBaudResponse,
    Status,
    StrListRequest,
    StrListResponse,
    StrSubscribeRequest,
)
from firmware_protocol.framing import encode_frame
from tests.fakes.bench_unit import BenchUnit

OFFERED = BaudRates.BAUD_115200 | BaudRates.BAUD_1000000


def on_a_line(offered: int = OFFERED) -> BenchUnit:
    unit = BenchUnit()
    unit.line_baud(115200)
    lib.bench_line_offers(unit.board, offered)
    unit.boot()
    unit.hello()
    return unit


def rate(unit: BenchUnit) -> int:
    return int(lib.bench_line_baud_now(unit.board))


def subscribe(unit: BenchUnit, channels: int, batch: int) -> codec.Response:
    ids = bytes(channel.id for channel in CHANNELS[:channels])
    return unit.ask(StrSubscribeRequest(1, 1, batch, 0, 255, ids))


def test_the_rate_changes_ten_milliseconds_behind_the_answer() -> None:
    unit = on_a_line()

    answer = unit.ask(SetBaudRequest(1_000_000)).message

    assert isinstance(answer, SetBaudResponse)
    assert (answer.switch_after_ms, answer.prove_within_ms) == (10, 200)
    unit.advance(0.009)
    assert rate(unit) == 115200
    unit.advance(0.003)
    assert rate(unit) == 1_000_000


def test_a_request_at_the_new_rate_makes_it_stay() -> None:
    unit = on_a_line()
    unit.ask(SetBaudRequest(1_000_000))
    unit.advance(0.1)

    unit.ask(PingRequest())
    unit.advance(4.0)

    assert rate(unit) == 1_000_000


def test_without_a_request_the_old_rate_is_back_after_a_fifth_of_a_second() -> None:
    unit = on_a_line()
    unit.ask(SetBaudRequest(1_000_000))

    unit.advance(0.205)
    assert rate(unit) == 1_000_000
    unit.advance(0.010)

    assert rate(unit) == 115200


def test_an_answer_that_promised_a_rate_given_back_is_not_given_again() -> None:
    unit = on_a_line()
    request = codec.encode(codec.Request(77, SetBaudRequest(1_000_000)))
    unit.ask_frame(request)
    unit.advance(0.3)
    assert rate(unit) == 115200

    repeated = bytes([request[0] | codec.FLAG_RETRANSMIT]) + request[1:]
    assert unit.ask_frame(repeated).status == Status.OK
    unit.advance(0.02)

    assert rate(unit) == 1_000_000


@pytest.mark.parametrize("baud", [0, 9600, 230400, 2_000_000])
def test_a_rate_that_is_not_offered_is_refused_with_those_that_are(baud: int) -> None:
    unit = on_a_line()

    answer = unit.ask(SetBaudRequest(baud))

    assert (answer.status, answer.detail) == (Status.UNSUPPORTED, OFFERED)
    unit.advance(0.1)
    assert rate(unit) == 115200


def test_a_line_of_one_rate_offers_none() -> None:
    unit = BenchUnit()

    assert unit.hello().baud_bitmap == 0
    assert unit.ask(SetBaudRequest(115200)).status == Status.UNSUPPORTED


def test_a_second_request_while_a_switch_is_under_way_is_refused() -> None:
    unit = on_a_line()
    unit.ask(SetBaudRequest(1_000_000))

    assert unit.ask(SetBaudRequest(115200)).status == Status.BUSY
    unit.advance(0.02)

    assert rate(unit) == 1_000_000


def test_streams_that_would_not_fit_the_new_rate_keep_the_old_one() -> None:
    # 21 channels at 100 Hz need over 4000 bytes/s; 80 % of 11520 holds two such, not three.
    unit = on_a_line()
    unit.ask(SetBaudRequest(1_000_000))
    unit.advance(0.02)
    unit.ask(PingRequest())
    ids = bytes(channel.id for channel in CHANNELS[:20])
    for stream in (1, 2, 3):
        assert unit.ask(StrSubscribeRequest(stream, 1, 5, 0, 255, ids)).status == Status.OK

    assert unit.ask(SetBaudRequest(115200)).status == Status.BANDWIDTH
    unit.advance(0.1)

    assert rate(unit) == 1_000_000


def test_admission_follows_the_rate() -> None:
    unit = on_a_line()
    budget = unit.ask(StrListRequest()).message
    assert isinstance(budget, StrListResponse)
    assert 0.79 * 11520 < budget.budget_bytes_per_s <= 0.80 * 11520

    unit.ask(SetBaudRequest(1_000_000))
    unit.advance(0.02)
    unit.ask(PingRequest())

    budget = unit.ask(StrListRequest()).message
    assert isinstance(budget, StrListResponse)
    assert budget.budget_bytes_per_s == 80_000


def test_while_a_switch_is_under_way_the_unit_says_nothing_but_answers() -> None:
    unit = on_a_line()
    assert subscribe(unit, 4, 1).status == Status.OK
    unit.advance(0.1)
    assert unit.streams
    unit.ask(SetBaudRequest(1_000_000))

    unit.streams.clear()
    unit.advance(0.15)
    assert not unit.streams
    unit.ask(PingRequest())
    unit.advance(0.05)

    # What waited was counted as built and comes now: no row is lost to the switch.
    numbers = [stream.seq for stream in unit.streams]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    assert len(numbers) >= 19


def test_an_answer_that_never_leaves_is_given_up_after_a_second() -> None:
    unit = on_a_line()
    unit.line_room(0)
    unit.say(encode_frame(codec.encode(codec.Request(5, SetBaudRequest(1_000_000)))))

    unit.advance_unread(1.1)
    unit.line_room(65536)
    unit.advance(0.3)

    assert rate(unit) == 115200


def test_a_unit_that_nobody_talks_to_is_back_at_its_first_rate_after_five_seconds() -> None:
    unit = on_a_line()
    unit.ask(SetBaudRequest(1_000_000))
    unit.advance(0.02)
    unit.ask(PingRequest())
    subscribe(unit, 4, 5)

    unit.advance(4.9)
    assert rate(unit) == 1_000_000
    unit.advance(0.2)

    assert rate(unit) == 115200
    unit.streams.clear()
    unit.advance(0.2)
    assert not unit.streams
