"""A container's files as bytes, from the child that opened it to the server, one at a time.

u32 header length, header JSON, the file. The child read hostile bytes: its answer is checked.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from dataclasses import asdict, fields
from pathlib import Path
from typing import NamedTuple

from backend.formats.containers.archive import BrokenArchive, Entry, Left, entries
from backend.formats.containers.bulk import Titles
from backend.formats.outcome import rejected

HEADER = struct.Struct("<I")


class Frame(NamedTuple):
    """A frame in pieces, so that a file within is not copied. last: nothing comes behind it."""

    parts: tuple[bytes, ...]
    last: bool = False


def frames(path: Path) -> Iterator[Frame]:
    """An archive -> its files, then what is left; or why nothing can be read."""
    try:
        for item in entries(path):
            yield encode_entry(item) if isinstance(item, Entry) else encode_left(item)
    except BrokenArchive as broken:
        yield encode_broken(broken)


def encode_entry(entry: Entry) -> Frame:
    """A file within, or why it is refused."""
    header = {
        field.name: getattr(entry, field.name) for field in fields(Entry) if field.name != "data"
    }
    return framed({"entry": header, "has_data": entry.data is not None}, entry.data or b"")


def encode_left(left: Left) -> Frame:
    """What is known at the end."""
    error = None if left.error is None else [left.error.code, left.error.detail]
    header = {"titles": asdict(left.titles), "left_alone": left.left_alone, "trouble": error}
    return framed({"left": header}, last=True)


def encode_broken(broken: BrokenArchive) -> Frame:
    """Why nothing can be read."""
    return framed({"broken": [broken.outcome.code, broken.outcome.detail]}, last=True)


def framed(header: dict[str, object], data: bytes = b"", last: bool = False) -> Frame:
    head = json.dumps(header).encode()
    return Frame((HEADER.pack(len(head)), head, data), last)


def decode_frame(frame: bytes) -> Entry | Left:
    """What the child told. Raises BrokenArchive, also where it makes no sense."""
    try:
        (length,) = HEADER.unpack_from(frame)
        header = json.loads(frame[HEADER.size : HEADER.size + length])
        if "broken" in header:
            code, detail = header["broken"]
            raise BrokenArchive(rejected(str(code), str(detail)))
        if "left" in header:
            titles = header["left"]["titles"]
            by_name = {str(key): (str(a), str(b)) for key, (a, b) in titles["by_name"].items()}
            by_start = tuple((int(us), str(a), str(b)) for us, a, b in titles["by_start_us"])
            error_fields = header["left"]["trouble"]
            outcome = (
                None
                if error_fields is None
                else rejected(str(error_fields[0]), str(error_fields[1]))
            )
            return Left(Titles(by_name, by_start), int(header["left"]["left_alone"]), outcome)
        data = frame[HEADER.size + length :] if header["has_data"] else None
        return Entry(**header["entry"], data=data)
    except (struct.error, ValueError, KeyError, TypeError, AttributeError) as error:
        raise BrokenArchive(
            rejected("parser_crashed", f"The reader's answer makes no sense: {error}.")
        ) from None
