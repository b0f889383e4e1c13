"""Goal: a host that has a ride safe may give the unit its room back, and nobody can by mistake.

Method: the real firmware on the bench board; what counts is what a restart finds in the flash.
"""

from backend.ingest.ride_logs import read_blocks
from firmware_protocol import codec
from firmware_protocol._generated import Event, LogEraseRequest, LogEraseResponse, Status
from tests.fakes.bench_logs import Entry, confirm, fetch, late_answer, logs, ride, unit_with_log
from tests.fakes.bench_unit import BenchUnit

BLOCK_BYTES = 2048
LOG_BYTES = 32 * BLOCK_BYTES


def unit_with_room() -> BenchUnit:
    return unit_with_log(BLOCK_BYTES, LOG_BYTES)


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
