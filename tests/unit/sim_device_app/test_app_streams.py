"""Goal: no row of telemetry is lost without being counted, and a missing value stays missing.

Method: real firmware on the bench board; the conservation law `built = received + dropped` is
checked on a line that is read, not read, and read again. The arithmetic of counts is the
registry's: value = count * scale.
"""

import math

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import codec, framing
from firmware_protocol._generated import (
    CHANNELS,
    ByeRequest,
    Event,
    InputFlags,
    PingRequest,
    Status,
    StrRenewRequest,
    StrSnapshotRequest,
    StrSnapshotResponse,
    StrSubscribeRequest,
    StrSubscribeResponse,
    StrUnsubscribeRequest,
)
from firmware_protocol.layout import MISSING
from tests.fakes.bench_unit import BenchUnit

ID = {channel.name: channel.id for channel in CHANNELS}
SPEED, CADENCE, GAIN, RAW = (
    ID[name] for name in ("speed_kmh", "cadence_rpm", "fuzzy_gain", "rider_torque_raw")
)
STEP_US = 10_000
LINE_BYTES = lib.BENCH_LINE_BYTES


def subscribe(
    unit: BenchUnit,
    *channel_ids: int,
    stream_id: int = 1,
    divider: int = 1,
    batch: int = 5,
    lease_s: int = 255,
) -> StrSubscribeResponse:
    request = StrSubscribeRequest(stream_id, divider, batch, 0, lease_s, bytes(channel_ids))
    message = unit.ask(request).message
    assert isinstance(message, StrSubscribeResponse)
    return message


def stats(unit: BenchUnit, stream_id: int) -> tuple[int, int]:
    latest = [
        event.fields
        for event in unit.events
        if event.code == Event.STREAM_COUNTS and event.fields["stream_id"] == stream_id
    ][-1]
    return int(str(latest["built"])), int(str(latest["dropped_tx"]))


def test_rows_come_at_the_rate_and_in_the_batches_that_were_agreed(unit: BenchUnit) -> None:
    agreed = subscribe(unit, SPEED, CADENCE, divider=4, batch=10)

    unit.advance(4.0)

    assert (agreed.period_us, agreed.batch) == (4 * STEP_US, 10)
    assert len(unit.streams) == 10
    assert [stream.seq for stream in unit.streams] == list(range(agreed.start_seq, 10))
    assert {stream.epoch for stream in unit.streams} == {agreed.epoch}
    times = [stream.t0_us for stream in unit.streams]
    assert np.diff(times).tolist() == [10 * agreed.period_us] * 9
    assert all(stream.values.shape == (10, 2) for stream in unit.streams)


def test_the_announced_rate_covers_what_the_line_really_carries(unit: BenchUnit) -> None:
    agreed = subscribe(unit, *ID.values(), batch=10)

    unit.advance_unread(0.9)
    bytes_per_s = len(unit.take_wire()) / 0.9

    assert 0.97 * agreed.bytes_per_s < bytes_per_s <= agreed.bytes_per_s


def test_a_value_is_its_count_times_the_scale_of_its_channel(unit: BenchUnit) -> None:
    unit.inputs(
        speed_kmh=23.456,
        cadence_rpm=-61.5,
        torque_raw_counts=1234.0,
        battery_voltage_v=36.002,
        battery_soc_pct=79.99,
        crank_angle_deg=359.98,
    )
    expected = {
        "speed_kmh": 2346,
        "cadence_rpm": -6150,
        "rider_torque_raw": 1234,
        "battery_voltage_v": 18001,
        "battery_soc_pct": 7999,
        "crank_angle_deg": 17999,
        "rider_torque_nm": 1234,
        "assist_mode": 3,
    }
    unit.advance(0.01)

    message = unit.ask(StrSnapshotRequest(bytes(ID[name] for name in expected))).message

    assert isinstance(message, StrSnapshotResponse)
    assert message.t_us == STEP_US
    assert np.frombuffer(message.values, "<i2").tolist() == list(expected.values())


