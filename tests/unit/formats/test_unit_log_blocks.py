"""Goal: of a unit's log everything that is proven whole is read, and nothing else.

Method: logs are written here block by block from the layout in SPEC chapter 11, then cut, torn,
doubled, shuffled and forged. Expected rows follow from which blocks were hit.
"""

from __future__ import annotations

import random
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.core.ride_events import CLOCK_SET, SETTINGS, RideEvent
from backend.formats.answer import decode, encode
from backend.formats.blocks import HOST_SEQ, SYNC_FIELDS, find_blocks, scan, sync_block
from backend.formats.formats import read_file
from backend.formats.ride_logs import read_blocks
from firmware_protocol._generated import SCHEMA_HASH
from firmware_protocol.parameters import default_config, pack_image

CONFIG, SCHEMA, DATA, EVENT, SYNC, END, CONFIG_REST = range(1, 8)
# Of a unit of release 0.5: it fits one block. A longer one goes on in a CONFIG_REST.
IMAGE_BYTES_0_5 = 427
IMAGE_BYTES_OF_A_CONFIG = 444
ROWS = 10
T0_US = 5_000_000
PERIOD_US = 100_000
UID = bytes(range(12))


def block(
    kind: int,
    seq: int,
    payload: bytes = b"",
    *,
    t0_us: int = T0_US,
    n: int = 0,
    schema_id: int = 0,
    log_id: int = 3,
    boot_id: int = 9,
    version: int = 1,
    page: int = 512,
) -> bytes:
    head = struct.pack(
        "<4sBBHIIIQHH", b"EBLL", version, kind, len(payload), log_id, boot_id, seq, t0_us, n,
        schema_id,
    )  # fmt: skip
    body = head + payload + struct.pack("<I", zlib.crc32(head + payload))
    return body.ljust(page, b"\xff")


def config_block(seq: int = 0, **changes: int) -> bytes:
    image = pack_image(default_config())[:IMAGE_BYTES_0_5]
    payload = UID + SCHEMA_HASH + struct.pack("<II", 4, zlib.crc32(image)) + image
    return block(CONFIG, seq, payload, **changes)


def schema_block(seq: int = 1, channels: tuple[tuple[int, float], ...] = ((1, 0.01), (2, 0.01)),
                 period_us: int = PERIOD_US, **changes: int) -> bytes:  # fmt: skip
    rows = b"".join(struct.pack("<Bf", *row) for row in channels)
    return block(
        SCHEMA, seq, struct.pack("<IB", period_us, len(channels)) + rows,
        **{"schema_id": 1, **changes},
    )  # fmt: skip


def data_block(seq: int, number: int, **changes: int) -> bytes:
    """Ten rows: speed counts up from 100 x number, cadence stands at the number."""
    rows = np.array([(100 * number + k, number) for k in range(ROWS)], "<i2")
    t0_us = T0_US + number * ROWS * PERIOD_US
    return block(
        DATA, seq, rows.tobytes(), **{"t0_us": t0_us, "n": ROWS, "schema_id": 1, **changes}
    )


def end_block(seq: int, rows: int) -> bytes:
    return block(END, seq, struct.pack("<IIB", rows, 0, 0))


def whole_log(blocks: int = 8) -> list[bytes]:
    rows = [data_block(2 + number, number) for number in range(blocks)]
    return [config_block(), schema_block(), *rows, end_block(2 + blocks, blocks * ROWS)]


def speeds(data: bytes) -> list[int]:
    (ride,) = read_blocks(data).rides
    return [int(count) for count in ride.rows.counts["speed_kmh"]]


def expected(numbers: list[int], total: int = 8) -> list[int]:
    """Speed counts when only these blocks of rows are there, cut to the first and last of them."""
    rows = []
    for number in range(min(numbers), max(numbers) + 1):
        there = number in numbers
        rows += [100 * number + k if there else -32768 for k in range(ROWS)]
    return rows


def test_a_whole_log_is_read_whole() -> None:
    outcome = read_blocks(b"".join(whole_log()))

    assert (outcome.state, outcome.code, outcome.completeness) == ("complete", None, 1.0)
    (ride,) = outcome.rides
    assert ride.period_us == PERIOD_US
    assert ride.context.device_serial == UID.hex()
    assert ride.context.config_generation == 4
    assert ride.context.gear_ratio == pytest.approx(40.34)
    assert (ride.context.boot_id, ride.context.unit_t0_us) == (9, T0_US)
    assert [(c.name, c.unit, c.scale) for c in ride.rows.channels] == [
        ("speed_kmh", "km/h", 0.01),
        ("cadence_rpm", "rpm", 0.01),
    ]
    assert speeds(b"".join(whole_log())) == expected(list(range(8)))


