"""Goal: power lost anywhere in the log writer costs at most the block it was writing.

Method: every operation on the flash in one whole ride is noted, from the first block erased to the
END. Then the flash is laid out as it is after every single byte of every one of them, and the unit
starts on it: the older log is untouched, the cut one holds every row of every block that was
finished. That is quick, because nobody rides again for it. With the firmware still running into a
dead flash, which costs a ride each time, the same at every 61st byte. Of all these places
`make test` tries every eleventh.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest
from sim_device.firmware.python._native import ffi, lib

from backend.formats.blocks import DATA, scan
from backend.formats.ride_logs import read_blocks
from firmware_protocol._generated import LogFlags
from tests import counts
from tests.fakes.bench_logs import Entry, fetch, logs, ride, unit_with_log
from tests.fakes.bench_unit import BenchUnit

BLOCK_BYTES = 1024
LOG_BYTES = 64 * BLOCK_BYTES
STRIDE = 61
"""Not a divisor of a page, so that every place in a block is met in one page or another."""
POLL_US = 1000
SPEEDS_KMH = (10.0, 11.0, 12.0, 13.0)
STANDSTILL_S = 21

pytestmark = [
    pytest.mark.slow,
    pytest.mark.board_long,
]


@dataclass(frozen=True)
class FlashOperation:
    """What one operation of the recorder makes of the flash, byte by byte from `address` on."""

    address: int
    after: np.ndarray


def short_ride(unit: BenchUnit, poll_us: int = 1_000_000) -> Iterator[None]:
    """Under five seconds with their own speeds, until the log is closed; stops at every poll."""
    for speed_kmh in SPEEDS_KMH:
        unit.inputs(speed_kmh=speed_kmh)
        yield from advance(unit, 1_000_000, poll_us)
    unit.inputs(speed_kmh=0.0)
    yield from advance(unit, STANDSTILL_S * 1_000_000, poll_us)
    unit.take_wire()


def advance(unit: BenchUnit, duration_us: int, poll_us: int) -> Iterator[None]:
    for _ in range(duration_us // poll_us):
        lib.bench_advance_us(unit.board, poll_us)
        yield


def do_short_ride(unit: BenchUnit) -> None:
    for _ in short_ride(unit):
        pass


def noted_ride(unit: BenchUnit) -> list[FlashOperation]:
    """A short ride, looked at in every poll: there is at most one operation in each."""
    flash = flash_of(unit)
    noted = []
    before, steps_before = flash.copy(), 0
    for _ in short_ride(unit, POLL_US):
        steps = lib.bench_log_steps(unit.board)
        if steps == steps_before:
            continue
        size, steps_before = steps - steps_before, steps
        changed = np.flatnonzero(flash != before)
        # A block that was erased already is erased again: nothing to see.
        if len(changed) > 0:
            address = int(changed[0]) // size * size
            assert changed[-1] < address + size
            noted.append(FlashOperation(address, flash[address : address + size].copy()))
        before = flash.copy()
    return noted


def flash_of(unit: BenchUnit) -> np.ndarray:
    size = lib.bench_log_size(unit.board)
    return np.frombuffer(ffi.buffer(lib.bench_log(unit.board), size), dtype=np.uint8)


def rows_in(data: bytes) -> int:
    return sum(block.n for block in scan(data).blocks if block.type == DATA)


class Cut:
    """A unit with one older log, and what a whole ride adds to it."""

    def __init__(self) -> None:
        self.unit = unit_with_log(BLOCK_BYTES, LOG_BYTES)
        do_short_ride(self.unit)
        self.older = logs(self.unit)[0]
        self.older_bytes = fetch(self.unit, self.older)
        self.flash = flash_of(self.unit)
        self.before = self.flash.copy()
        self.unit.boot()
        self.operations = noted_ride(self.unit)
        self.steps_total = lib.bench_log_steps(self.unit.board)
        self.unit.hello()
        self.whole = fetch(self.unit, logs(self.unit)[1])
        pages = range(0, len(self.whole) + 1, 512)
        self.rows_after_page = [rows_in(self.whole[:at]) for at in pages]

    def boot(self) -> list[Entry]:
        """Power on with the flash as it is."""
        self.unit.boot()
        self.unit.hello()
        return logs(self.unit)

    def check(self, found: list[Entry]) -> int:
        """The older log byte for byte, the cut one row for row; pages of the cut one."""
        assert fetch(self.unit, self.older) == self.older_bytes
        if len(found) == 1:
            return 0
        data = fetch(self.unit, found[1])
        pages = len(data) // 512
        outcome = read_blocks(data)
        assert rows_in(data) == self.rows_after_page[pages]
        assert (found[1].flags == LogFlags.ENDED) == (len(data) == len(self.whole))
        if outcome.rides:
            assert outcome.completeness == 1.0
        return pages


@pytest.fixture(scope="module")
def cut() -> Cut:
    return Cut()


@pytest.mark.large_count
def test_power_lost_after_any_byte_costs_at_most_the_block_being_written(cut: Cut) -> None:
    cut.flash[:] = cut.before
    bytes_cut = pages_finished = 0
    last: list[Entry] = []

    for operation in cut.operations:
        is_page = len(operation.after) == 512
        for done, byte in enumerate(operation.after):
            at = operation.address + done
            if cut.flash[at] == byte:
                continue
            cut.flash[at] = byte
            bytes_cut += 1
            if bytes_cut % counts.stride():
                continue
            found = cut.boot()
            assert found[0] == cut.older
            if found != last:
                # The directory tells another log: now its bytes are looked at as well.
                pages = cut.check(found)
                assert pages in (pages_finished, pages_finished + is_page)
                last = found
        pages_finished = cut.check(cut.boot())

    assert pages_finished * 512 == len(cut.whole)
    assert bytes_cut > len(cut.whole) // 2


@pytest.mark.large_count
def test_a_unit_that_runs_on_into_a_dead_flash_leaves_it_as_it_was_cut(cut: Cut) -> None:
    last_pages = 0
    for steps in [*range(0, cut.steps_total, STRIDE * counts.stride()), cut.steps_total]:
        cut.flash[:] = cut.before
        cut.unit.boot()
        lib.bench_log_cut_after(cut.unit.board, steps)
        do_short_ride(cut.unit)
        written = lib.bench_log_steps(cut.unit.board)

        found = cut.boot()

        assert found[0] == cut.older
        pages = cut.check(found)
        assert pages >= last_pages
        last_pages = pages
        # Every erase so far, and every page but the one under way.
        erases = -(-pages * 512 // BLOCK_BYTES) + 1
        assert written <= erases * BLOCK_BYTES + (pages + 1) * 512
    assert last_pages * 512 == len(cut.whole)


@pytest.mark.large_count
def test_after_a_cut_the_next_ride_makes_a_whole_log() -> None:
    unit = unit_with_log(BLOCK_BYTES, LOG_BYTES)
    for steps in range(1, 9000, 331 * counts.stride()):
        lib.bench_log_cut_after(unit.board, steps)
        do_short_ride(unit)
        unit.boot()
        ride(unit, 2.0, speed_kmh=25.0)
        unit.hello()

        newest = logs(unit)[-1]

        outcome = read_blocks(fetch(unit, newest))
        assert (outcome.state, outcome.completeness) == ("complete", 1.0)
        assert outcome.rides[0].rows.counts["speed_kmh"].max() == 2500
        unit.boot()


@pytest.mark.large_count
def test_a_block_that_was_erased_halfway_and_a_log_given_up_halfway_leave_nothing_behind() -> None:
    unit = unit_with_log(BLOCK_BYTES, 16 * BLOCK_BYTES)
    for _ in range(3):
        do_short_ride(unit)
    unit.hello()
    kept = {log.log_id: fetch(unit, log) for log in logs(unit)}
    victim = min(kept)

    for steps in range(0, 5000, 57 * counts.stride()):
        unit.boot()
        lib.bench_log_cut_after(unit.board, steps)
        do_short_ride(unit)
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
