"""A small FIT activity as a head unit writes it, byte by byte after Garmin's public description.

Header of 14 bytes, a file_id message, a definition of `record` (global message 20), one data
message a second, CRC-16 at the end. Written here independently of everything that reads FIT.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

# FIT counts seconds from 1989-12-31 00:00:00 UTC.
FIT_EPOCH_S = 631_065_600
ENUM, UINT8, UINT16, UINT32 = 0x00, 0x02, 0x84, 0x86
FILE_ID, RECORD = 0, 20


def crc16(data: bytes) -> int:
    """CRC-16/ARC (polynomial 0x8005, reflected), which the FIT description gives as a table."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ 0xA001 if crc & 1 else crc >> 1
    return crc


def definition(local: int, message: int, fields: Sequence[tuple[int, int, int]]) -> bytes:
    """A definition message: fields of number, size and base type, little-endian."""
    head = struct.pack("<BBBHB", 0x40 | local, 0, 0, message, len(fields))
    return head + b"".join(struct.pack("<BBB", *field) for field in fields)


def fit_ride(
    start_s: int, speed_kmh: Sequence[float], cadence_rpm: Sequence[int], power_w: Sequence[int]
) -> bytes:
    """A whole activity, one sample a second. start_s: Unix time of the first."""
    body = definition(0, FILE_ID, [(0, 1, ENUM), (4, 4, UINT32)])
    body += struct.pack("<BBI", 0, 4, start_s - FIT_EPOCH_S)
    body += definition(1, RECORD, [(253, 4, UINT32), (6, 2, UINT16), (4, 1, UINT8), (7, 2, UINT16)])
    for second, (speed, cadence, power) in enumerate(
        zip(speed_kmh, cadence_rpm, power_w, strict=True)
    ):
        millimetres_per_s = round(speed / 3.6 * 1000.0)
        time_s = start_s - FIT_EPOCH_S + second
        body += struct.pack("<BIHBH", 1, time_s, millimetres_per_s, cadence, power)
    head = struct.pack("<BBHI4s", 14, 0x20, 2132, len(body), b".FIT")
    head += struct.pack("<H", crc16(head))
    return head + body + struct.pack("<H", crc16(head + body))
