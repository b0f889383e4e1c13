"""Goal: power lost anywhere in the log writer costs at most the block it was writing.

Method: the flash counts every byte it erases and programs; the power is cut after every one of
them in turn, from the first block of a log to its end. After each cut the unit starts again: the
older log is untouched, the cut one holds every row of every block that was finished, and the next
ride makes a whole log.
"""

import numpy as np
import pytest
from sim_device.firmware.python._native import ffi, lib

from backend.ingest.blocks import DATA, scan
from backend.ingest.ride_logs import read_blocks
from firmware_protocol._generated import LogFlags
from tests.fakes.bench_logs import fetch, logs, ride, unit_with_log
from tests.fakes.bench_unit import BenchUnit

BLOCK_BYTES = 1024
LOG_BYTES = 64 * BLOCK_BYTES
STRIDE = 7
"""Not a divisor of a page, so that every place in a block is met in one page or another."""

pytestmark = pytest.mark.slow


def short_ride(unit: BenchUnit) -> None:
    """Under five seconds with their own speeds, cut where the log is full or the bike stands."""
    for second in range(4):
        unit.inputs(speed_kmh=10.0 + second)
        lib.bench_advance_us(unit.board, 1_000_000)
    unit.inputs(speed_kmh=0.0)
    lib.bench_advance_us(unit.board, 21_000_000)
    unit.take_wire()


def flash_of(unit: BenchUnit) -> np.ndarray:
    size = lib.bench_log_size(unit.board)
    return np.frombuffer(ffi.buffer(lib.bench_log(unit.board), size), dtype=np.uint8)


def rows_in(data: bytes) -> int:
    return sum(block.n for block in scan(data).blocks if block.type == DATA)


def test_power_lost_after_any_byte_costs_at_most_the_block_being_written() -> None:
    unit = unit_with_log(BLOCK_BYTES, LOG_BYTES)
    short_ride(unit)
    older = logs(unit)[0]
    older_bytes = fetch(unit, older)
    flash = flash_of(unit)
    before = flash.copy()
    unit.boot()
    short_ride(unit)
    steps_total = lib.bench_log_steps(unit.board)
    unit.hello()
    whole_log = logs(unit)[1]
    whole = fetch(unit, whole_log)
    rows_after_bytes = [rows_in(whole[:at]) for at in range(0, len(whole) + 1, 512)]
    assert steps_total > len(whole)
    last_pages = 0

    for steps in [*range(0, steps_total, STRIDE), steps_total]:
        flash[:] = before
        unit.boot()
        lib.bench_log_cut_after(unit.board, steps)
        short_ride(unit)
        written = lib.bench_log_steps(unit.board)
        unit.boot()
        unit.hello()

        found = logs(unit)
        assert found[0] == older
        assert fetch(unit, older) == older_bytes
        pages = 0
        if len(found) == 2:
            data = fetch(unit, found[1])
            pages = len(data) // 512
            outcome = read_blocks(data)
            assert rows_in(data) == rows_after_bytes[pages]
            assert (found[1].flags == LogFlags.ENDED) == (pages * 512 == len(whole))
            if outcome.rides:
                assert outcome.completeness == 1.0
        assert pages >= last_pages
        last_pages = pages
        # Every erase so far, and every page but the one under way.
        erases = -(-pages * 512 // BLOCK_BYTES) + 1
        assert written <= erases * BLOCK_BYTES + (pages + 1) * 512
    assert last_pages * 512 == len(whole)


def test_after_a_cut_the_next_ride_makes_a_whole_log() -> None:
    unit = unit_with_log(BLOCK_BYTES, LOG_BYTES)
    for steps in range(1, 9000, 331):
        lib.bench_log_cut_after(unit.board, steps)
        short_ride(unit)
        unit.boot()
        ride(unit, 2.0, speed_kmh=25.0)
        unit.hello()

        newest = logs(unit)[-1]

        outcome = read_blocks(fetch(unit, newest))
        assert (outcome.state, outcome.completeness) == ("complete", 1.0)
        assert outcome.rides[0].rows.counts["speed_kmh"].max() == 2500
        unit.boot()


def test_a_block_that_was_erased_halfway_and_a_log_given_up_halfway_leave_nothing_behind() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    for _ in range(3):
        short_ride(unit)
    unit.hello()
    kept = {log.log_id: fetch(unit, log) for log in logs(unit)}
    victim = min(kept)

    for steps in range(0, 5000, 57):
        unit.boot()
        lib.bench_log_cut_after(unit.board, steps)
        short_ride(unit)
        unit.boot()
        unit.hello()
        found = logs(unit)
        for log in found:
            data = fetch(unit, log)
            if log.log_id in kept and log.log_id != victim:
                assert data == kept[log.log_id]
            assert scan(data).damaged == 0
        if victim in kept and victim not in [log.log_id for log in found]:
            break
    else:
        raise AssertionError("no log was given up")
