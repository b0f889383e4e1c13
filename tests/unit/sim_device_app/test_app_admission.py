"""Goal: streams never take the line away from answers, and a refusal says what would fit.

Method: real firmware on a bench board whose line is said to have a rate. What a stream needs is
counted on the wire: bytes that really went out in a second, against 80 % of the line.
"""

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import (
    CHANNELS,
    Status,
    StrListRequest,
    StrListResponse,
    StrSubscribeRequest,
    StrSubscribeResponse,
    StrUnsubscribeRequest,
)
from tests.fakes.bench_unit import BenchUnit

ALL = bytes(channel.id for channel in CHANNELS)
ENTRY_BYTES = 14


def subscribe(unit: BenchUnit, stream_id: int, divider: int, batch: int = 5) -> object:
    return unit.ask(StrSubscribeRequest(stream_id, divider, batch, 0, 255, ALL))


def listed(unit: BenchUnit) -> StrListResponse:
    message = unit.ask(StrListRequest()).message
    assert isinstance(message, StrListResponse)
    return message


def test_a_line_without_a_known_rate_refuses_nothing(unit: BenchUnit) -> None:
    assert all(subscribe(unit, number, 1, 1).status == Status.OK for number in range(1, 5))
    assert listed(unit).budget_bytes_per_s == 0


@pytest.mark.parametrize("baud", [9600, 19200, 38400])
def test_what_does_not_fit_is_refused_with_the_largest_rate_that_does(
    unit: BenchUnit, baud: int
) -> None:
    unit.line_baud(baud)

    refused = subscribe(unit, 1, 1)

    assert refused.status == Status.BANDWIDTH
    assert 0 < refused.detail < 100
    assert subscribe(unit, 1, -(-100 // refused.detail)).status == Status.OK
    assert subscribe(unit, 1, 100 // (refused.detail + 1)).status == Status.BANDWIDTH


def test_an_admitted_stream_keeps_to_its_word_on_the_wire(unit: BenchUnit) -> None:
    unit.line_baud(115200)
    agreed = subscribe(unit, 1, 1).message
    assert isinstance(agreed, StrSubscribeResponse)

    unit.advance(1.0)
    unit.take_wire()
    lib.bench_advance_us(unit.board, 10_000_000)
    bytes_per_s = len(unit.take_wire()) / 10.0

    # 25 bytes of STREAM_COUNTS once a second are not the stream's.
    assert bytes_per_s - 40 <= agreed.bytes_per_s <= 0.8 * 11520


def test_streams_share_the_budget_and_one_that_ends_gives_its_part_back(unit: BenchUnit) -> None:
    unit.line_baud(230400)
    for stream_id in (1, 2, 3):
        assert subscribe(unit, stream_id, 1).status == Status.OK
    assert subscribe(unit, 4, 1).status == Status.BANDWIDTH

    unit.ask(StrUnsubscribeRequest(1))

    assert subscribe(unit, 4, 1).status == Status.OK


def test_every_channel_at_every_step_leaves_the_slowest_fast_line_a_third(unit: BenchUnit) -> None:
    """What a recorder asks for: 100 rows a second of all channels, in frames of three."""
    unit.line_baud(115200)

    agreed = subscribe(unit, 1, 1, batch=3).message

    assert isinstance(agreed, StrSubscribeResponse)
    assert agreed.bytes_per_s <= 2 / 3 * 11520


def test_a_stream_that_is_changed_does_not_stand_in_its_own_way(unit: BenchUnit) -> None:
    unit.line_baud(57600)
    fitting = subscribe(unit, 1, 2)

    assert fitting.status == Status.OK
    assert subscribe(unit, 1, 2).status == Status.OK


def test_the_list_says_what_runs_and_for_how_long(unit: BenchUnit) -> None:
    unit.line_baud(115200)
    subscribe(unit, 7, 4)
    unit.advance(5.0)

    found = listed(unit)

    assert found.budget_bytes_per_s == pytest.approx(0.8 * 11520, rel=0.01)
    assert len(found.entries) == ENTRY_BYTES
    entry = found.entries
    assert (entry[0], int.from_bytes(entry[2:4], "little"), entry[4], entry[5]) == (
        7,
        4,
        5,
        len(CHANNELS),
    )
    assert int.from_bytes(entry[6:10], "little") == pytest.approx(250_000, abs=20)


def test_a_refused_stream_leaves_the_one_that_runs_alone(unit: BenchUnit) -> None:
    unit.line_baud(38400)
    subscribe(unit, 1, 2)
    unit.advance(1.0)
    unit.streams.clear()

    assert subscribe(unit, 1, 1).status == Status.BANDWIDTH
    unit.advance(1.0)

    assert len(unit.streams) == 10