def test_the_kind_of_file_is_found_by_its_blocks_or_its_name() -> None:
    data = b"".join(whole_log())

    assert read_file("anything.bin", data).state == "complete"
    assert read_file("LOG.EBLL", b"\x55" * 8192 + data).code == "damaged"
    assert read_file("ride.ebll", b"EBLL" * 9).code == "no_records"


def event_block(seq: int, *events: tuple[float, int, int], tail: bytes = b"") -> bytes:
    """Events of time since the first row in s, code and value."""
    rows = [struct.pack("<QBH", T0_US + round(t_s * 1e6), *rest) for t_s, *rest in events]
    return block(EVENT, seq, b"".join(rows) + tail, n=len(events))


def test_faults_and_modes_are_events_of_the_ride_in_order_of_time() -> None:
    log = [
        *whole_log(),
        event_block(12, (4.0, 3, 2), (6.5, 128, 4)),
        event_block(11, (3.0, 2, 2), (3.5, 77, 1), tail=b"half"[:3]),
        event_block(13, (-4.0, 2, 1), (9e9, 2, 1)),
    ]

    (ride,) = read_blocks(b"".join(log)).rides

    assert [(event.t_s, event.kind, event.value) for event in ride.events] == [
        (3.0, "fault_set", 2),
        (4.0, "fault_cleared", 2),
        (6.5, "assist_mode", 4),
    ]


def test_a_log_full_of_events_does_not_fill_the_server() -> None:
    flickering = [
        event_block(11 + number, *[(1.0, 2 + k % 2, 1) for k in range(40)]) for number in range(50)
    ]

    (ride,) = read_blocks(b"".join([*whole_log(), *flickering])).rides

    assert len(ride.events) == 200


def test_the_outcome_crosses_to_the_server_as_it_is() -> None:
    outcome = read_blocks(b"".join([*whole_log(), event_block(11, (3.0, 2, 2))]))

    copy = decode(encode(outcome))

    assert copy.rides[0].events == outcome.rides[0].events != ()

    assert (copy.state, copy.completeness) == (outcome.state, outcome.completeness)
    assert copy.rides[0].context == outcome.rides[0].context
    assert copy.rides[0].start_known is False
    assert (
        copy.rides[0].rows.counts["speed_kmh"] == outcome.rides[0].rows.counts["speed_kmh"]
    ).all()


def test_without_a_clock_the_start_is_unknown_and_a_sync_of_unit_or_host_tells_it() -> None:
    log = b"".join(whole_log())
    start_us = 1_780_000_000_000_000

    unknown = read_blocks(log).rides[0]
    from_host = read_blocks(log + sync_block(3, 9, T0_US + 7_000_000, start_us + 7_000_000))
    nonsense = read_blocks(log + sync_block(3, 9, T0_US, 17)).rides[0]

    assert not unknown.start_known
    assert any("no clock" in note for note in unknown.notes)
    assert from_host.rides[0].start_known
    assert from_host.rides[0].started_us == start_us
    assert from_host.completeness == 1.0
    assert not nonsense.start_known
    assert HOST_SEQ == 0xFFFFFFFF


def test_a_unit_that_was_told_the_time_again_dates_its_log_by_that_and_says_so() -> None:
    wrong_us, right_us = 1_577_836_830_000_000, 1_795_770_000_000_000
    # Eight blocks of ten rows, a tenth of a second each; the clock was set after the fifth.
    set_us = T0_US + 5_000_000
    syncs = [
        block(SYNC, 11, SYNC_FIELDS.pack(wrong_us, 1000)),
        block(SYNC, 12, SYNC_FIELDS.pack(right_us, 1000), t0_us=set_us),
    ]
    host = sync_block(3, 9, T0_US, right_us)

    (ride,) = read_blocks(b"".join([*whole_log(), *syncs, host])).rides
    (kept,) = read_blocks(b"".join([*whole_log(), syncs[0]])).rides

    assert ride.started_us == right_us - 5_000_000
    by_ms = (right_us - 5_000_000 - wrong_us) // 1000
    assert ride.events == (RideEvent(5.0, CLOCK_SET, by_ms),)
    assert (kept.started_us, kept.events) == (wrong_us, ())


@pytest.mark.parametrize("cut", [512 * 6, 512 * 6 + 1, 512 * 6 + 31, 512 * 6 + 75, 512 * 7 - 1])
def test_a_file_cut_anywhere_keeps_every_block_before_the_cut(cut: int) -> None:
    data = b"".join(whole_log())[:cut]

    outcome = read_blocks(data)

    # The last block's check value ends before byte 76: a cut in the filling behind costs nothing.
    whole = 4 + (cut >= 512 * 6 + 76)
    assert outcome.state == "partial"
    assert outcome.code == ("truncated" if cut in (512 * 6, 512 * 7 - 1) else "damaged")
    assert speeds(data) == expected(list(range(whole)))


