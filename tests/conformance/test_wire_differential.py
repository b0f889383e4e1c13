"""Goal: no frame or damage exists that C and Python understand differently.

Method: differential testing with seeded random frames, streams broken in seeded places, and
configurations drawn by hypothesis; the two codecs share no code (PyPI cobs and zlib against the
unit's own C).
"""

import math
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from firmware_protocol import _generated as registry
from firmware_protocol import codec, framing, parameters
from sim_device.firmware.python import wire

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

FRAMES = 4000


def random_frame(source: random.Random) -> bytes:
    """Mostly zeros, mostly non-zero, or anything; up to the longest frame."""
    length = source.randrange(4, 541)
    alphabet = source.choice([b"\0\0\0\1", bytes(range(1, 256)), bytes(range(256))])
    return bytes(source.choices(alphabet, k=length))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_random_frames_have_the_same_bytes_and_cross_both_ways(seed: int) -> None:
    source = random.Random(seed)
    frames = [random_frame(source) for _ in range(FRAMES)]

    from_host = [framing.encode_frame(frame) for frame in frames]
    from_unit = [wire.encode_frame(frame) for frame in frames]

    assert from_host == from_unit
    assert wire.FrameDecoder().feed(b"".join(from_host)) == frames
    assert framing.FrameDecoder().feed(b"".join(from_unit)) == frames


def damaged(source: random.Random, data: bytes) -> bytes:
    """A line that flips, drops, doubles and invents bytes, about one in two hundred."""
    out = bytearray()
    for byte in data:
        fate = source.random()
        if fate < 0.002:
            out.append(byte ^ 1 << source.randrange(8))
        elif fate < 0.003:
            continue
        elif fate < 0.004:
            out += bytes([byte, byte])
        elif fate < 0.005:
            out += source.randbytes(source.randrange(1, 40))
        else:
            out.append(byte)
    return bytes(out)


@pytest.mark.parametrize("seed", range(8))
def test_a_damaged_line_gives_both_the_same_frames_and_counts(seed: int) -> None:
    source = random.Random(seed)
    sent = [random_frame(source) for _ in range(300)]
    line = damaged(source, b"".join(framing.encode_frame(frame) for frame in sent))
    host, unit = framing.FrameDecoder(), wire.FrameDecoder()

    at = 0
    heard: tuple[list[bytes], list[bytes]] = ([], [])
    while at < len(line):
        step = source.choice([1, 2, 64, 3000])
        heard[0].extend(host.feed(line[at : at + step]))
        heard[1].extend(unit.feed(line[at : at + step]))
        at += step

    assert heard[0] == heard[1]
    assert host.stats == unit.stats
    assert host.stats.crc_errors > 0
    assert set(heard[0]) <= set(sent)


@settings(max_examples=400, deadline=None)
@given(st.binary(max_size=80))
def test_any_bytes_in_a_frame_get_the_same_verdict(frame: bytes) -> None:
    plausible = bytes([frame[0] & 0x1B | 0x20]) + frame[1:] if frame else frame
    for candidate in (frame, plausible):
        host = codec.decode(candidate)
        unit, header = wire.check_frame(candidate)

        assert unit == (host.reason.value if isinstance(host, codec.Malformed) else 0)
        if isinstance(host, codec.Response):
            assert (header.tag, header.word) == (host.tid, host.message_id)


@settings(max_examples=200, deadline=None)
@given(st.binary(min_size=registry.IMAGE_LENGTH, max_size=registry.IMAGE_LENGTH))
def test_any_image_passes_through_the_units_struct_unchanged(image: bytes) -> None:
    assert wire.copy_image(image) == image


def test_both_sides_leave_the_factory_with_the_same_configuration() -> None:
    assert parameters.pack_image(parameters.default_config()) == wire.default_image()


numbers = st.floats(width=32) | st.floats(min_value=-1, max_value=60, width=32)


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_the_hosts_check_and_the_units_check_name_the_same_violations(data: st.DataObject) -> None:
    row = data.draw(st.sampled_from(registry.PARAMETERS))
    image = bytearray(wire.default_image())
    raw = data.draw(st.binary(min_size=row.size, max_size=row.size))
    if row.type == "f32":
        values = data.draw(st.lists(numbers, min_size=row.count, max_size=row.count))
        raw = parameters.pack_parameter(row, values if row.shape else values[0])
    if row.type == "text":
        text = data.draw(st.text(max_size=row.length // 4)).encode()
        raw = text.ljust(row.size, b"\0")
    image[row.image_offset : row.image_offset + row.size] = raw

    host = parameters.violations(parameters.unpack_image(bytes(image)))
    unit = wire.image_violations(bytes(image))

    names = {i.id: i.name for i in registry.PARAMETERS}
    assert [(v.field, v.index, v.code) for v in host] == [
        (names[i], at, registry.Violation(code).name) for i, at, code in unit
    ]


@pytest.mark.parametrize(
    ("scale", "value", "counts"),
    [
        (0.01, 25.0, 2500),
        (0.01, 0.004, 0),
        (0.01, 0.006, 1),
        (0.01, -0.006, -1),
        (0.0001, 2.0, 20000),
        (0.01, 1e9, 32767),
        (0.01, -1e9, -32767),
        (0.01, math.nan, -32768),
        (0.01, math.inf, -32768),
        (0.01, -math.inf, -32768),
    ],
)
def test_a_value_becomes_the_nearest_count_and_what_is_not_a_number_goes_missing(
    scale: float, value: float, counts: int
) -> None:
    assert wire.channel_counts(scale, value) == counts
