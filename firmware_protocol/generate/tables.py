"""What every reader of registry.toml needs: named numbers, sizes of types, and the refusal."""

import struct
from dataclasses import dataclass

from firmware_protocol.layout import STRUCT_CODES

SIZES = {name: struct.calcsize("<" + code) for name, code in STRUCT_CODES.items()}
"""Bytes of a value on the wire, by type."""


class BadRegistry(ValueError):
    """registry.toml breaks one of its own rules; the message names the row."""


@dataclass(frozen=True)
class Table:
    """An enumeration, or flags whose values are bit numbers."""

    name: str
    doc: str
    members: dict[str, int]
