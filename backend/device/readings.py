"""What a unit reports of itself: live values, faults, wear, and the rides in its own log."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.described import described
from backend.device.stream import StreamBlock

# A count times its scale carries the noise of float64 in its last digits; scales have five.
DECIMALS = 6


@described
class Snapshot:
    """One row of every channel, in its unit; a channel without a value is null. t_us: unit time."""

    t_us: int
    channels: dict[str, float | None]


def last_values(block: StreamBlock) -> Snapshot:
    """The newest row of a block."""
    t_us = block.t0_us + (len(block.values) - 1) * block.period_us
    return Snapshot(t_us, named_values(block.channels, block.values[-1].tolist()))


def named_values(channels: Sequence[ChannelSpec], counts: Sequence[int]) -> dict[str, float | None]:
    """Counts of one row, 16 bit, in the order of `channels` -> values by name."""
    return {
        channel.name: None if count == MISSING_INT16 else round(count * channel.scale, DECIMALS)
        for channel, count in zip(channels, counts, strict=True)
    }


Severity = Literal["warning", "assist_off", "latched"]


@described
class Fault:
    """A fault that is active or was. `frozen` is what the bike did when it came last."""

    name: str
    description: str
    """What the rider reads."""
    active: bool = True
    count: int | None = None
    """How often since the unit's start; null if not known."""
    frozen: Snapshot | None = None
    severity: Severity = "latched"
    """A warning only; no assist while it lasts; no assist until cleared at standstill."""
    mechanic_text: str = ""
    """What a mechanic measures and mends."""


SlotState = Literal["empty", "confirmed", "provisional", "void", "damaged", "unknown"]


@described
class ConfigSlot:
    """One of the two places in the unit's flash its configuration is kept."""

    state: SlotState
    """`unknown`: to this Spindle."""
    generation: int
    erases: int
    """In the unit's life; this wears it."""
    active: bool
    """Whether the unit runs on it."""


@described
class WearCounters:
    """What the unit knows of its own wear. What is not saved yet is lost with its supply, a minute
    at most."""

    distance_m: int
    operating_s: int
    saved_distance_m: int
    saved_operating_s: int
    config_slots: tuple[ConfigSlot, ...]
    runs_on_default: bool
    """Neither slot is good: the factory's values apply."""


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
