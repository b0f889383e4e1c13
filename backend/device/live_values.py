"""One row of telemetry as physical values by channel name; a missing value is None."""

from __future__ import annotations

from collections.abc import Sequence

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
