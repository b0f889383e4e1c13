"""SPEC.md as a stranger reads it: its tables, and a codec made of nothing else."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from pathlib import Path

SPEC = Path(__file__).resolve().parents[3] / "firmware_protocol" / "SPEC.md"
CODES = {"u8": "B", "u16": "H", "u32": "I", "u64": "Q", "i16": "h", "i32": "i", "f32": "f"}

Fields = dict[str, object]


@dataclass(frozen=True)
class Field:
    name: str
    type: str
    count: int

    @property
    def size(self) -> int:
        return struct.calcsize("<" + CODES[self.type]) * self.count


@dataclass(frozen=True)
class Message:
    id: int
    name: str
    request: tuple[Field, ...]
    response: tuple[Field, ...]


@dataclass(frozen=True)
class Parameter:
    id: int
    name: str
    type: str
    image_byte: int


class Page:
    """Messages and events by number and name, channels, parameters and statuses."""

    def __init__(self) -> None:
        text = SPEC.read_text(encoding="utf-8")
        self.text = text
        self.messages = {message.name: message for message in _messages(text)}
        self.message_names = {message.id: message.name for message in self.messages.values()}
        self.events = _events(text)
        self.channels = {
            name: (int(number), float(scale))
            for number, name, scale in re.findall(
                r"(?m)^\| (\d+) \| (\w+) \| [^|]* \| ([\d.e-]+) \|", _section(text, "channels")
            )
        }
        self.parameters = {
            name: Parameter(int(number, 16), name, kind, int(at))
            for number, name, kind, at in re.findall(
                r"(?m)^### 0x(\w{4}) (\w+)\n\n.*\n\n(\w+).* at image byte (\d+)",
                _section(text, "parameters"),
            )
        }
        self.enumerations = {
            name: {word: int(number) for number, word in re.findall(r"(\d+) ([A-Z]\w*)", members)}
            for name, members in re.findall(
                r"(?m)^### (\w+)\n\n.*\n\n(.*)\.$", _section(text, "enumerations")
            )
        }
        self.statuses = {number: word for word, number in self.enumerations["status"].items()}


def _section(text: str, name: str) -> str:
    """What stands between the markers of a table."""
    _, _, rest = text.partition(f"<!-- generated: {name} -->")
    return rest.partition("<!-- end generated -->")[0]


def _fields(words: str) -> tuple[Field, ...]:
    return tuple(
        Field(name, kind, int(count or 1))
        for name, kind, count in re.findall(
            r"(\w+) (u8|u16|u32|u64|i16|i32|f32|bytes)(?:\[(\d+)\])?", words
        )
    )


def _messages(text: str) -> list[Message]:
    rows = re.findall(
        r"(?m)^### 0x(\w{4}) (\w+)\n\n.*\n\n- Request: (.*)\n- Response: (.*)$",
        _section(text, "messages"),
    )
    return [
        Message(int(i, 16), name, _fields(asked), _fields(told)) for i, name, asked, told in rows
    ]


def _events(text: str) -> dict[int, tuple[str, tuple[Field, ...]]]:
    rows = re.findall(r"(?m)^\| (\d+) \| (\w+) \| (.*) \|$", _section(text, "events"))
    return {int(code): (name, _fields(words)) for code, name, words in rows}


def pack(fields: tuple[Field, ...], values: Fields) -> bytes:
    """A payload. A field `x_high` is bits 16 up of the number `x`."""
    payload = b""
    for field in fields:
        low = field.name.removesuffix("_high")
        if field.type == "bytes":
            payload += bytes(values.get(field.name, b""))  # type: ignore[call-overload]
        elif low != field.name:
            payload += struct.pack("<H", int(str(values[low])) >> 16)
        elif f"{field.name}_high" in [one.name for one in fields]:
            payload += struct.pack("<H", int(str(values[field.name])) & 0xFFFF)
        elif field.count > 1:
            numbers: tuple[int, ...] = tuple(values[field.name])  # type: ignore[arg-type]
            payload += struct.pack(f"<{field.count}{CODES[field.type]}", *numbers)
        else:
            payload += struct.pack("<" + CODES[field.type], values[field.name])
    return payload


def unpack(fields: tuple[Field, ...], payload: bytes) -> Fields:
    """The fields of a payload, which may be longer than they. Raises struct.error if shorter."""
    values: Fields = {}
    at = 0
    for field in fields:
        if field.type == "bytes":
            values[field.name] = payload[at:]
            break
        low = field.name.removesuffix("_high")
        if low in values:
            high = int.from_bytes(payload[at : at + 2], "little") if at + 2 <= len(payload) else 0
            values[low] = int(str(values[low])) | high << 16
        else:
            found = struct.unpack_from(f"<{field.count}{CODES[field.type]}", payload, at)
            values[field.name] = found if field.count > 1 else found[0]
        at += field.size
    return values