def test_a_torn_last_page_and_an_erased_tail_cost_nothing_else() -> None:
    torn = data_block(5, 3)[:60].ljust(512, b"\xff")
    data = b"".join(whole_log()[:5]) + torn + b"\xff" * 4096

    outcome = read_blocks(data)

    assert (outcome.state, outcome.code) == ("partial", "damaged")
    assert speeds(data) == expected([0, 1, 2])
    assert scan(data).first_damage == 5 * 512


def test_the_check_value_decides_and_the_next_block_is_found_at_any_byte() -> None:
    blocks = whole_log()
    blocks[4] = blocks[4][:50] + b"\x00" + blocks[4][51:]
    blocks[6] = blocks[6][1:]
    data = b"rubbish" + b"".join(blocks)

    outcome = read_blocks(data)

    assert (outcome.state, outcome.code) == ("partial", "damaged")
    assert outcome.completeness == pytest.approx(9 / 11)
    assert speeds(data) == expected([0, 1, 3, 5, 6, 7])


@pytest.mark.parametrize(("rest_of", "gear_ratio"), [(0, 40.34), (1, None)])
def test_a_configuration_goes_on_in_the_next_block(rest_of: int, gear_ratio: float | None) -> None:
    image = pack_image(default_config())
    crc32 = zlib.crc32(image)
    head = UID + SCHEMA_HASH + struct.pack("<II", 4, crc32)
    config = block(CONFIG, 0, head + image[:IMAGE_BYTES_OF_A_CONFIG])
    rest = struct.pack("<I", crc32 + rest_of) + image[IMAGE_BYTES_OF_A_CONFIG:]
    data = b"".join([config, block(CONFIG_REST, 11, rest), *whole_log()[1:]])

    (ride,) = read_blocks(data).rides

    assert ride.context.config_crc32 == crc32
    assert ride.context.gear_ratio == gear_ratio


def test_settings_that_changed_on_the_way_are_events_of_the_ride() -> None:
    """A unit tells its configuration every minute and at each change; the log begins before it."""

    def config(seq: int, at_s: float, crc32: int) -> bytes:
        payload = UID + SCHEMA_HASH + struct.pack("<II", 4, crc32)
        return block(CONFIG, seq, payload, t0_us=T0_US + round(at_s * 1e6))

    told = [(-2.0, 1), (-1.0, 2), (1.0, 2), (3.5, 3), (4.0, 3), (5.0, 2), (60.0, 9)]
    configs = [config(20 + seq, at_s, crc32) for seq, (at_s, crc32) in enumerate(told)]

    (ride,) = read_blocks(b"".join([*configs, *whole_log()[1:]])).rides

    assert ride.context.config_crc32 == 1
    changes = [(event.t_s, event.value) for event in ride.events if event.kind == SETTINGS]
    assert changes == [(0.0, 2), (3.5, 3), (5.0, 2)]


def test_order_and_repetition_make_no_difference() -> None:
    blocks = whole_log()
    shuffled = blocks * 2
    random.Random(3).shuffle(shuffled)

    outcome = read_blocks(b"".join(shuffled))

    assert outcome.state == "complete"
    assert speeds(b"".join(shuffled)) == expected(list(range(8)))


def test_kinds_of_block_we_do_not_know_are_skipped_and_count_as_there() -> None:
    blocks = whole_log(4)
    unknown = block(77, 7, b"x" * 300)
    more = [block(78, 4), data_block(5, 2), data_block(6, 3), unknown, end_block(8, 40)]
    data = b"".join([*blocks[:4], *more])

    outcome = read_blocks(data)

    assert (outcome.state, outcome.completeness) == ("complete", 1.0)
    assert speeds(data) == expected([0, 1, 2, 3])


def test_blocks_of_a_later_version_are_left_alone() -> None:
    data = b"".join([*whole_log()[:4], data_block(4, 2, version=2)])

    assert speeds(data) == expected([0, 1])


def test_two_logs_in_one_file_are_two_rides_and_numbers_used_again_are_told_apart_by_boot() -> None:
    other = [config_block(boot_id=10), schema_block(boot_id=10), data_block(2, 0, boot_id=10)]

    outcome = read_blocks(b"".join(whole_log() + other))

    assert [len(ride.rows.times_us) for ride in outcome.rides] == [80, 10]
    assert [ride.context.boot_id for ride in outcome.rides] == [9, 10]


def test_a_lost_description_is_taken_from_its_next_repetition_and_none_is_none() -> None:
    blocks = whole_log()
    later = schema_block(seq=4)
    data = b"".join([blocks[0], blocks[2], blocks[3], later, data_block(5, 2)])
    without = b"".join([blocks[0], *blocks[2:]])

    assert speeds(data) == expected([0, 1, 2])
    assert read_blocks(without).code == "no_records"


