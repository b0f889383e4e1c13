"""images.json: changes to the factory image and the violations both sides must name.

What is expected follows from the registry's row alone: a value one step outside its range, a
choice that does not exist, bytes that are no text, points that do not rise.
"""

import struct
from collections.abc import Iterator
from typing import Any

from firmware_protocol.generate.registry import Registry
from firmware_protocol.layout import NONE_BITS, STRUCT_CODES, Parameter

Violation = tuple[int, int, str]
Row = tuple[str, dict[int, bytes], list[Violation]]

OTHER_NANS = (NONE_BITS | 0x80000000, NONE_BITS + 1, 0x7F800001)
"""Negative, with a payload, signalling: none of them says none."""
NOT_TEXTS = {
    "a lone continuation byte": b"\x80",
    "an overlong slash": b"\xc0\xaf",
    "an overlong euro sign": b"\xf0\x82\x82\xac",
    "a surrogate": b"\xed\xa0\x80",
    "above U+10FFFF": b"\xf4\x90\x80\x80",
    "a sequence that ends early": b"\xe2\x82",
    "a line break": b"a\nb",
    "a delete character": b"a\x7f",
    "a letter after a zero": b"a\0b",
    "a byte UTF-8 never has": b"\xff",
}
TEXTS = {
    "empty": b"",
    "Chinese": "助力".encode(),
    "the last code point": "\U0010ffff".encode(),
    "two, three and four bytes": "é€😀".encode(),
}


def cases(registry: Registry) -> list[dict[str, Any]]:
    """Each case: bytes to put at offsets of the factory image, and what is then wrong."""
    rows = [row for parameter in registry.parameters for row in _rows(registry, parameter)]
    rows = [_with_orders(registry, row) for row in [*rows, *_order_rows(registry)]]
    return [
        {
            "name": name,
            "changes": [[offset, data.hex()] for offset, data in changes.items()],
            "violations": violations,
        }
        for name, changes, violations in rows
    ]


def _rows(registry: Registry, row: Parameter) -> Iterator[Row]:
    last = row.count - 1
    at = row.image_offset + last * row.length
    if row.type == "text":
        for words, text in TEXTS.items():
            yield f"{row.name}: {words}", {at: text.ljust(row.length, b"\0")}, []
        for words, text in NOT_TEXTS.items():
            found = [(row.id, last, "NOT_TEXT")]
            yield f"{row.name}: {words}", {at: text.ljust(row.length, b"\0")}, found
        yield f"{row.name}: full", {at: b"x" * row.length}, []
        return
    if row.enum is not None:
        choices = len(registry.enum(row.enum).members)
        yield f"{row.name}: last choice", {at: bytes([choices - 1])}, []
        yield (
            f"{row.name}: no such choice",
            {at: bytes([choices])},
            [(row.id, last, "NOT_A_CHOICE")],
        )
        return
    yield from _number_rows(row, at, last)


def _number_rows(row: Parameter, at: int, last: int) -> Iterator[Row]:
    assert row.min is not None
    assert row.max is not None
    code = "<" + STRUCT_CODES[row.type]
    least, most = struct.pack(code, row.min), struct.pack(code, row.max)
    below, above = [(row.id, last, "BELOW_MIN")], [(row.id, last, "ABOVE_MAX")]
    yield f"{row.name}: largest", {at: most}, []
    if most != b"\xff" * row.length:
        yield f"{row.name}: above the largest", {at: _stepped(code, most, 1)}, above
    if row.increasing:
        before = at - row.length
        flat = [(row.id, last, "NOT_INCREASING")]
        yield f"{row.name}: flat", {before: most, at: most}, flat
        near = struct.pack(code, row.max - 0.98 * row.least_step)
        yield f"{row.name}: too near", {before: near, at: most}, flat
        apart = struct.pack(code, row.max - row.least_step)
        yield f"{row.name}: as near as may be", {before: apart, at: most}, []
        yield f"{row.name}: denormal steps", *_denormal_points(row)
        yield f"{row.name}: least", {row.image_offset: least}, []
    else:
        yield f"{row.name}: least", {at: least}, []
        if row.type == "f32" or row.min > 0:
            yield f"{row.name}: below the least", {at: _stepped(code, least, -1)}, below
    if row.type == "f32":
        not_finite = [(row.id, last, "NOT_FINITE")]
        for value in (float("nan"), float("inf"), float("-inf")):
            found = [] if row.may_be_none and value != value else not_finite
            yield f"{row.name}: {value}", {at: struct.pack("<f", value)}, found
        for bits in OTHER_NANS if row.may_be_none else ():
            yield f"{row.name}: NaN {bits:08x}", {at: struct.pack("<I", bits)}, not_finite


def _denormal_points(row: Parameter) -> tuple[dict[int, bytes], list[Violation]]:
    """Every point the next float after the one before: increasing, and nothing to divide by."""
    points = [struct.pack("<i", index) for index in range(row.count)]
    changes = {row.image_offset: b"".join(points)}
    return changes, [(row.id, index, "NOT_INCREASING") for index in range(1, row.count)]


def _stepped(code: str, data: bytes, direction: int) -> bytes:
    """The next value the type can hold, upwards or downwards."""
    if code != "<f":
        return struct.pack(code, struct.unpack(code, data)[0] + direction)
    bits, value = struct.unpack("<i", data)[0], struct.unpack("<f", data)[0]
    if value == 0:
        return struct.pack("<f", direction * 1.4e-45)
    return struct.pack("<i", bits + (direction if value > 0 else -direction))


def _order_rows(registry: Registry) -> Iterator[Row]:
    by_name = {row.name: row for row in registry.parameters}
    for order in registry.orders:
        low, high = by_name[order.low].image_offset, by_name[order.high].image_offset
        for words, value in (("below", 12.25), ("equal to", 12.5), ("above", 12.75)):
            changes = {low: struct.pack("<f", value), high: struct.pack("<f", 12.5)}
            yield f"{order.low} {words} {order.high}", changes, []


def _with_orders(registry: Registry, row: Row) -> Row:
    """The case with the rules between parameters added to what must be wrong."""
    name, changes, violations = row
    by_name = {parameter.name: parameter for parameter in registry.parameters}
    found = list(violations)
    for order in registry.orders:
        low, high = by_name[order.low], by_name[order.high]
        values = [
            struct.unpack("<f", changes.get(p.image_offset, struct.pack("<f", p.default)))[0]
            for p in (low, high)
        ]
        if values[0] >= values[1]:
            found.append((high.id, 0, order.violation))
    return name, changes, found
