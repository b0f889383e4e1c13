"""The shapes the generated tables are made of: a message, a parameter, a channel.

Pure data and the one generic way between a message and its bytes, so that the generated file
holds nothing but facts from the registry.
"""

import struct
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Self, TypeAlias

Scalar: TypeAlias = int | float | str
Value: TypeAlias = Scalar | list[Scalar] | list[list[Scalar]] | None
"""A parameter in a configuration: a number, a text, a choice, nested lists, or none."""

Default: TypeAlias = "float | int | str | tuple[Default, ...] | None"
ParameterType: TypeAlias = Literal["f32", "u8", "u16", "u32", "text"]

STRUCT_CODES = {"u8": "B", "u16": "H", "u32": "I", "u64": "Q", "i16": "h", "i32": "i", "f32": "f"}
HALF_BITS = 16
HALF_MASK = 0xFFFF
HIGH_HALF = struct.Struct("<H")
NONE_BITS = 0x7FC00000
"""The one float32 that says none: the quiet NaN without a payload. No other NaN is a value."""
MISSING = -32768
"""The telemetry count that stands for no value."""


class ShortPayload(ValueError):
    """A payload ends before the last field its message must have."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a message: its name, its type, and how many (1 for a plain value).

    high_of: the field whose bits 16 up these are, "" for a field of its own. The message has one
    number for both; a payload of a peer that does not know the high half ends before it, and then
    these bits are 0.
    """

    name: str
    type: str
    count: int = 1
    high_of: str = ""


class Message:
    """Base of every generated message: fields in the order of the wire, little-endian.

    A `u8` array is `bytes`; any other array a tuple; a last field of type `bytes` takes the rest;
    a field and its high half are one number.
    """

    __slots__ = ()
    LAYOUT: ClassVar[tuple[Field, ...]] = ()
    LENGTH: ClassVar[int] = 0
    """Bytes of the fixed fields: the shortest payload that is accepted."""
    MESSAGE_ID: ClassVar[int] = 0
    """Of a request or response; 0 for the fields of an event."""

    @classmethod
    def from_bytes(cls, payload: bytes) -> Self:
        """The message in `payload`. Longer payloads come from a newer minor and are accepted.

        Raises ShortPayload if a field is missing.
        """
        if len(payload) < cls.LENGTH:
            raise ShortPayload(f"{cls.__name__} needs {cls.LENGTH} bytes, got {len(payload)}")
        values: list[Any] = []
        at = 0
        for field in cls.LAYOUT:
            if field.type == "bytes":
                values.append(bytes(payload[at:]))
                break
            if field.high_of:
                if at + HIGH_HALF.size <= len(payload):
                    place = [one.name for one in cls.LAYOUT].index(field.high_of)
                    values[place] |= HIGH_HALF.unpack_from(payload, at)[0] << HALF_BITS
                at += HIGH_HALF.size
                continue
            code = "<" + (f"{field.count}" if field.count > 1 else "") + STRUCT_CODES[field.type]
            size = struct.calcsize(code)
            if field.type == "u8" and field.count > 1:
                values.append(bytes(payload[at : at + size]))
            else:
                numbers = struct.unpack_from(code, payload, at)
                values.append(numbers if field.count > 1 else numbers[0])
            at += size
        return cls(*values)

    def to_bytes(self) -> bytes:
        """The payload. Raises struct.error or ValueError if a value does not fit its field."""
        parts: list[bytes] = []
        halved = {field.high_of for field in self.LAYOUT if field.high_of}
        for field in self.LAYOUT:
            value = getattr(self, field.high_of or field.name)
            if field.high_of:
                parts.append(HIGH_HALF.pack(value >> HALF_BITS))
            elif field.name in halved:
                parts.append(HIGH_HALF.pack(value & HALF_MASK))
            elif field.type == "bytes":
                parts.append(value)
            elif field.type == "u8" and field.count > 1:
                if len(value) != field.count:
                    raise ValueError(f"{field.name} takes {field.count} bytes, got {len(value)}")
                parts.append(value)
            elif field.count > 1:
                parts.append(struct.pack(f"<{field.count}{STRUCT_CODES[field.type]}", *value))
            else:
                parts.append(struct.pack("<" + STRUCT_CODES[field.type], value))
        return b"".join(parts)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One row of the parameter table.

    `shape` is () for one value; a text has `length` bytes each; `min` and `max` are None where
    the type or the enumeration is the only limit; `image_offset` is in bytes.
    """

    id: int
    name: str
    group: str
    type: ParameterType
    unit: str
    shape: tuple[int, ...]
    length: int
    min: float | None
    max: float | None
    enum: str | None
    increasing: bool
    default: Default
    access: int
    image_offset: int
    doc: str
    ratchet: bool = False
    """Going down is free, going up needs a token."""
    least_step: float = 0.0
    """Least distance of neighbours in an increasing list, to a hundredth."""
    record: str = "TUNABLE"
    """The record of the unit's flash that keeps it."""
    may_be_none: bool = False
    """A single float may have no value; on the wire and in flash that is NONE_BITS."""

    @property
    def count(self) -> int:
        """How many elements, 1 for a plain value."""
        count = 1
        for size in self.shape:
            count *= size
        return count

    @property
    def size(self) -> int:
        """Bytes in the image."""
        return self.count * self.length

    @property
    def of_the_unit(self) -> bool:
        """Whether it was measured or set for one unit and its bike: no part of a set-up for another
        one."""
        return self.record != "TUNABLE"


@dataclass(frozen=True, slots=True)
class Channel:
    """One telemetry channel: value = count * scale, except MISSING."""

    id: int
    name: str
    unit: str
    scale: float
    doc: str


@dataclass(frozen=True, slots=True)
class Fault:
    """One row of the fault table: its bit, what it does (a `Severity`), and two texts."""

    bit: int
    name: str
    severity: int
    rider_text: str
    """What the rider reads on the display: what to do now."""
    mechanic_text: str
    """What a mechanic measures and mends."""


@dataclass(frozen=True, slots=True)
class Order:
    """A rule between two parameters: `low` must be less than `high`."""

    low: str
    high: str
    violation: str


@dataclass(frozen=True, slots=True)
class Band:
    """What a dealer may set around what the factory measured; beyond it the maker's token.

    within_pct: of the value of `around`; else `within`, in `unit`, and `times` names the parameter
    that a distance is multiplied with to be in it.
    """

    parameter: str
    around: str
    within_pct: float | None
    within: float | None
    times: str | None
    unit: str
