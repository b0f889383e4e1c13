"""Goal: the unit's own record of a ride is whole, honest about what it lost, and never in the way.

Method: the real firmware on the bench board; what it wrote is fetched over the wire and read by the
host's reader of such logs. Figures: a row a 0.1 s, 11 rows of 21 channels in a block, 20 s of
standstill, from SPEC chapter 2.5 and 11.
"""

import itertools
import zlib

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from backend.formats.blocks import CONFIG, CONFIG_REST, DATA, END, EVENT, SCHEMA, scan
from backend.formats.ride_logs import read_blocks
from firmware_protocol._generated import (
    CHANNELS,
    Event,
    LogAckRequest,
    LogCloseRequest,
    LogConfirmRequest,
    LogCrcRequest,
    LogCrcResponse,
    LogEvent,
    LogFlags,
    LogOpenRequest,
    Status,
    TimSetRequest,
)
from firmware_protocol.parameters import default_config, pack_image
from tests.fakes.bench_logs import (
    BLOCK_BYTES,
    SESSION,
    acknowledge,
    begin,
    confirm,
    directory,
    fetch,
    late_answer,
    logs,
    ride,
    unit_with_log,
    unit_with_room,
)

ROWS_PER_BLOCK = 472 // (2 * len(CHANNELS))
"""SPEC 11: a block has 472 bytes for rows of one i16 a channel."""


def test_a_bike_that_stands_makes_no_log() -> None:
    unit = unit_with_room()

    unit.advance(60.0)

    assert logs(unit) == []


@pytest.mark.parametrize(("cadence_rpm", "kept"), [(5.0, 0), (5.1, 1)])
def test_cranks_that_turn_faster_than_5_rpm_make_a_ride(cadence_rpm: float, kept: int) -> None:
    """SPEC 2.5: at exactly the bound the bike stands."""
    unit = unit_with_room()

    unit.inputs(cadence_rpm=cadence_rpm)
    unit.advance(3.0)

    assert len(logs(unit)) == kept


def test_a_ride_becomes_one_closed_log_with_a_row_every_tenth_of_a_second() -> None:
    unit = unit_with_room()

    ride(unit, 15.0, speed_kmh=18.0)

    (log,) = logs(unit)
    assert log.flags == LogFlags.ENDED
    assert unit.event_codes().count(Event.LOG_CLOSED) == 1
    outcome = read_blocks(fetch(unit, log))
    assert (outcome.state, outcome.completeness) == ("complete", 1.0)
    (found,) = outcome.rides
    assert len(found.rows.times_us) == 350
    assert found.period_us == 100_000
    speed_kmh = found.rows.counts["speed_kmh"] * 0.01
    assert speed_kmh[:150] == pytest.approx(18.0)
    assert (speed_kmh[151:] == 0).all()


def test_the_log_says_what_its_numbers_mean_and_what_the_bike_was_set_to() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)

    (found,) = read_blocks(fetch(unit, logs(unit)[0])).rides

    assert [spec.name for spec in found.rows.channels] == [row.name for row in CHANNELS]
    assert [spec.scale for spec in found.rows.channels] == [row.scale for row in CHANNELS]
    image = pack_image(default_config())
    assert found.context.config_crc32 == zlib.crc32(image)
    assert found.context.device_serial == b"bench-unit-1".hex()
    assert found.context.gear_ratio == pytest.approx(40.34)
    assert found.context.boot_id == directory(unit).boot_id


def test_description_and_configuration_come_again_every_minute() -> None:
    unit = unit_with_log(4096, 1 << 20)
    ride(unit, 150.0)

    blocks = scan(fetch(unit, logs(unit)[0])).blocks

    assert [block.type for block in blocks[:3]] == [CONFIG, CONFIG_REST, SCHEMA]
    assert blocks[-1].type == END
    starts = [block.t0_us / 1e6 for block in blocks if block.type == SCHEMA]
    assert len(starts) == 3
    assert np.diff(starts) == pytest.approx(60.0, abs=1.0)


def test_faults_are_in_the_log_with_their_time() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0)
    unit.advance(3.0)
    unit.inputs(battery_voltage_v=29.5)
    unit.advance(2.0)
    unit.inputs(battery_voltage_v=36.0)

    ride(unit, 4.0)

    blocks = scan(fetch(unit, logs(unit)[0])).blocks
    told = [block.payload for block in blocks if block.type == EVENT]
    assert [int(payload[8]) for payload in told] == [Event.FAULT_SET, Event.FAULT_CLEARED]
    assert int.from_bytes(told[0][:8], "little") / 1e6 == pytest.approx(3.5, abs=0.05)