def test_what_the_law_was_told_is_told_to_the_host(unit: BenchUnit) -> None:
    names = ("input_flags", "torque_age_ms", "controller_temperature_degc")
    unit.inputs(torque_age_ms=7, controller_temperature_degc=41.5)
    told = []
    for pressed in ({}, {"brake": 1}, {"brake": 0, "walk_button": 1}):
        unit.inputs(**pressed)
        unit.advance(0.01)
        message = unit.ask(StrSnapshotRequest(bytes(ID[name] for name in names))).message
        assert isinstance(message, StrSnapshotResponse)
        told.append(np.frombuffer(message.values, "<i2").tolist())

    brake, walk = int(InputFlags.BRAKE), int(InputFlags.WALK_BUTTON)
    assert told == [[0, 7, 4150], [brake, 7, 4150], [walk, 7, 4150]]


def test_a_fault_that_forbids_torque_is_told_as_an_input_of_the_law(unit: BenchUnit) -> None:
    unit.inputs(battery_cut=1)
    unit.advance(1.0)

    message = unit.ask(StrSnapshotRequest(bytes([ID["input_flags"]]))).message

    assert isinstance(message, StrSnapshotResponse)
    assert np.frombuffer(message.values, "<i2").tolist() == [InputFlags.INHIBIT]


def test_what_is_not_known_is_missing_and_never_zero(unit: BenchUnit) -> None:
    unit.inputs(speed_kmh=math.nan, motor_temperature_degc=math.inf, mode_selected=1)
    subscribe(unit, SPEED, ID["motor_temperature_degc"], GAIN, CADENCE, batch=1)

    unit.advance(0.01)

    assert unit.streams[0].values.tolist() == [[MISSING, MISSING, MISSING, 0]]


def test_before_the_first_control_step_everything_is_missing() -> None:
    unit = BenchUnit()

    message = unit.ask(StrSnapshotRequest(bytes(ID.values()))).message

    assert isinstance(message, StrSnapshotResponse)
    assert set(np.frombuffer(message.values, "<i2").tolist()) == {MISSING}


def test_a_value_beyond_its_channel_is_clamped_and_the_frame_says_so(unit: BenchUnit) -> None:
    subscribe(unit, RAW, SPEED, batch=2)
    unit.advance(0.02)
    unit.inputs(torque_raw_counts=-1.0e9, speed_kmh=400.0)

    unit.advance(0.04)

    assert [stream.clip for stream in unit.streams] == [False, True, True]
    assert unit.streams[-1].values.tolist() == [[-32767, 32767]] * 2


def test_every_frame_built_is_received_or_counted_as_dropped(unit: BenchUnit) -> None:
    subscribe(unit, *ID.values(), stream_id=1, divider=1, batch=4)
    subscribe(unit, SPEED, stream_id=2, divider=3, batch=2)
    unit.advance(5.0)
    unit.line_room(0)
    unit.advance_unread(20.0)
    unit.line_room(LINE_BYTES)
    unit.advance(10.0)
    unit.ask(StrUnsubscribeRequest(99))

    for stream_id in (1, 2):
        received = [stream.seq for stream in unit.streams if stream.stream_id == stream_id]
        built, dropped = stats(unit, stream_id)
        counted = [seq for seq in received if seq < built]
        assert dropped > 0
        assert built == len(counted) + dropped
        assert received == sorted(set(received))
        gaps = sum(np.diff(received) - 1)
        assert gaps == dropped


def test_the_first_frame_after_a_gap_is_marked(unit: BenchUnit) -> None:
    subscribe(unit, *ID.values(), batch=4)
    unit.line_room(0)
    unit.advance_unread(10.0)
    unit.line_room(LINE_BYTES)
    unit.advance(1.0)

    after_gap = [
        later.seq
        for earlier, later in zip(unit.streams, unit.streams[1:], strict=False)
        if later.seq != earlier.seq + 1
    ]

    assert len(after_gap) == 1
    assert [stream.seq for stream in unit.streams if stream.overrun] == after_gap


def test_a_response_overtakes_the_streams_that_wait(unit: BenchUnit) -> None:
    subscribe(unit, *ID.values(), batch=10)
    unit.line_room(0)
    unit.advance_unread(3.0)
    unit.line_room(LINE_BYTES)

    unit.say(framing.encode_frame(codec.encode(codec.Request(7, PingRequest()))))
    kinds = [type(codec.decode(frame)) for frame in unit.take_frames()]

    # The frame that the line had half of is finished first.
    assert kinds.index(codec.Response) <= 1
    assert kinds.count(codec.Stream) > 2