def test_a_scale_is_the_one_the_counts_were_made_with_and_a_strange_channel_is_kept() -> None:
    data = b"".join(
        [config_block(), schema_block(channels=((1, 0.02), (222, 0.5))), data_block(2, 1)]
    )

    (ride,) = read_blocks(data).rides

    assert [(c.name, c.unit, c.scale) for c in ride.rows.channels] == [
        ("speed_kmh", "km/h", 0.02),
        ("channel_222", "", 0.5),
    ]


@pytest.mark.parametrize(
    "bad",
    [
        data_block(9, 5, n=9),
        data_block(9, 5, n=65535),
        data_block(9, 5, n=0),
        data_block(9, 5, schema_id=7),
        data_block(9, 5, t0_us=2**64 - 1),
        data_block(9, 5, t0_us=0x7FFFFFFFFFFFFFFF),
        schema_block(9, channels=()),
        schema_block(9, channels=((1, float("nan")), (2, 0.01))),
        schema_block(9, channels=((1, -1.0),)),
        schema_block(9, channels=((1, 0.01), (1, 0.01))),
        schema_block(9, period_us=0),
        schema_block(9, period_us=0xFFFFFFFF),
        block(SCHEMA, 9, b"\x01", schema_id=1),
        block(CONFIG, 9, b"short"),
        block(END, 9, b""),
        block(SYNC, 9, b"1234"),
        block(DATA, 9, b"", n=3, schema_id=1),
        block(DATA, 0xFFFFFFFE, b"", schema_id=1),
    ],
)  # fmt: skip
def test_a_proven_block_with_absurd_contents_changes_no_other_row(bad: bytes) -> None:
    blocks = [config_block(), schema_block(), *(data_block(2 + k, k) for k in range(7))]

    outcome = read_blocks(b"".join([*blocks[:5], bad, *blocks[5:]]))

    (ride,) = outcome.rides
    assert [int(c) for c in ride.rows.counts["speed_kmh"]] == expected(list(range(7)))


def test_a_believable_time_far_away_cannot_fill_the_memory() -> None:
    data = b"".join([*whole_log(3), data_block(9, 0, t0_us=T0_US + 6 * 86_400_000_000)])

    (ride,) = read_blocks(data).rides

    assert len(ride.rows.times_us) <= 2_000_000


def test_a_log_of_an_earlier_firmware_keeps_the_gear_of_its_unit() -> None:
    # The image that ended behind assist_cutoff_extra_kmh, with a radius where the wheel is now.
    image = bytearray(pack_image({**default_config(), "gear_ratio": 36.744})[:413])
    image[287:291] = struct.pack("<f", 0.33)
    payload = UID + bytes(8) + struct.pack("<II", 4, zlib.crc32(image)) + bytes(image)

    data = b"".join([block(CONFIG, 0, payload), *whole_log()[1:]])

    assert read_blocks(data).rides[0].context.gear_ratio == pytest.approx(36.744)


def test_a_configuration_that_is_not_what_its_check_value_says_is_not_believed() -> None:
    image = bytearray(pack_image(default_config()))
    payload = UID + SCHEMA_HASH + struct.pack("<II", 4, zlib.crc32(image) ^ 1) + bytes(image)

    data = b"".join([block(CONFIG, 0, payload), *whole_log()[1:]])

    assert read_blocks(data).rides[0].context.gear_ratio is None


@given(st.binary(max_size=3000))
@settings(max_examples=200, deadline=None)
def test_no_bytes_make_it_fail(noise: bytes) -> None:
    outcome = read_blocks(noise + b"EBLL" + noise)

    assert outcome.state in ("complete", "partial", "rejected")


@given(st.integers(0, 12), st.integers(0, 511), st.integers(0, 7))
@settings(max_examples=200, deadline=None)
@pytest.mark.slow
def test_no_flipped_bit_makes_a_wrong_row(page: int, at: int, bit: int) -> None:
    data = bytearray(b"".join([*whole_log(), b"\xff" * 1024]))
    data[page * 512 + at] ^= 1 << bit

    rides = read_blocks(bytes(data)).rides
    # The only description gone, nothing can be read; the first rows gone, the ride begins later.
    if not rides or page == 2:
        return
    found = [int(count) for count in rides[0].rows.counts["speed_kmh"]]
    for row, want in zip(found, expected(list(range(8))), strict=False):
        assert row in (want, -32768)


def test_blocks_are_found_back_to_back_without_pages() -> None:
    data = b"".join(part.rstrip(b"\xff") for part in whole_log())

    assert len(list(find_blocks(data))) == 11
