"""The configuration as a dictionary, as the unit's image, and as the items that change it.

Names are the registry's. Values are floats and ints, str for texts, the member's name for
enumerations ("FUZZY", "PB"), nested lists for shapes. The check here is the host's, before
anything is sent; the unit checks again for itself.
"""

import math
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from firmware_protocol._generated import (
    ENUM_BY_NAME,
    IMAGE_LENGTH,
    MTU,
    ORDERS,
    PARAMETER_BY_NAME,
    PARAMETERS,
)
from firmware_protocol.layout import STRUCT_CODES, Default, Parameter, Value

ITEM_HEAD = struct.Struct("<HBB")
ITEMS_LENGTH_MAX = MTU - 8 - 2
"""What the payload of CFG_SET holds beside header, check value and transaction."""

INTEGER_LIMITS = {"u8": 0xFF, "u16": 0xFFFF}


class BadImage(ValueError):
    """Bytes that are not an image of this registry; the message says what does not fit."""


class BadValue(ValueError):
    """A value cannot be put into its parameter; `violation` says which and why."""

    def __init__(self, violation: "ParameterViolation") -> None:
        super().__init__(violation.message)
        self.violation = violation


@dataclass(frozen=True, slots=True)
class ParameterViolation:
    """One wrong value. `index` is the element in the order of the image.

    `code` is a name of the registry's `violation`, or one only the host can meet:
    UNKNOWN_PARAMETER, WRONG_SHAPE, NOT_A_NUMBER, TOO_LONG, MISSING_PARAMETER.
    """

    field: str
    index: int
    code: str
    message: str


def default_config() -> dict[str, Value]:
    """A new dictionary with every parameter at its factory value."""
    return {row.name: _listed(row.default) for row in PARAMETERS}


def pack_image(config: Mapping[str, Value]) -> bytes:
    """The image of a whole configuration. Raises BadValue for the first value that cannot be put.

    Ranges are not looked at: see violations.
    """
    return b"".join(pack_parameter(row, config[row.name]) for row in PARAMETERS)


def pack_parameter(row: Parameter, value: Value) -> bytes:
    """The bytes of one parameter's value. Raises BadValue."""
    elements = []
    for index, element in enumerate(_elements(row, value)):
        problem = _problem_of_form(row, element)
        if problem is not None:
            raise BadValue(_violation(row, index, *problem))
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
            raise BadValue(_unknown(name))
    chunks = [b""]
    for row in PARAMETERS:
        if row.name not in changes:
            continue
        for item in _items(row, pack_parameter(row, changes[row.name]), length_max):
            if len(chunks[-1]) + len(item) > length_max:
                chunks.append(b"")
            chunks[-1] += item
    return [chunk for chunk in chunks if chunk]


def violations(config: Mapping[str, Value]) -> list[ParameterViolation]:
    """Everything that is wrong with a configuration; empty when the unit will take it.

    In the order of the unit's own check: parameters by id, at most one violation for an element,
    then the rules between parameters.
    """
    found = [_unknown(name) for name in config if name not in PARAMETER_BY_NAME]
    for row in PARAMETERS:
        if row.name not in config:
            text = f"{row.name} is missing from the configuration."
            found.append(ParameterViolation(row.name, 0, "MISSING_PARAMETER", text))
        else:
            found += _violations_of(row, config[row.name])
    for order in ORDERS:
        low, high = config.get(order.low), config.get(order.high)
        if not isinstance(low, int | float) or not isinstance(high, int | float):
            continue
        if _float32(low) >= _float32(high):
            text = f"{order.high} ({high}) must be greater than {order.low} ({low})."
            found.append(ParameterViolation(order.high, 0, order.violation, text))
    return found


def _violations_of(row: Parameter, value: Value) -> Iterator[ParameterViolation]:
    try:
        elements = _elements(row, value)
    except BadValue as error:
        yield error.violation
        return
    before: float | None = None
    for index, element in enumerate(elements):
        problem = _problem_of_form(row, element)
        if problem is not None:
            yield _violation(row, index, *problem)
            before = None
            continue
        if row.type == "text" or row.enum is not None:
            continue
        number = _float32(element)
        problem = _problem_of_range(row, number)
        if problem is None and row.increasing and before is not None and number <= before:
            problem = ("NOT_INCREASING", f"must be greater than {before:g}, the value before it")
        if problem is not None:
            yield _violation(row, index, *problem)
        before = number


def _problem_of_form(row: Parameter, element: Value) -> tuple[str, str] | None:
    """Why an element cannot be put into the image at all, as code and words."""
    if row.type == "text":
        return _problem_of_text(row, element)
    if row.enum is not None:
        names = list(ENUM_BY_NAME[row.enum].__members__)
        if isinstance(element, str) and element in names:
            return None
        return "NOT_A_CHOICE", f"must be one of {', '.join(names)}"
    if isinstance(element, bool) or not isinstance(element, int | float):
        return "NOT_A_NUMBER", "must be a number"
    if row.type == "f32":
        return None
    if not math.isfinite(_float32(element)):
        return "NOT_FINITE", "must be a finite number"
    if element != int(element):
        return "NOT_A_NUMBER", "must be a whole number"
    if not 0 <= element <= INTEGER_LIMITS[row.type]:
        return _problem_of_range(row, float(element))
    return None


