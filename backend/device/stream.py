"""Rows of telemetry as a unit's conversation hands them out, every lost row counted."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec

TIME_MODULUS = 1 << 32
"""The wire's times are the low 32 bits of the unit's clock."""


class LostBy(StrEnum):
    """Where rows were lost on their way, as far as this end can see.

    MACHINE: this computer read the port too late, and the unit's queue overflowed meanwhile. LINE:
    frames came damaged, or the connection was away. UNIT: it did not send them though the line was
    read in time: its queue was full, because the line is slower than the stream, or it did not
    measure.
    """

    MACHINE = "machine"
    LINE = "line"
    UNIT = "unit"


@dataclass(frozen=True)
class StreamStarted:
    """A subscription began: what its blocks hold.

    epoch: counts the host's subscriptions to this unit, so a restart of the unit is detected too.
    """

    epoch: int
    period_us: int
    channels: tuple[ChannelSpec, ...]


@dataclass(frozen=True)
class StreamBlock:
    """Rows of one frame.

    t0_us: unit time of the first row, 64 bit. period_us: from row to row. first_index: number of
    the first row since the subscription, lost ones counted. values: int16 (n, ch), counts of
    `channels`. lost_rows_before: rows missing between the block before and this one, lost_by: where
    they were lost. epoch: as in StreamStarted. wall_us: host's Unix time when the frame was read.
    """

    t0_us: int
    period_us: int
    first_index: int
    values: npt.NDArray[np.int16]
    lost_rows_before: int
    epoch: int
    wall_us: int
    channels: tuple[ChannelSpec, ...]
    lost_by: LostBy | None = None


def unwrap_us(low_us: int, near_us: int) -> int:
    """The 64-bit time with the low 32 bits `low_us` that is nearest to `near_us` (36 min away)."""
    ahead = (low_us - near_us) % TIME_MODULUS
    if ahead >= TIME_MODULUS // 2:
        ahead -= TIME_MODULUS
    return near_us + ahead
