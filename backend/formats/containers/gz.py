"""gzip: one file within another. What can be inflated is, up to the first damage."""

from __future__ import annotations

import zlib
from contextlib import suppress
from dataclasses import dataclass

GZIP = b"\x1f\x8b"
# Window bits of zlib by which it takes gzip's own header and checks its CRC.
GZIP_BITS = 31
# A ride of a day is 10 MB as FIT, 60 MB as GPX; more is a bomb (48 kB become 50 MB), not a ride.
INFLATED_BYTES_MAX = 128 * 1024 * 1024
PIECE_BYTES = 4096


class TooLarge(Exception):
    """More bytes than any ride has."""


@dataclass(frozen=True)
class Inflated:
    """What came out. error: a sentence where it is not all that went in."""

    data: bytes
    error: str | None = None


def inflate(data: bytes) -> Inflated:
    """The bytes within a gzip file of one or several members. Raises TooLarge."""
    inflated = bytearray()
    left = data
    while left.startswith(GZIP):
        one = zlib.decompressobj(GZIP_BITS)
        try:
            inflated += one.decompress(left, INFLATED_BYTES_MAX + 1 - len(inflated))
        except zlib.error as error:
            inflated += salvaged(left, INFLATED_BYTES_MAX - len(inflated))
            return Inflated(bytes(inflated), f"The gzip file is damaged: {error}.")
        if len(inflated) > INFLATED_BYTES_MAX:
            raise TooLarge
        if not one.eof:
            return Inflated(bytes(inflated), "The gzip file ends too early.")
        left = one.unused_data
    return Inflated(bytes(inflated))


def salvaged(data: bytes, size_max: int) -> bytes:
    """What comes out before the damage. Raises TooLarge."""
    one = zlib.decompressobj(GZIP_BITS)
    inflated = bytearray()
    for start in range(0, len(data), PIECE_BYTES):
        piece, before = data[start : start + PIECE_BYTES], one.copy()
        try:
            inflated += one.decompress(piece)
        except zlib.error:
            # What the piece with the damage gave before it: byte by byte.
            with suppress(zlib.error):
                for at in range(len(piece)):
                    inflated += before.decompress(piece[at : at + 1])
            break
        if len(inflated) > size_max:
            raise TooLarge
    return bytes(inflated)


def inflated_head(head: bytes, size: int) -> bytes:
    """The first bytes within a gzip file, as far as its own first bytes tell them."""
    try:
        return zlib.decompressobj(GZIP_BITS).decompress(head, size)
    except zlib.error:
        return b""


def inner_name(name: str) -> str:
    """`ride.fit.gz` -> `ride.fit`."""
    return name[:-3] if name.lower().endswith(".gz") else name
