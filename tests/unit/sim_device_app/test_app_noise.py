"""Goal: nothing that comes down the line can stop the unit. Method: seeded noise of four kinds,
thousands of rounds, on the real firmware; afterwards it must still answer and still be itself.

Kinds: bytes at random; good frames with random contents; real requests with bits flipped behind
a good check value; real requests harmed on the line.
"""

import random
import struct

import pytest

from firmware_protocol import codec, framing, parameters
from firmware_protocol._generated import PARAMETERS, REQUEST_BY_ID, PingRequest, Status
from tests.fakes.bench_unit import BenchUnit

ROUNDS = 4000
HEALTH_CHECK_ROUNDS = 100


def random_bytes(noise: random.Random) -> bytes:
    return noise.randbytes(noise.choice([1, 3, 17, 120, 700]))


def random_frame(noise: random.Random) -> bytes:
    return framing.encode_frame(noise.randbytes(noise.randrange(4, 540)))


def likely_payload(noise: random.Random, message_id: int) -> bytes:
    """What a request of this kind could carry: small numbers, real ids, some of it too long."""
    length = REQUEST_BY_ID[message_id].LENGTH
    fields = bytes(noise.choice([0, 1, 2, 5, 255, noise.randrange(256)]) for _ in range(length))
    parameter = noise.choice(PARAMETERS)
    items = struct.pack("<HBB", parameter.id, noise.randrange(3), noise.randrange(1, 4))
    return fields + noise.choice([b"", b"\x01\x02\x03", items + noise.randbytes(64)])


def likely_request(noise: random.Random) -> bytes:
    message_id = noise.choice(list(REQUEST_BY_ID))
    header = bytes([0x20 | noise.choice([0, 0, 0, 1, 2]), noise.randrange(1, 256)])
    return header + message_id.to_bytes(2, "little") + likely_payload(noise, message_id)


def request_as_sent(noise: random.Random) -> bytes:
    return framing.encode_frame(likely_request(noise))


def request_harmed_on_the_line(noise: random.Random) -> bytes:
    wire = bytearray(request_as_sent(noise))
    for _ in range(noise.randrange(1, 4)):
        at = noise.randrange(len(wire))
        if noise.random() < 0.5:
            wire[at] ^= 1 << noise.randrange(8)
        else:
            del wire[at:][:1]
            wire.insert(at, noise.randrange(256))
    return bytes(wire)


def assert_alive_and_sane(unit: BenchUnit) -> None:
    unit.say(b"\x00\x00")
    unit.hear()
    assert unit.ask(PingRequest()).status == Status.OK


@pytest.mark.parametrize(
    "kind", [random_bytes, random_frame, request_as_sent, request_harmed_on_the_line]
)
@pytest.mark.slow
def test_whatever_comes_down_the_line_the_unit_still_answers(unit: BenchUnit, kind: object) -> None:
    assert callable(kind)
    noise = random.Random(f"{kind.__name__} 1")

    for round_number in range(ROUNDS):
        unit.say(kind(noise))
        if noise.random() < 0.2:
            unit.advance(noise.choice([0.01, 0.1, 1.5]))
        if round_number % HEALTH_CHECK_ROUNDS == 0:
            assert_alive_and_sane(unit)

    unit.hello(nonce=b"are you ")
    assert_alive_and_sane(unit)
    assert parameters.violations(unit.config()) == []


@pytest.mark.board_long
def test_every_good_request_among_noise_gets_exactly_one_answer(unit: BenchUnit) -> None:
    noise = random.Random(2)

    for tid in range(1, 256):
        unit.hear()
        unit.say(random_bytes(noise))
        unit.hear()

        unit.say(framing.encode_frame(codec.encode(codec.Request(tid, PingRequest()))))

        assert [response.tid for response in unit.hear()] == [tid]


def test_a_host_that_floods_without_listening_costs_answers_and_nothing_else(
    unit: BenchUnit,
) -> None:
    noise = random.Random(3)
    unit.line_room(0)

    for _ in range(500):
        unit.say(request_as_sent(noise))
        unit.advance_unread(0.01)

    unit.line_room(65536)
    unit.advance(0.1)
    unit.hello(nonce=b"are you ")
    assert_alive_and_sane(unit)