def _problem_of_text(row: Parameter, element: Value) -> tuple[str, str] | None:
    if not isinstance(element, str):
        return "NOT_TEXT", "must be a text"
    try:
        size = len(element.encode())
    except UnicodeEncodeError:
        return "NOT_TEXT", "must be Unicode text that UTF-8 can hold"
    if size > row.length:
        return "TOO_LONG", f"must be at most {row.length} bytes in UTF-8, not {size}"
    if any(character < " " or character == "\x7f" for character in element):
        return "NOT_TEXT", "must not hold control characters"
    return None


def _problem_of_range(row: Parameter, number: float) -> tuple[str, str] | None:
    unit = f" {row.unit}" if row.unit else ""
    if not math.isfinite(number):
        return "NOT_FINITE", "must be a finite number"
    if row.min is not None and number < _float32(row.min):
        return "BELOW_MIN", f"must be at least {row.min:g}{unit}, not {number:g}"
    if row.max is not None and number > _float32(row.max):
        return "ABOVE_MAX", f"must be at most {row.max:g}{unit}, not {number:g}"
    return None


def _violation(row: Parameter, index: int, code: str, words: str) -> ParameterViolation:
    at = index
    position = ""
    for size in reversed(row.shape):
        position = f"[{at % size}]" + position
        at //= size
    return ParameterViolation(row.name, index, code, f"{row.name}{position} {words}.")


def _unknown(name: str) -> ParameterViolation:
    text = f"{name} is not a parameter of this unit."
    return ParameterViolation(name, 0, "UNKNOWN_PARAMETER", text)


def _float32(value: Value) -> float:
    """The nearest float32, which is what travels; too large for one becomes infinite."""
    assert isinstance(value, int | float)
    try:
        number: float = struct.unpack("<f", struct.pack("<f", float(value)))[0]
    except OverflowError:
        return math.inf if value > 0 else -math.inf
    return number


def _elements(row: Parameter, value: Value) -> list[Value]:
    """The value's elements in the order of the image. Raises BadValue if its shape is wrong."""
    level = [value]
    for size in row.shape:
        rows: list[Value] = []
        for item in level:
            if not isinstance(item, list | tuple) or len(item) != size:
                shape = " x ".join(str(extent) for extent in row.shape)
                raise BadValue(_violation_of_shape(row, f"must be a list of {shape} values"))
            rows.extend(item)
        level = rows
    if any(isinstance(item, list | tuple) for item in level):
        raise BadValue(_violation_of_shape(row, "holds a list where one value belongs"))
    return level


def _violation_of_shape(row: Parameter, words: str) -> ParameterViolation:
    return ParameterViolation(row.name, 0, "WRONG_SHAPE", f"{row.name} {words}.")


def _packed(row: Parameter, element: Value) -> bytes:
    if row.type == "text":
        return str(element).encode().ljust(row.length, b"\0")
    if row.enum is not None:
        return bytes([ENUM_BY_NAME[row.enum][str(element)]])
    if row.type == "f32":
        return struct.pack("<f", _float32(element))
    assert isinstance(element, int | float)
    return struct.pack("<" + STRUCT_CODES[row.type], int(element))


def _unpack_parameter(row: Parameter, image: bytes) -> Value:
    elements = [
        _unpacked(row, image[at : at + row.length])
        for at in range(row.image_offset, row.image_offset + row.size, row.length)
    ]
    for size in reversed(row.shape):
        elements = [list(elements[at : at + size]) for at in range(0, len(elements), size)]
    return elements[0]


def _unpacked(row: Parameter, element: bytes) -> Value:
    """One element; a text that is not UTF-8 shows U+FFFD, an unknown choice its number.

    A float is the shortest decimal that is the same float32: 0.01, not 0.009999999776.
    """
    if row.type == "text":
        return element.rstrip(b"\0").decode(errors="replace")
    number: float | int = struct.unpack("<" + STRUCT_CODES[row.type], element)[0]
    if row.enum is not None:
        names = {int(member): member.name for member in ENUM_BY_NAME[row.enum]}
        return names.get(int(number), int(number))
    return float(str(np.float32(number))) if row.type == "f32" else number


def _items(row: Parameter, data: bytes, length_max: int) -> Iterator[bytes]:
    """One item, or several where a parameter alone is longer than a message holds."""
    step = (length_max - ITEM_HEAD.size) // row.length
    for first in range(0, row.count, step):
        values = data[first * row.length : (first + step) * row.length]
        yield ITEM_HEAD.pack(row.id, first, len(values) // row.length) + values


def _listed(value: Default) -> Value:
    return [_listed(item) for item in value] if isinstance(value, tuple) else value
