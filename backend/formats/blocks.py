"""Ride logs of our own units: blocks that each stand alone (firmware_protocol/SPEC.md, 11).

No magic is trusted: a block is one whose check value is right. After anything else reading goes on
at the next byte, so damage costs the blocks it hit. Order, duplicates, an erased tail, blocks of
other logs and of kinds we do not know make no difference.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

MAGIC = b"EBLL"
VERSION = 1
HEADER = struct.Struct("<4sBBHIIIQHH")
CHECK = struct.Struct("<I")
# Flash programs at most 4 KiB at once; whoever claims more is no block.
PAYLOAD_BYTES_MAX = 4096 - HEADER.size - CHECK.size
PAGE_BYTES = 512
BLOCKS_SUFFIX = ".ebll"
ERASED = b"\xff"

CONFIG, SCHEMA, DATA, EVENT, SYNC, END, CONFIG_REST = range(1, 8)
EVENT_FIELDS = struct.Struct("<QBH")
# One for each event, behind all of them; a log of an older unit ends before them.
EVENT_FLAGS_HIGH = struct.Struct("<H")
SYNC_FIELDS = struct.Struct("<QI")
# Number of a block that a host appended to a log.
HOST_SEQ = 0xFFFFFFFF


@dataclass(frozen=True, slots=True)
class Block:
    """One whole block. offset: of its first byte in the file. seq: its number in its log."""

    offset: int
    version: int
    type: int
    log_id: int
    boot_id: int
    seq: int
    t0_us: int
    n: int
    schema_id: int
    payload: bytes


@dataclass(frozen=True)
class Scan:
    """Every whole block in the order of the file. damaged: bytes that are none and not erased."""

    blocks: tuple[Block, ...]
    damaged: int
    first_damage: int | None


def looks_like_blocks(head: bytes) -> bool:
    """Whether a file's first bytes hold a whole block."""
    return next(find_blocks(head), None) is not None


def scan(data: bytes) -> Scan:
    """Every block in `data`, whatever else is in it."""
    blocks = []
    damaged = 0
    first_damage: int | None = None
    at = 0
    for block in find_blocks(data):
        blocks.append(block)
        damaged, first_damage = _note_between(data, at, block.offset, damaged, first_damage)
        at = block.offset + HEADER.size + len(block.payload) + CHECK.size
    damaged, first_damage = _note_between(data, at, len(data), damaged, first_damage)
    return Scan(tuple(blocks), damaged, first_damage)


def find_blocks(data: bytes) -> Iterator[Block]:
    """Whole blocks in the order of the file."""
    at = data.find(MAGIC)
    while at >= 0:
        block = block_at(data, at)
        if block is None:
            at = data.find(MAGIC, at + 1)
            continue
        yield block
        at = data.find(MAGIC, at + HEADER.size + len(block.payload) + CHECK.size)


def block_at(data: bytes, at: int) -> Block | None:
    """The block that begins at byte `at`, None when it is not whole."""
    if at + HEADER.size + CHECK.size > len(data):
        return None
    _, version, kind, length, log_id, boot_id, seq, t0_us, n, schema_id = HEADER.unpack_from(
        data, at
    )
    end = at + HEADER.size + length
    if length > PAYLOAD_BYTES_MAX or end + CHECK.size > len(data):
        return None
    if zlib.crc32(data[at:end]) != CHECK.unpack_from(data, end)[0]:
        return None
    payload = bytes(data[at + HEADER.size : end])
    return Block(at, version, kind, log_id, boot_id, seq, t0_us, n, schema_id, payload)


def encode_block(block: Block) -> bytes:
    """A block as it lies in a log, its page filled up with 0xFF; `offset` is not used."""
    header = HEADER.pack(
        MAGIC,
        block.version,
        block.type,
        len(block.payload),
        block.log_id,
        block.boot_id,
        block.seq,
        block.t0_us,
        block.n,
        block.schema_id,
    )
    body = header + block.payload
    page = body + CHECK.pack(zlib.crc32(body))
    return page + ERASED * (-len(page) % PAGE_BYTES)


def sync_block(log_id: int, boot_id: int, t0_us: int, unix_us: int) -> bytes:
    """What a host knows that the unit did not: the Unix time at unit time `t0_us` of a boot."""
    payload = SYNC_FIELDS.pack(unix_us, 1000)
    return encode_block(Block(0, VERSION, SYNC, log_id, boot_id, HOST_SEQ, t0_us, 1, 0, payload))


def _note_between(
    data: bytes, start: int, stop: int, damaged: int, first: int | None
) -> tuple[int, int | None]:
    """Count what lies between two blocks and is not erased flash."""
    between = data[start:stop]
    rest = len(between) - between.count(ERASED)
    if rest and first is None:
        first = start + next(at for at, byte in enumerate(between) if byte != 0xFF)
    return damaged + rest, first
