"""Goal: frames survive any serial line, or are known to be lost.

Method: hypothesis draws frames, garbage and the places where the operating system cuts the bytes.
"""

import itertools

from hypothesis import given, settings
from hypothesis import strategies as st

from firmware_protocol._generated import MTU
from firmware_protocol.framing import FrameDecoder, encode_frame

frames = st.binary(min_size=4, max_size=MTU - 4)


def pieces(data: bytes, cuts: list[int]) -> list[bytes]:
    edges = sorted({0, len(data), *(cut % (len(data) + 1) for cut in cuts)})
    return [data[a:b] for a, b in itertools.pairwise(edges)]


@given(frames)
def test_a_frame_comes_back_as_it_was_sent(frame: bytes) -> None:
    sent = encode_frame(frame)

    assert FrameDecoder().feed(sent) == [frame]
    assert sent[0] == sent[-1] == 0
    assert 0 not in sent[1:-1]


@given(st.lists(frames, max_size=5), st.binary(max_size=300), st.lists(st.integers(0), max_size=9))
def test_where_the_bytes_are_cut_makes_no_difference(
    sent: list[bytes], garbage: bytes, cuts: list[int]
) -> None:
    line = b"".join(map(encode_frame, sent)) + garbage + b"".join(map(encode_frame, sent))
    whole, cut = FrameDecoder(), FrameDecoder()

    expected = whole.feed(line)
    heard = [frame for piece in pieces(line, cuts) for frame in cut.feed(piece)]

    assert heard == expected
    assert cut.stats == whole.stats


@settings(max_examples=200)
@given(st.binary(max_size=3000), frames)
def test_after_any_garbage_the_next_frame_is_heard(garbage: bytes, frame: bytes) -> None:
    heard = FrameDecoder().feed(garbage + encode_frame(frame))

    assert heard[-1:] == [frame]


@given(frames, st.integers(0), st.integers(0, 7))
def test_one_flipped_bit_never_gives_a_different_frame(frame: bytes, at: int, bit: int) -> None:
    line = bytearray(encode_frame(frame))
    line[1 + at % (len(line) - 2)] ^= 1 << bit

    assert FrameDecoder().feed(bytes(line)) == []


def test_a_line_that_never_pauses_does_not_fill_the_memory() -> None:
    decoder = FrameDecoder()

    for _ in range(200):
        assert decoder.feed(b"\x55" * 4096) == []
    held = len(decoder._pending)
    heard = decoder.feed(encode_frame(b"\x20\x01\x02\x00"))

    assert held <= 2 * MTU
    assert heard == [b"\x20\x01\x02\x00"]
    assert decoder.stats.overflows == 1


def test_a_smaller_mtu_refuses_what_is_longer() -> None:
    decoder = FrameDecoder(mtu=128)

    assert decoder.feed(encode_frame(bytes(124))) == [bytes(124)]
    assert decoder.feed(encode_frame(bytes(125))) == []
    assert decoder.stats.overflows == 1
