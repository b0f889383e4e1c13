"""How a FIT file is laid out: headers, definitions, and where each message begins.

After Garmin's public description of the format. A definition tells the size of every data message
that follows under its number, so a file is a chain: whoever loses the place must find it again.
"""

from __future__ import annotations

import struct
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from backend.formats.fit_numbers import BASE_TYPES, TIMESTAMP, UINT32

HEADER_SIZES = (12, 14)
MAGIC = b".FIT"
MAGIC_AT = 8
CHECKSUM_BYTES = 2
LOCALS = 16

# Header byte of a message.
COMPRESSED, DEFINITION, DEVELOPER = 0x80, 0x40, 0x20
LOCAL_MASK, COMPRESSED_MASK, OFFSET_MASK = 0x0F, 0x03, 0x1F
COMPRESSED_SHIFT = 5

DEFINITION_BYTES = 6
FIELD_BYTES = 3


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a message. at: byte behind the header byte. developer: whose field it is."""

    number: int
    size: int
    base: int
    at: int
    developer: int | None = None


@dataclass(slots=True)
class Definition:
    """What messages under one local number look like, and where those are.

    size: bytes of a data message with its header byte. time_at: where in it the timestamp stands,
    0 for nowhere. offsets: header bytes of its messages. time_of_offset: FIT times of compressed
    headers, by offset.
    """

    message: int
    little: bool
    fields: tuple[Field, ...]
    size: int
    time_at: int
    at: int
    offsets: array[int] = field(default_factory=lambda: array("q"))
    time_of_offset: dict[int, int] = field(default_factory=dict)

    def time_s(self, data: bytes, offset: int) -> int | None:
        """FIT time of the message at `offset`; None when it has none or it is invalid."""
        if not self.time_at:
            return None
        order = "<I" if self.little else ">I"
        (time_s,) = struct.unpack_from(order, data, offset + self.time_at)
        return None if time_s == BASE_TYPES[UINT32].invalid else int(time_s)


@dataclass(slots=True)
class Part:
    """One file of a chain: its definitions, those of the same bytes as one."""

    definitions: dict[bytes, Definition] = field(default_factory=dict)

    def add(self, definition: Definition, encoded: bytes) -> Definition:
        """The definition in force from now on. encoded: its bytes, but for the local number."""
        return self.definitions.setdefault(encoded, definition)

    def of(self, message: int) -> Iterator[Definition]:
        """Definitions of one kind of message that has any."""
        return (d for d in self.definitions.values() if d.message == message and d.offsets)

    def count(self, message: int) -> int:
        """How many messages of one kind there are."""
        return sum(len(d.offsets) for d in self.of(message))


def header_size(data: bytes, at: int) -> int:
    """Size of the file header at `at`, 0 when there is none."""
    named = data[at + MAGIC_AT : at + MAGIC_AT + len(MAGIC)] == MAGIC
    return data[at] if named and data[at] in HEADER_SIZES else 0


def declared_end(data: bytes, at: int) -> int | None:
    """Where the header at `at` says its messages end (the checksum follows); None for no header."""
    size = header_size(data, at)
    if not size:
        return None
    (length,) = struct.unpack_from("<I", data, at + 4)
    return at + size + int(length)


def read_definition(data: bytes, at: int, end: int) -> tuple[Definition, int] | None:
    """The definition whose header byte is at `at`, and where it ends; None when it is cut off."""
    if at + DEFINITION_BYTES > end:
        return None
    developer = bool(data[at] & DEVELOPER)
    little = data[at + 2] == 0
    (message,) = struct.unpack_from("<H" if little else ">H", data, at + 3)
    stop = at + DEFINITION_BYTES + FIELD_BYTES * data[at + 5]
    own_stop = stop
    if developer:
        if stop >= end:
            return None
        stop += 1 + FIELD_BYTES * data[stop]
    if stop > end:
        return None
    fields, size = [], 1
    for place in range(at + DEFINITION_BYTES, own_stop, FIELD_BYTES):
        number, length, base = data[place : place + FIELD_BYTES]
        fields.append(Field(number, length, base, size))
        size += length
    for place in range(own_stop + 1, stop, FIELD_BYTES) if developer else ():
        number, length, index = data[place : place + FIELD_BYTES]
        fields.append(Field(number, length, 0x0D, size, index))
        size += length
    time_at = next(
        (f.at for f in fields if f.number == TIMESTAMP and f.size == 4 and f.developer is None), 0
    )
    return Definition(int(message), little, tuple(fields), size, time_at, at), stop


def is_definition(head: int) -> bool:
    """Whether a message with this header byte is a definition."""
    return bool(head & DEFINITION) and not head & COMPRESSED


def definition_of(head: int, definitions: Sequence[Definition | None]) -> Definition | None:
    """The definition in force for a data message with this header byte.

    definitions: by local number.
    """
    if head & COMPRESSED:
        return definitions[head >> COMPRESSED_SHIFT & COMPRESSED_MASK]
    return definitions[head & LOCAL_MASK]


def makes_sense(definition: Definition, data: bytes) -> bool:
    """Whether a definition met behind damage is one: known types, no other architecture."""
    are_known = all(f.developer is not None or f.base in BASE_TYPES for f in definition.fields)
    return are_known and data[definition.at + 2] in (0, 1)
