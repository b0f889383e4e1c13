"""Frames of the live socket, made of what a viewer is sent.

- text `{"type": "stream", "epoch", "rate_hz", "period_us", "channels": [{name, unit, scale}]}`
  before the first rows and whenever one of these changes;
- text `{"type": "state", "state", "reason"}` whenever the unit's state changes;
- binary, little-endian: u32 sequence, u32 rows lost since the previous frame, u64 unit time of the
  first row in us, u16 rows n, u16 channels c, then i16[n * c] counts; value = count * scale,
  -32768 is missing.
"""

from __future__ import annotations

import json
import struct

from backend.services.units.watch import LiveItem, LiveRows, StreamNow

HEADER = struct.Struct("<IIQHH")
SEQUENCE_MODULUS = 2**32


def frame_of(item: LiveItem) -> str | bytes:
    """The frame that says this; a text is str."""
    if isinstance(item, LiveRows):
        return rows_frame(item)
    if isinstance(item, StreamNow):
        return stream_frame(item)
    return json.dumps({"type": "state", "state": item.state, "reason": item.reason})


def rows_frame(rows: LiveRows) -> bytes:
    """Header and counts."""
    header = HEADER.pack(
        rows.sequence % SEQUENCE_MODULUS,
        min(rows.lost_rows, SEQUENCE_MODULUS - 1),
        rows.t0_us,
        *rows.counts.shape,
    )
    return header + rows.counts.astype("<i2", copy=False).tobytes()


def stream_frame(stream: StreamNow) -> str:
    """How to read the rows after it."""
    return json.dumps(
        {
            "type": "stream",
            "epoch": stream.epoch,
            "rate_hz": 1e6 / stream.period_us,
            "period_us": stream.period_us,
            "channels": [
                {"name": channel.name, "unit": channel.unit, "scale": channel.scale}
                for channel in stream.channels
            ],
        }
    )
