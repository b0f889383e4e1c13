"""The configuration in a unit's flash, read and written by hand: what SPEC.md says of slots.

EBL3: a header twice, three state words, four records of items by parameter id.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from firmware_protocol import parameters
from firmware_protocol._generated import PARAMETER_BY_ID, PARAMETERS

RECORDS = ("MARKET", "FACTORY", "CALIBRATION", "TUNABLE")
HEADER = struct.Struct("<4sIIIIHH")
ROW = struct.Struct("<IHH")
ITEM = struct.Struct("<HBB")
AT_CONFIRMED, AT_VOID, AT_TABLE, AT_COPY, AT_RECORDS = 28, 32, 36, 68, 124
AT_PROVISIONAL = 24
HEADER_BYTES = 24
WRITTEN, ERASED = bytes(4), b"\xff" * 4


@dataclass(frozen=True)
class Item:
    """One parameter's values in a record. size: bytes of an element."""

    id: int
    count: int
    size: int
    values: bytes

    def packed(self) -> bytes:
        return ITEM.pack(self.id, self.count, self.size) + self.values


def items_of(image: bytes) -> list[Item]:
    """This firmware's image, parameter by parameter."""
    return [
        Item(p.id, p.count, p.length, image[p.image_offset : p.image_offset + p.size])
        for p in PARAMETERS
    ]


def slot(
    items: Iterable[Item], generation: int, worn_until_s: int = 0, erases: int = 1
) -> bytearray:
    """A confirmed slot of such items; what this firmware does not know lies with the tunable."""
    records: dict[str, bytes] = dict.fromkeys(RECORDS, b"")
    for item in items:
        known = PARAMETER_BY_ID.get(item.id)
        records[known.record if known else "TUNABLE"] += item.packed()
    table = b"".join(ROW.pack(zlib.crc32(r), len(r), 1) for r in records.values())
    fields = struct.pack("<IIIHH", generation, erases, worn_until_s, 1, 0xFFFF)
    header = b"EBL3" + struct.pack("<I", zlib.crc32(fields + table)) + fields
    words = ERASED + WRITTEN + ERASED
    return bytearray(header + words + table + header + table + b"".join(records.values()))


def records_at(flash: Sequence[int], at: int = 0) -> dict[str, range]:
    """Where each record of the slot at this address lies."""
    found = {}
    place = at + AT_RECORDS
    for index, name in enumerate(RECORDS):
        row = bytes(flash[at + AT_TABLE + ROW.size * index :][: ROW.size])
        length = ROW.unpack(row)[1]
        found[name] = range(place, place + length)
        place += length
    return found


def generation_at(flash: bytes, at: int) -> int:
    """Of the slot at this address."""
    return int(HEADER.unpack_from(flash, at)[2])


def image_at(flash: bytes, at: int) -> bytes:
    """The image that the slot at this address holds, of this firmware's own layout."""
    image = bytearray(parameters.pack_image(parameters.default_config()))
    for place in records_at(flash, at).values():
        here = place.start
        while here < place.stop:
            number, count, size = ITEM.unpack_from(flash, here)
            here += ITEM.size
            offset = PARAMETER_BY_ID[number].image_offset
            image[offset : offset + count * size] = flash[here : here + count * size]
            here += count * size
    return bytes(image)


def is_written(word: bytes) -> bool:
    """Whether a state word counts: two of its bits are cleared."""
    return (~int.from_bytes(word, "little") & 0xFFFFFFFF).bit_count() > 1
