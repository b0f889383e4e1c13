"""The configuration as a dictionary, as the unit's image, and as the items that change it.

Names are the registry's. Values are floats and ints, str for texts, the one spelling of choices
("fuzzy", "PB"; any case is taken), nested lists for shapes, None for a value that
may be none and is. The check here is the host's, before anything is sent; the unit checks again for
itself.
"""

import struct
from collections.abc import Iterator, Mapping
from typing import Any, cast

import numpy as np

from firmware_protocol._generated import (
    ENUM_BY_NAME,
    IMAGE_LENGTH,
    MTU,
    ORDERS,
    PARAMETER_BY_NAME,
    PARAMETERS,
)
from firmware_protocol.layout import NONE_BITS, STRUCT_CODES, Default, Parameter, Value
from firmware_protocol.parameter_values import (
    BadValue,
    ParameterViolation,
    choice_number,
    elements_of,
    float32,
    problem_of_form,
    problem_of_range,
    problem_of_step,
    respelled,
    unknown_parameter,
    violation_at,
)
from firmware_protocol.spelling import word_of

__all__ = [
    "BadImage",
    "BadValue",
    "ParameterViolation",
    "default_config",
    "pack_image",
    "pack_parameter",
    "set_items",
    "unpack_image",
    "violations",
]

ITEM_HEAD = struct.Struct("<HBB")
ITEMS_LENGTH_MAX = MTU - 8 - 2
"""What the payload of CFG_SET holds beside header, check value and transaction."""


class BadImage(ValueError):
    """Bytes that are not an image of this registry; the message says what does not fit."""


def default_config() -> dict[str, Value]:
    """A new dictionary with every parameter at its factory value."""
    return {row.name: respelled(row, _listed(row.default)) for row in PARAMETERS}


def pack_image(config: Mapping[str, Value]) -> bytes:
    """The image of a whole configuration. Raises BadValue for the first value that cannot be put.

    Ranges are not looked at: see violations.
    """
    return b"".join(pack_parameter(row, config[row.name]) for row in PARAMETERS)


def pack_parameter(row: Parameter, value: Value) -> bytes:
    """The bytes of one parameter's value. Raises BadValue."""
    elements = []
    for index, element in enumerate(elements_of(row, value)):
        problem = problem_of_form(row, element)
        if problem is not None:
            raise BadValue(violation_at(row, index, *problem))
        elements.append(_packed(row, element))
    return b"".join(elements)


def unpack_image(image: bytes) -> dict[str, Value]:
    """The configuration in an image, out-of-range values included. Raises BadImage."""
    if len(image) != IMAGE_LENGTH:
        raise BadImage(f"The image has {len(image)} bytes; this registry needs {IMAGE_LENGTH}.")
    return {row.name: _unpack_parameter(row, image) for row in PARAMETERS}


def set_items(changes: Mapping[str, Value], length_max: int = ITEMS_LENGTH_MAX) -> list[bytes]:
    """The changes as the `items` of as few CFG_SET as their length allows, in id order.

    Raises BadValue for an unknown name or a value that cannot be put.
    """
    for name in changes:
        if name not in PARAMETER_BY_NAME:
            raise BadValue(unknown_parameter(name))
    chunks = [b""]
    for row in PARAMETERS:
        if row.name not in changes:
            continue
        for item in _items(row, pack_parameter(row, changes[row.name]), length_max):
            if len(chunks[-1]) + len(item) > length_max:
                chunks.append(b"")
            chunks[-1] += item
    return [chunk for chunk in chunks if chunk]


def violations(config: Mapping[str, Value], complete: bool = True) -> list[ParameterViolation]:
    """Everything that is wrong with a configuration; empty when the unit will take it.

    In the order of the unit's own check: parameters by id, at most one violation for an element,
    then the rules between parameters. complete: False for some parameters only, of which none is
    missed.
    """
    found = [unknown_parameter(name) for name in config if name not in PARAMETER_BY_NAME]
    for row in PARAMETERS:
        if row.name not in config:
            if not complete:
                continue
            text = f"{row.name} is missing from the configuration."
            found.append(ParameterViolation(row.name, 0, "MISSING_PARAMETER", text))
        else:
            found += _violations_of(row, config[row.name])
    for order in ORDERS:
        low, high = config.get(order.low), config.get(order.high)
        if not isinstance(low, int | float) or not isinstance(high, int | float):
            continue
        if float32(low) >= float32(high):
            text = f"{order.high} ({high}) must be greater than {order.low} ({low})."
            found.append(ParameterViolation(order.high, 0, order.violation, text))
    return found


def _violations_of(row: Parameter, value: Value) -> Iterator[ParameterViolation]:
    try:
        elements = elements_of(row, value)
    except BadValue as error:
        yield error.violation
        return
    before: float | None = None
    for index, element in enumerate(elements):
        problem = problem_of_form(row, element)
        if problem is not None:
            yield violation_at(row, index, *problem)
            before = None
            continue
        if row.type == "text" or row.enum is not None or element is None:
            continue
        number = float32(element)
        problem = problem_of_range(row, number)
        if problem is None and row.increasing and before is not None:
            problem = problem_of_step(row, before, number)
        if problem is not None:
            yield violation_at(row, index, *problem)
        before = number


def _packed(row: Parameter, element: Value) -> bytes:
    if row.type == "text":
        return str(element).encode().ljust(row.length, b"\0")
    if row.enum is not None:
        number = choice_number(row, element)
        assert number is not None
        return bytes([number])
    if element is None:
        return struct.pack("<I", NONE_BITS)
    if row.type == "f32":
        return struct.pack("<f", float32(element))
    assert isinstance(element, int | float)
    return struct.pack("<" + STRUCT_CODES[row.type], int(element))


def _unpack_parameter(row: Parameter, image: bytes) -> Value:
    elements: list[Any] = [
        _unpacked(row, image[at : at + row.length])
        for at in range(row.image_offset, row.image_offset + row.size, row.length)
    ]
    for size in reversed(row.shape):
        elements = [list(elements[at : at + size]) for at in range(0, len(elements), size)]
    return cast(Value, elements[0])


def _unpacked(row: Parameter, element: bytes) -> Value:
    """One element; a text that is not UTF-8 shows U+FFFD, an unknown choice its number, and what is
    none is None.

    A float is the shortest decimal that is the same float32: 0.01, not 0.009999999776.
    """
    if row.type == "text":
        return element.rstrip(b"\0").decode(errors="replace")
    if row.may_be_none and struct.unpack("<I", element)[0] == NONE_BITS:
        return None
    number: float | int = struct.unpack("<" + STRUCT_CODES[row.type], element)[0]
    if row.enum is not None:
        names = {int(member): word_of(member.name) for member in ENUM_BY_NAME[row.enum]}
        return names.get(int(number), int(number))
    return float(str(np.float32(number))) if row.type == "f32" else number


def _items(row: Parameter, data: bytes, length_max: int) -> Iterator[bytes]:
    """One item, or several where a parameter alone is longer than a message holds."""
    step = (length_max - ITEM_HEAD.size) // row.length
    for first in range(0, row.count, step):
        values = data[first * row.length : (first + step) * row.length]
        yield ITEM_HEAD.pack(row.id, first, len(values) // row.length) + values


def _listed(value: Default) -> Any:
    return [_listed(item) for item in value] if isinstance(value, tuple) else value
