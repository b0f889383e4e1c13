"""What a unit has behind it when a seed begins: two rides in its flash, perhaps a maker's key.

Made once and shared, because riding for every seed would only take time.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cache

from sim_device.firmware.python.unit import LOG_BLOCK_LENGTH
from sim_device.lockstep import LockstepUnit
from tests.fakes.maker import Maker
from tests.simulation.checks_unlock import BLOCK_BYTES, RECORD, RECORDS_AT

MAKER = Maker()
# Small, so that rides come round the ring within a seed.
LOG_BYTES = 12 * LOG_BLOCK_LENGTH
RIDES_S = (9.0, 14.0)
STANDSTILL_S = 22.0
# The place for attempts is full after 85 of them; the last but one is due soon.
OLD_ATTEMPTS = 83
BOOT_ID = 0xFFFFFF00
# Below the market's, so that there is something to raise.
CUTOFF_KMH = 18.0


@dataclass(frozen=True)
class EarlierBoot:
    """Both flashes."""

    flash: bytes
    log: bytes


@cache
def earlier_boot(has_key: bool) -> EarlierBoot:
    """The unit before the seed began. has_key: whether limits can be raised at all."""
    unit = LockstepUnit(
        config_overrides={"assist_cutoff_kmh": CUTOFF_KMH},
        name="simulated",
        log=b"\xff" * LOG_BYTES,
        unlock_key=MAKER.public_key if has_key else None,
        boot_id=BOOT_ID,
    )
    for seconds in RIDES_S:
        unit.brake(False)
        unit.rider("legs", torque_nm=30.0)
        unit.advance(seconds)
        unit.rider("off")
        unit.brake(True)
        unit.advance(STANDSTILL_S)
    flash = bytearray(unit.unit.flash())
    for number in range(OLD_ATTEMPTS if has_key else 0):
        record = RECORD.pack(number + 1, 0, 0)
        check = zlib.crc32(record[:8]).to_bytes(4, "little")
        at = RECORDS_AT + number * RECORD.size
        flash[at : at + RECORD.size] = record[:8] + check
    assert OLD_ATTEMPTS * RECORD.size < BLOCK_BYTES
    return EarlierBoot(bytes(flash), unit.unit.log())
