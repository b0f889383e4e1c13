"""FIT's numbers that reading and writing share, after Garmin's public description (21.218)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

EPOCH_S = 631_065_600
"""FIT's zero, 1989-12-31, in Unix time."""

FILE_ID, SESSION, LAP, RECORD, EVENT, DEVICE_INFO, ACTIVITY = 0, 18, 19, 20, 21, 23, 34
FIELD_DESCRIPTION, DEVELOPER_DATA_ID = 206, 207
TIMESTAMP = 253

ENUM, SINT8, UINT8, UINT16, SINT32, UINT32, UINT32Z = 0x00, 0x01, 0x02, 0x84, 0x85, 0x86, 0x8C
FLOAT32, TEXT, BYTES = 0x88, 0x07, 0x0D


@dataclass(frozen=True)
class BaseType:
    """code: of `struct` and numpy, "" for text and plain bytes. invalid: the raw "no value"."""

    code: str
    invalid: int | None = None

    @property
    def size(self) -> int:
        """Bytes of one value."""
        return struct.calcsize(f"<{self.code}") if self.code else 1


BASE_TYPES: dict[int, BaseType] = {
    ENUM: BaseType("B", 0xFF),
    SINT8: BaseType("b", 0x7F),
    UINT8: BaseType("B", 0xFF),
    0x83: BaseType("h", 0x7FFF),
    UINT16: BaseType("H", 0xFFFF),
    SINT32: BaseType("i", 0x7FFFFFFF),
    UINT32: BaseType("I", 0xFFFFFFFF),
    TEXT: BaseType(""),
    FLOAT32: BaseType("f"),
    0x89: BaseType("d"),
    0x0A: BaseType("B", 0),
    0x8B: BaseType("H", 0),
    UINT32Z: BaseType("I", 0),
    BYTES: BaseType(""),
    0x8E: BaseType("q", 0x7FFFFFFFFFFFFFFF),
    0x8F: BaseType("Q", 0xFFFFFFFFFFFFFFFF),
    0x90: BaseType("Q", 0),
}