def test_the_mode_the_rider_chose_is_in_the_log_with_its_time() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0, mode_selected=2)
    unit.advance(3.0)
    unit.inputs(mode_selected=4)

    ride(unit, 4.0)

    blocks = scan(fetch(unit, logs(unit)[0])).blocks
    (found,) = read_blocks(fetch(unit, logs(unit)[0])).rides
    told = [block.payload for block in blocks if block.type == EVENT]
    assert [payload[8] for payload in told] == [LogEvent.ASSIST_MODE]
    assert [(event.kind, event.value) for event in found.events] == [("assist_mode", 4)]
    assert int.from_bytes(told[0][9:11], "little") == 4
    assert int.from_bytes(told[0][:8], "little") / 1e6 == pytest.approx(3.01, abs=0.05)


def test_events_that_come_too_fast_are_counted_and_the_log_says_so() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0, mode_selected=0)
    unit.advance(3.0)

    # A loose switch: another mode in each of 100 steps of a second, of which 16 are kept.
    for step in range(100):
        unit.inputs(mode_selected=step % 2 + 1)
        unit.advance(0.01)
    ride(unit, 4.0)

    (found,) = read_blocks(fetch(unit, logs(unit)[0])).rides
    kept = len(found.events)
    assert 16 <= kept < 100
    assert f"{100 - kept} events came too fast to be kept" in " ".join(found.notes)


@pytest.mark.parametrize("told_after_s", [0.0, 4.0], ids=["before", "meanwhile"])
def test_a_unit_that_was_told_the_time_writes_it_into_its_log(told_after_s: float) -> None:
    unit = unit_with_room()
    unix_us = 1_780_000_000_000_000
    unit.inputs(speed_kmh=18.0 if told_after_s else 0.0)
    unit.advance(told_after_s or 3.0)
    assert unit.ask(TimSetRequest(unix_us, 0, 1000)).status == Status.OK
    told_us = unit.hello().uptime_us

    ride(unit, 5.0)

    (found,) = read_blocks(fetch(unit, logs(unit)[0])).rides
    assert found.start_known
    assert found.context.unit_t0_us is not None
    assert found.started_us == pytest.approx(unix_us + found.context.unit_t0_us - told_us, abs=2000)


def test_power_lost_in_the_middle_leaves_a_log_that_says_it_was_not_ended() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0)
    unit.advance(10.0)

    unit.boot()
    unit.hello()

    (log,) = logs(unit)
    assert log.flags == LogFlags(0)
    outcome = read_blocks(fetch(unit, log))
    assert (outcome.state, outcome.code) == ("partial", "truncated")
    # At most a block that was filling, and the one that waited for its turn.
    assert 100 - 2 * 11 <= len(outcome.rides[0].rows.times_us) <= 100


def test_the_same_log_reads_the_same_after_a_restart() -> None:
    unit = unit_with_room()
    ride(unit, 12.0)
    ride(unit, 3.0)
    before = [(log.log_id, log.generation, fetch(unit, log)) for log in logs(unit)]

    unit.boot()
    unit.hello()

    after = [(log.log_id, log.generation, fetch(unit, log)) for log in logs(unit)]
    assert after == before
    assert [log.flags for log in logs(unit)] == [LogFlags.ENDED] * 2


def test_a_confirmed_log_stays_confirmed_and_reads_the_same() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    log = logs(unit)[0]
    data = fetch(unit, log)

    assert confirm(unit, log, data[:-1] + b"x") == Status.CRC_MISMATCH
    assert confirm(unit, log, data) == Status.OK
    assert confirm(unit, log, data) == Status.OK
    unit.boot()
    unit.hello()

    assert logs(unit)[0].flags == LogFlags.ENDED | LogFlags.CONFIRMED
    assert fetch(unit, log) == data


def test_a_full_flash_gives_up_confirmed_logs_first_and_says_when_it_must_take_another() -> None:
    unit = unit_with_log(BLOCK_BYTES, 32 * BLOCK_BYTES)
    for _ in range(3):
        ride(unit, 3.0)
    first, second, third = logs(unit)
    confirm(unit, second, fetch(unit, second))

    ride(unit, 3.0)
    while second in logs(unit):
        ride(unit, 3.0)
    assert Event.LOG_OVERWRITTEN not in unit.event_codes()
    assert directory(unit).overwritten == 0
    assert first in logs(unit)
    while Event.LOG_OVERWRITTEN not in unit.event_codes():
        ride(unit, 3.0)

    assert first not in logs(unit)
    assert third in logs(unit)
    assert directory(unit).overwritten == 1
    told = next(event for event in unit.events if event.code == Event.LOG_OVERWRITTEN)
    assert told.fields["log_id"] == first.log_id
    request = LogOpenRequest(first.log_id, first.generation, 0, 32, 1)
    assert unit.ask(request).status == Status.NOT_FOUND


