"""Goal: the lock holds against numbers: a million challenges, ten thousand guesses with restarts.

Method: both past the line, which only costs time, through doors of the bench board. A guess costs
0.1 ms of ours for its Ed25519 check; the protocol page's 100,000 are a matter of `GUESSES`.
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol._generated import Access, AuthChallengeRequest, Status
from tests.fakes.bench_unit import FLASH_BLOCK_BYTES, BenchUnit
from tests.fakes.maker import Maker, provision

pytestmark = pytest.mark.board_long

NONCES = 1_000_000
NONCE_BYTES = 16
BOOTS = 10
GUESSES = 10_000
GUESSES_A_BOOT = 7
DELAY_S_MAX = 60
MANY, DELAY_S_MANY = 100_000, 240
RECORDS_AT = 5 * FLASH_BLOCK_BYTES
RECORD_BYTES = 12
BLOCK_ERASES_MAX = 10_000
TEN_YEARS_S = 10 * 365.25 * 86_400
JUNK = bytes(64)


@pytest.fixture
def unit() -> BenchUnit:
    bench = BenchUnit()
    provision(bench, Maker())
    return bench


def guess(unit: BenchUnit) -> tuple[int, int]:
    """One attempt with a new challenge: status and detail."""
    nonce = ffi.new("uint8_t[]", NONCE_BYTES)
    assert lib.bench_unlock_nonces(unit.board, Access.DEALER, 1, nonce) == 1
    detail = ffi.new("uint16_t *")
    status = lib.bench_unlock_attempt(unit.board, JUNK, detail)
    return status, detail[0]


def is_closed(unit: BenchUnit) -> bool:
    nonce = ffi.new("uint8_t[]", NONCE_BYTES)
    return int(lib.bench_unlock_nonces(unit.board, Access.DEALER, 1, nonce)) == 0


@pytest.mark.slow
def test_a_million_nonces_over_restarts_are_a_million_nonces(unit: BenchUnit) -> None:
    nonces = np.zeros((NONCES, NONCE_BYTES), dtype=np.uint8)
    for part in np.split(nonces, BOOTS):
        given = lib.bench_unlock_nonces(
            unit.board, Access.DEALER, len(part), ffi.from_buffer("uint8_t[]", part)
        )
        assert given == len(part)
        unit.boot()

    assert len(np.unique(nonces.view("<u8").view("V16"))) == NONCES


@pytest.mark.slow
def test_ten_thousand_guesses_over_restarts_are_all_counted_and_all_slow(unit: BenchUnit) -> None:
    """Blocks of 85 records: the count moves between them more than a hundred times."""
    for attempt in range(1, GUESSES + 1):
        assert guess(unit) == (Status.AUTH_BAD, attempt)
        delay_us = min(DELAY_S_MAX, 2 ** min(attempt - 1, 6)) * 1_000_000
        if attempt % GUESSES_A_BOOT == 0:
            lib.bench_skip_us(unit.board, delay_us // 2)
            lib.bench_boot(unit.board, attempt)
        lib.bench_skip_us(unit.board, delay_us - 1)
        assert is_closed(unit)
        lib.bench_skip_us(unit.board, 1)


def test_who_guesses_for_ten_years_does_not_wear_out_the_flash_that_counts_it(
    unit: BenchUnit,
) -> None:
    """Every attempt is a record, and a block of them is erased before it takes new ones."""
    attempts = MANY + (TEN_YEARS_S - MANY * DELAY_S_MAX) / DELAY_S_MANY
    assert attempts / (2 * (FLASH_BLOCK_BYTES // RECORD_BYTES)) < BLOCK_ERASES_MAX
    record = struct.pack("<II", MANY - 1, MANY - 1)
    record += zlib.crc32(record).to_bytes(4, "little")
    unit.flash()[RECORDS_AT : RECORDS_AT + RECORD_BYTES] = list(record)
    unit.boot()

    for failures, delay_s in ((MANY, DELAY_S_MAX), (MANY + 1, DELAY_S_MANY)):
        lib.bench_skip_us(unit.board, DELAY_S_MAX * 1_000_000)
        assert guess(unit)[0] == Status.AUTH_BAD
        assert unit.ask(AuthChallengeRequest(Access.DEALER)).detail == delay_s, failures
    unit.boot()

    assert unit.ask(AuthChallengeRequest(Access.DEALER)).detail == DELAY_S_MANY


def test_the_doors_past_the_line_are_those_on_it(unit: BenchUnit) -> None:
    assert guess(unit) == (Status.AUTH_BAD, 1)

    assert unit.ask(AuthChallengeRequest(Access.DEALER)).status == Status.AUTH_DELAY