def test_a_changed_subscription_has_another_epoch_and_counts_from_its_start(
    unit: BenchUnit,
) -> None:
    first = subscribe(unit, SPEED, batch=1)
    unit.advance(0.1)
    second = subscribe(unit, SPEED, CADENCE, batch=1)
    unit.streams.clear()

    unit.advance(0.1)

    assert second.epoch != first.epoch
    assert unit.streams[0].seq == second.start_seq
    assert {(stream.epoch, stream.values.shape[1]) for stream in unit.streams} == {
        (second.epoch, 2)
    }


def test_a_stream_that_nobody_renews_ends(unit: BenchUnit) -> None:
    subscribe(unit, SPEED, batch=1, lease_s=2)
    unit.advance(1.9)
    assert unit.ask(StrRenewRequest(1, 2)).status == Status.OK
    unit.advance(1.9)
    alive = len(unit.streams)

    unit.advance(10.0)

    assert alive == 380
    assert len(unit.streams) == 390
    assert unit.ask(StrRenewRequest(1, 2)).status == Status.NOT_FOUND


@pytest.mark.parametrize("ending", ["unsubscribe", "bye", "hello"])
def test_streams_end_when_the_host_wants_or_leaves(unit: BenchUnit, ending: str) -> None:
    subscribe(unit, SPEED, batch=1)
    unit.advance(0.1)

    if ending == "unsubscribe":
        assert unit.ask(StrUnsubscribeRequest(1)).status == Status.OK
    elif ending == "bye":
        unit.ask(ByeRequest())
    else:
        unit.hello(nonce=b"another!")
    unit.streams.clear()
    unit.advance(1.0)

    assert unit.streams == []
    assert unit.ask(StrUnsubscribeRequest(1)).status == Status.NOT_FOUND


@pytest.mark.parametrize(
    ("request_", "status", "detail"),
    [
        (StrSubscribeRequest(1, 0, 5, 0, 5, b"\x01"), Status.RANGE, 0),
        (StrSubscribeRequest(1, 1, 0, 0, 5, b"\x01"), Status.RANGE, 0),
        (StrSubscribeRequest(1, 1, 5, 0, 0, b"\x01"), Status.RANGE, 0),
        (StrSubscribeRequest(1, 1, 5, 1, 5, b"\x01"), Status.UNSUPPORTED, 0),
        (StrSubscribeRequest(1, 1, 5, 0, 5, b""), Status.LENGTH, 0),
        (StrSubscribeRequest(1, 1, 5, 0, 5, b"\x01" * (len(CHANNELS) + 1)), Status.LENGTH, 0),
        (StrSubscribeRequest(1, 1, 5, 0, 5, b"\x01\xc8"), Status.UNKNOWN_ID, 200),
        (StrSnapshotRequest(b"\x01\xc8"), Status.UNKNOWN_ID, 200),
        (StrSnapshotRequest(b""), Status.LENGTH, 0),
    ],
    ids=repr,
)
def test_a_subscription_that_makes_no_sense_is_refused(
    unit: BenchUnit, request_: StrSubscribeRequest, status: Status, detail: int
) -> None:
    response = unit.ask(request_)

    assert (response.status, response.detail) == (status, detail)


def test_a_frame_beyond_the_agreed_size_is_refused_with_the_batch_that_fits(
    unit: BenchUnit,
) -> None:
    every_channel = bytes(ID.values())
    fits = (544 - 4 - 6 - 4) // (2 * len(every_channel))

    refused = unit.ask(StrSubscribeRequest(1, 1, fits + 1, 0, 5, every_channel))

    assert (refused.status, refused.detail) == (Status.RANGE, fits)
    assert unit.ask(StrSubscribeRequest(1, 1, fits, 0, 5, every_channel)).status == Status.OK


def test_there_is_room_for_four_streams_and_no_more(unit: BenchUnit) -> None:
    for stream_id in (1, 2, 3, 4):
        subscribe(unit, SPEED, stream_id=stream_id)

    fifth = unit.ask(StrSubscribeRequest(5, 1, 5, 0, 5, bytes([SPEED])))

    assert fifth.status == Status.NO_SPACE
    unit.ask(StrUnsubscribeRequest(2))
    subscribe(unit, SPEED, stream_id=5)
