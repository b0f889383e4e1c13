"""Bytes on the wire to frames and back: 00 | COBS(frame, CRC-32) | 00.

A frame is header and payload. The decoder is fed, never reads: any split of the bytes gives the
same frames, damage is counted and skipped, and the next delimiter starts afresh.
"""

import zlib
from dataclasses import dataclass

from cobs import cobs

from firmware_protocol._generated import MTU

DELIMITER = b"\x00"
CHECK_LENGTH = 4
FRAME_LENGTH_MIN = 8
"""Header and check value: the shortest thing that can be a frame."""

CRC_RESIDUE = 0x2144DF1C
RUN_LENGTH_MAX = 254


@dataclass(slots=True)
class Counts:
    """What a receiver has seen: every non-empty stretch between two delimiters is counted once.

    `cobs_errors` also counts stretches with no room for header and check value; `overflows` what
    decodes to more than the MTU.
    """

    frames_ok: int = 0
    crc_errors: int = 0
    cobs_errors: int = 0
    overflows: int = 0


def encode_frame(frame: bytes) -> bytes:
    """The wire bytes of a frame (header and payload), with both delimiters."""
    check = zlib.crc32(frame).to_bytes(CHECK_LENGTH, "little")
    stuffed: bytes = cobs.encode(frame + check)
    return DELIMITER + stuffed + DELIMITER


class FrameDecoder:
    """Takes bytes as they arrive and gives the frames that are whole and intact.

    `mtu`: the longest frame in decoded bytes, check value included. Holds at most one frame's
    bytes between calls, whatever arrives.
    """

    def __init__(self, mtu: int = MTU) -> None:
        self.stats = Counts()
        self._mtu = mtu
        self._pending_max = mtu + mtu // RUN_LENGTH_MAX + 2
        self._pending = b""
        self._overflowed = False

    def feed(self, data: bytes) -> list[bytes]:
        """The good frames that end in `data`, without their check values. Never raises."""
        stretches = (self._pending + data).split(DELIMITER)
        self._pending = stretches.pop()
        frames = []
        for stretch in stretches:
            if self._overflowed:
                self.stats.overflows += 1
                self._overflowed = False
            elif stretch:
                frame = self._decode(stretch)
                if frame is not None:
                    frames.append(frame)
        if len(self._pending) > self._pending_max:
            self._overflowed = True
        if self._overflowed:
            self._pending = b""
        return frames

    def _decode(self, stretch: bytes) -> bytes | None:
        try:
            decoded: bytes = cobs.decode(stretch)
        except cobs.DecodeError:
            if _decoded_length(stretch) > self._mtu:
                self.stats.overflows += 1
            else:
                self.stats.cobs_errors += 1
            return None
        if len(decoded) > self._mtu:
            self.stats.overflows += 1
        elif len(decoded) < FRAME_LENGTH_MIN:
            self.stats.cobs_errors += 1
        elif zlib.crc32(decoded) != CRC_RESIDUE:
            self.stats.crc_errors += 1
        else:
            self.stats.frames_ok += 1
            return decoded[:-CHECK_LENGTH]
        return None


def _decoded_length(stretch: bytes) -> int:
    """Bytes that a stretch cut short had given before it ended."""
    length = 0
    at = 0
    while at < len(stretch):
        code = stretch[at]
        run = min(code - 1, len(stretch) - at - 1)
        length += run
        at += code
        if code <= RUN_LENGTH_MAX and at < len(stretch):
            length += 1
    return length
