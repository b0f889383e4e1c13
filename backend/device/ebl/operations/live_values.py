"""One row of telemetry as physical values by channel name; a missing value is None."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.device.ebl.session.operation import Operation, ask
from backend.device.stream import StreamBlock
from backend.domain.channels import ChannelSpec
from firmware_protocol._generated import CHANNELS, StrSnapshotRequest, StrSnapshotResponse
from firmware_protocol.layout import MISSING

# A count times its scale carries the noise of float64 in its last digits; scales have five.
DECIMALS = 6

CHANNEL_SPECS = tuple(ChannelSpec(row.name, row.unit, float(row.scale)) for row in CHANNELS)


@dataclass(frozen=True)
class LiveValues:
    """t_us: unit time of the row, 64 bit. channels: value in the channel's unit, None: missing."""

    t_us: int
    channels: dict[str, float | None]


def last_values(block: StreamBlock) -> LiveValues:
    """The newest row of a block."""
    t_us = block.t0_us + (len(block.values) - 1) * block.period_us
    return LiveValues(t_us, _named(block.channels, block.values[-1].tolist()))


def ask_values() -> Operation[LiveValues]:
    """Ask the unit for one row of every channel."""
    ids = bytes(row.id for row in CHANNELS)
    answer = yield from ask(StrSnapshotRequest(ids), StrSnapshotResponse)
    return values_of(answer.t_us, answer.values)


def values_of(t_us: int, row: bytes) -> LiveValues:
    """A row of every channel in the order of their ids, as the wire carries it.

    A unit of earlier firmware has fewer channels: those it does not send are missing.
    """
    known = len(CHANNEL_SPECS)
    counts = np.frombuffer(row[: min(len(row) // 2, known) * 2], dtype="<i2").tolist()
    return LiveValues(t_us, _named(CHANNEL_SPECS, counts + [MISSING] * (known - len(counts))))


def _named(channels: Sequence[ChannelSpec], counts: Sequence[int]) -> dict[str, float | None]:
    return {
        channel.name: None if count == MISSING else round(count * channel.scale, DECIMALS)
        for channel, count in zip(channels, counts, strict=True)
    }
