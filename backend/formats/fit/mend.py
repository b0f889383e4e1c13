"""One flipped bit in what gives a FIT file its structure, found by the file's own checksum.

A definition tells the layout of thousands of records once: a flipped bit in it loses them all. The
checksum is linear, so that what it lacks tells which single bit can have been flipped: one in every
32,767 places. It is put right where exactly one of these is in a definition or where the way was
lost, and makes the file sound. A flipped bit in a value is never touched: there every one of the
places would do.
"""

from __future__ import annotations

from fastcrc import crc16

from backend.formats.fit.layout import CHECKSUM_BYTES, Part, declared_end
from backend.formats.fit.walk import sound_parts

# CRC-16/ARC, its lowest bit first.
POLYNOMIAL = 0xA001
PERIOD_BITS = 32_767


def mended(data: bytes, where: list[range]) -> tuple[bytes, list[Part], int] | None:
    """The file with its one flipped bit put right, its parts, and the byte that bit is in; None for
    anything else.

    data: one FIT file. where: the bytes that can be at fault.
    """
    end = declared_end(data, 0)
    if end is None or end + CHECKSUM_BYTES != len(data):
        return None
    lacks = crc16.arc(memoryview(data)[:end]) ^ int.from_bytes(data[end:], "little")
    steps = steps_to(lacks)
    if steps is None:
        return None
    candidates: list[tuple[bytes, list[Part], int]] = []
    for behind in range(steps, 8 * end + 1, PERIOD_BITS):
        place, bit = divmod(8 * end - behind, 8)
        if not any(place in spans for spans in where):
            continue
        other = bytearray(data)
        other[place] ^= 1 << bit
        if (parts := sound_parts(bytes(other))) is not None:
            candidates.append((bytes(other), parts, place))
    return candidates[0] if len(candidates) == 1 else None


def steps_to(lacks: int) -> int | None:
    """How many bits from the end of the messages the flipped one is, the first of its places."""
    state = 1
    for steps in range(1, PERIOD_BITS + 1):
        state = state >> 1 ^ (POLYNOMIAL if state & 1 else 0)
        if state == lacks:
            return steps
    return None
