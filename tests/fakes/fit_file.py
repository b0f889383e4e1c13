"""Writes small FIT activities for tests, byte by byte after Garmin's public description.

Header of 14 bytes, a file_id, a definition of `record` and a data message a row, a session,
CRC-16/ARC at the end. Nothing is shared with the readers under test.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence

# FIT counts seconds from 1989-12-31 00:00:00 UTC.
FIT_EPOCH_S = 631_065_600
START_S = 1_700_000_000
RECORD, SESSION, FILE_ID = 20, 18, 0

# field name -> number, base type, struct code, scale, offset
RECORD_FIELDS: Mapping[str, tuple[int, int, str, float, float]] = {
    "timestamp": (253, 0x86, "I", 1, 0),
    "position_lat": (0, 0x85, "i", 2**31 / 180.0, 0),
    "position_long": (1, 0x85, "i", 2**31 / 180.0, 0),
    "heart_rate": (3, 0x02, "B", 1, 0),
    "cadence": (4, 0x02, "B", 1, 0),
    "distance": (5, 0x86, "I", 100, 0),
    "speed": (6, 0x84, "H", 1000, 0),
    "power": (7, 0x84, "H", 1, 0),
    "motor_power": (82, 0x84, "H", 1, 0),
    "enhanced_altitude": (78, 0x86, "I", 5, 500),
    "ebike_battery_level": (118, 0x02, "B", 1, 0),
}
INVALID = {"I": 0xFFFFFFFF, "i": 0x7FFFFFFF, "B": 0xFF, "H": 0xFFFF}

Record = Mapping[str, float | None]


def crc16(data: bytes) -> int:
    """CRC-16/ARC, bit by bit."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ 0xA001 if crc & 1 else crc >> 1
    return crc


def definition(local: int, message: int, fields: Sequence[tuple[int, int, int]]) -> bytes:
    """A definition message; fields: number, size, base type."""
    head = struct.pack("<BBBHB", 0x40 | local, 0, 0, message, len(fields))
    return head + b"".join(struct.pack("<BBB", *field) for field in fields)


def enclosed(body: bytes, header_crc: bool = True) -> bytes:
    """Header, body and checksum."""
    header = struct.pack("<BBHI4s", 14, 0x20, 2160, len(body), b".FIT")
    header += struct.pack("<H", crc16(header) if header_crc else 0)
    return header + body + struct.pack("<H", crc16(header + body))


def fit_file(records: Sequence[Record], sport: int = 2, header_crc: bool = True) -> bytes:
    """An activity: file_id, records, one session. Times in Unix seconds; None is FIT's invalid."""
    names = list(dict.fromkeys(name for record in records for name in record))
    layout = [RECORD_FIELDS[name] for name in names]
    body = definition(0, FILE_ID, [(0, 1, 0x00), (4, 4, 0x86)])
    body += struct.pack("<BBI", 0, 4, START_S - FIT_EPOCH_S)
    fields = [(number, struct.calcsize(code), base) for number, base, code, _, _ in layout]
    body += definition(1, RECORD, fields)
    for record in records:
        body += b"\x01"
        for name, (_, _, code, scale, offset) in zip(names, layout, strict=True):
            value = record.get(name)
            if value is None:
                body += struct.pack(f"<{code}", INVALID[code])
                continue
            shift = -FIT_EPOCH_S if name == "timestamp" else offset
            body += struct.pack(f"<{code}", round((value + shift) * scale))
    body += definition(2, SESSION, [(253, 4, 0x86), (5, 1, 0x00)])
    body += struct.pack("<BIB", 2, START_S - FIT_EPOCH_S, sport)
    return enclosed(body, header_crc)


def commute(rows: int, start_s: int = START_S) -> list[dict[str, float | None]]:
    """A steady ride of one record a second: 18 km/h, 150 W, 75 rpm."""
    return [
        {
            "timestamp": start_s + row,
            "position_lat": 48.0 + row * 4.5e-5,
            "position_long": 11.0,
            "heart_rate": 120,
            "cadence": 75,
            "distance": 5.0 * row,
            "speed": 5.0,
            "power": 150,
            "motor_power": 200,
            "enhanced_altitude": 520.2,
            "ebike_battery_level": 80,
        }
        for row in range(rows)
    ]


def fit_ride(
    start_s: int, speed_kmh: Sequence[float], cadence_rpm: Sequence[int], power_w: Sequence[int]
) -> bytes:
    """A whole activity, one sample a second. start_s: Unix time of the first."""
    rows = zip(speed_kmh, cadence_rpm, power_w, strict=True)
    return fit_file(
        [
            {"timestamp": start_s + row, "speed": speed / 3.6, "cadence": cadence, "power": power}
            for row, (speed, cadence, power) in enumerate(rows)
        ]
    )
