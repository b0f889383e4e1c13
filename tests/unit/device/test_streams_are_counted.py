"""Every telemetry row is either received or counted as lost, and none is misread.

The unit numbers the frames it builds; sequence numbers and the 32-bit time go over their edges, and
frames of an earlier subscription arrive late.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.device.ebl.session.stream_receiver import StreamPlan, StreamReceiver
from backend.device.states import LinkStatistics, UnitEvent
from backend.device.stream import LostBy, StreamStarted, unwrap_us
from firmware_protocol._generated import (
    CHANNELS,
    FaultClearedEvent,
    FaultSetEvent,
    MessageId,
    Status,
    StreamCountsEvent,
    StrSubscribeResponse,
)
from firmware_protocol.codec import Stream
from tests.fakes.bench import Bench
from tests.fakes.unit import FakeUnit, Refusal


def test_a_hundred_rows_a_second_arrive_in_twenty_blocks_of_all_channels() -> None:
    bench = Bench(FakeUnit(), StreamPlan(batch=5)).connect()
    bench.run(0.2)
    before = len(bench.blocks())

    bench.run(10.0)

    blocks = bench.blocks()[before:]
    assert len(blocks) == 200
    assert {block.values.shape for block in blocks} == {(5, len(CHANNELS))}
    assert [channel.name for channel in blocks[0].channels] == [row.name for row in CHANNELS]
    assert blocks[0].period_us == 10_000


def test_blocks_follow_each_other_in_time_and_number_without_a_seam() -> None:
    bench = Bench(FakeUnit(), StreamPlan(batch=5)).connect()
    bench.run(10.0)

    blocks = bench.blocks()

    assert blocks[0].first_index == 0
    for earlier, later in pairwise(blocks):
        assert later.first_index == earlier.first_index + 5
        assert later.t0_us == earlier.t0_us + 50_000


def test_lost_frames_are_counted_to_the_row() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan(batch=5)).connect()
    bench.run(1.0)
    seen = len(bench.blocks())

    unit.skip_stream_frames(3)
    bench.run(1.0)

    first = bench.blocks()[seen]
    assert first.lost_rows_before == 15
    assert first.first_index == 5 * seen + 15
    assert bench.session.link_statistics().stream_rows_lost == 15


@pytest.mark.parametrize("lost_by", LostBy)
def test_lost_rows_say_where_they_were_lost(lost_by: LostBy) -> None:
    """By what this end sees: that it read late, that frames came damaged, or neither."""
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan(batch=5)).connect()
    bench.run(1.0)
    seen = len(bench.blocks())

    if lost_by is LostBy.MACHINE:
        bench.now_s += 0.5
    if lost_by is LostBy.LINE:
        bench.session.receive(b"\x05half\x00", bench.now_s)
    unit.skip_stream_frames(3)
    bench.run(1.0)
    unit.skip_stream_frames(1)
    bench.run(2.0)
    unit.skip_stream_frames(1)
    bench.run(0.5)

    told = [block.lost_by for block in bench.blocks()[seen:] if block.lost_rows_before]
    assert told[0] is lost_by
    assert told[-1] is LostBy.UNIT
    assert {block.lost_by for block in bench.blocks() if not block.lost_rows_before} == {None}


def test_what_was_built_is_what_was_received_and_what_was_lost() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan(batch=5)).connect()
    bench.run(0.5)
    pieces = 0

    def lose_every_seventh(data: bytes) -> bytes:
        nonlocal pieces
        pieces += bool(data)
        return b"" if pieces % 7 == 0 else data

    bench.to_host = lose_every_seventh
    bench.run(20.0)
    bench.to_host = lambda data: data
    bench.run(0.5)

    counted = bench.session.link_statistics()
    assert counted.stream_rows_lost > 100
    assert counted.stream_frames * 5 == counted.stream_rows
    assert unit.frames_built * 5 == counted.stream_rows + counted.stream_rows_lost


def test_unit_time_goes_on_past_its_32_bits() -> None:
    unit = FakeUnit()
    unit.time_us = 2**32 - 500_000
    bench = Bench(unit, StreamPlan(batch=5)).connect()
    bench.run(2.0)

    times = [block.t0_us for block in bench.blocks()]

    assert times[-1] > 2**32
    assert set(np.diff(times)) == {50_000}


def test_the_first_rows_have_the_unit_s_full_time_after_days_of_running() -> None:
    unit = FakeUnit()
    unit.time_us = 3 * 86_400_000_000
    bench = Bench(unit, StreamPlan(batch=5)).connect()

    bench.run(0.5)

    assert 0 < bench.blocks()[0].t0_us - 3 * 86_400_000_000 < 500_000


def test_a_block_knows_when_the_host_read_it() -> None:
    bench = Bench(FakeUnit(), StreamPlan(batch=5))
    bench.session.wall_offset_us = 1_700_000_000_000_000
    bench.connect().run(1.0)

    read_us = bench.blocks()[-1].wall_us

    assert 0 <= 1_700_000_000_000_000 + bench.now_s * 1e6 - read_us < 100_000


def test_the_lease_is_renewed_every_two_seconds_and_the_stream_never_ends() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan(batch=5)).connect()

    bench.run(21.0)

    assert unit.executed.count(MessageId.STR_RENEW) == 10
    assert unit.executed.count(MessageId.STR_SUBSCRIBE) == 1


@pytest.mark.slow
def test_the_lease_of_a_simulated_unit_that_runs_two_hundred_times_faster_holds() -> None:
    class Hurried(FakeUnit):
        def advance(self, seconds: float) -> None:
            super().advance(200.0 * seconds)

    unit = Hurried()
    unit.device_class = 129
    bench = Bench(unit, StreamPlan(batch=5)).connect()

    bench.run(5.0)

    assert unit.executed.count(MessageId.STR_SUBSCRIBE) == 1
    assert unit.executed.count(MessageId.HELLO) == 1


def test_a_line_that_is_too_slow_is_asked_for_less() -> None:
    class SlowLine(FakeUnit):
        def _on_str_subscribe(self, request: object) -> object:
            if request.divider < 4:  # type: ignore[attr-defined]
                raise Refusal(Status.BANDWIDTH, 25)
            return super()._on_str_subscribe(request)

    bench = Bench(SlowLine(), StreamPlan(batch=5)).connect()
    bench.run(1.0)

    assert bench.of(StreamStarted)[0].period_us == 40_000


def test_faults_and_the_unit_s_own_frame_count_are_noted() -> None:
    unit = FakeUnit()
    bench = Bench(unit, StreamPlan(batch=5)).connect()

    unit.tell(FaultSetEvent(0b101))
    unit.tell(FaultClearedEvent(0b001))
    unit.tell(StreamCountsEvent(1, 1, 500, 3, 0))
    bench.run(0.1)

    assert bench.session.unit_state.faults_active == ("battery_low",)
    assert [event.name for event in bench.of(UnitEvent)] == ["FAULT_SET", "FAULT_CLEARED"]
    assert bench.session.link_statistics().unit_frames_dropped == 3


def receiver(start_seq: int = 0, epoch: int = 3) -> tuple[StreamReceiver, LinkStatistics]:
    statistics = LinkStatistics()
    reply = StrSubscribeResponse(10_000, 2, epoch, start_seq, 1000)
    plan = StreamPlan(channels=CHANNELS[:3], batch=2)
    return StreamReceiver(plan, reply, 1, 0, statistics), statistics


def rows(seq: int, epoch: int = 3, channels: int = 3) -> Stream:
    return Stream(1, seq, 0, epoch, np.zeros((2, channels), dtype=np.int16))


def test_a_frame_of_an_earlier_subscription_is_dropped_not_misread() -> None:
    stream, statistics = receiver(epoch=3)

    assert stream.take(rows(0, epoch=2), 0) is None
    assert statistics.stream_frames_foreign == 1
    assert stream.take(rows(0, epoch=3), 0) is not None


def test_a_frame_of_another_width_is_dropped_not_misread() -> None:
    stream, statistics = receiver()

    assert stream.take(rows(0, channels=4), 0) is None
    assert statistics.stream_frames_foreign == 1


def test_a_frame_that_comes_twice_counts_once() -> None:
    stream, statistics = receiver()
    stream.take(rows(0), 0)

    assert stream.take(rows(0), 0) is None
    assert statistics.stream_frames_repeated == 1
    assert statistics.stream_rows == 2


@given(
    start=st.integers(0, 65535),
    arrived=st.lists(st.booleans(), min_size=1, max_size=200),
)
def test_received_and_lost_always_add_up(start: int, arrived: list[bool]) -> None:
    stream, statistics = receiver(start_seq=start)
    for number, here in enumerate(arrived):
        if here:
            block = stream.take(rows((start + number) % 65536), 0)
            assert block is not None
            assert block.first_index == 2 * number

    last = max((number for number, here in enumerate(arrived) if here), default=-1)
    assert statistics.stream_rows + statistics.stream_rows_lost == 2 * (last + 1)


@given(time_us=st.integers(0, 2**60), apart_us=st.integers(-(2**31) + 1, 2**31 - 1))
def test_32_bits_of_time_are_enough_within_half_an_hour(time_us: int, apart_us: int) -> None:
    if time_us + apart_us >= 0:
        assert unwrap_us((time_us + apart_us) % 2**32, time_us) == time_us + apart_us


@pytest.mark.parametrize("listener_sleeps_s", [120.0])
def test_a_caller_that_stops_reading_loses_events_and_not_memory(listener_sleeps_s: float) -> None:
    bench = Bench(FakeUnit(), StreamPlan(batch=5)).connect()
    session = bench.session
    for _ in range(round(listener_sleeps_s * 100)):
        bench.now_s += 0.01
        bench.unit.advance(0.01)
        session.receive(bench.unit.transmit(), bench.now_s)
        session.tick(bench.now_s)
        bench.unit.receive(session.bytes_to_send())

    assert len(session.next_events()) == 1000
    assert session.link_statistics().events_dropped == pytest.approx(1400, abs=20)
