"""One parameter's value against its row: can it be put at all, and is it in range.

The host's half of the check in SPEC.md 3; numbers are compared as the float32 that travels.
"""

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import cast

import numpy as np

from firmware_protocol._generated import ENUM_BY_NAME, PARAMETER_BY_NAME
from firmware_protocol.layout import Parameter, Value
from firmware_protocol.spelling import member_of, word_of, words_of

INTEGER_LIMITS = {"u8": 0xFF, "u16": 0xFFFF, "u32": 0xFFFFFFFF}

STEP_SHARE = np.float32(0.99)
"""Of the least distance of two points: decimals that are so far apart may be nearer as float32."""


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


def problem_of_form(row: Parameter, element: Value) -> tuple[str, str] | None:
    """Why an element cannot be put into the image at all, as code and words."""
    if row.type == "text":
        return _problem_of_text(row, element)
    if row.enum is not None:
        if choice_number(row, element) is not None:
            return None
        return "NOT_A_CHOICE", f"must be one of {', '.join(choices_of(row))}"
    if element is None and row.may_be_none:
        return None
    if isinstance(element, bool) or not isinstance(element, int | float):
        return "NOT_A_NUMBER", "must be a number"
    if row.type == "f32":
        return None
    if not math.isfinite(float32(element)):
        return "NOT_FINITE", "must be a finite number"
    if element != int(element):
        return "NOT_A_NUMBER", "must be a whole number"
    if not 0 <= element <= INTEGER_LIMITS[row.type]:
        return problem_of_range(row, float(element))
    return None


def choices_of(row: Parameter) -> tuple[str, ...]:
    """What a parameter of an enumeration may be; nothing for any other."""
    return words_of(ENUM_BY_NAME[row.enum]) if row.enum is not None else ()


def choice_number(row: Parameter, element: Value) -> int | None:
    """The number a choice travels as, whatever its case; None for what is no choice."""
    if row.enum is None or not isinstance(element, str):
        return None
    try:
        return int(member_of(ENUM_BY_NAME[row.enum], element))
    except KeyError:
        return None


def respelled(row: Parameter, value: Value) -> Value:
    """A value with its choices in their one spelling; what is no choice stays as it is."""
    if row.enum is None:
        return value
    if isinstance(value, list | tuple):
        return cast(Value, [respelled(row, element) for element in value])
    number = choice_number(row, value)
    return value if number is None else word_of(ENUM_BY_NAME[row.enum](number).name)


def in_one_spelling(config: Mapping[str, Value]) -> dict[str, Value]:
    """A configuration with every choice in its one spelling; nothing else is looked at."""
    return {
        name: respelled(PARAMETER_BY_NAME[name], value) if name in PARAMETER_BY_NAME else value
        for name, value in config.items()
    }


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


def problem_of_range(row: Parameter, number: float) -> tuple[str, str] | None:
    """Why a number is not one the parameter may have, as code and words."""
    unit = f" {row.unit}" if row.unit else ""
    if not math.isfinite(number):
        return "NOT_FINITE", "must be a finite number"
    if row.min is not None and number < float32(row.min):
        return "BELOW_MIN", f"must be at least {row.min:g}{unit}, not {shown(number)}"
    if row.max is not None and number > float32(row.max):
        return "ABOVE_MAX", f"must be at most {row.max:g}{unit}, not {shown(number)}"
    return None


def problem_of_step(row: Parameter, before: float, number: float) -> tuple[str, str] | None:
    """Why a number cannot follow the one before it in an increasing list, as code and words.

    In float32, step by step as the unit computes it, so that both agree to the bit.
    """
    if not is_too_near(before, number, row.least_step):
        return None
    return (
        "NOT_INCREASING",
        f"must be at least {row.least_step:g} above {shown(before)}, the value before it",
    )


def is_too_near(before: float, number: float, least_step: float) -> bool:
    """Whether a point is not far enough above the one before it; False beside what is no number."""
    with np.errstate(over="ignore", invalid="ignore"):
        step = np.float32(number) - np.float32(before)
        return bool(step < STEP_SHARE * np.float32(least_step))


def shown(number: float) -> str:
    """The shortest text that is the same float32, so 25.000002 is not called 25."""
    return f"{float(str(np.float32(number))):.9g}"


def violation_at(row: Parameter, index: int, code: str, words: str) -> ParameterViolation:
    """The violation of one element, its place in the shape spelled out: fuzzy_rules[4][2]."""
    at = index
    position = ""
    for size in reversed(row.shape):
        position = f"[{at % size}]" + position
        at //= size
    return ParameterViolation(row.name, index, code, f"{row.name}{position} {words}.")


def unknown_parameter(name: str) -> ParameterViolation:
    """The violation of a name that the registry does not have."""
    text = f"{name} is not a parameter of this unit."
    return ParameterViolation(name, 0, "UNKNOWN_PARAMETER", text)


def float32(value: Value) -> float:
    """The nearest float32, which is what travels; too large for one becomes infinite."""
    assert isinstance(value, int | float)
    try:
        number: float = struct.unpack("<f", struct.pack("<f", float(value)))[0]
    except OverflowError:
        return math.inf if value > 0 else -math.inf
    return number


def elements_of(row: Parameter, value: Value) -> list[Value]:
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
