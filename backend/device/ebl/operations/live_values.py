"""One row of telemetry, asked of the unit."""

from __future__ import annotations

import numpy as np

from backend.core.channels import ChannelSpec
from backend.device.ebl.session.operation import Operation, query
from backend.device.live_values import Snapshot, named_values
from firmware_protocol._generated import CHANNELS, StrSnapshotRequest, StrSnapshotResponse
from firmware_protocol.layout import MISSING

CHANNEL_SPECS = tuple(ChannelSpec(row.name, row.unit, float(row.scale)) for row in CHANNELS)


def read_values() -> Operation[Snapshot]:
    """Ask the unit for one row of every channel."""
    ids = bytes(row.id for row in CHANNELS)
    answer = yield from query(StrSnapshotRequest(ids), StrSnapshotResponse)
    return values_of(answer.t_us, answer.values)


def values_of(t_us: int, row: bytes) -> Snapshot:
    """A row of every channel in the order of their ids, as the wire carries it.

    A unit of earlier firmware has fewer channels: those it does not send are missing.
    """
    channel_count = len(CHANNEL_SPECS)
    counts = np.frombuffer(row[: min(len(row) // 2, channel_count) * 2], dtype="<i2").tolist()
    return Snapshot(
        t_us, named_values(CHANNEL_SPECS, counts + [MISSING] * (channel_count - len(counts)))
    )
