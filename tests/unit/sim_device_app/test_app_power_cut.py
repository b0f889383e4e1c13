"""Goal: a commit that loses power leaves exactly the old configuration or exactly the new one.

Method: the flash counts every byte it erases and programs; the power is cut after every one of
them in turn (in `make test` after every eleventh), until the commit goes through, and the unit is
started again each time. Damage to a slot is done by hand.
"""

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    PARAMETERS,
    CfgConfirmRequest,
    CfgRollbackRequest,
    Event,
    Status,
)
from tests import counts
from tests.fakes.bench_unit import FLASH_BLOCK_BYTES, BenchUnit, crc32
from tests.fakes.config_flash import AT_CONFIRMED, AT_RECORDS, AT_TABLE, AT_VOID

OLD_CUTOFF_KMH = 21.0
NEW_CUTOFF_KMH = 19.0
BLOCK_BYTES, BLOCKS = 256, 4
"""Small blocks: fewer dull steps of erasing."""

SLOT_BYTES = BLOCKS * BLOCK_BYTES
FLASH_BYTES = 2 * SLOT_BYTES
AT_WORDS, WORD_BYTES = 24, 4
UNLIMITED = 0xFFFFFFFF
PARAMETER_COUNT = len(PARAMETERS)


def assert_written_in_order(flash: np.ndarray, whole: np.ndarray) -> None:
    """An erased slot filled up to somewhere: records, the header's copy and table, the header,
    and then the words that count.

    whole: the flash after a commit that was not cut.
    """
    records, summary, header = (
        slice(AT_RECORDS, SLOT_BYTES),
        slice(AT_TABLE, AT_RECORDS),
        slice(0, AT_WORDS),
    )
    if (flash[summary] != 0xFF).any():
        assert (flash[records] == whole[records]).all()
    if (flash[header] != 0xFF).any():
        assert (flash[summary] == whole[summary]).all()
    if (flash[AT_WORDS:AT_TABLE] != 0xFF).any():
        assert (flash[header] == whole[header]).all()


def commit_with_power_for(unit: BenchUnit, steps: int) -> Status | int:
    unit.boot()
    lib.bench_flash_cut_after(unit.board, steps)
    return unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH}).status


@pytest.mark.large_count
@pytest.mark.board_long
@pytest.mark.parametrize("commits_before", [0, 1, 2])
@pytest.mark.slow
def test_power_lost_after_any_byte_leaves_the_old_or_the_new_configuration(
    commits_before: int,
) -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    for i in range(commits_before):
        unit.write({"assist_cutoff_kmh": OLD_CUTOFF_KMH - i})
    old = unit.read_image()
    flash_before = unit.flash().copy()
    new_config = unit.config() | {"assist_cutoff_kmh": NEW_CUTOFF_KMH}
    new = (old[0] + 1, parameters.pack_image(new_config))
    assert commit_with_power_for(unit, UNLIMITED) == Status.OK
    whole = unit.flash().copy()
    target = slice(0, SLOT_BYTES) if commits_before % 2 else slice(SLOT_BYTES, FLASH_BYTES)
    assert (whole[target] != flash_before[target]).any()
    steps = 0
    booted = []

    while True:
        unit.flash()[:] = flash_before
        status = commit_with_power_for(unit, steps)
        if steps >= SLOT_BYTES:
            assert_written_in_order(unit.flash()[target], whole[target])
        seen = unit.read_image()
        assert seen == (new if status == Status.OK else old)

        unit.boot()
        booted.append(unit.read_image())
        assert booted[-1] in (old, new)
        assert Event.CONFIG_DEFAULTED not in [event.code for event in unit.events]
        if status == Status.OK:
            break
        assert status == Status.FLASH_FAIL
        steps += counts.stride()

    assert booted[0] == old
    assert booted[-1] == new
    assert booted == sorted(booted, key=lambda image: image[0])
    assert steps > SLOT_BYTES + len(new[1])


@pytest.mark.large_count
@pytest.mark.board_long
@pytest.mark.parametrize("commits_before", [0, 1, 2])
@pytest.mark.slow
def test_power_lost_anywhere_in_a_trial_brings_back_the_old_configuration(
    commits_before: int,
) -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    for i in range(commits_before):
        unit.write({"assist_cutoff_kmh": OLD_CUTOFF_KMH - i})
    old = unit.read_image()
    flash_before = unit.flash().copy()
    steps = 0

    while True:
        unit.flash()[:] = flash_before
        unit.boot()
        lib.bench_flash_cut_after(unit.board, steps)
        status = unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH}, confirm_s=30).status

        # Twice: the first start writes a word of its own where it finds a trial.
        for _ in range(2):
            unit.boot()
            assert unit.read_image() == old
            assert Event.CONFIG_DEFAULTED not in [event.code for event in unit.events]
        if status == Status.OK:
            break
        assert status == Status.FLASH_FAIL
        steps += counts.stride()

    assert steps > SLOT_BYTES + len(old[1])


