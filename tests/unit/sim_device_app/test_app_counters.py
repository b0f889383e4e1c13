"""Goal: what a unit has learned of itself outlives power cuts and is no part of its configuration.

Method: real firmware on the bench board. Distance is speed times time; the power is cut after every
byte of a saving, and what comes back is the count before or the count after.
"""

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import CountersRequest, CountersResponse
from tests.fakes.bench_unit import FLASH_BLOCK_BYTES, BenchUnit

RECORD_BYTES = 20
CREEPING_KMH = 0.4
"""Way is made, and the bike still counts as standing: a block may be erased."""
STANDING_SAVE_S = 600
BLOCK_ERASES_MAX = 10_000
TEN_YEARS_S = 10 * 365.25 * 86_400
COUNTERS_AT = 2 * FLASH_BLOCK_BYTES


def counters(unit: BenchUnit) -> CountersResponse:
    message = unit.ask(CountersRequest()).message
    assert isinstance(message, CountersResponse)
    return message


def test_distance_is_speed_times_time() -> None:
    unit = BenchUnit()
    unit.inputs(speed_kmh=36.0)

    unit.advance(50.0)

    assert counters(unit).distance_m == pytest.approx(500, abs=1)
    assert counters(unit).operating_s == 50


@pytest.mark.parametrize("speed_kmh", [float("nan"), 900.0])
def test_what_is_no_speed_is_no_distance(speed_kmh: float) -> None:
    unit = BenchUnit()
    unit.inputs(speed_kmh=speed_kmh)

    unit.advance(10.0)

    assert counters(unit).distance_m == 0


def test_a_restart_costs_at_most_the_last_minute() -> None:
    unit = BenchUnit()
    unit.inputs(speed_kmh=36.0)
    unit.advance(150.0)
    seen = counters(unit)

    unit.boot()

    kept = counters(unit)
    assert (kept.distance_m, kept.operating_s) == (seen.saved_distance_m, seen.saved_operating_s)
    assert kept.operating_s >= 119


def test_a_unit_that_stands_for_ten_years_does_not_wear_out_the_flash_of_its_counters() -> None:
    records_per_area = FLASH_BLOCK_BYTES // RECORD_BYTES
    assert TEN_YEARS_S / STANDING_SAVE_S / (2 * records_per_area) < BLOCK_ERASES_MAX
    unit = BenchUnit()
    saved = set()

    for _ in range(int(3.5 * STANDING_SAVE_S / 50)):
        unit.advance(50.0)
        saved.add(counters(unit).saved_operating_s)

    assert len(saved - {0}) == 3
    assert min(saved - {0}) >= STANDING_SAVE_S


def test_learning_does_not_touch_the_configuration() -> None:
    unit = BenchUnit()
    unit.inputs(speed_kmh=CREEPING_KMH)
    before = unit.read_image()
    slots = unit.flash()[:COUNTERS_AT].copy()

    unit.advance(300.0)

    assert unit.read_image() == before
    assert (unit.flash()[:COUNTERS_AT] == slots).all()


@pytest.mark.board_long
@pytest.mark.slow
def test_the_log_goes_round_and_never_forgets() -> None:
    unit = BenchUnit(flash_block_bytes=512, flash_bytes=6 * 512)
    unit.inputs(speed_kmh=CREEPING_KMH)
    minutes = 3 * 2 * (512 // RECORD_BYTES)
    seen = 0

    for minute in range(minutes):
        unit.advance(60.0)
        if minute % 7 == 0:
            saved = counters(unit).saved_operating_s
            unit.boot()
            assert counters(unit).operating_s == saved >= seen
            seen = saved

    assert seen > 0.85 * 60 * minutes


@pytest.mark.board_long
def test_an_area_is_not_erased_while_the_bike_rolls() -> None:
    unit = BenchUnit(flash_block_bytes=64, flash_bytes=64 * 32)
    unit.inputs(speed_kmh=20.0)
    unit.advance(60.0 * 20)
    rolling = counters(unit)
    unit.inputs(speed_kmh=0.0)
    unit.advance(61.0)

    assert rolling.saved_operating_s <= 60 * 9
    assert counters(unit).saved_operating_s > 60 * 20


@pytest.mark.slow
@pytest.mark.board_long
def test_power_lost_in_any_byte_of_a_saving_leaves_the_count_before_or_after() -> None:
    unit = BenchUnit(flash_block_bytes=512, flash_bytes=6 * 512)
    unit.inputs(speed_kmh=CREEPING_KMH)
    unit.advance(61.0)
    flash_before = unit.flash().copy()
    found = []

    for steps in range(RECORD_BYTES + 1):
        unit.flash()[:] = flash_before
        unit.boot()
        before = counters(unit).operating_s
        lib.bench_flash_cut_after(unit.board, steps)
        unit.advance(61.0)
        unit.boot()
        found.append(counters(unit).operating_s - before)
        unit.advance(61.0)
        assert counters(unit).saved_operating_s > before

    assert set(found[:-1]) == {0}
    assert found[-1] in (59, 60)


def test_a_flash_with_no_room_for_a_log_counts_in_ram() -> None:
    unit = BenchUnit(flash_block_bytes=512, flash_bytes=4 * 512)

    unit.advance(120.0)

    assert counters(unit).operating_s == 120
    assert counters(unit).saved_operating_s == 0
