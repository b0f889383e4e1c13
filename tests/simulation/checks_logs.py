"""The judge of ride logs: pages are written once, logs are given up by the rules, copies are exact.

It reads the unit's flash for logs as it is after every change and finds the logs there by itself.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from backend.device.readings import RideLog
from backend.formats.blocks import HEADER, MAGIC, PAGE_BYTES, Block, block_at
from sim_device.firmware.python.unit import LOG_BLOCK_LENGTH
from tests.simulation.violation import Violation

PAGES_PER_BLOCK = LOG_BLOCK_LENGTH // PAGE_BYTES
AT_STATE = PAGE_BYTES - 4
ERASED_STATE, CONFIRMED_STATE = b"\xff" * 4, bytes(4)
# One for the log being written and one erased ahead of it.
SPARE_BLOCKS = 2
LOGS_MAX = 24


@dataclass(frozen=True)
class StoredLog:
    """A log as it lies in the flash: its whole pages in their order, the unit's words blanked."""

    log_id: int
    generation: int
    data: bytes
    confirmed: bool
    first_block: int
    blocks: frozenset[int]


class LogChecks:
    """One unit's flash for logs. Methods raise Violation with what was seen."""

    def __init__(self, flash: bytes) -> None:
        self.safe: set[tuple[int, int]] = set()
        self.given_up_unconfirmed = 0
        self._flash = flash
        self._logs: dict[tuple[int, int], StoredLog] | None = None

    @property
    def logs(self) -> dict[tuple[int, int], StoredLog]:
        """What is in the flash, by id and generation."""
        if self._logs is None:
            self._logs = stored_logs(self._flash)
        return self._logs

    def looked(self, flash: bytes) -> None:
        """The flash after a change."""
        old, new = pages_of(self._flash), pages_of(flash)
        for page in np.flatnonzero((old != new).any(axis=1)):
            self._page_changed(int(page), old[page].tobytes(), new[page].tobytes())
        self._flash, self._logs = flash, None

    def _page_changed(self, page: int, old: bytes, new: bytes) -> None:
        if old.count(0xFF) == PAGE_BYTES:
            return
        if is_being_erased(old, new):
            self._erased(page)
            return
        if old[:AT_STATE] == new[:AT_STATE] and page % PAGES_PER_BLOCK == 0:
            log = next(log for log in self.logs.values() if page // PAGES_PER_BLOCK in log.blocks)
            if (log.log_id, log.generation) in self.safe:
                return
            raise Violation(f"Log {log.log_id} is marked as safe; no host has confirmed its bytes.")
        raise Violation(f"Page {page} of the flash for logs was written twice.")

    def _erased(self, page: int) -> None:
        block, place = divmod(page, PAGES_PER_BLOCK)
        gone = next((log for log in self.logs.values() if log.first_block == block), None)
        if place or gone is None or (gone.log_id, gone.generation) in self.safe:
            return
        before = self.logs
        self.given_up_unconfirmed += 1
        if any(log.confirmed for log in before.values()):
            raise Violation(f"Log {gone.log_id} was given up before one that a host has.")
        older = [log.log_id for log in before.values() if log.log_id < gone.log_id]
        if older:
            raise Violation(f"Log {gone.log_id} was given up before the older {older}.")
        taken = sum(len(log.blocks) for log in before.values())
        room = len(self._flash) // LOG_BLOCK_LENGTH - taken
        if room > SPARE_BLOCKS and len(before) < LOGS_MAX:
            raise Violation(f"Log {gone.log_id} was given up with {room} blocks free.")

    # ------------------------------------------------------------------ the host's side

    def shown_logs(self, logs: Iterable[RideLog]) -> None:
        """A directory somebody read. What is closed does not change any more."""
        for log in logs:
            stored = self.logs.get((log.log_id, log.generation))
            if log.recording or stored is None:
                continue
            if log.length != len(stored.data):
                raise Violation(
                    f"Log {log.log_id} is shown with {log.length} bytes; "
                    f"{len(stored.data)} of it are whole."
                )
            if log.confirmed and (log.log_id, log.generation) not in self.safe:
                raise Violation(f"Log {log.log_id} is shown as safe; no host has confirmed it.")

    def all_shown(self, logs: Iterable[RideLog]) -> None:
        """A directory read while nothing is recorded and nothing goes wrong."""
        self.shown_logs(logs)
        missing = self.logs.keys() - {(log.log_id, log.generation) for log in logs}
        if missing:
            raise Violation(f"The logs {sorted(missing)} are in the flash and not shown.")

    def fetched(self, log: RideLog, truth: bytes, data: bytes) -> None:
        """A log that came over whole. truth: its bytes in the flash when it was opened."""
        if data != truth:
            wrong = next(at for at in range(len(data) + 1) if data[: at + 1] != truth[: at + 1])
            raise Violation(
                f"Log {log.log_id} came with {len(data)} of {len(truth)} bytes, "
                f"other ones from byte {wrong} on."
            )


def is_being_erased(old: bytes, new: bytes) -> bool:
    """Whether the new page is the old one erased to some byte."""
    end = next((at for at in range(PAGE_BYTES) if new[at] != 0xFF), PAGE_BYTES)
    return end > 0 and new[end:] == old[end:]


def pages_of(flash: bytes) -> np.ndarray:
    """uint8 (pages, 512)."""
    return np.frombuffer(flash, dtype=np.uint8).reshape(-1, PAGE_BYTES)


def stored_logs(flash: bytes) -> dict[tuple[int, int], StoredLog]:
    """Every log whose first page is whole, by id and generation."""
    found: dict[tuple[int, int], StoredLog] = {}
    for block in range(len(flash) // LOG_BLOCK_LENGTH):
        first = page_at(flash, block, 0)
        head = block_at(first, 0) if first[:4] == MAGIC else None
        if head is not None and head.seq == 0:
            end = HEADER.size + len(head.payload)
            generation = int.from_bytes(first[end : end + 4], "little")
            found[head.log_id, generation] = stored_log(flash, head, generation, block)
    return found


def stored_log(flash: bytes, first: Block, generation: int, first_block: int) -> StoredLog:
    """The log that begins with this page; what lies behind its last whole page is not of it."""
    pages: dict[int, bytes] = {}
    blocks = set()
    last = 0
    for block in range(len(flash) // LOG_BLOCK_LENGTH):
        head = HEADER.unpack_from(page_at(flash, block, 0))
        if (
            head[0] != MAGIC
            or head[4:6] != (first.log_id, first.boot_id)
            or head[6] % PAGES_PER_BLOCK
        ):
            continue
        blocks.add(block)
        for place in range(PAGES_PER_BLOCK):
            page = page_at(flash, block, place)
            pages[head[6] + place] = page[:AT_STATE] + ERASED_STATE
            whole = block_at(page, 0) if page[:4] == MAGIC else None
            if whole is not None and whole.log_id == first.log_id:
                last = max(last, head[6] + place)
    erased = b"\xff" * PAGE_BYTES
    data = b"".join(pages.get(seq, erased) for seq in range(last + 1))
    confirmed = page_at(flash, first_block, 0)[AT_STATE:] == CONFIRMED_STATE
    return StoredLog(first.log_id, generation, data, confirmed, first_block, frozenset(blocks))


def page_at(flash: bytes, block: int, place: int) -> bytes:
    """One page of an erase block."""
    at = block * LOG_BLOCK_LENGTH + place * PAGE_BYTES
    return flash[at : at + PAGE_BYTES]
