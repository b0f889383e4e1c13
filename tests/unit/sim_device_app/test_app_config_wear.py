"""Goal: however often a host commits, the flash of the configuration outlives ten years.

Method: the arithmetic is done again here, from what a block stands and how long ten years are; the
unit is asked how long it wants to wait, told to commit as fast as it lets, tried, and restarted.
"""

import pytest

from firmware_protocol._generated import (
    CfgRollbackRequest,
    CfgSlotsRequest,
    CfgStatusRequest,
    CfgWearRequest,
    CfgWearResponse,
    Status,
)
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.config_flash import items_of, slot
from tests.fakes.maker import commit as commit_once
from tests.fakes.maker import staged

BLOCK_ERASES_MAX, BLOCKS = 10_000, 2
TEN_YEARS_S = 10 * 365.25 * 86_400
PACE_S = 2.1
FREE, WRITE_S = 1000, 16_800


def wear(unit: BenchUnit) -> CfgWearResponse:
    message = unit.ask(CfgWearRequest()).message
    assert isinstance(message, CfgWearResponse)
    return message


def commit(unit: BenchUnit, number: int) -> Status | int:
    """A change after the two seconds between any two; the answer to its commit."""
    unit.advance(PACE_S)
    changes = {"sensor_offset_counts": float(number % 300 + 1)}
    return commit_once(unit, *staged(unit, changes)).status


def worn(free: int) -> BenchUnit:
    """A unit that has so many writes left before it wants to wait."""
    unit = BenchUnit()
    image = unit.read_image()[1]
    laid = bytes(slot(items_of(image), 1, worn_until_s=(FREE - free) * WRITE_S))
    unit.flash()[: len(laid)] = list(laid)
    unit.boot()
    return unit


def test_the_free_writes_and_the_pace_after_them_stay_within_what_two_blocks_stand() -> None:
    assert FREE + TEN_YEARS_S / WRITE_S < BLOCKS * BLOCK_ERASES_MAX
    assert wear(BenchUnit()) == CfgWearResponse(0, FREE)


@pytest.mark.board_long
@pytest.mark.slow
def test_a_host_that_commits_as_fast_as_it_may_is_told_to_wait_in_the_end() -> None:
    unit = BenchUnit()

    done = 0
    while commit(unit, done) == Status.OK:
        done += 1

    erases = sum(unit.ask(CfgSlotsRequest()).message.erases)
    # A second of operating time comes back with every second; the factory's write is free.
    assert FREE <= done <= FREE + done * PACE_S / WRITE_S + 1
    assert erases == done + 1
    assert WRITE_S - done * PACE_S - 1 < wear(unit).wait_s <= WRITE_S


@pytest.mark.parametrize("confirm_s", [0, 30], ids=["for good", "on trial"])
def test_a_write_is_counted_and_a_restart_gives_nothing_back(confirm_s: int) -> None:
    unit = worn(free=2)
    assert wear(unit).writes_free == 2

    assert unit.write({"assist_cutoff_kmh": 20.0}, confirm_s).status == Status.OK
    if confirm_s:
        unit.ask(CfgRollbackRequest())
    unit.boot()
    assert wear(unit).writes_free == 1
    assert unit.write({"assist_cutoff_kmh": 19.0}, confirm_s).status == Status.OK
    unit.boot()

    assert wear(unit).writes_free == 0
    assert 0 < wear(unit).wait_s <= WRITE_S


def test_a_refusal_says_how_long_as_far_as_its_field_goes_and_changes_nothing() -> None:
    unit = worn(free=0)
    before = unit.read_image()
    flash = unit.flash().copy()

    response = commit_once(unit, *staged(unit, {"assist_cutoff_kmh": 18.0}))

    assert (response.status, response.detail) == (Status.RATE_LIMIT, 65_535)
    assert unit.ask(CfgStatusRequest()).message.commit_wait_ms == 65_535
    assert unit.read_image() == before
    assert (unit.flash()[:2048] == flash[:2048]).all()


def test_a_write_comes_back_after_its_time() -> None:
    unit = worn(free=0)
    wait_s = wear(unit).wait_s
    assert wait_s == WRITE_S

    unit.advance(60.0)

    assert wear(unit).wait_s == WRITE_S - 60


def test_counters_that_were_lost_cost_one_wait_and_no_more() -> None:
    """The operating time begins anew, so what was written looks like far ahead of it."""
    unit = BenchUnit()
    image = unit.read_image()[1]
    laid = bytes(slot(items_of(image), 1, worn_until_s=900_000_000))
    unit.flash()[: len(laid)] = list(laid)
    unit.boot()

    assert wear(unit) == CfgWearResponse(WRITE_S, 0)
