"""messages.json: every request, response and event with the least, usual and largest values."""

import struct
from typing import Any

from firmware_protocol.generate.registry import Layout, Registry
from firmware_protocol.layout import HALF_BITS, STRUCT_CODES, Field

SIZES = {"least": 0, "usual": 1, "largest": 2}


def cases(registry: Registry) -> list[dict[str, Any]]:
    """One case for each message, direction and size: the fields and the frame they must give."""
    found = []
    room = int(registry.protocol["mtu"]) - 8
    for size in SIZES:
        for position, row in enumerate(registry.messages, start=1):
            tid = 255 if size == "largest" else position
            header = struct.pack("<BH", tid, row.id)
            for kind, layout, head in (
                ("request", row.request, b"\x20" + header),
                ("response", row.response, b"\x28" + header + b"\0"),
            ):
                found += _cases(row.name, kind, layout, head, size, room)
        for name, layout in registry.events:
            code = registry.enum("event").members[name]
            head = b"\x38\x00" + struct.pack("<HBI", 513, code, 1_000_000)
            found += _cases(name, "event", layout, head, size, room)
    return found


def _cases(
    name: str, kind: str, layout: Layout, head: bytes, size: str, room: int
) -> list[dict[str, Any]]:
    """What is sent; where a number has a high half, first what a peer that has none of it sends."""
    found = [_case(name, kind, Layout(layout.members), head, size, room)]
    if layout.full_length != layout.length:
        found.append(_case(name, kind, layout, head, size, room))
        found[-1]["name"] += ", both halves"
    return found


def _case(
    name: str, kind: str, layout: Layout, head: bytes, size: str, room: int
) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    payload = b""
    for position, field in enumerate(layout.fields):
        if field.type == "bytes":
            length = (0, 5, room - (len(head) - 4) - layout.full_length)[SIZES[size]]
            data = bytes((index * 7 + 1) % 256 for index in range(length))
            fields[field.name] = data.hex()
            payload += data
            continue
        values = [_number(field, size, position + index) for index in range(field.count)]
        data = struct.pack(f"<{field.count}{STRUCT_CODES[field.type]}", *values)
        payload += data
        if field.high_of:
            fields[field.high_of] |= values[0] << HALF_BITS
        elif field.count == 1:
            fields[field.name] = values[0]
        else:
            fields[field.name] = data.hex() if field.type == "u8" else values
    return {
        "name": f"{name} {kind}, {size} values",
        "kind": kind,
        "message": name,
        "fields": fields,
        "frame": (head + payload).hex(),
    }


def _number(field: Field, size: str, position: int) -> int:
    """Zero, a number whose every byte differs from its neighbours, or all bits set."""
    width = struct.calcsize("<" + STRUCT_CODES[field.type])
    usual = int.from_bytes(bytes((16 * position + at + 1) % 256 for at in range(width)), "little")
    found = (0, usual, (1 << 8 * width) - 1)[SIZES[size]]
    signed = field.type.startswith("i") and found >= 1 << (8 * width - 1)
    return found - (1 << 8 * width) if signed else found
