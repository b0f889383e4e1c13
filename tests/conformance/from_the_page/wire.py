"""Chapter 1 of SPEC.md: delimiters, COBS, CRC-32 and the header, written from the page."""

from __future__ import annotations

from dataclasses import dataclass

MAJOR = 1
REQUEST, RESPONSE, STREAM, ASYNC = range(4)
RETRANSMIT = 2


def _crc_table() -> list[int]:
    table = []
    for byte in range(256):
        value = byte
        for _ in range(8):
            value = value >> 1 ^ (0xEDB88320 if value & 1 else 0)
        table.append(value)
    return table


TABLE = _crc_table()


def crc32(data: bytes) -> int:
    """0x04C11DB7 reflected, start and final 0xFFFFFFFF."""
    value = 0xFFFFFFFF
    for byte in data:
        value = value >> 8 ^ TABLE[(value ^ byte) & 0xFF]
    return value ^ 0xFFFFFFFF


@dataclass(frozen=True)
class Frame:
    """kind, tag, word and payload as in the table of chapter 1."""

    kind: int
    tag: int
    word: int
    payload: bytes
    flags: int = 0

    def bytes(self) -> bytes:
        """Header and payload."""
        return bytes([MAJOR << 5 | self.kind << 3 | self.flags, self.tag]) + (
            self.word.to_bytes(2, "little") + self.payload
        )

    def on_the_wire(self) -> bytes:
        """With its check value, stuffed, between delimiters."""
        data = self.bytes()
        return b"\0" + stuffed(data + crc32(data).to_bytes(4, "little")) + b"\0"


def stuffed(data: bytes) -> bytes:
    """Runs of a length byte L and L-1 bytes that are not zero."""
    out = bytearray()
    run = bytearray()
    full = False
    for byte in data:
        full = False
        if byte:
            run.append(byte)
        if not byte or len(run) == 254:
            out += bytes([len(run) + 1]) + run
            full = len(run) == 254
            run.clear()
    # A final run of 254 bytes gets no empty run after it.
    return bytes(out) if full else bytes(out) + bytes([len(run) + 1]) + bytes(run)


def unstuffed(data: bytes) -> bytes | None:
    """None where a run ends early."""
    out = bytearray()
    at = 0
    while at < len(data):
        length = data[at]
        if at + length > len(data):
            return None
        out += data[at + 1 : at + length]
        at += length
        if length < 255 and at < len(data):
            out.append(0)
    return bytes(out)


class Receiver:
    """Bytes in any split to frames; what is damaged costs itself."""

    def __init__(self) -> None:
        self._rest = b""
        self.bad = 0

    def feed(self, data: bytes) -> list[Frame]:
        *stretches, self._rest = (self._rest + data).split(b"\0")
        return [frame for one in stretches if one and (frame := self._frame(one)) is not None]

    def _frame(self, stretch: bytes) -> Frame | None:
        data = unstuffed(stretch)
        if data is None or len(data) < 8 or crc32(data[:-4]).to_bytes(4, "little") != data[-4:]:
            self.bad += 1
            return None
        first = data[0]
        if first >> 5 != MAJOR or first & 4:
            return None
        word = int.from_bytes(data[2:4], "little")
        return Frame(first >> 3 & 3, data[1], word, data[4:-4], first & 3)
