"""The ride logs a unit keeps, and one that is being fetched, as services see them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class RideLog:
    """One log in a unit's memory.

    generation: tells it from another log of the same id. t0_us, t1_us: unit time of its first and
    behind its last row, in the boot `boot_id`. ended: closed by the unit and not by a power loss.
    """

    log_id: int
    generation: int
    boot_id: int
    t0_us: int
    t1_us: int
    length: int
    recording: bool
    confirmed: bool
    ended: bool


@dataclass(frozen=True)
class RideLogs:
    """Every log of a unit, the oldest first.

    overwritten: logs given up unconfirmed since the unit started. boot_id, now_us: of the unit.
    """

    logs: tuple[RideLog, ...]
    overwritten: int
    boot_id: int
    now_us: int


class LogSegments(Protocol):
    """A log that is coming, from any thread."""

    failure: str | None
    # Bytes that are here without a hole, from the log's beginning.
    received: int

    @property
    def done(self) -> bool:
        """Whether the whole log is here."""
        ...

    def take_segments(self) -> list[bytes]:
        """Bytes in order since the last call; together with those before, `received` of them."""
        ...
