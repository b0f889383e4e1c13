"""framing.json, damage.json and verdicts.json: byte stuffing, broken lines, odd frames.

What is expected is stated by how each case is made; only the stuffing itself comes from the
`cobs` package and zlib, which share no code with the unit.
"""

import struct
import zlib
from typing import Any

from cobs import cobs

from firmware_protocol.generate.registry import Registry

LENGTHS = (*range(5), *range(248, 257), *range(502, 512), 540)
PATTERNS = ("zeros", "ones", "counting")
PING = bytes.fromhex("20070200")


def pattern(name: str, length: int) -> bytes:
    """Bytes of a named pattern: all zero, no zero, or counting through both."""
    if name == "counting":
        return bytes(at % 256 for at in range(length))
    return (b"\0" if name == "zeros" else b"\1") * length


def wire(frame: bytes) -> bytes:
    """The frame on the wire."""
    stuffed: bytes = cobs.encode(frame + struct.pack("<I", zlib.crc32(frame)))
    return b"\0" + stuffed + b"\0"


def framing_cases() -> list[dict[str, Any]]:
    """Wire bytes of patterns at the edges of the runs of 254; under 4 bytes is no frame."""
    return [
        {
            "name": f"{length} bytes, {name}",
            "pattern": name,
            "length": length,
            "wire": wire(pattern(name, length)).hex(),
            "accepted": length >= 4,
        }
        for length in LENGTHS
        for name in PATTERNS
    ]


def damage_cases(mtu: int) -> list[dict[str, Any]]:
    """Streams of bytes, the frames that must come out, and what must be counted."""
    good = wire(PING)
    other = wire(bytes.fromhex("2807020000"))
    long = wire(pattern("ones", mtu - 4))
    over = wire(pattern("ones", mtu - 3))
    flipped = bytes([*good[:3], good[3] ^ 0x10, *good[4:]])
    full_run = wire(_frame_with_full_last_run())
    wrong_check = b"\0" + cobs.encode(PING + b"\1\2\3\4") + b"\0"
    rows: list[tuple[str, bytes, int, tuple[int, int, int]]] = [
        ("nothing", b"", 0, (0, 0, 0)),
        ("delimiters only", b"\0" * 9, 0, (0, 0, 0)),
        ("one frame", good, 1, (0, 0, 0)),
        ("two frames glued", good + other, 2, (0, 0, 0)),
        ("two frames sharing a delimiter", good + other[1:], 2, (0, 0, 0)),
        ("no leading delimiter", good[1:], 1, (0, 0, 0)),
        ("no trailing delimiter", good[:-1], 0, (0, 0, 0)),
        ("a flipped bit", flipped, 0, (1, 0, 0)),
        ("a wrong check value", wrong_check, 0, (1, 0, 0)),
        ("noise, then a frame", b"\x03\x41\x42" + good, 1, (0, 1, 0)),
        ("cut short inside a run", good[:-3] + b"\0" + other, 1, (0, 1, 0)),
        ("cut short to one code", b"\0\x05\0" + good, 1, (0, 1, 0)),
        ("a code of 255 alone", b"\0\xff\0" + good, 1, (0, 1, 0)),
        ("an empty run", b"\0\x01\0" + good, 1, (0, 1, 0)),
        ("the longest frame", long, 1, (0, 0, 0)),
        ("one byte too long", over + good, 1, (0, 0, 1)),
        ("far too long", b"\0" + b"\x02\x41" * 4000 + b"\0" + good, 1, (0, 0, 1)),
        ("too long and cut short", b"\0" + b"\x02\x41" * 300 + b"\x09\0" + good, 1, (0, 0, 1)),
        ("too long and never ended", b"\0" + b"\x41" * 5000, 0, (0, 0, 0)),
        ("all bits set", b"\xff" * 2000 + b"\0" + good, 1, (0, 0, 1)),
        ("a full last run", full_run, 1, (0, 0, 0)),
        ("a full last run and an empty one", full_run[:-1] + b"\x01\0", 1, (0, 0, 0)),
        ("two frames around damage", good + flipped + other, 2, (1, 0, 0)),
    ]
    for length in range(4):
        short = wire(pattern("counting", length))
        rows.append((f"a frame of {length} bytes", short + good, 1, (0, 1, 0)))
    return [
        {
            "name": name,
            "wire": data.hex(),
            "frames_ok": ok,
            "crc_errors": crc,
            "cobs_errors": stuffing,
            "overflows": over_mtu,
        }
        for name, data, ok, (crc, stuffing, over_mtu) in rows
    ]


def _frame_with_full_last_run() -> bytes:
    """A frame that ends, check value included, in exactly one run of 254 bytes."""
    for number in range(1, 256):
        frame = bytes([number]) * 250
        if 0 not in struct.pack("<I", zlib.crc32(frame)):
            return frame
    raise AssertionError("some frame of 255 has no zero in its check value")


