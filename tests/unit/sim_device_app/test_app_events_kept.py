"""Goal: an event that matters arrives, however often the line loses it. Method: real firmware on
the bench board; a test is the host that acknowledges, or does not.
"""

import pytest

from firmware_protocol import codec
from firmware_protocol._generated import (
    AliveRequest,
    AliveResponse,
    ByeRequest,
    Event,
    EvtAckRequest,
    PingRequest,
)
from firmware_protocol.framing import encode_frame
from tests.fakes.bench_unit import BenchUnit

REPEAT_S = 0.25
KEPT = 8


def with_a_host() -> BenchUnit:
    unit = BenchUnit()
    unit.hello()
    unit.events.clear()
    return unit


def battery(unit: BenchUnit, voltage_v: float) -> None:
    """A voltage that is a fault or the end of one, until the unit has told."""
    told = len(unit.events)
    unit.inputs(battery_voltage_v=voltage_v)
    for _ in range(100):
        unit.advance(0.05)
        if len(unit.events) > told:
            return
    raise AssertionError("the unit told nothing within 5 s")


def break_and_mend(unit: BenchUnit, times: int) -> None:
    """Two events each time: a fault that comes, and that goes."""
    for _ in range(times):
        battery(unit, 29.0)
        battery(unit, 40.0)


def acknowledge(unit: BenchUnit, seq: int, tid: int = 0) -> None:
    unit.say(encode_frame(codec.encode(codec.Request(tid, EvtAckRequest(seq)))))


def alive(unit: BenchUnit) -> AliveResponse:
    message = unit.ask(AliveRequest()).message
    assert isinstance(message, AliveResponse)
    return message


def test_an_event_is_sent_again_until_it_is_acknowledged() -> None:
    unit = with_a_host()
    battery(unit, 29.0)
    (told,) = unit.events

    unit.advance(4 * REPEAT_S)
    again = list(unit.events_repeated)
    acknowledge(unit, told.seq)
    unit.events_repeated.clear()
    unit.advance(4 * REPEAT_S)

    assert [event.seq for event in again] == [told.seq] * len(again)
    assert 3 <= len(again) <= 4
    assert all((event.code, event.t_us, event.fields) == (told.code, told.t_us, told.fields)
               for event in again)  # fmt: skip
    assert not unit.events_repeated


def test_an_acknowledgement_with_tid_0_is_taken_and_not_answered() -> None:
    unit = with_a_host()
    break_and_mend(unit, 1)
    assert alive(unit).events_waiting == 2

    acknowledge(unit, unit.events[0].seq)

    assert unit.hear() == []
    assert alive(unit).events_waiting == 1


def test_an_acknowledgement_with_a_tid_is_answered() -> None:
    unit = with_a_host()
    break_and_mend(unit, 1)

    acknowledge(unit, unit.events[1].seq, tid=9)

    assert [answer.tid for answer in unit.hear()] == [9]
    assert alive(unit).events_waiting == 1


def test_a_number_nobody_waits_for_changes_nothing() -> None:
    unit = with_a_host()
    break_and_mend(unit, 1)

    for seq in (0xFFFF, 0x1234):
        acknowledge(unit, seq)

    assert alive(unit).events_waiting == 2


def test_the_oldest_gives_way_when_there_is_no_more_room_and_is_counted() -> None:
    unit = with_a_host()

    break_and_mend(unit, 5)
    unit.events_repeated.clear()
    unit.advance(REPEAT_S)

    state = alive(unit)
    assert (state.events_waiting, state.events_pushed_out) == (KEPT, 2)
    assert [event.seq for event in unit.events_repeated[:KEPT]] == [
        event.seq for event in unit.events[-KEPT:]
    ]


@pytest.mark.parametrize("ends", ["bye", "never"])
def test_without_a_host_nothing_is_repeated_and_the_next_one_hears_it(ends: str) -> None:
    unit = BenchUnit()
    if ends == "bye":
        unit.hello()
        unit.ask(ByeRequest())
    unit.advance(0.05)
    unit.events.clear()
    break_and_mend(unit, 1)
    unit.advance(2.0)
    assert not unit.events_repeated

    unit.hello()
    unit.advance(2 * REPEAT_S)

    assert [event.code for event in unit.events_repeated[:2]] == [
        Event.FAULT_SET,
        Event.FAULT_CLEARED,
    ]


def test_a_line_that_takes_nothing_is_not_filled_with_repetitions() -> None:
    unit = with_a_host()
    unit.line_room(0)
    unit.inputs(battery_voltage_v=29.0)
    unit.advance_unread(10.0)

    unit.line_room(65536)
    unit.advance(0.01)

    assert len(unit.events) + len(unit.events_repeated) <= 3


def test_alive_tells_which_life_and_which_session_it_is() -> None:
    unit = with_a_host()
    before = alive(unit)
    unit.hello()
    after = alive(unit)
    unit.boot()
    restarted = alive(unit)

    assert after.session_id == before.session_id + 1
    assert after.boot_id == before.boot_id != restarted.boot_id
    assert restarted.session_id == 0
    assert after.bits_per_second == 0
    assert unit.ask(PingRequest()).message is not None
