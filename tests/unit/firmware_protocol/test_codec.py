"""Goal: a session can rely on what it is told about a frame, whoever built the unit.

Method: frames written out byte by byte from SPEC.md, newer units imitated by longer payloads and
codes that do not exist yet, and hypothesis for everything else.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from firmware_protocol import codec
from firmware_protocol._generated import (
    BootEvent,
    CfgReadRequest,
    CfgReadResponse,
    Event,
    HelloRequest,
    PingRequest,
    Status,
)
from firmware_protocol.codec import Malformed, Reason


def test_a_request_keeps_its_transaction_id_and_says_when_it_is_sent_again() -> None:
    first = codec.encode(codec.Request(9, PingRequest()))
    again = codec.encode(codec.Request(9, PingRequest(), retransmit=True))

    assert first.hex() == "20090200"
    assert again.hex() == "22090200"
    assert codec.decode(again) == codec.Request(9, PingRequest(), retransmit=True)


def test_the_rest_of_a_payload_is_the_last_field() -> None:
    frame = bytes.fromhex("28040101") + b"\0" + bytes.fromhex("07000000 2b01") + b"image"

    answer = codec.decode(frame)

    assert isinstance(answer, codec.Response)
    assert answer.message == CfgReadResponse(generation=7, total_length=299, data=b"image")


def test_a_longer_answer_of_a_newer_unit_is_read_as_far_as_we_know_it() -> None:
    frame = bytes.fromhex("28040001") + b"\0" + bytes(11) + b"something new"

    answer = codec.decode(frame)

    assert isinstance(answer, codec.Response)
    assert answer.status == Status.OK


def test_a_refusal_carries_its_detail_and_no_message() -> None:
    answer = codec.decode(bytes.fromhex("280425010b2a00"))

    assert isinstance(answer, codec.Response)
    assert (answer.status, answer.detail, answer.message) == (Status.STALE_BASE, 42, None)


def test_a_status_we_do_not_know_is_an_error_with_its_number() -> None:
    answer = codec.decode(bytes.fromhex("28042501630100"))

    assert isinstance(answer, codec.Response)
    assert (answer.status, answer.detail) == (99, 1)


def test_an_event_we_know_has_named_fields() -> None:
    event = codec.decode(bytes.fromhex("38000300" + "01" + "40420f00" + "efbeadde" + "05"))

    assert isinstance(event, codec.Event)
    assert (event.seq, event.code, event.t_us) == (3, Event.BOOT, 1_000_000)
    assert event.message == BootEvent(boot_id=0xDEADBEEF, reset_cause=5)
    assert event.fields == {"boot_id": 0xDEADBEEF, "reset_cause": 5}


def test_an_event_we_do_not_know_is_still_reported() -> None:
    event = codec.decode(bytes.fromhex("38000300" + "63" + "40420f00" + "0102"))

    assert isinstance(event, codec.Event)
    assert (event.code, event.message, event.payload) == (99, None, b"\1\2")


def test_stream_rows_are_a_view_of_the_frame() -> None:
    frame = bytes.fromhex("3001010240420f0002000000ffff00010100")

    stream = codec.decode(frame)

    assert isinstance(stream, codec.Stream)
    assert (stream.stream_id, stream.seq, stream.t0_us, stream.epoch) == (1, 513, 1_000_000, 0)
    assert stream.values.tolist() == [[0, -1], [256, 1]]
    assert np.shares_memory(stream.values, np.frombuffer(frame, np.uint8))


def test_a_stream_of_another_width_than_subscribed_is_not_misread() -> None:
    frame = bytes.fromhex("3001010240420f0002000000ffff00010100")

    assert codec.decode(frame, channel_count=4) == Malformed(Reason.SHAPE, frame)
    assert codec.decode_stream(frame, 2) is not None


def test_epoch_and_flags_have_bits_of_their_own() -> None:
    rows = np.array([[1]], dtype=np.int16)
    frame = codec.encode(codec.Stream(1, 0, 0, epoch=5, values=rows, overrun=True, clip=True))

    stream = codec.decode(frame)

    assert frame[9] == 0b0001_1101
    assert isinstance(stream, codec.Stream)
    assert (stream.epoch, stream.overrun, stream.clip) == (5, True, True)


@given(st.binary(max_size=120))
def test_no_bytes_at_all_make_the_decoder_raise(frame: bytes) -> None:
    decoded = codec.decode(frame)

    if isinstance(decoded, Malformed):
        assert decoded.frame == frame


@given(st.binary(min_size=8, max_size=8), st.integers(1, 255), st.integers(0, 0xFFFF))
@pytest.mark.slow
def test_what_is_encoded_is_what_is_decoded(nonce: bytes, tid: int, mtu: int) -> None:
    request = codec.Request(tid, HelloRequest(1, 1, 0, mtu, nonce))

    assert codec.decode(codec.encode(request)) == request


def test_a_value_that_does_not_fit_its_field_is_our_error_and_is_not_sent() -> None:
    with pytest.raises(Exception, match="65535"):
        codec.encode(codec.Request(1, CfgReadRequest(bank=0, offset=70_000, length=1)))
    with pytest.raises(ValueError, match="host_nonce takes 8 bytes, got 3"):
        codec.encode(codec.Request(1, HelloRequest(1, 1, 0, 512, b"abc")))