def verdict_cases(registry: Registry) -> list[dict[str, str]]:
    """Whole frames with a good check value and what must be said about each."""
    rows: list[tuple[str, bytes, str]] = []
    rows += [(f"a header of {length} bytes", PING[:length], "LENGTH") for length in range(4)]
    majors = (0, 2, 3, 4, 5, 6, 7)
    rows += [(f"major {major}", bytes([major << 5]) + PING[1:], "VERSION") for major in majors]
    rows.append(("header bit 2", b"\x24" + PING[1:], "RESERVED"))
    rows.append(("header bit 2 in a response", bytes.fromhex("2c07020000"), "RESERVED"))
    rows.append(("MORE", b"\x21" + PING[1:], "OK"))
    rows.append(("RETRANSMIT", b"\x22" + PING[1:], "OK"))
    rows.append(("transaction id 0", b"\x20\x00\x02\x00", "OK"))
    for message_id in (0x0000, 0x00FF, 0x01FF, 0x0900, 0x7003, 0xFFFF):
        request = b"\x20\x07" + struct.pack("<H", message_id)
        response = b"\x28\x07" + struct.pack("<H", message_id)
        rows.append((f"request of unknown message 0x{message_id:04x}", request, "UNKNOWN_MSG"))
        rows.append((f"success of unknown 0x{message_id:04x}", response + b"\0", "UNKNOWN_MSG"))
        rows.append((f"refusal of unknown 0x{message_id:04x}", response + b"\2\0\0", "OK"))
    rows += _length_rows(registry) + _status_rows(registry)
    rows += _stream_rows() + _event_rows(registry)
    return [
        {"name": name, "frame": frame.hex(), "verdict": verdict} for name, frame, verdict in rows
    ]


def _length_rows(registry: Registry) -> list[tuple[str, bytes, str]]:
    rows = []
    for row in registry.messages:
        header = struct.pack("<BH", 7, row.id)
        for kind, layout, head in (
            ("request", row.request, b"\x20" + header),
            ("response", row.response, b"\x28" + header + b"\0"),
        ):
            if layout.length:
                frame = head + b"\1" * (layout.length - 1)
                rows.append((f"{row.name} {kind}, one byte short", frame, "LENGTH"))
            frame = head + b"\1" * (layout.length + 3)
            rows.append((f"{row.name} {kind}, longer than we know", frame, "OK"))
    return rows


def _status_rows(registry: Registry) -> list[tuple[str, bytes, str]]:
    statuses = {name: code for name, code in registry.enum("status").members.items() if code}
    head = bytes.fromhex("28070200")
    rows = [
        (f"refusal {name}", head + struct.pack("<BH", code, 0x1234), "OK")
        for name, code in statuses.items()
    ]
    rows.append(("refusal with a code we do not know", head + b"\x63\x34\x12", "OK"))
    rows.append(("refusal with more than its detail", head + b"\x0d\1\0abcd", "OK"))
    rows.append(("refusal with half a detail", head + b"\x02\x34", "LENGTH"))
    rows.append(("refusal without a detail", head + b"\x02", "LENGTH"))
    rows.append(("response without a status", head, "LENGTH"))
    return rows


def _stream_rows() -> list[tuple[str, bytes, str]]:
    head = bytes.fromhex("30010102") + struct.pack("<I", 1_000_000)
    return [
        ("stream without rows", head + b"\0\0", "OK"),
        ("stream of no rows with values", head + b"\0\0\1\0", "SHAPE"),
        ("stream of two rows of three", head + b"\2\0" + b"\1\0" * 6, "OK"),
        ("stream of two rows of nothing", head + b"\2\0", "OK"),
        ("stream with half a value", head + b"\2\0" + b"\1\0" * 6 + b"\1", "SHAPE"),
        ("stream with half a row", head + b"\2\0" + b"\1\0" * 5, "SHAPE"),
        ("stream of an encoding we do not know", head + b"\1\x20\1\0", "SHAPE"),
        ("stream of 255 rows of one", head + b"\xff\x07" + b"\1\0" * 255, "OK"),
        ("stream with overrun, clip and the last bit", head + b"\1\x9f\1\0", "OK"),
        ("stream whose head is cut", head + b"\1", "LENGTH"),
    ]


def _event_rows(registry: Registry) -> list[tuple[str, bytes, str]]:
    head = bytes.fromhex("38000102")
    rows = [
        ("event without a time", head + b"\1\0\0\0", "LENGTH"),
        ("event with a code we do not know", head + struct.pack("<BI", 99, 5), "OK"),
        ("bulk on a channel that does not exist", b"\x38\x10\0\0" + b"\0" * 8, "UNKNOWN_MSG"),
        ("bulk without its length", b"\x38\1\0\0" + b"\0" * 7, "LENGTH"),
        ("bulk of nothing", b"\x38\1\0\0" + b"\0" * 8, "SHAPE"),
        ("bulk of three bytes", b"\x38\x0f\1\0" + struct.pack("<IHH", 512, 3, 0) + b"abc", "OK"),
        (
            "bulk with a byte too many",
            b"\x38\1\1\0" + struct.pack("<IHH", 0, 2, 0) + b"abc",
            "SHAPE",
        ),
        (
            "bulk with a byte too few",
            b"\x38\1\1\0" + struct.pack("<IHH", 0, 4, 0) + b"abc",
            "SHAPE",
        ),
        (
            "bulk with its reserved word set",
            b"\x38\1\1\0" + struct.pack("<IHH", 0, 1, 9) + b"a",
            "OK",
        ),
    ]
    for name, layout in registry.events:
        code = registry.enum("event").members[name]
        frame = head + struct.pack("<BI", code, 5) + b"\1" * layout.length
        rows.append((f"event {name}, one byte short", frame[:-1], "LENGTH"))
        rows.append((f"event {name}, longer than we know", frame + b"\1\1", "OK"))
    return rows
