"""Goal: a unit that spares its flash, or has lost what its maker chose, says so in words.

Method: the session against the real firmware, whose flash is written by hand beforehand.
"""

from collections.abc import Callable

import pytest

from backend.device.ebl.operations import config_transaction
from backend.errors import AccessDenied, DeviceRefused
from firmware_protocol._generated import Status
from sim_device.configure import read_image
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.config_flash import items_of, records_at, slot
from tests.fakes.simulated_unit import LockstepAsUnit

LOWERED = {"assist_cutoff_kmh": 19.0}
SPENT_S = 1000 * 16_800


def a_bench(changed: Callable[[bytearray], None]) -> Bench:
    """A unit whose flash somebody changed, and a session with it."""
    flash = bytearray(LockstepUnit(1).unit.flash())
    changed(flash)
    return Bench(LockstepAsUnit(LockstepUnit(1, flash=bytes(flash)))).connect()


def worn(flash: bytearray) -> None:
    image = read_image(LockstepUnit(1).unit)
    laid = slot(items_of(image), 1, worn_until_s=SPENT_S)
    flash[: len(laid)] = laid


def market_lost(flash: bytearray) -> None:
    flash[records_at(flash)["MARKET"][4]] ^= 1


def change(bench: Bench) -> object:
    base = bench.ask(config_transaction.read_config())
    return bench.ask(config_transaction.write_config(base, LOWERED))


def test_the_refusal_of_a_worn_unit_tells_how_long_and_nothing_changes() -> None:
    bench = a_bench(worn)

    with pytest.raises(DeviceRefused, match=r"after 4 h 40 min of operation. Nothing was") as told:
        change(bench)

    assert told.value.status == Status.RATE_LIMIT.name


def test_a_unit_that_lost_its_market_wants_its_makers_word_for_anything() -> None:
    bench = a_bench(market_lost)

    with pytest.raises(AccessDenied, match=r"What the maker chose for this unit is damaged"):
        change(bench)
