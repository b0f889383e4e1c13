"""Goal: counters and the lock's count of attempts survive a power cut where their log turns over to
the next block, the old records of which are erased for it.

Method: small blocks, filled up to the last place; then the power is cut after every byte of the
erase and of the record behind it (in `make test` after every eleventh). What comes back is the
count before or the count after, and the next record is kept again. Places within a block:
test_app_counters.py, test_app_unlock.py.
"""

from itertools import count

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import (
    Access,
    AuthChallengeRequest,
    CountersRequest,
    CountersResponse,
    Status,
)
from firmware_protocol.unlock_token import Token
from tests import counts
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.maker import Maker, challenged, provision, respond, staged

BLOCK_BYTES = 64
FLASH_BYTES = 32 * BLOCK_BYTES
COUNTER_RECORD_BYTES, ATTEMPT_RECORD_BYTES = 20, 12
COUNTER_RECORDS = BLOCK_BYTES // COUNTER_RECORD_BYTES
ATTEMPT_RECORDS = BLOCK_BYTES // ATTEMPT_RECORD_BYTES
MINUTE_S = 61.0
CREEPING_KMH = 0.4
"""Way to save every minute, and the bike still counts as standing: a block may be erased."""
LOWERED = {"assist_cutoff_kmh": 20.0}
RAISED = {"assist_cutoff_kmh": 25.0}
JUNK = Token(2**63, bytes(64))
DELAY_S_MAX = 60

pytestmark = [pytest.mark.board_long, pytest.mark.large_count]


def operating_s(unit: BenchUnit) -> int:
    message = unit.ask(CountersRequest()).message
    assert isinstance(message, CountersResponse)
    return message.operating_s


@pytest.mark.parametrize("blocks_full", [2, 3], ids=["back to the first", "on to the second"])
def test_counters_survive_the_erase_of_their_next_block(blocks_full: int) -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    unit.inputs(speed_kmh=CREEPING_KMH)
    for _ in range(blocks_full * COUNTER_RECORDS):
        unit.advance(MINUTE_S)
    flash = unit.flash().copy()
    unit.boot()
    before = operating_s(unit)
    found: dict[int, int] = {}

    for steps in count(step=counts.stride()):
        unit.flash()[:] = flash
        unit.boot()
        lib.bench_flash_cut_after(unit.board, steps)
        unit.advance(MINUTE_S)
        taken = lib.bench_flash_steps(unit.board)
        unit.boot()
        found[steps] = operating_s(unit) - before
        for _ in range(2):
            unit.advance(MINUTE_S)
        unit.boot()
        assert operating_s(unit) > before + found[steps] + 60
        if taken < steps:
            break

    enough = BLOCK_BYTES + COUNTER_RECORD_BYTES
    assert {more_s for steps, more_s in found.items() if steps < enough} == {0}
    assert {more_s for steps, more_s in found.items() if steps >= enough} <= {59, 60}
    assert max(found) > enough


def delay_s(unit: BenchUnit) -> int:
    response = unit.ask(AuthChallengeRequest(Access.DEALER))
    return response.detail if response.status == Status.AUTH_DELAY else 0


def guess(unit: BenchUnit, steps: int) -> Status | int:
    """A wrong token once its delay is over, with power for so many bytes of flash."""
    unit.advance(DELAY_S_MAX)
    transaction, image = staged(unit, RAISED)
    challenged(unit, Access.DEALER, image)
    lib.bench_flash_cut_after(unit.board, steps)
    return respond(unit, transaction, JUNK).status


def test_attempts_survive_the_erase_of_their_next_block() -> None:
    unit = BenchUnit(flash_block_bytes=BLOCK_BYTES, flash_bytes=FLASH_BYTES)
    provision(unit, Maker())
    assert unit.write(dict(LOWERED)).status == Status.OK
    # One block full, with the largest delays but one at its end.
    for _ in range(ATTEMPT_RECORDS):
        assert guess(unit, 0xFFFFFFFF) == Status.AUTH_BAD
    flash = unit.flash().copy()
    unit.boot()
    before_s = delay_s(unit)
    after_s = min(DELAY_S_MAX, 2 * before_s)
    assert 0 < before_s < after_s
    found = []

    for steps in count(step=counts.stride()):
        unit.flash()[:] = flash
        unit.boot()
        status = guess(unit, steps)
        unit.boot()
        found.append(delay_s(unit))
        assert status == Status.AUTH_BAD or status == Status.FLASH_FAIL
        if status == Status.AUTH_BAD:
            break
        assert guess(unit, 0xFFFFFFFF) == Status.AUTH_BAD
        unit.boot()
        assert delay_s(unit) > found[-1] or delay_s(unit) == DELAY_S_MAX

    assert set(found[:-1]) <= {before_s, after_s}
    assert found[0] == before_s
    assert found[-1] == after_s
    assert found == sorted(found)
    assert steps > BLOCK_BYTES
