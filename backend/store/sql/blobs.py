"""Small blobs in SQL: seconds of a live ride, and levels of the pyramid.

Tail: int16 rows of a live ride, each channel's deltas one after the other, zlib 1.
Level: "SPL1", u32 header length, header JSON {step, cells, channels: [...]}, then minimum and
maximum of every channel; all but the magic in zlib. zlib's checksum tells damage from data.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec, Counts, channel_from_json, channel_to_json
from backend.core.pyramid import Level
from backend.errors import StoreError

LEVEL_MAGIC = b"SPL1"
# Level 1 for what is deleted again, 6 for what stays.
TAIL_EFFORT = 1
LEVEL_EFFORT = 6

Rows16 = npt.NDArray[np.int16]


def encode_tail(rows: Rows16) -> bytes:
    """int16 (n, channels) -> payload."""
    deltas = np.diff(rows, axis=0, prepend=np.zeros((1, rows.shape[1]), np.int16))
    return zlib.compress(np.ascontiguousarray(deltas.T).astype("<i2").tobytes(), TAIL_EFFORT)


def decode_tail(payload: bytes, channel_count: int) -> Rows16:
    """Payload -> int16 (n, channels). Raises StoreError when it is damaged."""
    try:
        raw = np.frombuffer(zlib.decompress(payload), "<i2").reshape(channel_count, -1)
    except (zlib.error, ValueError) as error:
        raise StoreError(f"A second of a recording is damaged: {error}") from error
    return np.cumsum(raw, axis=1, dtype=np.int16).T


def encode_level(level: Level) -> bytes:
    """One level of the pyramid -> payload."""
    cells = len(next(iter(level.minimum.values()), np.empty(0)))
    header = json.dumps(
        {
            "step": level.step,
            "cells": cells,
            "channels": [channel_to_json(channel) for channel in level.channels],
        }
    ).encode()
    body = bytearray(struct.pack("<I", len(header)) + header)
    for channel in level.channels:
        low, high = level.minimum[channel.name], level.maximum[channel.name]
        body += shuffled(low) + shuffled(high)
    return LEVEL_MAGIC + zlib.compress(bytes(body), LEVEL_EFFORT)


def decode_level(payload: bytes) -> Level:
    """Payload -> level. Raises StoreError when it is damaged."""
    try:
        if not payload.startswith(LEVEL_MAGIC):
            raise ValueError("not a level")
        body = zlib.decompress(payload[len(LEVEL_MAGIC) :])
        (length,) = struct.unpack_from("<I", body)
        header = json.loads(body[4 : 4 + length])
        channels = tuple(channel_from_json(entry) for entry in header["channels"])
        offset, cells = 4 + length, int(header["cells"])
        minimum: dict[str, Counts] = {}
        maximum: dict[str, Counts] = {}
        for channel in channels:
            size = channel.dtype.itemsize * cells
            minimum[channel.name] = unshuffled(body[offset : offset + size], channel)
            maximum[channel.name] = unshuffled(body[offset + size : offset + 2 * size], channel)
            offset += 2 * size
    except (zlib.error, ValueError, KeyError, struct.error) as error:
        raise StoreError(f"A ride's overview is damaged: {error}") from error
    return Level(int(header["step"]), channels, minimum, maximum)


def shuffled(counts: Counts) -> bytes:
    """All low bytes first, then the high ones, which hardly change: what zlib likes."""
    little = counts.astype(counts.dtype.newbyteorder("<"))
    width = counts.dtype.itemsize
    return little.view(np.uint8).reshape(-1, width).T.tobytes()


def unshuffled(raw: bytes, channel: ChannelSpec) -> Counts:
    """The inverse of `shuffled`."""
    width = channel.dtype.itemsize
    planes = np.frombuffer(raw, np.uint8).reshape(width, -1)
    little = np.ascontiguousarray(planes.T).view(channel.dtype.newbyteorder("<")).reshape(-1)
    return little.astype(channel.dtype)


def channel_list(entries: Sequence[dict[str, object]]) -> tuple[ChannelSpec, ...]:
    """Channels from the JSON of a table row."""
    return tuple(channel_from_json(entry) for entry in entries)
