"""Goal: a host that has a ride safe may give the unit its room back, and nobody can by mistake.

Method: the real firmware on the bench board; what counts is what a restart finds in the flash.
"""

from sim_device.firmware.python._native import lib

from backend.formats.ride_logs import read_blocks
from firmware_protocol import codec
from firmware_protocol._generated import (
    Event,
    LogCloseRequest,
    LogEraseRequest,
    LogEraseResponse,
    LogOpenRequest,
    Status,
)
from tests.fakes.bench_logs import (
    BLOCK_BYTES,
    SESSION,
    Entry,
    begin,
    confirm,
    fetch,
    late_answer,
    logs,
    ride,
    unit_with_log,
    unit_with_room,
)
from tests.fakes.bench_unit import BenchUnit


def erase(unit: BenchUnit, log: Entry) -> codec.Response:
    return late_answer(unit, LogEraseRequest(log.log_id, log.generation))


def test_only_a_log_that_a_host_has_confirmed_is_erased_on_request() -> None:
    unit = unit_with_room()
    ride(unit, 3.0)
    ride(unit, 4.0)
    kept, gone = logs(unit)
    other_data = fetch(unit, kept)
    confirm(unit, gone, fetch(unit, gone))

    unconfirmed = erase(unit, kept)
    done = erase(unit, gone)

    assert (unconfirmed.status, unconfirmed.detail) == (Status.STATE, kept.log_id)
    assert done.status == Status.OK
    assert logs(unit) == [kept]
    again = LogEraseRequest(gone.log_id, gone.generation)
    assert unit.ask(again).status == Status.NOT_FOUND
    unit.boot()
    unit.hello()
    assert logs(unit) == [kept]
    assert fetch(unit, kept) == other_data


def test_a_log_that_is_being_written_is_not_erased() -> None:
    unit = unit_with_room()
    unit.inputs(speed_kmh=18.0)
    unit.advance(5.0)
    (log,) = logs(unit)

    assert erase(unit, log).status == Status.STATE
    assert logs(unit)[0].log_id == log.log_id


def test_a_log_that_a_host_is_fetching_is_not_erased_under_it() -> None:
    unit = unit_with_room()
    ride(unit, 3.0)
    (log,) = logs(unit)
    whole = fetch(unit, log)
    confirm(unit, log, whole)
    begin(unit, log, window=1)
    unit.advance(3.0)

    refused = erase(unit, log)

    assert (refused.status, refused.detail) == (Status.BUSY, 7)
    unit.ask(LogCloseRequest(SESSION))
    assert fetch(unit, log) == whole
    assert erase(unit, log).status == Status.OK


def test_a_fetch_that_nobody_goes_on_with_stands_in_the_way_for_ten_seconds() -> None:
    unit = unit_with_room()
    ride(unit, 3.0)
    (log,) = logs(unit)
    confirm(unit, log, fetch(unit, log))
    begin(unit, log, window=1)

    unit.advance(10.0)

    assert erase(unit, log).status == Status.OK


def test_a_log_whose_erasing_waits_for_the_flash_is_not_given_out() -> None:
    unit = unit_with_room()
    ride(unit, 3.0)
    (log,) = logs(unit)
    confirm(unit, log, fetch(unit, log))
    unit.inputs(speed_kmh=18.0)
    unit.advance(3.0)
    lib.bench_log_stuck(unit.board, 1)
    unit.advance(3.0)
    assert unit.ask(LogEraseRequest(log.log_id, log.generation)).status == Status.PENDING

    opened = unit.ask(LogOpenRequest(log.log_id, log.generation, 0, 32, SESSION))

    assert (opened.status, opened.detail) == (Status.BUSY, 1)


def test_every_erase_of_a_block_is_counted_and_the_count_outlives_a_restart() -> None:
    unit = unit_with_room()
    for _ in range(2):
        ride(unit, 3.0)
    first, second = logs(unit)
    for log in (first, second):
        confirm(unit, log, fetch(unit, log))
    before = erase(unit, first).message
    assert isinstance(before, LogEraseResponse)
    # Each ride of a few blocks took the ring's blocks one erase each, and one erase freed the log.
    taken = -(-first.length // BLOCK_BYTES) + -(-second.length // BLOCK_BYTES)
    assert taken < before.erases <= taken + 3
    unit.advance(61.0)

    unit.boot()
    unit.hello()

    assert erase(unit, second).message == LogEraseResponse(before.erases + 1)


def test_rides_go_on_in_the_room_of_what_was_erased() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    for number in range(12):
        ride(unit, 2.0, speed_kmh=10.0 + number)
        (log,) = logs(unit)
        outcome = read_blocks(fetch(unit, log))
        assert (outcome.state, outcome.completeness) == ("complete", 1.0)
        confirm(unit, log, fetch(unit, log))
        assert erase(unit, log).status == Status.OK
    assert Event.LOG_OVERWRITTEN not in [event.code for event in unit.events]


def test_a_block_that_cannot_be_erased_costs_no_ride_and_no_other_log() -> None:
    """The oldest log would have to give way and begins in it: it stays, the next one goes."""
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    ride(unit, 3.0, speed_kmh=10.0)
    (oldest,) = logs(unit)
    kept = fetch(unit, oldest)
    lib.bench_log_worn(unit.board, 0)

    for number in range(1, 20):
        ride(unit, 3.0, speed_kmh=10.0 + number)
        newest = read_blocks(fetch(unit, logs(unit)[-1]))
        assert (newest.state, newest.completeness) == ("complete", 1.0)
        speeds = newest.rides[0].rows.counts["speed_kmh"]
        assert (speeds.min(), speeds.max()) == (0, 1000 + 100 * number)

    assert logs(unit)[0] == oldest
    assert fetch(unit, oldest) == kept


def test_a_free_block_that_cannot_be_erased_is_passed_over() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    lib.bench_log_worn(unit.board, 3 * BLOCK_BYTES)

    for number in range(12):
        ride(unit, 3.0, speed_kmh=10.0 + number)
        newest = read_blocks(fetch(unit, logs(unit)[-1]))
        assert (newest.state, newest.completeness) == ("complete", 1.0)
        assert newest.rides[0].rows.counts["speed_kmh"].max() == 1000 + 100 * number


def test_what_the_flash_refuses_is_neither_counted_nor_tried_in_every_poll() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    ride(unit, 3.0)
    (first,) = logs(unit)
    confirm(unit, first, fetch(unit, first))
    # No supply for the flash: nothing of it can be erased, for a minute of riding.
    lib.bench_log_cut_after(unit.board, 0)
    changes = lib.bench_log_changes(unit.board)
    unit.inputs(speed_kmh=18.0)
    unit.advance(60.0)
    assert lib.bench_log_changes(unit.board) - changes < 60.0 / 0.1 + 10

    lib.bench_log_cut_after(unit.board, 0xFFFFFFFF)
    ride(unit, 3.0)
    newest = logs(unit)[-1]
    confirm(unit, newest, fetch(unit, newest))
    erased = erase(unit, newest).message

    assert isinstance(erased, LogEraseResponse)
    assert erased.erases < 20
