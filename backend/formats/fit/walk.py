"""The walk through a sound FIT file: from the first message to exactly the last."""

from __future__ import annotations

from dataclasses import dataclass, field

from fastcrc import crc16

from backend.formats.fit.layout import (
    CHECKSUM_BYTES,
    COMPRESSED,
    COMPRESSED_MASK,
    COMPRESSED_SHIFT,
    DEFINITION,
    LOCAL_MASK,
    LOCALS,
    OFFSET_MASK,
    Definition,
    Part,
    declared_end,
    header_size,
    read_definition,
)


@dataclass
class Clock:
    """The last time a file told, which compressed headers count on from."""

    at: int = 0
    definition: Definition | None = None
    time_s: int | None = None

    def tick(self, data: bytes, offset_s: int) -> int | None:
        """FIT time of a message whose header tells the time's lowest five bits; None for none."""
        if self.definition is not None:
            self.time_s = self.definition.time_s(data, self.at)
            self.definition = None
        if self.time_s is None:
            return None
        self.time_s += (offset_s - self.time_s) & OFFSET_MASK
        return self.time_s


@dataclass
class Walk:
    """Where a walk is: definitions in force by local number, and the clock."""

    part: Part = field(default_factory=Part)
    definitions: list[Definition | None] = field(default_factory=lambda: [None] * LOCALS)
    clock: Clock = field(default_factory=Clock)


def sound_parts(data: bytes) -> list[Part] | None:
    """The files of a chain when each is sound: sizes, definitions and checksum; else None."""
    parts, at = [], 0
    while at < len(data):
        end = declared_end(data, at)
        if end is None or end + CHECKSUM_BYTES > len(data):
            return None
        if not checksum_fits(data, at, end):
            return None
        walk = Walk()
        if go_on(data, at + header_size(data, at), end, walk) != end:
            return None
        parts.append(walk.part)
        at = end + CHECKSUM_BYTES
    return parts


def checksum_fits(data: bytes, at: int, end: int) -> bool:
    """Whether the two bytes at `end` are the CRC-16/ARC of the bytes from `at`."""
    declared = int.from_bytes(data[end : end + CHECKSUM_BYTES], "little")
    return end + CHECKSUM_BYTES <= len(data) and crc16.arc(memoryview(data)[at:end]) == declared


def go_on(data: bytes, at: int, end: int, walk: Walk) -> int:
    """Take messages from `at` to `end`; returns `end`, or where a message cannot be one."""
    definitions, clock = walk.definitions, walk.clock
    while at < end:
        head = data[at]
        if head & COMPRESSED:
            definition = definitions[head >> COMPRESSED_SHIFT & COMPRESSED_MASK]
        elif head & DEFINITION:
            result = read_definition(data, at, end)
            if result is None:
                return at
            definitions[head & LOCAL_MASK] = walk.part.add(result[0], data[at + 1 : result[1]])
            at = result[1]
            continue
        else:
            definition = definitions[head & LOCAL_MASK]
        if definition is None or at + definition.size > end:
            return at
        if head & COMPRESSED:
            time_s = clock.tick(data, head & OFFSET_MASK)
            if time_s is not None:
                definition.time_of_offset[at] = time_s
        elif definition.time_at:
            clock.at, clock.definition = at, definition
        definition.offsets.append(at)
        at += definition.size
    return at
