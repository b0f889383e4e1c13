"""The judge of the lock: attempts are counted before they are looked at, and never forgotten.

It reads the records of failed attempts in the unit's flash and the challenges at the unit's pins.
"""

from __future__ import annotations

import struct
import zlib

from firmware_protocol._generated import AuthChallengeResponse
from tests.simulation.violation import Violation

# The two blocks before the last of eight, in which attempts are counted.
RECORDS_AT, RECORDS_END = 5 * 1024, 7 * 1024
BLOCK_BYTES = 1024
RECORD = struct.Struct("<III")
DELAY_S_MAX = 60
TTL_S = 60
# The judge looks every 10 ms, and a boot takes the unit's clock back to nothing.
LOOK_S = 0.011


class UnlockChecks:
    """One unit's lock. Methods raise Violation with what was seen."""

    def __init__(self, flash: bytes) -> None:
        self.sequence, self.failures = newest_record(flash)
        self.attempts = 0
        # Good tokens that were shown: only they end a series of failures.
        self.good_tokens_shown = 0
        self._records = flash[RECORDS_AT:RECORDS_END]
        self._open_s = delay_s(self.failures)
        self._nonces: dict[bytes, tuple[int, int]] = {}

    def restarted(self) -> None:
        """The unit has a new RAM and its clock starts at zero."""
        self._open_s = delay_s(self.failures)

    def looked(self, flash: bytes, unit_s: float) -> None:
        """The flash after a step; unit_s: the unit's own clock."""
        records = flash[RECORDS_AT:RECORDS_END]
        if records == self._records:
            return
        self._records = records
        sequence, failures = newest_record(flash)
        if sequence < self.sequence:
            raise Violation(f"Attempt {self.sequence} was forgotten; {sequence} is the newest.")
        if failures == 0 < self.failures and not self.good_tokens_shown:
            raise Violation(f"{self.failures} failures were forgotten without a good token.")
        if failures > self.failures + 1:
            raise Violation(f"{self.failures} failures became {failures} at once.")
        self.attempts += failures > self.failures
        self.sequence, self.failures = sequence, failures
        self._open_s = unit_s - LOOK_S + delay_s(failures) if failures else 0.0

    def refused(self, failures: int) -> None:
        """The unit says that a token was wrong, and how often so far."""
        if failures > self.failures:
            raise Violation(
                f"A token was refused as failure {failures}; {self.failures} are on record."
            )

    def challenged(self, answer: AuthChallengeResponse) -> None:
        """A challenge left the unit."""
        asked = (answer.boot_id, answer.expires_us)
        if self._nonces.setdefault(answer.nonce, asked) != asked:
            raise Violation(f"The nonce {answer.nonce.hex()} was given twice.")
        given_s = answer.expires_us / 1e6 - TTL_S
        if given_s < self._open_s:
            raise Violation(
                f"A challenge was given at {given_s:.2f} s of the unit's time; after "
                f"{self.failures} failures it is closed until {self._open_s:.2f} s."
            )


def delay_s(failures: int) -> float:
    """Protocol page, 4.3: 1, 2, 4 .. 60 s."""
    return float(min(DELAY_S_MAX, 2 ** (failures - 1))) if failures else 0.0


def newest_record(flash: bytes) -> tuple[int, int]:
    """Sequence number and failures of the newest whole record; zeros where there is none."""
    newest = (0, 0)
    for block in range(RECORDS_AT, RECORDS_END, BLOCK_BYTES):
        for at in range(block, block + BLOCK_BYTES - RECORD.size + 1, RECORD.size):
            sequence, failures, check = RECORD.unpack_from(flash, at)
            if check == zlib.crc32(flash[at : at + 8]):
                newest = max(newest, (sequence, failures))
    return newest