@pytest.mark.board_long
@pytest.mark.slow
def test_every_log_in_a_ring_that_went_round_many_times_is_whole() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    for number in range(40):
        ride(unit, 1.0 + number % 5, speed_kmh=10.0 + number)
        if number % 7 == 3:
            unit.boot()
            unit.hello()
        kept = logs(unit)
        assert kept
        for log in kept:
            outcome = read_blocks(fetch(unit, log))
            assert (outcome.state, outcome.completeness) == ("complete", 1.0)
    speeds = [read_blocks(fetch(unit, log)).rides[0].rows.counts["speed_kmh"].max() for log in kept]
    assert speeds == sorted(speeds)
    assert speeds[-1] == pytest.approx(4900)


def test_a_long_ride_is_cut_into_logs_of_half_the_flash_and_no_row_is_between_them() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    unit.inputs(speed_kmh=18.0)

    unit.advance(60.0)

    closed = [log for log in logs(unit) if not log.flags & LogFlags.RECORDING]
    assert closed
    assert all(log.length <= 8 * BLOCK_BYTES for log in closed)
    spans = [(log.t0_us, log.t1_us) for log in closed]
    for (_, ended_us), (began_us, _) in itertools.pairwise(spans):
        assert abs(began_us - ended_us) <= 150_000


def test_another_log_under_the_same_number_is_not_found() -> None:
    unit = unit_with_room()
    ride(unit, 2.0)
    log = logs(unit)[0]

    other = log.generation ^ 1

    assert unit.ask(LogOpenRequest(log.log_id, other, 0, 32, 1)).status == Status.NOT_FOUND
    assert unit.ask(LogCrcRequest(log.log_id, other, 0, 0)).status == Status.NOT_FOUND
    assert unit.ask(LogConfirmRequest(99, 0, 0, 0)).status == Status.NOT_FOUND


def test_a_log_that_is_still_being_written_is_listed_and_not_given_out() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0)
    unit.advance(5.0)

    (log,) = logs(unit)

    assert log.flags == LogFlags.RECORDING
    request = LogOpenRequest(log.log_id, log.generation, 0, 32, 1)
    assert unit.ask(request).status == Status.STATE


def test_the_unit_checks_any_part_of_a_log_and_one_check_at_a_time() -> None:
    unit = unit_with_room()
    ride(unit, 10.0)
    log = logs(unit)[0]
    data = fetch(unit, log)

    for start, length in ((0, len(data)), (0, 0), (512, 1024), (700, 33), (len(data) - 1, 1)):
        answer = late_answer(unit, LogCrcRequest(log.log_id, log.generation, start, length))
        assert answer.message == LogCrcResponse(zlib.crc32(data[start : start + length]))
    too_far = LogCrcRequest(log.log_id, log.generation, 1, len(data))
    assert unit.ask(too_far).status == Status.RANGE
    whole = LogCrcRequest(log.log_id, log.generation, 0, len(data))
    assert unit.ask(whole).status == Status.PENDING
    assert unit.ask(whole).status == Status.BUSY


@pytest.mark.parametrize(
    ("offset", "window", "session"),
    [(0, 0, 1), (0, 8, 0), (0, 8, 16), (1, 8, 1), (1 << 30, 8, 1)],
    ids=["no window", "session 0", "session 16", "odd offset", "behind the end"],
)
def test_an_opening_that_makes_no_sense_is_refused(offset: int, window: int, session: int) -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    log = logs(unit)[0]

    request = LogOpenRequest(log.log_id, log.generation, offset, window, session)

    assert unit.ask(request).status == Status.RANGE
    assert unit.bulks == []