@pytest.mark.board_long
@pytest.mark.parametrize("ending", [CfgConfirmRequest, CfgRollbackRequest])
def test_power_lost_anywhere_in_the_end_of_a_trial_leaves_the_old_or_the_new(
    ending: type[CfgConfirmRequest | CfgRollbackRequest],
) -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    old = unit.read_image()
    new = (old[0] + 1, parameters.pack_image(unit.config() | {"assist_cutoff_kmh": 19.0}))
    booted = []

    for steps in range(WORD_BYTES + 1):
        if steps > 0:
            unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
        unit.write({"assist_cutoff_kmh": 19.0}, confirm_s=30)
        lib.bench_flash_cut_after(unit.board, steps)
        if ending is CfgConfirmRequest:
            response = unit.ask(CfgConfirmRequest(new[0], crc32(new[1])))
            assert response.status == (Status.OK if steps == WORD_BYTES else Status.FLASH_FAIL)
        else:
            assert unit.ask(CfgRollbackRequest()).status == Status.OK
            assert unit.read_image() == old
        unit.boot()
        booted.append(unit.read_image())
        unit.boot()
        assert unit.read_image() == booted[-1]

    # A word that was begun was meant.
    kept = new if ending is CfgConfirmRequest else old
    assert booted == [old] + [kept] * WORD_BYTES


def test_power_lost_while_a_trial_is_taken_back_at_the_start_is_taken_back_at_the_next() -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    old = unit.read_image()
    for cut in range(WORD_BYTES + 1):
        unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH}, confirm_s=30)
        void = slice(SLOT_BYTES + AT_VOID, SLOT_BYTES + AT_VOID + cut)
        unit.flash()[void] = 0

        unit.boot()

        assert unit.read_image() == old


def test_a_commit_that_failed_can_be_repeated_when_the_flash_works_again() -> None:
    unit = BenchUnit()
    assert commit_with_power_for(unit, 1100) == Status.FLASH_FAIL

    unit.boot()

    assert unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH}).status == Status.OK
    unit.boot()
    assert unit.config()["assist_cutoff_kmh"] == NEW_CUTOFF_KMH


# Each parameter is programmed in two pieces, then come the header's copy, its table, itself.
@pytest.mark.parametrize("program", [*range(2 * PARAMETER_COUNT + 4)])
def test_a_byte_that_does_not_take_is_noticed_before_the_commit_counts(program: int) -> None:
    unit = BenchUnit()
    unit.write({"assist_cutoff_kmh": OLD_CUTOFF_KMH})
    old = unit.read_image()
    lib.bench_flash_weak_bit_after(unit.board, program)

    status = unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH}).status

    assert status == Status.VERIFY_FAIL
    assert unit.read_image() == old
    unit.boot()
    assert unit.read_image() == old


@pytest.mark.parametrize("word", [AT_CONFIRMED, AT_VOID], ids=["not confirmed", "void"])
def test_a_whole_slot_that_was_not_confirmed_or_was_taken_back_does_not_count(word: int) -> None:
    unit = BenchUnit()
    factory = unit.read_image()
    unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH})
    state = slice(FLASH_BLOCK_BYTES + word, FLASH_BLOCK_BYTES + word + 4)

    unit.flash()[state] ^= np.uint8(0xFF)
    unit.boot()

    assert unit.read_image() == factory


def test_with_both_slots_damaged_the_unit_starts_on_its_default_and_says_so() -> None:
    unit = BenchUnit()
    unit.write({"assist_cutoff_kmh": NEW_CUTOFF_KMH})

    # Both copies of both headers.
    for at in (50, 90):
        unit.flash()[[at, FLASH_BLOCK_BYTES + at]] ^= np.uint8(0x10)
    unit.boot()

    assert unit.read_image() == (0, parameters.pack_image(parameters.default_config()))
    assert Event.CONFIG_DEFAULTED in [event.code for event in unit.events]


def test_damaged_flash_is_not_taken_for_a_unit_fresh_from_the_factory() -> None:
    unit = BenchUnit()
    unit.flash()[50] ^= np.uint8(0x10)
    damaged = unit.flash().copy()

    assert lib.bench_provision(unit.board) == 0

    assert (unit.flash() == damaged).all()