def test_no_more_than_a_window_is_under_way_and_an_acknowledgement_makes_room() -> None:
    unit = unit_with_room()
    ride(unit, 30.0)
    begin(unit, logs(unit)[0], window=4)

    def pieces() -> list[int]:
        unit.hear()
        offsets = [piece.offset // 512 for piece in unit.bulks]
        unit.bulks.clear()
        return offsets

    assert pieces() == [0, 1, 2, 3]
    acknowledge(unit, 2 * 512)
    assert pieces() == [4, 5]
    acknowledge(unit, 2 * 512)
    acknowledge(unit, 512)
    assert pieces() == []
    acknowledge(unit, 1 << 20)
    acknowledge(unit, 3 * 512 + 1)
    acknowledge(unit, 5 * 512, session=9)
    assert pieces() == []


def test_an_acknowledgement_is_answered_only_when_it_asks_for_it() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    begin(unit, logs(unit)[0], window=1)

    acknowledge(unit, 512)

    assert unit.hear() == []
    assert [piece.offset for piece in unit.bulks] == [0, 512]
    assert unit.ask(LogAckRequest(SESSION, 1024, 0)).status == Status.OK
    assert unit.ask(LogAckRequest(SESSION, 1 << 30, 0)).status == Status.RANGE
    assert unit.ask(LogAckRequest(SESSION + 1, 1024, 0)).status == Status.NOT_FOUND


def test_a_closed_session_is_over() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    begin(unit, logs(unit)[0], window=1)

    assert unit.ask(LogCloseRequest(SESSION)).status == Status.OK
    unit.bulks.clear()
    unit.advance(5.0)

    assert unit.bulks == []


def test_a_session_nobody_listens_to_repeats_its_oldest_piece_and_ends_after_ten_seconds() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    begin(unit, logs(unit)[0], window=2)
    unit.advance(9.0)
    assert [piece.offset for piece in unit.bulks[:2]] == [0, 512]
    assert {piece.offset for piece in unit.bulks[2:]} == {0}
    assert len(unit.bulks) > 10

    unit.advance(2.0)
    unit.bulks.clear()
    unit.advance(20.0)

    assert unit.bulks == []


def test_a_flash_that_never_answers_costs_rows_and_nothing_else() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0)
    unit.advance(5.0)
    lib.bench_log_stuck(unit.board, 1)
    steps_before = lib.bench_log_steps(unit.board)

    unit.advance(120.0)

    assert lib.bench_log_steps(unit.board) == steps_before
    assert unit.hello().uptime_us == pytest.approx(125e6, abs=1e4)
    lib.bench_log_stuck(unit.board, 0)
    ride(unit, 5.0)
    outcome = read_blocks(fetch(unit, logs(unit)[0]))
    (found,) = outcome.rides
    assert (outcome.state, outcome.completeness) == ("complete", 1.0)
    missing = (found.rows.counts["speed_kmh"] == -32768).sum()
    assert 1150 <= missing <= 1200
    assert any("too slow" in note for note in found.notes)


def test_a_log_without_a_whole_first_block_is_no_log() -> None:
    unit = unit_with_room()
    ride(unit, 5.0)
    flash = lib.bench_log(unit.board)
    flash[40] ^= 1

    unit.boot()
    unit.hello()

    assert logs(unit) == []
    ride(unit, 2.0)
    assert [log.log_id for log in logs(unit)] == [2]


def test_damage_in_the_middle_costs_what_it_hit() -> None:
    unit = unit_with_room()
    ride(unit, 30.0)
    flash = lib.bench_log(unit.board)
    whole = read_blocks(fetch(unit, logs(unit)[0])).rides[0]
    # The header of an erase block, so that the unit cannot tell whose it is, and a page elsewhere.
    flash[2 * BLOCK_BYTES] ^= 0xFF
    flash[4 * BLOCK_BYTES + 512 + 100] ^= 0xFF

    unit.boot()
    unit.hello()
    outcome = read_blocks(fetch(unit, logs(unit)[0]))

    assert outcome.code == "damaged"
    counts = outcome.rides[0].rows.counts["speed_kmh"]
    assert len(counts) == len(whole.rows.times_us)
    lost = counts == -32768
    assert lost.sum() == 5 * ROWS_PER_BLOCK
    assert (counts[~lost] == whole.rows.counts["speed_kmh"][~lost]).all()


def test_a_unit_without_flash_for_logs_says_so() -> None:
    unit = unit_with_log(2048, 0)
    unit.inputs(speed_kmh=18.0)
    unit.advance(5.0)

    assert unit.ask(LogOpenRequest(1, 1, 0, 1, 1)).status == Status.UNSUPPORTED


def test_blocks_of_rows_are_full() -> None:
    unit = unit_with_room()
    ride(unit, 20.0)

    blocks = scan(fetch(unit, logs(unit)[0])).blocks

    rows = [block.n for block in blocks if block.type == DATA]
    assert set(rows[:-1]) == {ROWS_PER_BLOCK}
